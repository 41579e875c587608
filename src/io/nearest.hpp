// Finds what a person may have meant by a misspelt word.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace footfall::io {

/// The number of letters to insert, remove, change or swap with their neighbour that makes `a` into `b`; letters are
/// compared without their case.
[[nodiscard]] int edit_distance(std::string_view a, std::string_view b);

/// The word of `words` that is nearest to `word`, or that begins with it; empty where none is near enough to be meant.
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& words);

/// ": did you mean 'WORD'?", or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& words);

/// "a, b, c"
[[nodiscard]] std::string listed(const std::vector<std::string>& words);

}  // namespace footfall::io
