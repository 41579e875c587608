// The explicit method against Butcher's theory: the order conditions of every rooted tree, and its stability.
#include "footfall/solve/dormand_prince_853.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace footfall {
namespace {

namespace table = dormand_prince_853_table;
using Real = long double;
using Weights = std::array<Real, table::dense_stages>;

/// A rooted tree with its order, its density gamma and its elementary weight in each stage: what the stage's row makes
/// of the product of its branches (Hairer, Norsett & Wanner I, section II.2).
struct Tree {
    int order;
    Real gamma;
    Weights weight;  // the product of the branches at each stage
};

/// What a stage's row makes of a function given at the stages.
Weights through_rows(const Weights& values) {
    Weights out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) out[i] += table::a[i][j] * values[j];
    return out;
}

/// Every rooted tree up to an order. A tree is a multiset of smaller trees under a root.
std::vector<Tree> trees_up_to(int order) {
    std::vector<Tree> trees;
    Weights ones;
    ones.fill(1);
    trees.push_back({1, 1, ones});
    for (int n = 2; n <= order; ++n) {
        const std::vector<Tree> smaller = trees;
        std::vector<Weights> branch;
        for (const Tree& t : smaller) branch.push_back(through_rows(t.weight));
        // Branches in decreasing position of the list, so that each multiset comes once.
        const auto grow = [&](const auto& self, std::size_t largest, int left, Real gamma,
                              const Weights& product) -> void {
            if (left == 0) {
                trees.push_back({n, gamma * static_cast<Real>(n), product});
                return;
            }
            for (std::size_t k = 0; k <= largest; ++k) {
                if (smaller[k].order > left) continue;
                Weights next = product;
                for (std::size_t i = 0; i < next.size(); ++i) next[i] *= branch[k][i];
                self(self, k, left - smaller[k].order, gamma * smaller[k].gamma, next);
            }
        };
        grow(grow, smaller.size() - 1, n - 1, 1, ones);
    }
    return trees;
}

template <std::size_t N>
Real sum(const std::array<Real, N>& weights, const Weights& values) {
    Real total = 0;
    for (std::size_t i = 0; i < N; ++i) total += weights[i] * values[i];
    return total;
}

TEST(DormandPrince853, OrderConditionsAreThoseOfAllRootedTrees) {
    const std::array<int, 9> known{0, 1, 1, 2, 4, 9, 20, 48, 115};  // Cayley 1857
    std::array<int, 9> found{};
    for (const Tree& t : trees_up_to(8)) ++found[static_cast<std::size_t>(t.order)];
    EXPECT_EQ(found, known);
}

TEST(DormandPrince853, FulfilsEveryOrderConditionUpToEight) {
    for (const Tree& t : trees_up_to(8))
        EXPECT_NEAR(static_cast<double>(sum(table::a[table::stages], t.weight) * t.gamma - 1), 0, 2e-15) << t.order;
}

TEST(DormandPrince853, IsNotOfOrderNine) {
    Real worst = 0;
    for (const Tree& t : trees_up_to(9))
        if (t.order == 9) worst = std::fmax(worst, std::abs(sum(table::a[table::stages], t.weight) * t.gamma - 1));
    EXPECT_GT(worst, 1e-4);
}

TEST(DormandPrince853, ErrorEstimatesAreOfOrdersFiveAndThree) {
    Real five = 0, three = 0;
    for (const Tree& t : trees_up_to(6)) {
        const Real of_five = std::abs(sum(table::error5, t.weight));
        const Real of_three = std::abs(sum(table::error3, t.weight));
        if (t.order <= 5) {
            EXPECT_LE(of_five, 1e-15L) << t.order;
        }
        if (t.order <= 3) {
            EXPECT_LE(of_three, 1e-15L) << t.order;
        }
        if (t.order == 6) five = std::fmax(five, of_five);
        if (t.order == 4) three = std::fmax(three, of_three);
    }
    EXPECT_GT(five, 1e-6);
    EXPECT_GT(three, 1e-6);
}

/// y = (a, a', t): the pendulum of unit length and weight driven by cos t, as an autonomous system.
struct DrivenPendulum {
    using State = Eigen::Array<Real, 3, 1>;
    void operator()(const State& y, State& rate, bool) const {
        rate << y[1], -std::sin(y[0]) + Real(0.3) * std::cos(y[2]), Real(1);
    }
    static State start() { return {Real(0.7), Real(0.2), Real(0)}; }

    /// Where it is after a time, by very small steps.
    static State exact(Real time) {
        DormandPrince853<State> method;
        const DrivenPendulum f;
        constexpr int steps = 512;
        method.begin(f, start());
        for (int k = 0; k < steps; ++k) {
            method.step(f, time / steps);
            method.finish(f);
            method.advance(State(method.end()));
        }
        return method.start();
    }
};

/// The mean slope of log(error) over log(h) while h is halved.
template <class Error>
double mean_slope(const Error& error, Real h, int halvings) {
    const Real first = error(h), last = error(std::ldexp(h, -halvings));
    return static_cast<double>(std::log2(first / last)) / halvings;
}

TEST(DormandPrince853, LocalErrorFallsWithTheNinthPowerOfTheStep) {
    const DrivenPendulum f;
    const auto error = [&](Real h) {
        DormandPrince853<DrivenPendulum::State> method;
        method.begin(f, DrivenPendulum::start());
        method.step(f, h);
        return (method.end() - DrivenPendulum::exact(h)).abs().maxCoeff();
    };
    EXPECT_NEAR(mean_slope(error, 0.8L, 3), 9, 0.3);
}

// An interpolant of order 7 is wrong by h^8 inside the step.
TEST(DormandPrince853, DenseOutputIsOfOrderSeven) {
    const DrivenPendulum f;
    for (const Real theta : {0.13L, 0.5L, 0.77L}) {
        const auto error = [&](Real h) {
            DormandPrince853<DrivenPendulum::State> method;
            method.begin(f, DrivenPendulum::start());
            method.step(f, h);
            method.finish(f);
            method.prepare_dense(f);
            return (method.at(theta) - DrivenPendulum::exact(theta * h)).abs().maxCoeff();
        };
        EXPECT_NEAR(mean_slope(error, 0.8L, 3), 8, 0.3) << static_cast<double>(theta);
    }
}

TEST(DormandPrince853, DenseOutputMeetsBothEndsWithTheirRates) {
    const DrivenPendulum f;
    DormandPrince853<DrivenPendulum::State> method;
    const Real h = 0.5L, d = 1e-5L;
    method.begin(f, DrivenPendulum::start());
    method.step(f, h);
    method.finish(f);
    method.prepare_dense(f);
    EXPECT_LE((method.at(0) - method.start()).abs().maxCoeff(), 1e-18L);
    EXPECT_LE((method.at(1) - method.end()).abs().maxCoeff(), 1e-18L);
    const auto rate = [&](Real theta) { return ((method.at(theta + d) - method.at(theta - d)) / (2 * d * h)).eval(); };
    EXPECT_LE((rate(0) - method.start_rate()).abs().maxCoeff(), 1e-9L);
    EXPECT_LE((rate(1) - method.end_rate()).abs().maxCoeff(), 1e-9L);
    for (Eigen::Index c = 0; c < 3; ++c) EXPECT_EQ(method.at(0.3L, c), method.at(0.3L)[c]);
}

// The two estimates are combined so that the whole falls with h^8 where h is small.
TEST(DormandPrince853, ErrorEstimateFallsWithTheEighthPowerOfTheStep) {
    const DrivenPendulum f;
    const auto estimate = [&](Real h) {
        DormandPrince853<DrivenPendulum::State> method;
        method.begin(f, DrivenPendulum::start());
        method.step(f, h);
        return method.error(DrivenPendulum::State::Constant(1));
    };
    EXPECT_NEAR(mean_slope(estimate, 0.05L, 3), 8, 0.3);
}

TEST(DormandPrince853, NeverAcceptsAStepThatIsNotANumber) {
    using State = Eigen::Array<double, 2, 1>;
    const auto f = [](const State& y, State& rate, bool) {
        rate << y[0], y[0] > 1 ? std::numeric_limits<double>::quiet_NaN() : 0;
    };
    DormandPrince853<State> method;
    method.begin(f, State(1, 0));
    method.step(f, 0.1);
    EXPECT_FALSE(method.error(State::Constant(1)) <= 1);
}

/// What one step makes of ydot = lambda y, h lambda = z.
double amplification(std::complex<double> z) {
    using State = Eigen::Array<double, 2, 1>;
    const auto f = [&](const State& y, State& rate, bool) {
        rate << z.real() * y[0] - z.imag() * y[1], z.imag() * y[0] + z.real() * y[1];
    };
    DormandPrince853<State> method;
    method.begin(f, State(1, 0));
    method.step(f, 1.0);
    return std::hypot(method.end()[0], method.end()[1]);
}

TEST(DormandPrince853, IsStableOverTheNegativeHalfDiscOfRadiusFour) {
    for (double radius = 0.1; radius <= 4; radius += 0.1)
        for (double angle = 0.52; angle <= 1.0; angle += 0.04)
            EXPECT_LE(amplification(std::polar(radius, angle * std::numbers::pi)), 1)
                << radius << " at " << angle << " pi";
}

TEST(DormandPrince853, LosesStabilityOnTheRealAxisNearSix) {
    EXPECT_LT(amplification(-5.5), 1);
    EXPECT_GT(amplification(-6.5), 1);
}

}  // namespace
}  // namespace footfall
