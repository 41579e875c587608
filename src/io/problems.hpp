// What is wrong with a file, and where.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "footfall/io/scenario.hpp"

namespace footfall::io {

/// A place in a file, from 1. Columns count characters.
struct Position {
    int line = 1;
    int column = 1;
    std::string source = {};  ///< the file, or the place of a setting (Setting::place); empty: the file
};

/// A piece of the user's text as a message shows it: on one line, and cut where it is long.
[[nodiscard]] std::string shown(std::string_view text);

/// Collects what is wrong with a file, so that a user sees all of it at once. Beyond a thousand it only counts.
class Problems {
public:
    explicit Problems(std::string file) : file_(std::move(file)) {}

    /// A message that is long is cut; what cannot be printed in it becomes an escape.
    void add(const Position& at, std::string_view message);
    /// `message()` is only made where it is kept.
    template <class Message>
        requires std::is_invocable_r_v<std::string, Message>
    void add(const Position& at, const Message& message) {
        if (full()) {
            ++more_;
        } else {
            add(at, std::string_view(std::string(message())));
        }
    }
    [[nodiscard]] bool empty() const noexcept { return problems_.empty(); }
    /// `a` is before `b`: what settings say comes after the file.
    [[nodiscard]] bool before(const Position& a, const Position& b) const;
    /// Throws ScenarioError with every problem that was kept, those of settings first, then in the order of the file;
    /// does nothing where there is none.
    void throw_if_any() const;
    /// Adds the last problem and throws as throw_if_any does.
    [[noreturn]] void throw_with(const Position& at, std::string_view message);

private:
    [[noreturn]] void throw_all() const;
    [[nodiscard]] bool is_setting(const Position& at) const { return !at.source.empty() && at.source != file_; }
    [[nodiscard]] bool full() const noexcept;

    std::string file_;
    std::vector<ScenarioProblem> problems_;
    std::size_t more_ = 0;
};

}  // namespace footfall::io
