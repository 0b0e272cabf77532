// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tautline/models/model_description.h"
#include "tautline/models/osim_reader.h"
#include "xml_source.h"

namespace tautline::models {

/** What all readers share: the text, what the user asks for, the description under construction, and what nobody
knows. */
struct Reading {
    const XmlSource& source;
    const ReadingOptions& options;
    ModelDescription& model;
    std::vector<UnknownElement> unknown;
};

/** One XML element being read. Every child that is asked for counts as known; refuseUnknown() then lists the children
that nobody asked for, so nothing can be overlooked in silence. Each getter refuses a missing, malformed or non-finite
value with the line, the owner and the value. */
class Element {
public:
    Element(Reading& reading, pugi::xml_node node) : m_reading(&reading), m_node(node) {}

    explicit operator bool() const { return static_cast<bool>(m_node); }
    Reading& updReading() const { return *m_reading; }
    std::string getTag() const { return m_node.name(); }
    /** The name attribute, maybe empty. */
    std::string getName() const { return m_node.attribute("name").value(); }
    std::string getRequiredName() const;
    int findLine() const { return m_reading->source.findLine(m_node); }
    /** Tag and name, for messages: Body 'humerus'. */
    std::string describe() const;
    /** The same for a field, with its owner: location of PathPoint 'origin'. */
    std::string describeField() const;
    /** The text without surrounding blanks. */
    std::string getText() const;
    [[noreturn]] void fail(const std::string& what) const;
    /** Tells the user that something is read otherwise than it is written. */
    void note(const std::string& what) const;

    /** The only child of a tag, or an element that is false. Two of them are refused. */
    Element find(const std::string& tag);
    Element require(const std::string& tag);
    /** The first of several spellings of one child. */
    Element findAny(const std::vector<std::string>& tags);
    /** What a socket names, in any of the spellings that documents have had; false if there is none. */
    Element findSocket(const std::string& name);
    Element requireSocket(const std::string& name);
    /** All child elements. */
    std::vector<Element> getChildren() const;
    /** The members of a set: the children of <objects>, and of the set itself if it has none. */
    std::vector<Element> getSetMembers();

    /** The words of the text. */
    std::vector<std::string> getWords() const;
    double getNumber() const;
    std::vector<double> getNumbers() const;
    std::vector<double> getNumbers(std::size_t count) const;
    Vector3 getVec3() const;
    bool getBool() const;

    double requireNumber(const std::string& tag) { return require(tag).getNumber(); }
    double getNumberOr(const std::string& tag, double fallback);
    std::optional<double> findNumber(const std::string& tag);
    Vector3 getVec3Or(const std::string& tag, const Vector3& fallback);
    bool getBoolOr(const std::string& tag, bool fallback);
    /** A number that must be greater than zero. */
    double requirePositive(const std::string& tag);

    /** Lists the children of these tags as skipped. */
    void skip(const std::vector<std::string>& tags, const std::string& reason, Effect effect = Effect::None);
    /** The same for those of these tags that nobody has asked for. */
    void skipUnread(const std::vector<std::string>& tags, const std::string& reason);
    /** Lists this element as skipped. */
    void skipThis(const std::string& owner, const std::string& reason, Effect effect = Effect::None) const;
    /** Lists this element as unknown, or as skipped if the user ignores it or wants lengths only and they do not
    depend on it.
    @param kind   what it is: force, joint, ...
    @param effect   what leaving it out would change */
    void refuse(const std::string& kind, Effect effect) const;
    /** The same for an element without which its owner cannot be read: nobody can ignore it. */
    void refuseForGood(const std::string& kind, const std::string& why) const;
    /** Refuses the children that were not asked for. */
    void refuseUnknown() const;
    void acceptTag(const std::string& tag) { m_known.insert(tag); }

private:
    /** The element that this one is a part or a member of. */
    Element getOwner() const;
    double parseNumber(const std::string& word) const;

    Reading* m_reading;
    pugi::xml_node m_node;
    std::set<std::string> m_known;
};

}  // namespace tautline::models
