// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tautline/paths/start_hint.h"
#include "tautline/surfaces/surface.h"

namespace tautline {

/** One element of a path: a point (origin, via point, insertion) or an obstacle that the path may touch.
Its frame E is posed in ground by the caller; a point sits at E's origin, a surface frame S is E. */
struct PathElement {
    std::string name;
    std::shared_ptr<const Surface> surface;    ///< null: a point
    StartHint hint;                            ///< how the path is asked to run about it
    Vector3 side_S = Vector3::Constant(kNaN);  ///< of PassNear and PassOnSide: the side asked for, a unit vector
    bool isAskedThroughHole = false;           ///< by PassNear: the point lies in the hole of the surface
    bool hasHole = false;                      ///< of the surface (Surface::getHole())
    bool isEndless = false;                    ///< the z axis of S never leaves the body: sides are homotopy classes
    bool isPoint() const { return surface == nullptr; }
};

/** What a path is made of, in order from origin to insertion; constant while it is solved. */
class PathProblem {
public:
    /** Appends a point. @return its element index */
    int addPoint(std::string name);
    /** Appends an obstacle. @return its element index. InvalidInput if surface is null, and as setHint() */
    int addObstacle(std::string name, std::shared_ptr<const Surface> surface, const StartHint& hint = {});

    /** As above. @param hint_S   a point near which the path shall run; none: nothing is known */
    int addObstacle(std::string name, std::shared_ptr<const Surface> surface, std::optional<Vector3> hint_S);

    /** InvalidInput if a number of the hint is not finite, a direction has no length, or the surface has no hole
    to thread. */
    void setHint(int element, const StartHint& hint);
    void setHint(int element, std::optional<Vector3> hint_S);

    /** InvalidInput unless the path begins and ends with a point. */
    void validate() const;

    /** False where the square of an obstacle's size is 0 or infinite in double precision: no path is found there. */
    bool hasUsableSizes() const { return m_hasUsableSizes; }

    /** Whether there are obstacles, in whatever pose. */
    bool hasObstacles() const { return m_hasObstacles; }

    /** True if a hint says of any obstacle how the path is to run about it. */
    bool hasHints() const { return m_numHints > 0; }

    /** True if a surface has a hole. */
    bool hasHoles() const { return m_hasHoles; }

    int getNumElements() const { return static_cast<int>(m_elements.size()); }
    const PathElement& getElement(int element) const { return m_elements[element]; }

private:
    std::vector<PathElement> m_elements;
    bool m_hasUsableSizes = true;
    bool m_hasObstacles = false;
    bool m_hasHoles = false;
    int m_numHints = 0;
};

/** Where the elements of a path are: pose X_GE of each element's frame in ground, and which take part.
A switched-off element is passed over as if it were not there (conditional points); origin and insertion
always take part. */
struct PathPose {
    std::vector<Pose> X_GE;
    std::vector<char> isActive;  ///< empty: all

    /** @throws InvalidInput unless there is one pose per element, and one flag if there are any */
    void validate(const PathProblem& problem) const;
    bool isFinite() const;
    bool hasElement(int element) const { return isActive.empty() || isActive[element]; }
};

}  // namespace tautline
