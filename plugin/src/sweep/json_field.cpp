// SPDX-License-Identifier: Apache-2.0
#include "sweep/json_field.h"

#include <algorithm>
#include <stdexcept>

#include "name_pattern.h"
#include "storage_file.h"

namespace tautline {

JsonField::JsonField(const nlohmann::ordered_json& json, std::string file, std::string place)
    : m_json(json), m_file(std::move(file)), m_place(std::move(place)) {}

bool JsonField::has(const std::string& key) {
    if (!m_json.is_object()) fail("must be an object");
    m_known.insert(key);
    return m_json.contains(key);
}

JsonField JsonField::require(const std::string& key) {
    if (!has(key)) fail("has no \"" + key + "\"");
    return {m_json.at(key), m_file, m_place + "/" + key};
}

std::vector<JsonField> JsonField::getItems() const {
    if (!m_json.is_array() || m_json.empty()) fail("must be an array that is not empty");
    std::vector<JsonField> items;
    for (std::size_t i = 0; i < m_json.size(); ++i)
        items.emplace_back(m_json[i], m_file, m_place + "/" + std::to_string(i));
    return items;
}

std::vector<std::string> JsonField::getKeys() const {
    if (!m_json.is_object()) fail("must be an object");
    std::vector<std::string> keys;
    for (const auto& item : m_json.items()) keys.push_back(item.key());
    return keys;
}

std::string JsonField::getString() const {
    if (!m_json.is_string() || m_json.get_ref<const std::string&>().empty()) fail("must be a string that is not empty");
    return m_json.get<std::string>();
}

double JsonField::getNumber() const {
    if (!m_json.is_number()) fail("must be a number");
    return m_json.get<double>();
}

std::int64_t JsonField::getInteger(std::int64_t least, std::int64_t most) const {
    const bool isWhole = m_json.is_number_integer();
    if (!isWhole || m_json.get<std::int64_t>() < least || m_json.get<std::int64_t>() > most)
        fail("must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return m_json.get<std::int64_t>();
}

std::string JsonField::getText() const {
    return m_json.is_number() ? toText(getNumber()) : getString();
}

std::string JsonField::getChoice(const std::vector<std::string>& choices) const {
    const std::string word = getString();
    if (std::find(choices.begin(), choices.end(), word) == choices.end()) fail("must be one of " + listNames(choices));
    return word;
}

void JsonField::refuseUnknown() const {
    for (const std::string& key : getKeys())
        if (m_known.count(key) == 0)
            fail("has the unknown key \"" + key + "\"; known are " +
                 listNames(std::vector<std::string>(m_known.begin(), m_known.end())));
}

void JsonField::fail(const std::string& what) const {
    const std::string value = m_json.is_structured() ? "" : " is " + m_json.dump() + " and";
    throw std::runtime_error(m_file + ": " + (m_place.empty() ? "/" : m_place) + value + " " + what);
}

}  // namespace tautline
