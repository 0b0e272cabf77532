// SPDX-License-Identifier: Apache-2.0
#pragma once
/** Surfaces and force laws of one's own in model files.

A shared library that includes this file and has

    TAUTLINE_EXTENSION(extensions) {
        extensions.addSurface("WrapEgg", makeEgg);
        extensions.addForceLaw("CreepingString", readCreepingString);
    }

in one of its sources is loaded by `tautline --load FILE.so` or loadExtension(). From then on model files may have a
`<WrapEgg>` among their wrap objects and a `<CreepingString>` with a path in their ForceSet. */
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tautline/simbody/cable_force_law.h"
#include "tautline/surfaces/surface.h"
#include "tautline/version.h"

namespace tautline::models {

class Element;

/** The properties of an element that an extension reads. Every child that is asked for counts as known; the reader
refuses those that nobody asked for. What is missing, malformed, not finite or out of its limits is refused by a
ModelError with file, line, owner and value. */
class ElementProperties {
public:
    explicit ElementProperties(Element& element) : m_element(element) {}

    /** The name attribute. */
    std::string getName() const;
    double requireNumber(const std::string& tag);
    /** A number that must be greater than zero. */
    double requirePositive(const std::string& tag);
    double getNumberOr(const std::string& tag, double fallback);
    Vector3 requireVec3(const std::string& tag);
    Vector3 getVec3Or(const std::string& tag, const Vector3& fallback);
    /** Any number of numbers. */
    std::vector<double> requireNumbers(const std::string& tag);
    bool getBoolOr(const std::string& tag, bool fallback);
    std::string getTextOr(const std::string& tag, const std::string& fallback);
    /** Refuses the element. @throws ModelError with file and line */
    [[noreturn]] void fail(const std::string& what) const;

private:
    Element& m_element;
};

/** Reads a wrap object's dimensions. Place, quadrant, activity and name are read as for all wrap objects.
@return the surface in the object's frame, not null. What it throws as InvalidInput gets file and line. */
using SurfaceReader = std::function<std::shared_ptr<const Surface>(ElementProperties&)>;

/** A new law for a cable. */
using ForceLawMaker = std::function<std::unique_ptr<CableForceLaw>(const Cable&)>;
/** Reads a force's parameters. Name, path and appliesForce are read as for all forces with a path.
@return what makes the law, not null; called for every system that is built. What it throws as InvalidInput gets file
and line. */
using ForceLawReader = std::function<ForceLawMaker(ElementProperties&)>;

/** The elements that extensions have added. */
class Extensions {
public:
    /** @param element   the tag, for example WrapEgg
    @throws InvalidInput if it is empty or known already, or the reader is empty */
    void addSurface(const std::string& element, SurfaceReader reader);
    void addForceLaw(const std::string& element, ForceLawReader reader);

    /** Null if there is none. */
    const SurfaceReader* findSurface(const std::string& element) const;
    const ForceLawReader* findForceLaw(const std::string& element) const;

private:
    void requireNew(const std::string& element, bool hasReader) const;

    std::map<std::string, SurfaceReader> m_surfaces;
    std::map<std::string, ForceLawReader> m_forceLaws;
};

/** Those of this process, known to all readers of model files. Add to them before any thread reads. */
Extensions& updExtensions();

/** Loads a shared library and lets it add its elements. It stays loaded.
@throws std::runtime_error with the file if it cannot be loaded, is no extension, or was built for another version of
Tautline or another layout of Simbody; InvalidInput as Extensions */
void loadExtension(const std::filesystem::path& file);

#ifdef NDEBUG
#define TAUTLINE_EXTENSION_LAYOUT "without asserts"
#else
#define TAUTLINE_EXTENSION_LAYOUT "with asserts"
#endif
/** What extension and program must have in common. */
#define TAUTLINE_EXTENSION_BUILD "Tautline " TAUTLINE_VERSION ", Simbody " TAUTLINE_EXTENSION_LAYOUT

/** Opens the function in which an extension adds its elements. */
#define TAUTLINE_EXTENSION(extensions)                                                         \
    extern "C" __attribute__((visibility("default"))) const char* tautline_extension_build() { \
        return TAUTLINE_EXTENSION_BUILD;                                                       \
    }                                                                                          \
    extern "C" __attribute__((visibility("default"))) void tautline_extension_register(        \
        ::tautline::models::Extensions& extensions)

}  // namespace tautline::models
