// Access to the tables of a file by key.
#include "io/record.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace footfall::io {

bool Record::has(std::string_view key) const { return entries.contains(key); }

const Entry& Record::operator[](std::string_view key) const {
    const auto found = entries.find(key);
    if (found == entries.end()) throw std::logic_error(fmt::format("scenario: no value for '{}'", key));
    return found->second;
}

double Record::number(std::string_view key) const { return (*this)[key].numbers.at(0); }

Eigen::Vector3d Record::vector(std::string_view key) const {
    const std::vector<double>& numbers = (*this)[key].numbers;
    return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

const std::string& Record::text(std::string_view key) const { return (*this)[key].text; }

bool Record::flag(std::string_view key) const { return (*this)[key].flag; }

const Record& Record::table(std::string_view key) const { return (*this)[key].records.at(0); }

}  // namespace footfall::io
