// SPDX-License-Identifier: Apache-2.0
#include "document.h"

#include "field_settings.h"

namespace tautline::models {

Document::Document(std::string_view text, const std::string& fileName, const ReadingOptions& options,
                   ModelDescription model)
    : m_source(text, fileName),
      m_options(options),
      m_model(std::move(model)),
      m_reading{m_source, m_options, m_model, {}},
      m_root(m_reading, m_source.getRoot()) {
    if (m_model.fileName.empty()) m_model.fileName = fileName;
    applySettings(m_options.settings, m_source, m_model.notes);
}

void Document::requireRoot(const std::string& tag) const {
    if (m_root.getTag() != tag) m_root.fail("the document is <" + m_root.getTag() + ">, not <" + tag + ">");
}

}  // namespace tautline::models
