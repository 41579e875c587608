// Which crossings of guards a step finds, in which order, and at what cost.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "solve/followed.hpp"

namespace footfall {
namespace {

using test::follow, test::Followed;

/// A component that is the time, and a guard that falls through zero at each of some moments.
template <int Count>
struct Alarms {
    template <class S>
    struct Model {
        static constexpr int motion = 1, guards = Count;
        std::vector<double> moments;

        template <class T>
        void flow(int, const T*, T* rate) const {
            rate[0] = T(1);
        }
        template <class T>
        void look(int, const T* y, T* out) const {
            for (std::size_t k = 0; k < moments.size(); ++k) out[k] = T(moments[k]) - y[0];
        }
        int jump(int guard, int mode, S*) {
            moments[static_cast<std::size_t>(guard)] = 1e3;  // it has rung
            return mode;
        }
        template <class T>
        [[nodiscard]] Model<T> over() const {
            return {moments};
        }
    };
};

TEST(Guards, ThatCrossAtTheSameMomentAreHandledTogetherInTheirOrder) {
    Followed<Alarms<4>::Model, double> alarms({{0.5, 0.25, 0.5, 0.75}});
    follow(alarms, {0}, 1);
    ASSERT_EQ(alarms.events.size(), 4u);
    const std::array order{1, 0, 2, 3};
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(alarms.events[k].guard, order[k]);
    EXPECT_EQ(alarms.events[1].time, alarms.events[2].time);
}

void expect_in_order(const std::vector<double>& moments) {
    constexpr int count = 1000;
    Followed<Alarms<count>::Model, double> alarms({moments});
    SolverCost cost;
    follow(alarms, {0}, 2, &cost);
    ASSERT_EQ(alarms.events.size(), moments.size());
    std::vector<double> sorted = moments;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        ASSERT_NEAR(alarms.events[k].time, sorted[k], 1e-12) << k;
        ASSERT_EQ(moments[static_cast<std::size_t>(alarms.events[k].guard)], sorted[k]) << k;
    }
    // Each event ends a step: a step before it, the interpolant, its samples and the zero, and a step that ends on it.
    EXPECT_LT(cost.evaluations, 70 * count);
}

TEST(Guards, AThousandInOneStepAreHandledInTheirOrderAndCheaply) {
    std::vector<double> moments(1000);
    std::iota(moments.begin(), moments.end(), 1);
    for (double& m : moments) m /= 1001;
    expect_in_order(moments);
    std::reverse(moments.begin(), moments.end());  // each that is looked at is earlier than those before
    expect_in_order(moments);
    std::shuffle(moments.begin(), moments.end(), std::mt19937(2010));
    expect_in_order(moments);
}

/// A guard that is (t - bottom)^2 - depth, over a motion that a step of any length follows.
template <class S>
struct Dip {
    static constexpr int motion = 2, guards = 1;
    S bottom, depth;

    template <class T>
    void flow(int, const T* y, T* rate) const {
        rate[0] = y[1];
        rate[1] = T(2);
    }
    template <class T>
    void look(int mode, const T* y, T* out) const {
        out[0] = mode == 0 ? y[0] - T(depth) : T(1);
    }
    int jump(int, int, S*) const { return 1; }
    template <class T>
    [[nodiscard]] Dip<T> over() const {
        return {T(value_of(bottom)), T(value_of(depth))};
    }
};

std::vector<double> crossings(double bottom, double depth, double step) {
    Followed<Dip, double> dip({bottom, depth});
    dip.first = step;
    follow(dip, {bottom * bottom, -2 * bottom}, 1);
    std::vector<double> times;
    for (const auto& event : dip.events) times.push_back(event.time);
    return times;
}

TEST(Guards, ThatDipBelowZeroAndBackWithinOneStepAreFoundWhereTheyFall) {
    for (const double bottom : {0.05, 0.31, 0.5, 0.77, 0.96})
        for (const double depth : {1e-3, 1e-6, 1e-9, 1e-12}) {
            const auto times = crossings(bottom, depth, 1);
            ASSERT_EQ(times.size(), 1u) << bottom << " " << depth;
            EXPECT_NEAR(times[0], bottom - std::sqrt(depth), 4e-15 / std::sqrt(depth)) << bottom << " " << depth;
        }
}

TEST(Guards, ThatComeNearZeroAndDoNotReachItAreNoEvents) {
    for (const double bottom : {0.05, 0.31, 0.5, 0.77, 0.96})
        for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12})
            EXPECT_TRUE(crossings(bottom, -gap, 1).empty()) << bottom << " " << gap;
}

// Whether it is an event is a matter of rounding; that it is found where it is, and once, is not.
TEST(Guards, ThatTouchZeroAreOneEventOrNone) {
    for (const double bottom : {0.05, 0.31, 0.5, 0.77, 0.96})
        for (const double step : {1.0, 0.5, 0.1, 1e-3}) {
            const auto times = crossings(bottom, 0, step);
            ASSERT_LE(times.size(), 1u) << bottom;
            for (const double t : times) EXPECT_NEAR(t, bottom, 1e-7) << bottom;
        }
}

/// A component that is the time, and a guard that falls through zero steeply.
template <class S>
struct Steep {
    static constexpr int motion = 1, guards = 1;
    S moment;

    template <class T>
    void flow(int, const T*, T* rate) const {
        rate[0] = T(1);
    }
    template <class T>
    void look(int mode, const T* y, T* out) const {
        out[0] = mode == 0 ? 1e9 * (T(moment) - y[0]) : T(1);
    }
    int jump(int, int, S*) const { return 1; }
    template <class T>
    [[nodiscard]] Steep<T> over() const {
        return {T(value_of(moment))};
    }
};

// The end of the work gives way to an event at the same moment, which is located by its own slope.
TEST(Guards, ThatFallWhereTheWorkEndsDoNotMoveTheEnd) {
    for (const double end : {0.1, 0.3, 1.0 / 3, 0.7, 0.9, 1.1}) {
        Followed<Steep, double> steep({end});
        const auto y = follow(steep, {0}, end);
        EXPECT_LE(steep.events.size(), 1u);
        EXPECT_NEAR(y[0], end, 1e-14);
        EXPECT_NEAR(y[1], end, 1e-14);
    }
}

}  // namespace
}  // namespace footfall
