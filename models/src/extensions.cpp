// SPDX-License-Identifier: Apache-2.0
#include "tautline/models/extensions.h"

#include <dlfcn.h>

#include "element.h"
#include "read_forces.h"
#include "read_wrap_objects.h"
#include "tautline/error.h"

namespace tautline::models {

std::string ElementProperties::getName() const {
    return m_element.getName();
}

double ElementProperties::requireNumber(const std::string& tag) {
    return m_element.requireNumber(tag);
}

double ElementProperties::requirePositive(const std::string& tag) {
    return m_element.requirePositive(tag);
}

double ElementProperties::getNumberOr(const std::string& tag, double fallback) {
    return m_element.getNumberOr(tag, fallback);
}

Vector3 ElementProperties::requireVec3(const std::string& tag) {
    return m_element.require(tag).getVec3();
}

Vector3 ElementProperties::getVec3Or(const std::string& tag, const Vector3& fallback) {
    return m_element.getVec3Or(tag, fallback);
}

std::vector<double> ElementProperties::requireNumbers(const std::string& tag) {
    return m_element.require(tag).getNumbers();
}

bool ElementProperties::getBoolOr(const std::string& tag, bool fallback) {
    return m_element.getBoolOr(tag, fallback);
}

std::string ElementProperties::getTextOr(const std::string& tag, const std::string& fallback) {
    const Element child = m_element.find(tag);
    return child ? child.getText() : fallback;
}

void ElementProperties::fail(const std::string& what) const {
    m_element.fail(m_element.describe() + ": " + what);
}

void Extensions::requireNew(const std::string& element, bool hasReader) const {
    require(!element.empty(), "an extension adds an element without a name");
    require(hasReader, "an extension adds the element '", element, "' without a reader");
    require(!findSurface(element) && !findForceLaw(element) && !isWrapObjectType(element) && !isForceType(element),
            "an extension adds the element '", element, "', which is known already");
}

void Extensions::addSurface(const std::string& element, SurfaceReader reader) {
    requireNew(element, reader != nullptr);
    m_surfaces[element] = std::move(reader);
}

void Extensions::addForceLaw(const std::string& element, ForceLawReader reader) {
    requireNew(element, reader != nullptr);
    m_forceLaws[element] = std::move(reader);
}

const SurfaceReader* Extensions::findSurface(const std::string& element) const {
    const auto found = m_surfaces.find(element);
    return found == m_surfaces.end() ? nullptr : &found->second;
}

const ForceLawReader* Extensions::findForceLaw(const std::string& element) const {
    const auto found = m_forceLaws.find(element);
    return found == m_forceLaws.end() ? nullptr : &found->second;
}

Extensions& updExtensions() {
    static Extensions extensions;
    return extensions;
}

void loadExtension(const std::filesystem::path& file) {
    // A name without a slash would be looked for in the system's folders.
    const std::string path = std::filesystem::absolute(file).string();
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) throw std::runtime_error("the extension cannot be loaded: " + std::string(dlerror()));
    const auto fail = [&](const std::string& what) {
        dlclose(library);
        throw std::runtime_error(file.string() + " " + what);
    };
    const auto getBuild = reinterpret_cast<const char* (*)()>(dlsym(library, "tautline_extension_build"));
    const auto add = reinterpret_cast<void (*)(Extensions&)>(dlsym(library, "tautline_extension_register"));
    if (!getBuild || !add) fail("is no extension of Tautline: it has no TAUTLINE_EXTENSION");
    if (std::string(getBuild()) != TAUTLINE_EXTENSION_BUILD)
        fail("was built for " + std::string(getBuild()) + ", but this is " + TAUTLINE_EXTENSION_BUILD);
    add(updExtensions());
}

}  // namespace tautline::models
