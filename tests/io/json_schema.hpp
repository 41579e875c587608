// A validator for the part of JSON Schema 2020-12 that the scenario's schema uses. It throws where the schema uses
// anything else, so that nothing passes because it was not looked at.
#pragma once

#include <cstddef>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

namespace footfall::test {

using Json = nlohmann::json;

inline bool has_type(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    throw std::logic_error("type " + type);
}

inline bool conforms(const Json& value, const Json& schema) {
    const auto count = [&value](const Json& schemas) {
        std::size_t n = 0;
        for (const Json& one : schemas) n += conforms(value, one) ? 1 : 0;
        return n;
    };
    static const std::set<std::string> silent{"$schema",    "title", "description", "default",
                                              "properties", "then",  "else"};
    for (const auto& [word, rule] : schema.items()) {
        bool good = true;
        if (silent.contains(word)) {
            continue;
        } else if (word == "type") {
            good = has_type(value, rule);
        } else if (word == "enum") {
            good = std::find(rule.begin(), rule.end(), value) != rule.end();
        } else if (word == "const") {
            good = value == rule;
        } else if (word == "required") {
            for (const Json& key : rule) good = good && (!value.is_object() || value.contains(key.get<std::string>()));
        } else if (word == "additionalProperties") {
            if (rule != false) throw std::logic_error("additionalProperties other than false");
            if (value.is_object()) {
                for (const auto& [key, ignored] : value.items()) good = good && schema["properties"].contains(key);
            }
        } else if (word == "items") {
            if (value.is_array()) {
                for (const Json& item : value) good = good && conforms(item, rule);
            }
        } else if (word == "minItems") {
            good = !value.is_array() || value.size() >= rule.get<std::size_t>();
        } else if (word == "maxItems") {
            good = !value.is_array() || value.size() <= rule.get<std::size_t>();
        } else if (word == "minimum") {
            good = !value.is_number() || value.get<double>() >= rule.get<double>();
        } else if (word == "maximum") {
            good = !value.is_number() || value.get<double>() <= rule.get<double>();
        } else if (word == "exclusiveMinimum") {
            good = !value.is_number() || value.get<double>() > rule.get<double>();
        } else if (word == "exclusiveMaximum") {
            good = !value.is_number() || value.get<double>() < rule.get<double>();
        } else if (word == "pattern") {
            good =
                !value.is_string() || std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()));
        } else if (word == "anyOf") {
            good = count(rule) > 0;
        } else if (word == "oneOf") {
            good = count(rule) == 1;
        } else if (word == "allOf") {
            good = count(rule) == rule.size();
        } else if (word == "not") {
            good = !conforms(value, rule);
        } else if (word == "if") {
            const char* branch = conforms(value, rule) ? "then" : "else";
            good = !schema.contains(branch) || conforms(value, schema[branch]);
        } else {
            throw std::logic_error("schema word " + word);
        }
        if (!good) return false;
    }
    if (value.is_object() && schema.contains("properties")) {
        for (const auto& [key, rule] : schema["properties"].items()) {
            if (value.contains(key) && !conforms(value[key], rule)) return false;
        }
    }
    return true;
}

}  // namespace footfall::test
