// How the tables of a scenario file are described: the one description that reading, error messages, the JSON Schema
// and the reference follow.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace footfall::io {

/// The values that a number may have; it is always finite.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false;
    bool high_open = false;

    [[nodiscard]] bool contains(double value) const noexcept;
    [[nodiscard]] bool bounded() const noexcept;
    /// "> 0", ">= 0", "from 1e-14 to 1e-3"; empty where every number is allowed. `unit` is put behind bounds other
    /// than 0.
    [[nodiscard]] std::string words(const std::string& unit) const;
};

inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), true};
inline constexpr Range not_negative{0};

/// What kind of value a key has.
enum class Form {
    text,     ///< any string
    flag,     ///< true or false
    number,   ///< a number, or a string with a unit
    numbers,  ///< `length` of those
    choice,   ///< one of `choices`
    inertia,  ///< one of `choices`, three moments, or a 3x3 tensor
    table,    ///< a table of `tables.front()`
    tables,   ///< one or more tables of `tables.front()`
};

struct Table;

/// One key of a table. A key that is not required and has neither fallback is absent where it is left out.
struct Key {
    std::string name;
    Form form = Form::number;
    std::string unit = "1";  ///< SI, of numbers; "1" where they have none
    bool plain = false;      ///< only plain numbers: the unit depends on other keys
    Range range = {};        ///< of each number
    int length = 3;          ///< of Form::numbers
    bool nonzero = false;    ///< not all numbers are zero
    bool required = false;
    std::vector<double> fallback = {};  ///< the numbers where it is left out
    std::string fallback_text = {};     ///< the text or choice where it is left out, or the default in words
    std::vector<std::string> choices = {};
    std::string choices_where = {};  ///< where there are only these: "with [contact.material], "
    std::string example = {};        ///< a value as written in a file
    std::string refused = {};        ///< not empty: the key cannot stand here, and this says why
    std::string description = {};    ///< one phrase
    std::vector<Table> tables;       ///< the table of Form::table and Form::tables, once
};

/// One set of further keys, chosen by the value of Table::selector.
struct Alternative {
    std::string name;
    std::string description;
    std::vector<Key> keys;
};

/// Keys of which at most one, or exactly one, may be given.
struct OneOf {
    std::vector<std::string> keys;
    bool required = false;
};

struct Table {
    std::string description;
    std::vector<Key> keys = {};
    std::vector<OneOf> one_of = {};
    /// The key (of Form::choice, in `keys`) that chooses among `alternatives`; empty where something outside the
    /// table does.
    std::string selector = {};
    std::vector<Alternative> alternatives = {};
    std::string without_keys = {};  ///< why there are no keys, where there are none
};

/// A key for a table, with the description that the table has.
[[nodiscard]] Key table_key(std::string name, Table table, bool required = false);

}  // namespace footfall::io
