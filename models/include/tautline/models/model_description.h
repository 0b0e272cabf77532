// SPDX-License-Identifier: Apache-2.0
#pragma once
/** A musculoskeletal model as plain data: what a model file says, without a multibody system.

Units are SI and radians. Bodies are named; "ground" is the fixed body and is not in the list of bodies. Offset frames
are already resolved: whatever stood in one is given in its base body. `line` is the line of the element in the source
file. */
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tautline/models/multivariate_function.h"
#include "tautline/models/scalar_function.h"
#include "tautline/muscles/muscle_model.h"
#include "tautline/types.h"

namespace tautline {
class Cable;
class CableForceLaw;
class Surface;
}  // namespace tautline

namespace tautline::models {

inline constexpr const char* kGroundName = "ground";

struct Body {
    std::string name;
    double mass = 0.0;
    Vector3 massCenter = Vector3::Zero();
    /** About the mass center: xx, yy, zz, xy, xz, yz. */
    std::array<double, 6> inertia{};
    int line = 0;
};

struct Coordinate {
    std::string name;
    double defaultValue = 0.0;
    double defaultSpeed = 0.0;
    /** Unbounded where the file gives none. */
    std::array<double, 2> range{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    bool clamped = false;
    bool locked = false;
    /** Motion as a function of time; present only if the model enforces it. */
    std::optional<ScalarFunction> prescribedMotion;
    int line = 0;
};

/** One of the six axes of a custom joint: a turn about it or a shift along it, by function(q...). */
struct TransformAxis {
    /** The function's arguments; none: its value at 0 holds always. */
    std::vector<std::string> coordinates;
    Vector3 axis = Vector3::Zero();
    MultivariateFunction function;
    int line = 0;
};

enum class JointType { Weld, Pin, Slider, Universal, Ball, Gimbal, Planar, Free, Ellipsoid, Custom };

/** X(parent -> child) = parentOffset * X_joint(q) * inverse(childOffset). */
struct Joint {
    std::string name;
    JointType type = JointType::Weld;
    std::string parentBody;
    Pose parentOffset;
    std::string childBody;
    Pose childOffset;
    std::vector<Coordinate> coordinates;
    /** Custom joints only: three turns, each carrying the next, then three shifts. */
    std::array<TransformAxis, 6> axes;
    /** Ellipsoid joints only: the origin of the child's frame rides on this ellipsoid, its z axis along the normal. */
    Vector3 semiAxes = Vector3::Zero();
    int line = 0;
};

/** dependent = scaleFactor * function(independent...). */
struct CoordinateCoupler {
    std::string name;
    std::vector<std::string> independentCoordinates;
    std::string dependentCoordinate;
    MultivariateFunction function;
    double scaleFactor = 1.0;
    int line = 0;
};

/** A point of one body coincides with a point of another. */
struct PointConstraint {
    std::string name;
    std::string body1;
    Vector3 location1 = Vector3::Zero();
    std::string body2;
    Vector3 location2 = Vector3::Zero();
    int line = 0;
};

/** A frame of one body coincides with a frame of another. */
struct WeldConstraint {
    std::string name;
    std::string body1;
    Pose X_B1F;
    std::string body2;
    Pose X_B2F;
    int line = 0;
};

/** A point of one body stays on a line of another. */
struct PointOnLineConstraint {
    std::string name;
    std::string lineBody;
    Vector3 pointOnLine = Vector3::Zero();
    Vector3 direction = Vector3::Zero();
    std::string followerBody;
    Vector3 follower = Vector3::Zero();
    int line = 0;
};

/** Points of two bodies stay at a distance. */
struct ConstantDistanceConstraint {
    std::string name;
    std::string body1;
    Vector3 location1 = Vector3::Zero();
    std::string body2;
    Vector3 location2 = Vector3::Zero();
    double distance = 0.0;
    int line = 0;
};

using ModelConstraint =
    std::variant<CoordinateCoupler, PointConstraint, WeldConstraint, PointOnLineConstraint, ConstantDistanceConstraint>;

/** Axis z, centered. */
struct CylinderShape {
    double radius = 0.0;
    double length = std::numeric_limits<double>::infinity();
};
struct SphereShape {
    double radius = 0.0;
};
struct EllipsoidShape {
    Vector3 semiAxes = Vector3::Zero();
};
/** Ring in the xy plane; the path goes through the hole. */
struct TorusShape {
    double tubeRadius = 0.0;
    double ringRadius = 0.0;
};

/** z = x^2/a + y^2/b; the path runs below it, on the convex side. */
struct ParaboloidShape {
    double a = 0.0;
    double b = 0.0;
};
/** Ring in the xy plane whose tube has an elliptic section; the path goes through the hole. */
struct EllipticTorusShape {
    double ringRadius = 0.0;
    double radialSemiAxis = 0.0;
    double axialSemiAxis = 0.0;
};
/** Fitted to a mesh: a solid from a file, with the scale factors of the model, or a patch. */
struct MeshShape {
    std::shared_ptr<const Surface> surface;
};
/** Of an extension: extensions.h. */
struct ExtensionShape {
    std::shared_ptr<const Surface> surface;
};
using WrapShape = std::variant<CylinderShape, SphereShape, EllipsoidShape, TorusShape, ParaboloidShape,
                               EllipticTorusShape, MeshShape, ExtensionShape>;

/** As which kind of surface geodesics are computed: f(p) = 0 or x(u, v). The paths are the same. */
enum class SurfaceForm { Implicit, Parametric };

/** The side of a wrap object, in its own frame, on which a path must pass. */
enum class Quadrant { All, PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ };

struct WrapObject {
    std::string name;
    std::string body;
    /** Pose of the object's frame W in the body. */
    Pose X_BW;
    Quadrant quadrant = Quadrant::All;
    bool active = true;
    WrapShape shape;
    SurfaceForm form = SurfaceForm::Implicit;
    /** Made of a contact geometry, for a path that names it: no PathWrap can mean it. */
    bool isContactGeometry = false;
    int line = 0;
};

struct FixedLocation {};
/** The point belongs to the path only while the coordinate is within the range. */
struct ConditionalLocation {
    std::string coordinate;
    std::array<double, 2> range{};
};
/** Components in a frame F of the body; the coordinate is clipped to its range first. */
struct MovingLocation {
    std::string coordinate;
    std::array<ScalarFunction, 3> location_F;
    Pose X_BF;
};

struct PathPoint {
    std::string name;
    std::string body;
    /** In the body; not used by moving points. */
    Vector3 location = Vector3::Zero();
    std::variant<FixedLocation, ConditionalLocation, MovingLocation> kind;
    int line = 0;
};

enum class WrapMethod { Hybrid, Midpoint, Axial };

/** A geodesic from which the iteration of a path may start, in the frame of the wrap object. */
struct WrapStart {
    Vector3 point = Vector3::Zero();
    Vector3 direction = Vector3::Zero();
    double length = 0.0;
    int line = 0;
};

struct PathWrap {
    std::string name;
    /** Index into ModelDescription::wrapObjects. */
    std::size_t wrapObject = 0;
    WrapMethod method = WrapMethod::Hybrid;
    /** First and last point between which the path may wrap, counted from 1; -1 is the end. */
    std::array<int, 2> range{-1, -1};
    /** A point near which the path runs at first, in the frame of the wrap object. */
    std::optional<Vector3> hint;
    std::optional<WrapStart> start;
    int line = 0;
};

/** A path that is not laid out: its length is a function of coordinates, fitted to one that was. */
struct PathFunctions {
    std::vector<std::string> coordinates;
    MultivariateFunction length;
    /** -dl/dq for each coordinate; none: they follow from the length. */
    std::vector<MultivariateFunction> momentArms;
    /** Of the coordinates, then of their speeds; none: it follows from the moment arms. */
    std::optional<MultivariateFunction> lengtheningSpeed;
};

struct MusclePath {
    std::vector<PathPoint> points;
    std::vector<PathWrap> wraps;
    /** The wraps of one segment follow each other along the path as they do in the list. */
    bool areWrapsInOrder = false;
    /** In place of points and wraps. */
    std::optional<PathFunctions> functions;
    int line = 0;
};

struct Muscle {
    std::string name;
    /** The element's type in the file, for example Thelen2003Muscle. */
    std::string type;
    bool appliesForce = true;
    /** With the file's parameters. */
    std::shared_ptr<const MuscleModel> model;
    /** What the user should know of how the file was understood, each without the muscle's name. */
    std::vector<std::string> notes;
    MusclePath path;
    int line = 0;
};

/** An elastic string: tension = stiffness * stretch * (1 + dissipation * rate), never negative. */
struct PathSpring {
    std::string name;
    bool appliesForce = true;
    double restingLength = 0.0;
    double stiffness = 0.0;
    double dissipation = 0.0;
    MusclePath path;
    int line = 0;
};

/** Whose length is known and whose force is not. */
struct NoTension {};

/** tension = maxForce * curve(length / restingLength) while longer than that. */
struct LigamentTension {
    double restingLength = 0.0;
    double maxForce = 0.0;
    ScalarFunction curve;
};

/** Blankevoort and Huiskes (1991), Eqn. 1, damped. */
struct BlankevoortTension {
    double slackLength = 0.0;
    double stiffness = 0.0;  ///< [N] per unit of strain
    double transitionStrain = 0.0;
    double damping = 0.0;  ///< [N s]
};

/** tension = optimalForce * control. */
struct ControlledTension {
    double optimalForce = 1.0;
    std::array<double, 2> controlRange{-std::numeric_limits<double>::infinity(),
                                       std::numeric_limits<double>::infinity()};
};

/** A tension that the file, a host or a State gives. */
struct PrescribedTension {
    double tension = 0.0;  ///< [N], at first
};

/** Of an extension: extensions.h. */
struct ExtensionTension {
    std::function<std::unique_ptr<CableForceLaw>(const Cable&)> makeLaw;
};

/** A force along a path that is neither a muscle nor a path spring. */
struct PathForce {
    std::string name;
    /** The element's type in the file, for example Ligament. */
    std::string type;
    bool appliesForce = true;
    MusclePath path;
    std::variant<NoTension, LigamentTension, BlankevoortTension, ControlledTension, PrescribedTension, ExtensionTension>
        tension;
    int line = 0;
};

/** @name Forces without a path */
///@{
/** Springs and dampers that set in over `transition` beyond either limit. SI units, radians. */
struct CoordinateLimitForce {
    std::string coordinate;
    double upperLimit = 0.0, upperStiffness = 0.0;
    double lowerLimit = 0.0, lowerStiffness = 0.0;
    double damping = 0.0;
    double transition = 0.0;
};

/** force = -stiffness (q - restLength) - viscosity qdot */
struct CoordinateSpringForce {
    std::string coordinate;
    double stiffness = 0.0;
    double restLength = 0.0;
    double viscosity = 0.0;
};

/** Six springs and dampers between two frames: about x, y, z, then along them. */
struct BushingForce {
    std::string body1;
    Pose X_B1F;
    std::string body2;
    Pose X_B2F;
    std::array<double, 6> stiffness{};
    std::array<double, 6> damping{};
};

struct PointToPointSpring {
    std::string body1;
    Vector3 point1 = Vector3::Zero();
    std::string body2;
    Vector3 point2 = Vector3::Zero();
    double stiffness = 0.0;
    double restLength = 0.0;
};

/** force = optimalForce * control; with a time constant the control is that of an activation, which is multiplied. */
struct CoordinateActuator {
    std::string coordinate;
    double optimalForce = 1.0;
    std::array<double, 2> controlRange{-std::numeric_limits<double>::infinity(),
                                       std::numeric_limits<double>::infinity()};
    std::optional<double> activationTime;
    double defaultActivation = 0.0;
};

struct ContactMaterial {
    double stiffness = 0.0;
    double dissipation = 0.0;
    double staticFriction = 0.0, dynamicFriction = 0.0, viscousFriction = 0.0;
};

/** Hunt and Crossley (1975), between all of its geometries. */
struct HuntCrossleyContact {
    struct Surface {
        /** Index into ModelDescription::contactGeometries. */
        std::size_t geometry = 0;
        ContactMaterial material;
    };
    std::vector<Surface> surfaces;
    double transitionVelocity = 0.01;
};

/** A sphere on a half space, smoothed (Serrancoli et al. 2019). */
struct SmoothSphereContact {
    /** Indices into ModelDescription::contactGeometries. */
    std::size_t sphere = 0, halfSpace = 0;
    ContactMaterial material;
    double transitionVelocity = 0.01;
    double constantContactForce = 1e-5;
    double hertzSmoothing = 300.0;
    double huntCrossleySmoothing = 50.0;
};

struct BodyForce {
    std::string name;
    bool appliesForce = true;
    std::variant<CoordinateLimitForce, CoordinateSpringForce, BushingForce, PointToPointSpring, CoordinateActuator,
                 HuntCrossleyContact, SmoothSphereContact>
        law;
    int line = 0;
};
///@}

/** What a controller tells an actuator or a muscle, as a function of time. */
struct PrescribedControl {
    std::string actuator;
    ScalarFunction control;
    int line = 0;
};

/** Its points have x >= 0. */
struct HalfSpaceShape {};

/** A surface that contact forces and paths may use. */
struct ContactGeometry {
    std::string name;
    std::string body;
    Pose X_BS;
    std::variant<SphereShape, CylinderShape, EllipsoidShape, TorusShape, HalfSpaceShape> shape;
    int line = 0;
};

/** A mesh that a body looks like, such as a bone. It is only drawn. */
struct BodyMesh {
    std::string file;  ///< as the model names it; may be a bare name
    std::string body;
    Pose X_BM;
    Vector3 scale = Vector3::Ones();  ///< by which the mesh's coordinates are multiplied, in its own frame
    int line = 0;
};

/** What an element that is left out would change. */
enum class Effect {
    None,
    Forces,  ///< and so the motion of a simulation
    Motion   ///< which poses there are, and so lengths
};

/** Elements of one type in owners of one type that were read over, and why. */
struct SkippedElements {
    std::string element;
    std::string owner;
    std::string reason;
    Effect effect = Effect::None;
    int firstLine = 0;
    int count = 0;
};

/** Something that the file says and that was read as something else. */
struct ReadingNote {
    int line = 0;
    std::string text;
};

struct ModelDescription {
    std::string fileName;
    std::string name;
    int documentVersion = 0;
    Vector3 gravity = Vector3::Zero();
    std::vector<Body> bodies;
    std::vector<Joint> joints;
    /** Those that the model enforces. */
    std::vector<ModelConstraint> constraints;
    std::vector<WrapObject> wrapObjects;
    std::vector<Muscle> muscles;
    std::vector<PathSpring> springs;
    /** The other forces along paths. */
    std::vector<PathForce> pathForces;
    std::vector<BodyForce> bodyForces;
    std::vector<PrescribedControl> controls;
    std::vector<ContactGeometry> contactGeometries;
    std::vector<BodyMesh> meshes;
    std::vector<SkippedElements> skipped;
    std::vector<ReadingNote> notes;
};

/** The body, coordinate, muscle, spring or wrap object of a name; null if there is none. */
const Body* findBody(const ModelDescription& model, const std::string& name);
const Coordinate* findCoordinate(const ModelDescription& model, const std::string& name);
/** Whether a coordinate is an angle: it drives one of its joint's axes of rotation. False for unknown names. */
bool isRotational(const ModelDescription& model, const std::string& coordinate);
const Muscle* findMuscle(const ModelDescription& model, const std::string& name);
const PathSpring* findSpring(const ModelDescription& model, const std::string& name);
const PathForce* findPathForce(const ModelDescription& model, const std::string& name);
const WrapObject* findWrapObject(const ModelDescription& model, const std::string& name);

}  // namespace tautline::models
