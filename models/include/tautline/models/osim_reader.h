// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tautline/models/model_description.h"
#include "tautline/models/model_error.h"

namespace tautline::models {

struct ReadingOptions {
    /** Names or types of elements that may be left out though the reader does not know them. */
    std::vector<std::string> ignored;
    /** Nothing will be simulated: what only makes forces is never in the way. */
    bool lengthsOnly = false;
    /** Fields that get other values than the file gives them, each ELEMENT/FIELD=VALUE, or ELEMENT/FIELD=*FACTOR for
    numbers that are multiplied. The names of elements around it, before ELEMENT, tell elements of one name apart. What
    was set is in ModelDescription::notes. */
    std::vector<std::string> settings = {};
};

/** An element of a file that the reader does not know. */
struct UnknownElement {
    std::string kind;  ///< force, joint, element, ...
    std::string type;
    std::string name;  ///< may be empty
    std::string owner;
    Effect effect = Effect::Motion;  ///< what leaving it out would change
    /** Why it cannot be ignored; empty if it can. */
    std::string whyNeeded;
    int line = 0;
};

/** A file with elements that are not known. The message has a line for each of them. */
class UnknownElementsError : public ModelError {
public:
    /** @param andThen   the message of what ended the reading; empty if nothing did */
    UnknownElementsError(const std::string& fileName, std::vector<UnknownElement> elements,
                         const std::string& andThen = "");

    /** In the order of reading. */
    const std::vector<UnknownElement>& getElements() const { return m_elements; }

private:
    std::vector<UnknownElement> m_elements;
};

/** Reads an OpenSim model, document versions up to 40600.

What has no effect on the motion, or only on forces, is listed in ModelDescription::skipped; what is read otherwise than
it is written, as OpenSim does, in ModelDescription::notes. What the reader does not know is refused, so a model that
is returned has all its joints, points and wraps.

@throws UnknownElementsError with everything that is not known at once, and ModelError if the file cannot be read or a
value is refused. */
ModelDescription readOsimFile(const std::filesystem::path& file, const ReadingOptions& options = {});

/** The same from a text; `fileName` only names it in messages. */
ModelDescription readOsimText(std::string_view text, const std::string& fileName, const ReadingOptions& options = {});

/** Reads forces along paths for bodies that are there already, from a document of the elements that a Model has:
@code{.xml}
    <TautlineForces>
        <Ground>, <BodySet>      only what a Body of the name adds: WrapObjectSet, components
        <components>, <ContactGeometrySet>, <ForceSet>, <ControllerSet>
    </TautlineForces>
@endcode
A host has no coordinates by name, so conditional and moving points and functions of coordinates are refused, as are
forces without a path.

@param bodies   their names, besides "ground"
@return a description without joints, whose bodies have no mass: for HostedForces
@throws as readOsimFile() */
ModelDescription readForcesText(std::string_view text, const std::string& fileName,
                                const std::vector<std::string>& bodies, const ReadingOptions& options = {});

}  // namespace tautline::models
