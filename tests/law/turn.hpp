// A turn of the ground's plane.
#pragma once

#include <cmath>

#include "footfall/math/vector.hpp"

namespace footfall::test {

class Turn {
public:
    explicit Turn(double angle) : cosine_(std::cos(angle)), sine_(std::sin(angle)) {}

    [[nodiscard]] Vector2<double> operator*(const Vector2<double>& v) const {
        return {cosine_ * v.x() - sine_ * v.y(), sine_ * v.x() + cosine_ * v.y()};
    }

private:
    double cosine_, sine_;
};

}  // namespace footfall::test
