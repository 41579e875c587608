// The scenario file described: as JSON Schema for editors, and in Markdown for docs/scenario.md.
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "footfall/io/scenario.hpp"
#include "io/nearest.hpp"
#include "io/scenario_keys.hpp"

namespace footfall {
namespace {

using io::Alternative;
using io::Form;
using io::Key;
using io::Table;
using Json = nlohmann::ordered_json;

// JSON Schema ---------------------------------------------------------------------------------------------------------

/// A decimal number and whatever unit follows.
constexpr const char* quantity_pattern = R"(^[ \t]*[+-]?([0-9]|\.[0-9]))";

std::string described(const Key& key) {
    std::string text = key.description;
    const std::string range = key.range.words(key.unit);
    const bool is_number = key.form == Form::number || key.form == Form::numbers || key.form == Form::inertia;
    if (is_number && key.unit != "1") text += fmt::format(" [{}]", key.unit);
    if (is_number && !range.empty()) text += fmt::format(", {}", range);
    if (key.nonzero) text += ", not all zero";
    return text;
}

Json number_schema(const Key& key) {
    Json number{{"type", "number"}};
    if (std::isfinite(key.range.low)) number[key.range.low_open ? "exclusiveMinimum" : "minimum"] = key.range.low;
    if (std::isfinite(key.range.high)) number[key.range.high_open ? "exclusiveMaximum" : "maximum"] = key.range.high;
    if (key.plain) return number;
    return {{"anyOf", Json::array({number, {{"type", "string"}, {"pattern", quantity_pattern}}})}};
}

Json array_schema(const Json& items, int length) {
    return {{"type", "array"}, {"items", items}, {"minItems", length}, {"maxItems", length}};
}

Json table_schema(const Table& table);

Json key_schema(const Key& key) {
    Json schema;
    switch (key.form) {
        case Form::text:
            schema = {{"type", "string"}};
            break;
        case Form::flag:
            schema = {{"type", "boolean"}, {"default", false}};
            break;
        case Form::number:
            schema = number_schema(key);
            break;
        case Form::numbers:
            schema = array_schema(number_schema(key), key.length);
            break;
        case Form::choice:
            schema = {{"enum", key.choices}};
            break;
        case Form::inertia: {
            Key moment = key;
            moment.range = io::positive;
            schema = {{"anyOf", Json::array({{{"enum", key.choices}},
                                             array_schema(number_schema(moment), 3),
                                             array_schema(array_schema(number_schema(key), 3), 3)})}};
            break;
        }
        case Form::table:
            schema = table_schema(key.tables.front());
            break;
        case Form::tables:
            schema = {{"type", "array"}, {"items", table_schema(key.tables.front())}, {"minItems", 1}};
            break;
    }
    schema["description"] = described(key);
    if (key.fallback.size() == 1) schema["default"] = key.fallback.front();
    if (key.fallback.size() > 1) schema["default"] = key.fallback;
    return schema;
}

/// An object with these keys and no others.
Json object_schema(const std::vector<Key>& keys) {
    Json properties = Json::object();
    Json required = Json::array();
    for (const Key& key : keys) {
        if (!key.refused.empty()) continue;
        properties[key.name] = key_schema(key);
        if (key.required) required.push_back(key.name);
    }
    Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty()) schema["required"] = required;
    return schema;
}

Json table_schema(const Table& table) {
    if (!table.alternatives.empty()) {
        Json alternatives = Json::array();
        for (const Alternative& alternative : table.alternatives) {
            std::vector<Key> keys = table.keys;
            keys.insert(keys.end(), alternative.keys.begin(), alternative.keys.end());
            Json schema = object_schema(keys);
            if (!alternative.description.empty()) schema["description"] = alternative.description;
            if (!table.selector.empty()) schema["properties"][table.selector] = {{"const", alternative.name}};
            alternatives.push_back(schema);
        }
        return {{"type", "object"}, {"anyOf", alternatives}};
    }
    Json schema = object_schema(table.keys);
    Json groups = Json::array();
    for (const io::OneOf& group : table.one_of) {
        Json choices = Json::array();
        for (const std::string& key : group.keys) choices.push_back({{"required", {key}}});
        if (!group.required) choices.push_back({{"not", {{"anyOf", choices}}}});
        groups.push_back({{"oneOf", choices}});
    }
    if (!groups.empty()) schema["allOf"] = groups;
    return schema;
}

// Markdown ------------------------------------------------------------------------------------------------------------

std::string kind_of(const Key& key) {
    switch (key.form) {
        case Form::text:
            return "string";
        case Form::flag:
            return "boolean";
        case Form::number:
            return key.plain ? "plain number" : "number";
        case Form::numbers:
            return fmt::format("{} numbers", key.length);
        case Form::choice:
            return fmt::format("`\"{}\"`", fmt::join(key.choices, "\"`, `\""));
        case Form::inertia:
            return fmt::format("`\"{}\"`, 3 or 3x3 numbers", fmt::join(key.choices, "\"`, `\""));
        case Form::table:
            return "table";
        case Form::tables:
            return "tables";
    }
    return "";
}

std::string default_of(const Key& key) {
    if (key.required) return "**required**";
    if (key.form == Form::flag) return "`false`";
    if (!key.fallback_text.empty()) return key.fallback_text;
    if (key.fallback.size() == 1) return fmt::format("`{:.6g}`", key.fallback.front());
    if (!key.fallback.empty()) return fmt::format("`[{}]`", fmt::join(key.fallback, ", "));
    return "";
}

void append_keys(std::string& page, const std::vector<Key>& keys) {
    page += "| key | value | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
    for (const Key& key : keys) {
        if (key.form == Form::table || key.form == Form::tables || !key.refused.empty()) continue;
        const bool has_unit = key.unit != "1";
        const std::string range = key.nonzero ? "not all 0" : key.range.words(key.unit);
        page += fmt::format("| `{}` | {} | {} | {} | {} | {}; `{} = {}` |\n", key.name, kind_of(key),
                            has_unit ? key.unit : "", range, default_of(key), key.description, key.name, key.example);
    }
    page += '\n';
}

void append_table(std::string& page, const Table& table, const std::string& path, bool many) {
    if (!path.empty()) {
        page += fmt::format("### `{}{}{}`\n\n{}.\n\n", many ? "[[" : "[", path, many ? "]]" : "]", table.description);
    }
    if (!table.alternatives.empty() && table.selector.empty()) {
        // The keys of whichever law there is: they stand where the law is described.
        page += "Any of the law's keys, except `law`.\n\n";
        return;
    }
    append_keys(page, table.keys);
    for (const io::OneOf& group : table.one_of) {
        page +=
            fmt::format("{} one of `{}`.\n\n", group.required ? "Exactly" : "At most", fmt::join(group.keys, "`, `"));
    }
    for (const Alternative& alternative : table.alternatives) {
        page +=
            fmt::format("#### `{} = \"{}\"`\n\n`{}`\n\n", table.selector, alternative.name, alternative.description);
        if (!alternative.keys.empty()) append_keys(page, alternative.keys);
    }
    for (const Key& key : table.keys) {
        if (key.form != Form::table && key.form != Form::tables) continue;
        append_table(page, key.tables.front(), path.empty() ? key.name : path + "." + key.name,
                     key.form == Form::tables);
    }
}

}  // namespace

std::string scenario_schema() {
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", "footfall scenario"},
                {"description", "One body over one ground. Numbers are in SI units; strings carry a unit."}};
    const io::Choices coefficients{};
    io::Choices materials{};
    materials.materials = true;
    schema.update(table_schema(io::scenario_table(coefficients)));

    // Where materials are given, the coefficients that they give cannot be, and the other way round.
    Json with = table_schema(io::scenario_table(materials))["properties"]["contact"];
    Json without = schema["properties"]["contact"];
    without["properties"].erase("material");
    schema["properties"]["contact"] = {{"description", without["description"]},
                                       {"type", "object"},
                                       {"if", {{"required", {"material"}}}},
                                       {"then", with},
                                       {"else", without}};
    return schema.dump(2);
}

std::string scenario_reference() {
    std::string page;
    append_table(page, io::scenario_table({}), "", false);
    return page;
}

}  // namespace footfall
