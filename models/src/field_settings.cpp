// SPDX-License-Identifier: Apache-2.0
#include "field_settings.h"

#include <charconv>
#include <cmath>
#include <sstream>

#include "tautline/models/model_error.h"

namespace tautline::models {
namespace {

constexpr const char* kForm = "ELEMENT/FIELD=VALUE or ELEMENT/FIELD=*FACTOR";

struct Setting {
    std::string given;
    std::vector<std::string> names;  ///< of the element and of those around it, outermost first
    std::string field, value;
};

[[noreturn]] void refuse(const std::string& given, const std::string& why) {
    throw ModelError("setting '" + given + "' " + why);
}

Setting parseSetting(const std::string& given) {
    Setting setting{given, {}, {}, {}};
    const std::size_t equals = given.find('=');
    if (equals == std::string::npos) refuse(given, std::string("must be ") + kForm);
    setting.value = given.substr(equals + 1);
    std::istringstream path(given.substr(0, equals));
    for (std::string name; std::getline(path, name, '/');) setting.names.push_back(name);
    if (setting.names.size() < 2 || setting.value.empty()) refuse(given, std::string("must be ") + kForm);
    setting.field = setting.names.back();
    setting.names.pop_back();
    for (const std::string& name : setting.names)
        if (name.empty() || setting.field.empty()) refuse(given, "has an empty name in it");
    return setting;
}

/** Whether an element bears the last of the names, and elements around it those before, in their order. */
bool bearsNames(pugi::xml_node node, const std::vector<std::string>& names) {
    if (node.attribute("name").value() != names.back()) return false;
    std::size_t left = names.size() - 1;
    for (node = node.parent(); node && left > 0; node = node.parent())
        if (node.attribute("name").value() == names[left - 1]) --left;
    return left == 0;
}

void findNamed(pugi::xml_node node, const std::vector<std::string>& names, std::vector<pugi::xml_node>& found) {
    for (const pugi::xml_node child : node.children()) {
        if (child.type() != pugi::node_element) continue;
        if (bearsNames(child, names)) found.push_back(child);
        findNamed(child, names, found);
    }
}

std::string listLines(const std::vector<pugi::xml_node>& nodes, const XmlSource& source) {
    std::string lines;
    for (const pugi::xml_node& node : nodes)
        lines += (lines.empty() ? "" : ", ") + std::to_string(source.findLine(node));
    return lines;
}

/** Of elements of one name that one has the field, which has no elements in it. */
pugi::xml_node findField(const Setting& setting, const XmlSource& source) {
    std::vector<pugi::xml_node> named, fields;
    findNamed(source.getRoot(), setting.names, named);
    if (named.empty()) refuse(setting.given, "meets no element of that name in " + source.getFileName());
    for (const pugi::xml_node& node : named)
        for (const pugi::xml_node field : node.children(setting.field.c_str())) fields.push_back(field);
    if (fields.empty())
        refuse(setting.given, "meets no field <" + setting.field + "> of '" + setting.names.back() + "' (line " +
                                  listLines(named, source) + " of " + source.getFileName() + ")");
    if (fields.size() > 1)
        refuse(setting.given, "meets " + std::to_string(fields.size()) + " fields (lines " + listLines(fields, source) +
                                  " of " + source.getFileName() +
                                  "): begin with the name of an element around the one that is meant");
    for (const pugi::xml_node child : fields.front().children())
        if (child.type() == pugi::node_element)
            refuse(setting.given, "meets <" + setting.field + ">, which has elements in it and no value (line " +
                                      listLines(fields, source) + " of " + source.getFileName() + ")");
    return fields.front();
}

double parseNumber(const std::string& word, const Setting& setting, const std::string& what) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
        refuse(setting.given, "has " + what + " '" + word + "', which is not a finite number");
    return value;
}

/** The numbers of a text times a factor, as short as they can be read back. */
std::string multiply(const std::string& text, const Setting& setting) {
    const double factor = parseNumber(setting.value.substr(1), setting, "the factor");
    std::istringstream words(text);
    std::string product;
    for (std::string word; words >> word;) {
        char digits[32];
        const double value = factor * parseNumber(word, setting, "to multiply");
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        product += (product.empty() ? "" : " ") + std::string(digits, end);
    }
    if (product.empty()) refuse(setting.given, "has nothing to multiply: the field is empty");
    return product;
}

}  // namespace

void applySettings(const std::vector<std::string>& settings, XmlSource& source, std::vector<ReadingNote>& notes) {
    for (const std::string& given : settings) {
        const Setting setting = parseSetting(given);
        const pugi::xml_node field = findField(setting, source);
        const std::string before = field.text().get();
        const std::string after = setting.value[0] == '*' ? multiply(before, setting) : setting.value;
        field.text().set(after.c_str());
        notes.push_back({source.findLine(field), setting.field + " of '" + setting.names.back() + "' is set to " +
                                                     after + " in place of " + before});
    }
}

}  // namespace tautline::models
