// A TOML text, read along a description of its tables.
#include "io/document.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "footfall/io/units.hpp"
#include "io/nearest.hpp"
#include "io/toml.hpp"
#include "io/toml_scan.hpp"
#include "io/toml_words.hpp"

namespace footfall::io {

std::string_view type_of(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return "an array";
        case toml::node_type::string:
            return "a string";
        case toml::node_type::integer:
            return "an integer";
        case toml::node_type::floating_point:
            return "a number";
        case toml::node_type::boolean:
            return "a boolean";
        case toml::node_type::date:
            return "a date";
        case toml::node_type::time:
            return "a time of day";
        case toml::node_type::date_time:
            return "a date and time";
        case toml::node_type::none:
            break;
    }
    return "nothing";
}

namespace {

Position position_of(const toml::source_region& region) {
    return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column),
            region.path ? *region.path : ""};
}

/// "a length (m)"; a unit that depends on other keys is only named.
std::string kind_of_number(const Key& key) {
    return key.plain ? fmt::format("a number (in {})", key.unit) : describe(parse_unit(key.unit).dimension);
}

// More than this is seldom meant in radians: a plain number beyond it is taken for one in degrees, and refused.
constexpr double full_turn = 2 * std::numbers::pi;

std::string meant_degrees(double value) { return fmt::format("; for degrees write \"{:.6g} deg\"", value); }

/// What a number should be, with how to write it.
std::string expected_number(const Key& key) {
    if (key.plain) return fmt::format("a plain number (its unit, {}, depends on other keys)", key.unit);
    if (key.unit == "1") return "a number";
    return fmt::format("{}: a number in {}, or a string with a unit", kind_of_number(key), key.unit);
}

std::string expected_value(const Key& key) {
    switch (key.form) {
        case Form::text:
            return "a string";
        case Form::flag:
            return "true or false";
        case Form::number:
            return expected_number(key);
        case Form::numbers:
            return fmt::format("an array of {} numbers", key.length);
        case Form::choice:
            return fmt::format("one of {}", listed(key.choices));
        case Form::inertia:
            return fmt::format("one of {}, an array of three moments, or a 3x3 array", listed(key.choices));
        case Form::table:
            return "a table";
        case Form::tables:
            return "an array of tables";
    }
    return "";
}

std::vector<std::string> names_of(const std::vector<const Key*>& keys) {
    std::vector<std::string> names;
    for (const Key* key : keys) {
        if (key->refused.empty()) names.push_back(key->name);
    }
    return names;
}

class Reader {
public:
    explicit Reader(Problems& problems) : problems_(problems) {}

    /// `path` is the table's dotted path, empty for the whole document.
    Record read_table(const toml::table& node, const Position& at, const Table& table, const std::string& path) {
        Record record{at, {}};
        std::vector<const Key*> keys;
        for (const Key& key : table.keys) keys.push_back(&key);
        const bool complete = add_alternative(node, table, keys);

        std::set<std::string> meant;
        if (complete) meant = refuse_unknown(node, table, keys, path);
        for (const Key* key : keys) {
            const std::string name = name_of(*key, path);
            const toml::node* value = node.get(key->name);
            if (value && !key->refused.empty()) {
                add(position_of(key_of(node, key->name).source()), name, key->refused);
            } else if (value) {
                read_value(*value, *key, name, record);
            } else if (key->required) {
                if (!meant.contains(key->name)) refuse_missing(at, *key, path);
            } else {
                add_default(at, *key, name, record);
            }
        }
        for (const OneOf& group : table.one_of) check_one_of(node, at, group, path);
        return record;
    }

private:
    static std::string name_of(const Key& key, const std::string& path) {
        return path.empty() ? key.name : path + "." + key.name;
    }

    static const toml::key& key_of(const toml::table& node, std::string_view name) { return node.find(name)->first; }

    void add(const Position& at, const std::string& name, const std::string& message) {
        add(at, name, [&message] { return message; });
    }
    template <class Message>
        requires std::is_invocable_r_v<std::string, Message>
    void add(const Position& at, const std::string& name, const Message& message) {
        problems_.add(at, [&] { return name.empty() ? message() : fmt::format("{}: {}", name, message()); });
    }

    /// Adds the keys that the selector's value chooses. False where nothing is chosen: the rest of the table cannot
    /// be judged then.
    static bool add_alternative(const toml::table& node, const Table& table, std::vector<const Key*>& keys) {
        if (table.selector.empty()) return table.alternatives.empty();
        const auto chosen = node[table.selector].value<std::string>();
        for (const Alternative& alternative : table.alternatives) {
            if (chosen != alternative.name) continue;
            for (const Key& key : alternative.keys) keys.push_back(&key);
            return true;
        }
        return false;
    }

    /// Returns the keys that were meant by the unknown ones.
    std::set<std::string> refuse_unknown(const toml::table& node, const Table& table,
                                         const std::vector<const Key*>& keys, const std::string& path) {
        std::set<std::string> meant;
        const std::vector<std::string> names = names_of(keys);
        for (const auto& [key, value] : node) {
            const auto known = [&key = key](const Key* k) { return k->name == key.str(); };
            if (std::any_of(keys.begin(), keys.end(), known)) continue;
            if (names.empty()) {
                add(position_of(key.source()), path, [&, &key = key] {
                    return fmt::format("unknown key '{}': {}", shown(key.str()), table.without_keys);
                });
                continue;
            }
            if (meant.size() < names.size()) meant.insert(nearest(key.str(), names));
            add(position_of(key.source()), path, [&, &key = key] {
                return fmt::format("unknown key '{}'{} (keys here: {})", shown(key.str()),
                                   did_you_mean(key.str(), names), listed(names));
            });
        }
        return meant;
    }

    void refuse_missing(const Position& at, const Key& key, const std::string& path) {
        const std::string name = name_of(key, path);
        if (key.form == Form::table) {
            problems_.add(at, fmt::format("the table [{}] is missing: {}", name, key.description));
        } else if (key.form == Form::tables) {
            problems_.add(at, fmt::format("[[{}]] is missing: {}", name, key.description));
        } else {
            std::string kind;
            if (key.form == Form::choice) kind = fmt::format(" (one of {})", listed(key.choices));
            if (key.form == Form::number && key.unit != "1") kind = fmt::format(" ({})", key.unit);
            add(at, path,
                fmt::format("'{}' is missing: {}{}, for example: {} = {}", key.name, key.description, kind, key.name,
                            key.example));
        }
    }

    void check_one_of(const toml::table& node, const Position& at, const OneOf& group, const std::string& path) {
        std::vector<std::string> given;
        Position last;
        for (const std::string& name : group.keys) {
            if (!node.contains(name)) continue;
            given.push_back(name);
            const Position key = position_of(key_of(node, name).source());
            if (given.size() == 1 || problems_.before(last, key)) last = key;
        }
        if (given.size() > 1) add(last, path, fmt::format("give only one of {}", listed(given)));
        if (given.empty() && group.required) add(at, path, fmt::format("one of {} is missing", listed(group.keys)));
    }

    void add_default(const Position& at, const Key& key, const std::string& name, Record& record) {
        Entry entry{at, {}, false, {}, {}};
        switch (key.form) {
            case Form::flag:
                break;
            case Form::text:
                entry.text = key.fallback_text;
                break;
            case Form::choice:
            case Form::inertia:
                if (key.fallback_text.empty()) return;
                entry.text = key.fallback_text;
                break;
            case Form::number:
            case Form::numbers:
                if (key.fallback.empty()) return;
                entry.numbers = key.fallback;
                break;
            case Form::table: {
                // A table that needs nothing is there with its defaults.
                const Table& table = key.tables.front();
                const auto needs = [](const Key& k) { return k.required; };
                if (std::any_of(table.keys.begin(), table.keys.end(), needs)) return;
                if (std::any_of(table.one_of.begin(), table.one_of.end(), [](const OneOf& g) { return g.required; })) {
                    return;
                }
                entry.records.push_back(read_table(toml::table{}, at, table, name));
                break;
            }
            case Form::tables:
                return;
        }
        record.entries.emplace(key.name, std::move(entry));
    }

    void read_value(const toml::node& node, const Key& key, const std::string& name, Record& record) {
        Entry entry{position_of(node.source()), {}, false, {}, {}};
        bool good = true;
        switch (key.form) {
            case Form::text:
                good = read_text(node, key, name, entry);
                break;
            case Form::flag:
                good = read_flag(node, key, name, entry);
                break;
            case Form::number:
                good = read_number(node, key, name, entry.numbers);
                break;
            case Form::numbers:
                good = read_numbers(node, key, name, entry);
                break;
            case Form::choice:
                good = read_text(node, key, name, entry) && check_choice(key, name, entry);
                break;
            case Form::inertia:
                good = read_inertia(node, key, name, entry);
                break;
            case Form::table:
                if (const toml::table* table = node.as_table()) {
                    entry.records.push_back(read_table(*table, entry.at, key.tables.front(), name));
                } else {
                    good = refuse_type(node, key, name);
                }
                break;
            case Form::tables:
                good = read_tables(node, key, name, entry);
                break;
        }
        if (good) record.entries.emplace(key.name, std::move(entry));
    }

    bool refuse_type(const toml::node& node, const Key& key, const std::string& name) {
        add(position_of(node.source()), name,
            fmt::format("expected {}, got {}{}", expected_value(key), type_of(node),
                        key.form == Form::tables && node.is_table() ? fmt::format(": write [[{}]]", name) : ""));
        return false;
    }

    bool read_text(const toml::node& node, const Key& key, const std::string& name, Entry& entry) {
        const auto text = node.value_exact<std::string>();
        if (!text) return refuse_type(node, key, name);
        entry.text = *text;
        return true;
    }

    bool read_flag(const toml::node& node, const Key& key, const std::string& name, Entry& entry) {
        const auto flag = node.value_exact<bool>();
        if (!flag) return refuse_type(node, key, name);
        entry.flag = *flag;
        return true;
    }

    bool check_choice(const Key& key, const std::string& name, const Entry& entry) {
        if (std::find(key.choices.begin(), key.choices.end(), entry.text) != key.choices.end()) return true;
        add(entry.at, name,
            fmt::format("'{}' is not allowed{} ({}one of {})", shown(entry.text), did_you_mean(entry.text, key.choices),
                        key.choices_where, listed(key.choices)));
        return false;
    }

    /// Appends the number in SI units.
    bool read_number(const toml::node& node, const Key& key, const std::string& name, std::vector<double>& numbers) {
        const Position at = position_of(node.source());
        double value = 0;
        if (const auto* text = node.as_string(); text && !key.plain) {
            try {
                value = to_si(text->get(), key.unit);
            } catch (const InvalidInput& error) {
                add(at, name, error.what());
                return false;
            }
        } else if (const auto* integer = node.as_integer()) {
            value = static_cast<double>(integer->get());
        } else if (const auto* floating = node.as_floating_point()) {
            value = floating->get();
        } else {
            Key single = key;
            single.form = Form::number;
            return refuse_type(node, single, name);
        }
        if (!std::isfinite(value)) {
            add(at, name, fmt::format("{} is not allowed: must be a finite number", value));
            return false;
        }
        const bool plain_angle = key.unit == "rad" && !node.is_string();
        if (!key.range.contains(value)) {
            const std::string unit = key.unit == "1" ? "" : " " + key.unit;
            std::string said = fmt::format("{:.6g}{}", value, unit);
            if (const auto* text = node.as_string()) said = fmt::format("'{}' ({})", text->get(), said);
            add(at, name,
                fmt::format("{} is not allowed: must be {}{}", said, key.range.words(key.unit),
                            plain_angle ? meant_degrees(value) : ""));
            return false;
        }
        if (plain_angle && std::abs(value) > full_turn) {
            add(at, name,
                fmt::format("{:.6g} rad is more than a turn{}, or \"{:.6g} rad\" where that is meant", value,
                            meant_degrees(value), value));
            return false;
        }
        numbers.push_back(value);
        return true;
    }

    bool read_array(const toml::array& array, const Key& key, const std::string& name, std::vector<double>& numbers) {
        if (static_cast<int>(array.size()) != key.length) {
            add(position_of(array.source()), name,
                fmt::format("expected {} numbers, got {}", key.length, array.size()));
            return false;
        }
        bool good = true;
        for (std::size_t i = 0; i < array.size(); ++i) {
            good = read_number(*array.get(i), key, fmt::format("{}[{}]", name, i), numbers) && good;
        }
        return good;
    }

    bool read_numbers(const toml::node& node, const Key& key, const std::string& name, Entry& entry) {
        const toml::array* array = node.as_array();
        if (!array) return refuse_type(node, key, name);
        if (!read_array(*array, key, name, entry.numbers)) return false;
        const auto zero = [](double x) { return x == 0; };
        if (key.nonzero && std::all_of(entry.numbers.begin(), entry.numbers.end(), zero)) {
            add(entry.at, name, "a zero vector is not allowed: it has no direction");
            return false;
        }
        return true;
    }

    bool read_inertia(const toml::node& node, const Key& key, const std::string& name, Entry& entry) {
        if (node.is_string()) return read_text(node, key, name, entry) && check_choice(key, name, entry);
        const toml::array* array = node.as_array();
        if (!array) return refuse_type(node, key, name);
        Key row = key;
        row.form = Form::numbers;
        row.length = 3;
        if (array->empty() || !array->get(0)->is_array()) {
            row.range = positive;  // principal moments
            return read_array(*array, row, name, entry.numbers);
        }
        if (array->size() != 3) return refuse_type(node, key, name);
        bool good = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const toml::array* elements = array->get(i)->as_array();
            const std::string row_name = fmt::format("{}[{}]", name, i);
            if (!elements)
                good = refuse_type(*array->get(i), row, row_name);
            else
                good = read_array(*elements, row, row_name, entry.numbers) && good;
        }
        return good;
    }

    bool read_tables(const toml::node& node, const Key& key, const std::string& name, Entry& entry) {
        const toml::array* array = node.as_array();
        if (!array) return refuse_type(node, key, name);
        if (array->empty()) {
            add(entry.at, name, fmt::format("at least one is needed: {}", key.description));
            return false;
        }
        bool good = true;
        for (std::size_t i = 0; i < array->size(); ++i) {
            const toml::node& element = *array->get(i);
            const std::string element_name = fmt::format("{}[{}]", name, i);
            if (const toml::table* table = element.as_table()) {
                entry.records.push_back(
                    read_table(*table, position_of(element.source()), key.tables.front(), element_name));
            } else {
                add(position_of(element.source()), element_name,
                    fmt::format("expected a table, got {}", type_of(element)));
                good = false;
            }
        }
        return good;
    }

    Problems& problems_;
};

}  // namespace

struct Document::Parsed {
    toml::table root;
};

Document::Document(std::string_view text, const std::string& file, const std::vector<Setting>& settings) {
    const auto refuse = [&file](const Position& at, const std::string& message) {
        Problems(file).throw_with(at, message);
    };
    const TomlScan scan = scan_toml(text);
    if (scan.too_deep) {
        refuse(*scan.too_deep,
               fmt::format("nested deeper than {} brackets or dots: no key here is so deep", deepest_toml));
    }
    try {
        auto parsed = std::make_unique<Parsed>(Parsed{toml::parse(text, std::string_view(file))});
        for (const Setting& setting : settings) apply(setting, parsed->root);
        parsed_ = std::move(parsed);
    } catch (const toml::parse_error& error) {
        const Position at = position_of(error.source());
        // What is left open is better said where it was opened than where the text ends.
        if (scan.unclosed &&
            std::pair(scan.unclosed->at.line, scan.unclosed->at.column) <= std::pair(at.line, at.column)) {
            refuse(scan.unclosed->at, not_closed(scan.unclosed->what));
        }
        refuse(at, in_plain_words(error.description(), text, at));
    }
}

Document::~Document() = default;

bool Document::has(std::string_view path) const { return static_cast<bool>(parsed_->root.at_path(path)); }

std::optional<std::string> Document::text(std::string_view path) const {
    return parsed_->root.at_path(path).value<std::string>();
}

std::string Document::written(const std::vector<Setting>& settings) const {
    std::string head = "# Changed by";
    for (const Setting& setting : settings) head += " " + setting.place;
    // A place may have been written on several lines.
    std::replace_if(
        head.begin(), head.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    std::ostringstream text;
    text << head << "\n\n" << toml::toml_formatter(parsed_->root) << '\n';
    return text.str();
}

Record Document::read(const Table& table, Problems& problems) const {
    return Reader(problems).read_table(parsed_->root, Position{}, table, "");
}

}  // namespace footfall::io
