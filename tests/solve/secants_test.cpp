// Events that a guard tells by so little that no interpolant shows how it falls.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solve/followed.hpp"

namespace footfall {
namespace {

using test::follow, test::Followed;

/// A point that is drawn after another, sin t, and lags behind it by about cos(t)/lambda: the guard is the lag.
/// Components: the point, the time. The lag is (sin t + lambda cos t)/(1 + lambda^2), zero where tan t = -lambda.
template <class S>
struct Drawn {
    static constexpr int motion = 2, guards = 1;
    S lambda;

    template <class T>
    void flow(int, const T* y, T* rate) const {
        using std::sin;
        rate[0] = T(lambda) * (sin(y[1]) - y[0]);
        rate[1] = T(1);
    }
    template <class T>
    void look(int mode, const T* y, T* out) const {
        using std::sin;
        const T lag = T(sin(y[1])) - y[0];
        out[0] = mode == 0 ? lag : T(-lag);
    }
    static int jump(int, int mode, S*) { return 1 - mode; }
    template <class T>
    [[nodiscard]] Drawn<T> over() const {
        return {T(value_of(lambda))};
    }
};

struct Follower : Followed<Drawn, double> {
    using Followed::Followed;
    static constexpr Switching switching{
        .look = 16, .border = 0.5, .price = 5, .patience = 4, .gentle = 0.25, .follows_turning = true};
    static constexpr bool locates_by_secants = true;
};

// The lag is known to a thousandth of its size. By the interpolant it is missed by 0.08 at lambda = 1e4.
TEST(Secants, FindWhereALagTurnsThatTheInterpolantDoesNotKnow) {
    for (const double lambda : {1e2, 1e3, 1e4}) {
        Follower point({lambda});
        point.tolerance = 1e-3 / lambda;
        SolverCost cost;
        follow(point, {-lambda / (1 + lambda * lambda), 0}, 20, &cost);
        ASSERT_EQ(point.events.size(), 6u) << lambda;
        for (std::size_t k = 0; k < point.events.size(); ++k) {
            const double wanted = (static_cast<double>(k) + 0.5) * std::numbers::pi + 1 / lambda;
            EXPECT_NEAR(point.events[k].time, wanted, 1e-3) << lambda;
        }
        EXPECT_LT(cost.steps, 100) << lambda;
    }
}

TEST(Secants, FindTheZeroOfAFunctionThatIsKnownToItsRounding) {
    for (const double noise : {0.0, 1e-11}) {
        Secants<double> secants;
        double place = 0.9;
        int looks = 0;
        while (!secants.found() && looks < 20) {
            const double rounding = noise * (looks % 2 == 0 ? 1 : -1);
            place += secants.see(place, std::cos(2 * place) + rounding, -1);
            ++looks;
        }
        EXPECT_NEAR(place, std::numbers::pi / 4, 1e-15 + 2 * noise) << noise;
        EXPECT_LT(looks, 12) << noise;
    }
}

}  // namespace
}  // namespace footfall
