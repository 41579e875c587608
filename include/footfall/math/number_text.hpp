// A number in words of an error: the fewest digits that give it back.
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace footfall {

[[nodiscard]] inline std::string number_text(double x) {
    constexpr int enough = 17;  // for every double
    std::array<char, 32> text{};
    for (int digits = 15; digits <= enough; ++digits) {
        std::snprintf(text.data(), text.size(), "%.*g", digits, x);
        if (std::strtod(text.data(), nullptr) == x) break;
    }
    return text.data();
}

}  // namespace footfall
