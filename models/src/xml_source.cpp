// SPDX-License-Identifier: Apache-2.0
#include "xml_source.h"

#include <algorithm>

#include "tautline/models/model_error.h"

namespace tautline::models {

XmlSource::XmlSource(std::string_view text, std::string fileName) : m_fileName(std::move(fileName)) {
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\n') m_lineEnds.push_back(static_cast<std::ptrdiff_t>(i));
    // The encoding is fixed: a conversion would shift the offsets that the lines are found by, and
    // real files hold bytes that are not valid UTF-8 in their comments and credits.
    const pugi::xml_parse_result result =
        m_document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) fail(findLineOfOffset(result.offset), std::string("not well-formed XML: ") + result.description());
}

int XmlSource::findLine(pugi::xml_node node) const {
    return findLineOfOffset(node.offset_debug());
}

void XmlSource::fail(int line, const std::string& what) const {
    throw ModelError(m_fileName, line, what);
}

int XmlSource::findLineOfOffset(std::ptrdiff_t offset) const {
    const auto end = std::lower_bound(m_lineEnds.begin(), m_lineEnds.end(), offset);
    return 1 + static_cast<int>(end - m_lineEnds.begin());
}

}  // namespace tautline::models
