// What is wrong with a file, put into words.
#include "io/problems.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "footfall/io/printable.hpp"

namespace footfall {
namespace {

constexpr std::size_t most_kept = 1000;    // problems of one file
constexpr std::size_t most_in_full = 20;   // of those, in one text
constexpr std::size_t longest_piece = 60;  // of the user's text, in a message [bytes]
constexpr std::size_t longest_message = 2000;

/// What of `text` is within `size` bytes, without half a character at the end.
std::string_view cut(std::string_view text, std::size_t size) {
    if (text.size() <= size) return text;
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    while (size > 0 && continues(text[size])) --size;
    return text.substr(0, size);
}

std::string as_text(const std::string& file, const std::vector<ScenarioProblem>& problems, std::size_t more) {
    std::string text;
    const std::size_t in_full = std::min(problems.size(), most_in_full);
    for (std::size_t i = 0; i < in_full; ++i) {
        const ScenarioProblem& problem = problems[i];
        if (!text.empty()) text += '\n';
        text += problem.setting.empty()
                    ? fmt::format("{}:{}:{}: {}", printable(file), problem.line, problem.column, problem.message)
                    : fmt::format("{}: {}", printable(problem.setting), problem.message);
    }
    const std::size_t rest = problems.size() - in_full + more;
    if (rest > 0) text += fmt::format("\n{}: ... and {} more problem{}", printable(file), rest, rest == 1 ? "" : "s");
    return text;
}

}  // namespace

ScenarioError::ScenarioError(const std::string& file, std::vector<ScenarioProblem> problems, std::size_t more)
    : InvalidInput(as_text(file, problems, more)), problems_(std::move(problems)), more_(more) {}

namespace io {

std::string shown(std::string_view text) {
    const std::string_view kept = cut(text, longest_piece);
    return kept.size() < text.size() ? printable(kept) + "..." : printable(kept);
}

void Problems::add(const Position& at, std::string_view message) {
    if (full()) {
        ++more_;
        return;
    }
    std::string kept = printable(cut(message, longest_message));
    if (message.size() > longest_message) kept += "...";
    problems_.push_back({at.line, at.column, std::move(kept), is_setting(at) ? at.source : ""});
}

bool Problems::full() const noexcept { return problems_.size() >= most_kept; }

bool Problems::before(const Position& a, const Position& b) const {
    return std::tuple(is_setting(a), a.line, a.column) < std::tuple(is_setting(b), b.line, b.column);
}

void Problems::throw_if_any() const {
    if (!problems_.empty()) throw_all();
}

void Problems::throw_with(const Position& at, std::string_view message) {
    add(at, message);
    throw_all();
}

void Problems::throw_all() const {
    std::vector<ScenarioProblem> sorted = problems_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const ScenarioProblem& a, const ScenarioProblem& b) {
        if (a.setting.empty() != b.setting.empty()) return b.setting.empty();
        return a.setting.empty() && std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    throw ScenarioError(file_, std::move(sorted), more_);
}

}  // namespace io
}  // namespace footfall
