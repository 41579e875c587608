// What is wrong with a file, put into words.
#include "io/problems.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

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

/// How many bytes the character at the start of `text` has, in UTF-8; 0 where there is none.
std::size_t character_size(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t size = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
    if (size == 0 || size > text.size()) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) return 0;
    return size;
}

/// The text as one line of UTF-8: line breaks, control characters and bytes that are no character become escapes.
std::string printable(std::string_view text) {
    std::string line;
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        const auto code = static_cast<unsigned char>(text.front());
        constexpr unsigned char first_printable = 0x20, delete_character = 0x7F;
        if (code == '\n') {
            line += "\\n";
        } else if (code == '\t') {
            line += "\\t";
        } else if (size == 0 || code < first_printable || code == delete_character) {
            line += fmt::format("\\x{:02x}", code);
        } else {
            line += text.substr(0, size);
        }
        text.remove_prefix(std::max(size, std::size_t{1}));
    }
    return line;
}

std::string as_text(const std::string& file, const std::vector<ScenarioProblem>& problems, std::size_t more) {
    std::string text;
    const std::size_t in_full = std::min(problems.size(), most_in_full);
    for (std::size_t i = 0; i < in_full; ++i) {
        const ScenarioProblem& problem = problems[i];
        if (!text.empty()) text += '\n';
        text += problem.setting.empty()
                    ? fmt::format("{}:{}:{}: {}", file, problem.line, problem.column, problem.message)
                    : fmt::format("{}: {}", problem.setting, problem.message);
    }
    const std::size_t rest = problems.size() - in_full + more;
    if (rest > 0) text += fmt::format("\n{}: ... and {} more problem{}", file, rest, rest == 1 ? "" : "s");
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
    if (problems_.empty()) return;
    std::vector<ScenarioProblem> sorted = problems_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const ScenarioProblem& a, const ScenarioProblem& b) {
        if (a.setting.empty() != b.setting.empty()) return b.setting.empty();
        return a.setting.empty() && std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    throw ScenarioError(file_, std::move(sorted), more_);
}

}  // namespace io
}  // namespace footfall
