// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tautline::models {

/** A parsed text that can tell the line of each of its elements. */
class XmlSource {
public:
    /** @throws ModelError if the text is not well-formed. */
    XmlSource(std::string_view text, std::string fileName);

    const std::string& getFileName() const { return m_fileName; }
    pugi::xml_node getRoot() const { return m_document.document_element(); }
    int findLine(pugi::xml_node node) const;
    [[noreturn]] void fail(int line, const std::string& what) const;

private:
    int findLineOfOffset(std::ptrdiff_t offset) const;

    std::string m_fileName;
    std::vector<std::ptrdiff_t> m_lineEnds;
    pugi::xml_document m_document;
};

}  // namespace tautline::models
