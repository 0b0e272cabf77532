// SPDX-License-Identifier: Apache-2.0
#include "element.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>

namespace tautline::models {

std::string Element::getRequiredName() const {
    const std::string name = getName();
    if (name.empty()) fail(getTag() + " without a name");
    return name;
}

std::string Element::describe() const {
    const std::string name = getName();
    return name.empty() ? getTag() : getTag() + " '" + name + "'";
}

std::string Element::describeField() const {
    return getTag() + " of " + Element(*m_reading, m_node.parent()).describe();
}

std::string Element::getText() const {
    // A comment splits a text into several nodes.
    std::string text;
    for (pugi::xml_node part : m_node.children())
        if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) text += part.value();
    const char* blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

void Element::fail(const std::string& what) const {
    m_reading->source.fail(findLine(), what);
}

void Element::note(const std::string& what) const {
    m_reading->model.notes.push_back({findLine(), what});
}

Element Element::find(const std::string& tag) {
    m_known.insert(tag);
    Element child(*m_reading, m_node.child(tag.c_str()));
    if (child) {
        Element second(*m_reading, child.m_node.next_sibling(tag.c_str()));
        if (second) second.fail("a second " + tag + " in " + describe());
    }
    return child;
}

Element Element::require(const std::string& tag) {
    Element child = find(tag);
    if (!child) fail(describe() + " has no " + tag);
    return child;
}

Element Element::findAny(const std::vector<std::string>& tags) {
    Element found(*m_reading, pugi::xml_node());
    for (const std::string& tag : tags) {
        const Element child = find(tag);
        if (!child) continue;
        if (found) child.fail("both " + found.getTag() + " and " + tag + " in " + describe());
        found = child;
    }
    return found;
}

Element Element::findSocket(const std::string& name) {
    const Element socket =
        findAny({"socket_" + name, "socket_" + name + "_connectee_name", "connector_" + name + "_connectee_name"});
    if (socket) return socket;
    const Element connectors = find("connectors");  // documents 30501 to 30507
    for (Element connector : connectors.getChildren())
        if (connector.getName() == name) return connector.find("connectee_name");
    return socket;
}

Element Element::requireSocket(const std::string& name) {
    const Element socket = findSocket(name);
    if (!socket) fail(describe() + " has no socket_" + name);
    return socket;
}

std::vector<Element> Element::getChildren() const {
    std::vector<Element> children;
    for (pugi::xml_node child : m_node.children())
        if (child.type() == pugi::node_element) children.emplace_back(*m_reading, child);
    return children;
}

std::vector<Element> Element::getSetMembers() {
    skip({"groups"}, "groups only gather names");
    Element objects = find("objects");
    refuseUnknown();
    return objects ? objects.getChildren() : std::vector<Element>();
}

double Element::parseNumber(const std::string& word) const {
    const char* first = word.data() + (word.size() > 1 && word[0] == '+' ? 1 : 0);
    const char* last = word.data() + word.size();
    double number = 0.0;
    const auto [end, error] = std::from_chars(first, last, number);
    const std::string where = " in " + describeField();
    if (error != std::errc() || end != last) fail("'" + word + "' is not a number" + where);
    if (!std::isfinite(number)) fail("'" + word + "' is not a finite number" + where);
    return number;
}

std::vector<std::string> Element::getWords() const {
    std::istringstream text(getText());
    return {std::istream_iterator<std::string>(text), {}};
}

std::vector<double> Element::getNumbers() const {
    std::vector<double> numbers;
    for (const std::string& word : getWords()) numbers.push_back(parseNumber(word));
    return numbers;
}

std::vector<double> Element::getNumbers(std::size_t count) const {
    const std::vector<double> numbers = getNumbers();
    if (numbers.size() != count) {
        fail(describeField() + " has " + std::to_string(numbers.size()) + " numbers instead of " +
             std::to_string(count));
    }
    return numbers;
}

double Element::getNumber() const {
    return getNumbers(1)[0];
}

Vector3 Element::getVec3() const {
    const std::vector<double> numbers = getNumbers(3);
    return {numbers[0], numbers[1], numbers[2]};
}

bool Element::getBool() const {
    std::string text = getText();
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (text == "true" || text == "1") return true;
    if (text == "false" || text == "0") return false;
    fail("'" + getText() + "' is neither true nor false in " + describeField());
}

double Element::getNumberOr(const std::string& tag, double fallback) {
    return findNumber(tag).value_or(fallback);
}

std::optional<double> Element::findNumber(const std::string& tag) {
    const Element child = find(tag);
    return child ? std::optional<double>(child.getNumber()) : std::nullopt;
}

Vector3 Element::getVec3Or(const std::string& tag, const Vector3& fallback) {
    const Element child = find(tag);
    return child ? child.getVec3() : fallback;
}

bool Element::getBoolOr(const std::string& tag, bool fallback) {
    const Element child = find(tag);
    return child ? child.getBool() : fallback;
}

double Element::requirePositive(const std::string& tag) {
    const Element child = require(tag);
    const double number = child.getNumber();
    if (!(number > 0.0)) child.fail(tag + " of " + describe() + " is " + child.getText() + ", not positive");
    return number;
}

void Element::skip(const std::vector<std::string>& tags, const std::string& reason, Effect effect) {
    for (const std::string& tag : tags) {
        m_known.insert(tag);
        for (pugi::xml_node child : m_node.children(tag.c_str()))
            Element(*m_reading, child).skipThis(getTag(), reason, effect);
    }
}

void Element::skipUnread(const std::vector<std::string>& tags, const std::string& reason) {
    for (const std::string& tag : tags)
        if (m_known.count(tag) == 0) skip({tag}, reason);
}

void Element::skipThis(const std::string& owner, const std::string& reason, Effect effect) const {
    auto& skipped = m_reading->model.skipped;
    const std::string tag = getTag();
    const auto entry = std::find_if(skipped.begin(), skipped.end(), [&](const SkippedElements& elements) {
        return elements.element == tag && elements.owner == owner && elements.reason == reason;
    });
    if (entry != skipped.end())
        ++entry->count;
    else
        skipped.push_back({tag, owner, reason, effect, findLine(), 1});
}

void Element::refuse(const std::string& kind, Effect effect) const {
    const ReadingOptions& options = m_reading->options;
    // An element without a name can be ignored by its tag.
    for (const std::string& ignored : options.ignored)
        if (ignored == getName() || ignored == getTag())
            return skipThis(getOwner().getTag(), "ignored as asked", effect);
    if (options.lengthsOnly && effect == Effect::Forces)
        return skipThis(getOwner().getTag(), "not known; without effect on lengths", effect);
    m_reading->unknown.push_back({kind, getTag(), getName(), getOwner().describe(), effect, "", findLine()});
}

void Element::refuseForGood(const std::string& kind, const std::string& why) const {
    m_reading->unknown.push_back({kind, getTag(), getName(), getOwner().describe(), Effect::Motion, why, findLine()});
}

void Element::refuseUnknown() const {
    for (const Element& child : getChildren())
        if (!m_known.count(child.getTag())) child.refuse("element", Effect::Motion);
}

Element Element::getOwner() const {
    const pugi::xml_node parent = m_node.parent();
    const bool isList = std::string(parent.name()) == "objects" || std::string(parent.name()) == "components";
    return {*m_reading, isList ? parent.parent() : parent};
}

}  // namespace tautline::models
