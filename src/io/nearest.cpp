// Finds what a person may have meant by a misspelt word.
#include "io/nearest.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace footfall::io {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// The word was cut short: "--tol" for "--tolerance". Where it has a letter or two, as many words begin with it.
bool begins(std::string_view candidate, std::string_view word) {
    return word.size() >= 3 && candidate.size() > word.size() &&
           std::equal(word.begin(), word.end(), candidate.begin(), [](char a, char b) { return lower(a) == lower(b); });
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
    // Optimal string alignment: the table's row i holds the distances of a's first i letters to every start of b.
    std::vector<int> before_last, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = static_cast<int>(i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
            const bool swapped =
                i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        before_last = last;
        last = row;
    }
    return last[b.size()];
}

std::string nearest(std::string_view word, const std::vector<std::string>& words) {
    constexpr std::size_t longest = 100;  // of a word that a person may have misspelt; the table grows with it
    if (word.size() > longest) return "";
    std::string best;
    const int length = static_cast<int>(word.size());
    // Half the letters may be wrong, but not all of them.
    int best_distance = std::min(length, std::max(1, length / 2) + 1);
    for (const std::string& candidate : words) {
        const int distance = begins(candidate, word) ? 1 : edit_distance(word, candidate);
        if (distance < best_distance) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& words) {
    const std::string meant = nearest(word, words);
    return meant.empty() ? "" : fmt::format(": did you mean '{}'?", meant);
}

std::string listed(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

}  // namespace footfall::io
