// Settings put into a parsed TOML document.
#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "footfall/math/error.hpp"
#include "io/read.hpp"
#include "io/text.hpp"
#include "io/toml.hpp"

namespace footfall::io {
namespace {

/// A part of a path: the key of a table, or the index of an array.
using Step = std::variant<std::string, std::size_t>;

[[noreturn]] void refuse(const Setting& setting, const std::string& why) {
    throw InvalidInput(fmt::format("{}: {}", setting.place, why));
}

bool is_key_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

// No key lies nearly as deep; tables that are made without end would exhaust the stack.
constexpr std::size_t most_steps = 20;

/// "body.spheres[1].radius"
std::vector<Step> steps_of(const Setting& setting) {
    std::vector<Step> steps;
    std::string_view rest = setting.key;
    const auto malformed = [&] {
        refuse(setting,
               fmt::format("'{}' is not a key: write it as in time.end or body.spheres[0].radius", setting.key));
    };
    for (;;) {
        const auto* const end = std::find_if_not(rest.begin(), rest.end(), is_key_letter);
        const auto length = static_cast<std::size_t>(end - rest.begin());
        if (length == 0) malformed();
        steps.emplace_back(std::string(rest.substr(0, length)));
        rest.remove_prefix(length);
        while (rest.starts_with('[')) {
            std::size_t index = 0;
            const auto [after, error] = std::from_chars(rest.data() + 1, rest.data() + rest.size(), index);
            rest.remove_prefix(static_cast<std::size_t>(after - rest.data()));
            if (error != std::errc{} || !rest.starts_with(']')) malformed();
            rest.remove_prefix(1);
            steps.emplace_back(index);
        }
        if (steps.size() > most_steps) malformed();
        if (rest.empty()) return steps;
        if (rest.front() != '.') malformed();
        rest.remove_prefix(1);
    }
}

/// `TOML` under the key "value", with the setting's place as its source.
toml::table parse_value(const Setting& setting, const std::string& written) {
    return toml::parse("value = " + written, setting.place);
}

toml::table value_of(const Setting& setting) {
    const std::string& text = setting.value;
    const bool one_line = std::none_of(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; });
    try {
        if (one_line) return parse_value(setting, text);
    } catch (const toml::parse_error&) {
        // It was meant as TOML: a string of these letters would only be refused in other words.
        const char first = text.empty() ? ' ' : text.front();
        if (first == '[' || first == '{')
            refuse(setting,
                   "the value cannot be read: write an array as in [1, \"2 cm\", 0], a table as in {key = 1}, text "
                   "and numbers with units in quotes");
        if (first == '"' || first == '\'') refuse(setting, "the value cannot be read: its quotes do not match");
    }
    // Numbers that TOML has in another form, such as .5
    if (const auto number = plain_number(trimmed(text))) return parse_value(setting, fmt::format("{}", *number));
    try {
        return parse_value(setting, text::toml_string(text));
    } catch (const toml::parse_error&) {
        refuse(setting, "the value is not UTF-8 text");
    }
}

/// Calls `put` with the node as what it is, so that it can be moved from.
template <class Put>
void move_value(toml::table& from, Put put) {
    from.get("value")->visit([&](auto& node) { put(std::move(node)); });
}

class Walk {
public:
    Walk(const Setting& setting, toml::table& root) : setting_(setting), at_(&root) {}

    /// Goes on to the node at `step`; a missing table is made.
    void go(const Step& step, bool array_follows) {
        if (const auto* key = std::get_if<std::string>(&step)) {
            toml::table& table = here_as_table();
            if (!table.contains(*key)) {
                if (array_follows)
                    refuse(setting_, fmt::format("there is no {} that an element could be set of: give the whole array",
                                                 joined(*key)));
                toml::table made = parse_value(setting_, "{}");
                move_value(made, [&](auto&& node) { insert(table, *key, std::forward<decltype(node)>(node)); });
            }
            at_ = table.get(*key);
            path_ = joined(*key);
        } else {
            const std::size_t index = std::get<std::size_t>(step);
            at_ = here_as_array(index).get(index);
            path_ += fmt::format("[{}]", index);
        }
    }

    void put(const Step& step, toml::table value) {
        if (const auto* key = std::get_if<std::string>(&step)) {
            toml::table& table = here_as_table();
            move_value(value, [&](auto&& node) { insert(table, *key, std::forward<decltype(node)>(node)); });
        } else {
            const std::size_t index = std::get<std::size_t>(step);
            toml::array& array = here_as_array(index);
            move_value(value, [&](auto&& node) {
                array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(index), std::forward<decltype(node)>(node));
            });
        }
    }

private:
    template <class Node>
    static void insert(toml::table& table, const std::string& key, Node&& node) {
        table.erase(key);  // with its place in the file
        const toml::source_region source = node.source();
        table.insert_or_assign(toml::key(key, source), std::forward<Node>(node));
    }

    [[nodiscard]] std::string joined(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

    toml::table& here_as_table() {
        if (toml::table* table = at_->as_table()) return *table;
        const bool tables = at_->is_array_of_tables();
        refuse(setting_, fmt::format("{} is {}, not a table{}", path_, type_of(*at_),
                                     tables ? fmt::format(": write {}[0]", path_) : ""));
    }

    toml::array& here_as_array(std::size_t index) {
        toml::array* array = at_->as_array();
        if (!array) refuse(setting_, fmt::format("{} is {}, not an array", path_, type_of(*at_)));
        if (index >= array->size())
            refuse(setting_,
                   fmt::format("{} has no element {}: it has {}, counted from 0", path_, index, array->size()));
        return *array;
    }

    const Setting& setting_;
    toml::node* at_;
    std::string path_;
};

}  // namespace

void apply(const Setting& setting, toml::table& root) {
    const std::vector<Step> steps = steps_of(setting);
    Walk walk(setting, root);
    for (std::size_t i = 0; i + 1 < steps.size(); ++i)
        walk.go(steps[i], std::holds_alternative<std::size_t>(steps[i + 1]));
    walk.put(steps.back(), value_of(setting));

    if (!setting.for_all_spheres) return;
    if (toml::array* spheres = root.at_path("body.spheres").as_array()) {
        for (toml::node& sphere : *spheres) {
            if (toml::table* table = sphere.as_table()) table->erase(std::get<std::string>(steps.back()));
        }
    }
}

}  // namespace footfall::io

namespace footfall {

Setting parse_setting(std::string_view text, std::string place) {
    const std::size_t equals = text.find('=');
    const std::string_view key = io::trimmed(text.substr(0, equals));
    const std::string_view value = equals == std::string_view::npos ? "" : io::trimmed(text.substr(equals + 1));
    if (key.empty() || value.empty())
        throw InvalidInput(fmt::format("{}: expected KEY=VALUE, as in time.end=2 or body.mass=\"200 g\"", place));
    return {std::string(key), std::string(value), std::move(place)};
}

}  // namespace footfall
