// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "element.h"

namespace tautline::models {

/** A document that is open for reading, with all that its reading needs. */
class Document {
public:
    /** @param fileName   for messages
    @param model   what is known already; what is read is added to it
    @throws ModelError if the text is not well-formed */
    Document(std::string_view text, const std::string& fileName, const ReadingOptions& options,
             ModelDescription model = {});
    Document(const Document&) = delete;

    Element& updRoot() { return m_root; }
    /** @throws ModelError if the root has another tag */
    void requireRoot(const std::string& tag) const;
    ModelDescription& updModel() { return m_model; }
    /** What its root says of its version. */
    std::string getVersion() const { return m_source.getRoot().attribute("Version").value(); }

    /** Calls read() and refuses what is unknown all at once.
    @throws UnknownElementsError, or what read() throws if nothing is unknown */
    template <class Read>
    void read(Read read) {
        try {
            read();
        } catch (const ModelError& error) {
            if (m_reading.unknown.empty()) throw;
            throw UnknownElementsError(m_source.getFileName(), m_reading.unknown, error.what());
        }
        if (!m_reading.unknown.empty()) throw UnknownElementsError(m_source.getFileName(), m_reading.unknown);
    }

private:
    XmlSource m_source;
    ReadingOptions m_options;
    ModelDescription m_model;
    Reading m_reading;
    Element m_root;
};

}  // namespace tautline::models
