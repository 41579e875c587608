// A falling function followed to its zero by secants, one point of it after another.
#pragma once

#include <cmath>
#include <limits>

namespace footfall {

/// Places are shares of a step; each evaluation is dear, and may be known to little more than its sign.
template <class Value>
class Secants {
public:
    /// The value at a place; returns how far the zero is from there. The first slope is given, < 0.
    Value see(const Value& place, const Value& value, const Value& first_slope) {
        constexpr double rounding = 1e-9;  // of a step: a way that does not shrink below this leads nowhere
        constexpr Value enough = Value(64) * std::numeric_limits<Value>::epsilon();
        if (!seen_) slope_ = first_slope;
        if (seen_ && place != place_) {
            const Value secant = (value - value_) / (place - place_);
            if (secant < Value(0)) slope_ = secant;
        }
        const Value way = -value / slope_, size = std::abs(way);
        found_ = !(size > enough) || (seen_ && size < Value(rounding) && !(size < last_size_ / Value(2)));
        seen_ = true;
        place_ = place;
        value_ = value;
        last_size_ = size;
        return way;
    }
    /// Whether the last place was the zero, as far as the function is known.
    [[nodiscard]] bool found() const noexcept { return found_; }
    [[nodiscard]] const Value& slope() const noexcept { return slope_; }

private:
    bool seen_ = false, found_ = false;
    Value place_{0}, value_{0}, slope_{0}, last_size_{0};
};

}  // namespace footfall
