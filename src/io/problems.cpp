// What is wrong with a file, put into words.
#include "io/problems.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace footfall {
namespace {

std::string as_text(const std::string& file, const std::vector<ScenarioProblem>& problems) {
    std::string text;
    for (const ScenarioProblem& problem : problems) {
        if (!text.empty()) text += '\n';
        text += problem.setting.empty()
                    ? fmt::format("{}:{}:{}: {}", file, problem.line, problem.column, problem.message)
                    : fmt::format("{}: {}", problem.setting, problem.message);
    }
    return text;
}

}  // namespace

ScenarioError::ScenarioError(const std::string& file, std::vector<ScenarioProblem> problems)
    : InvalidInput(as_text(file, problems)), problems_(std::move(problems)) {}

namespace io {

void Problems::add(const Position& at, std::string message) {
    problems_.push_back({at.line, at.column, std::move(message), is_setting(at) ? at.source : ""});
}

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
    throw ScenarioError(file_, std::move(sorted));
}

}  // namespace io
}  // namespace footfall
