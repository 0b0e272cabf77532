// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace tautline {

/** A value of a JSON document that is being read: it tells its place in errors, and lists keys that nobody asked for.
 */
class JsonField {
public:
    /** @param json   must outlive this
    @param file   for messages */
    JsonField(const nlohmann::ordered_json& json, std::string file, std::string place = "");

    const nlohmann::ordered_json& get() const { return m_json; }
    bool has(const std::string& key);
    /** A member. @throws std::runtime_error if there is none */
    JsonField require(const std::string& key);
    std::vector<JsonField> getItems() const;
    std::vector<std::string> getKeys() const;

    std::string getString() const;
    double getNumber() const;
    /** @throws std::runtime_error if it is no whole number of this range */
    std::int64_t getInteger(std::int64_t least, std::int64_t most) const;
    /** A number or a string, as it stands on a command line. */
    std::string getText() const;
    /** One of several words. */
    std::string getChoice(const std::vector<std::string>& choices) const;

    /** @throws std::runtime_error naming a key that was not asked for */
    void refuseUnknown() const;
    [[noreturn]] void fail(const std::string& what) const;

private:
    const nlohmann::ordered_json& m_json;
    std::string m_file, m_place;
    std::set<std::string> m_known;
};

}  // namespace tautline
