// The tables of a file after they were read: checked, converted to SI units, with their defaults.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "footfall/math/vector.hpp"
#include "io/problems.hpp"

namespace footfall::io {

struct Record;

/// The value of one key: as given in the file, checked, or its default.
struct Entry {
    Position at;  ///< of the value; of the table where the key was left out
    std::string text;
    bool flag = false;
    std::vector<double> numbers;  ///< SI
    std::vector<Record> records;  ///< one of Form::table, all of Form::tables
};

/// One table, read. Asking for a key that its description lacks is an error of the program (std::logic_error).
struct Record {
    Position at;
    std::map<std::string, Entry, std::less<>> entries;

    /// There is a value: given or a default.
    [[nodiscard]] bool has(std::string_view key) const;
    [[nodiscard]] const Entry& operator[](std::string_view key) const;
    [[nodiscard]] double number(std::string_view key) const;
    [[nodiscard]] Eigen::Vector3d vector(std::string_view key) const;
    [[nodiscard]] const std::string& text(std::string_view key) const;
    [[nodiscard]] bool flag(std::string_view key) const;
    [[nodiscard]] const Record& table(std::string_view key) const;
};

}  // namespace footfall::io
