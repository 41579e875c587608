// The friction laws with internal states: closed forms, published properties, and where the energy goes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/law/contact_law.hpp"
#include "footfall/math/dual.hpp"
#include "law/any_rate_friction.hpp"
#include "law/laws.hpp"
#include "law/turn.hpp"
#include "math/property.hpp"

namespace footfall {
namespace {

using namespace test;
using Vector = Vector2<double>;
using RateLaws = TypesOf<RateFrictionLawOver<double>>::type;

/// A law at a load of 1 N, moved along a given path: its traction is the friction force. Classical Runge-Kutta steps,
/// halved onto the points where the law jumps.
class Rig {
public:
    explicit Rig(const AnyRateFriction<>& law) : law_(law), x_(static_cast<std::size_t>(law.state_count())) {
        phase_ = law.first_phase();
    }

    /// Moves with the velocity V(t) for a time, in `steps` steps.
    void move(const std::function<Vector(double)>& V, double duration, int steps) {
        const double end = time + duration, h = duration / steps;
        for (int k = 0; k < steps; ++k) step(V, k + 1 < steps ? h : end - time);
    }
    void move(const Vector& V, double duration, int steps) {
        move([V](double) { return V; }, duration, steps);
    }

    /// Moves along x, forwards or backwards at 1 m/s, until the force on the mover is `force`.
    void pull_to(double force, double step_length) {
        const double way = force > pull() ? 1 : -1;
        double h = step_length;
        while (h > 1e-9 * step_length) {
            const Rig before = *this;
            step([way](double) { return Vector(way, 0); }, h);
            if (way * (pull() - force) > 0) {
                *this = before;
                h /= 2;
            }
        }
    }

    [[nodiscard]] Vector traction(const Vector& V = Vector::Zero()) const {
        std::vector<double> rate(x_.size());
        return law_.respond(phase_, V, x_, rate).traction;
    }
    /// What must be pulled with, along x, to move at this speed.
    [[nodiscard]] double pull(double speed = 0) const { return -traction({speed, 0}).x(); }
    [[nodiscard]] double stored() const { return law_.stored(phase_, x_); }
    [[nodiscard]] Phase phase() const { return phase_; }
    [[nodiscard]] const std::vector<double>& states() const { return x_; }

    double time = 0;      // [s]
    double distance = 0;  // along x [m]
    double work = 0;      // done on the law [J]
    double damped = 0;    // in the damper [J]

private:
    struct Point {
        std::vector<double> x;
        double distance, work, damped;
    };

    void step(const std::function<Vector(double)>& V, double h) {
        Point y = stepped(V, h);
        if (law_.margin(phase_, V(time + h), y.x) < 0) {
            double before = 0, after = h;
            for (int k = 0; k < 45; ++k) {
                const double middle = (before + after) / 2;
                (law_.margin(phase_, V(time + middle), stepped(V, middle).x) < 0 ? after : before) = middle;
            }
            y = stepped(V, after);
            take(y, after);
            phase_ = law_.jump(phase_, V(time), x_);
            if (h - after > 0) step(V, h - after);
            return;
        }
        take(y, h);
    }
    void take(const Point& y, double h) {
        x_ = y.x;
        time += h;
        distance = y.distance;
        work = y.work;
        damped = y.damped;
    }

    [[nodiscard]] Point stepped(const std::function<Vector(double)>& V, double h) const {
        const std::size_t n = x_.size();
        const auto rates = [&](double t, const std::vector<double>& x) {
            Point r{std::vector<double>(n), V(t).x(), 0, 0};
            const auto response = law_.respond(phase_, V(t), x, r.x);
            r.work = -response.traction.dot(V(t));
            r.damped = response.damper_power;
            return r;
        };
        const auto at = [&](const Point& k, double by) {
            std::vector<double> x = x_;
            for (std::size_t i = 0; i < n; ++i) x[i] += by * k.x[i];
            return x;
        };
        const Point a = rates(time, x_), b = rates(time + h / 2, at(a, h / 2)), c = rates(time + h / 2, at(b, h / 2)),
                    d = rates(time + h, at(c, h));
        const auto mean = [h](double k1, double k2, double k3, double k4) {
            return h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        };
        Point y{x_, distance + mean(a.distance, b.distance, c.distance, d.distance),
                work + mean(a.work, b.work, c.work, d.work), damped + mean(a.damped, b.damped, c.damped, d.damped)};
        for (std::size_t i = 0; i < n; ++i) y.x[i] += mean(a.x[i], b.x[i], c.x[i], d.x[i]);
        return y;
    }

    AnyRateFriction<> law_;
    std::vector<double> x_;
    Phase phase_ = Phase::slip;
};

constexpr LuGreFriction<> lugre{1e5, 30, 0.5, 0.3, 0.01, 0.4};
constexpr ElastoPlasticFriction<> elasto_plastic{1e5, 30, 0.5, 0.3, 0.01, 0.4, 0.7};
constexpr SevenParameterFriction<> seven{1e5, 0.3, 0.2, 0.01, 0.005, 2.0, 0.4};

// ---- what holds for every law --------------------------------------------------------------------------------------

/// A random law in a random state that it can be in.
template <class Law>
struct RateCase {
    Law law = random_law<Law>();
    AnyRateFriction<> any{law};
    Phase phase = any.first_phase();
    Vector V = random_vector(1e-4, 1e1);
    std::vector<double> x = std::vector<double>(static_cast<std::size_t>(Law::states));

    RateCase() {
        for (int i = 0; i < Law::states; ++i)
            x[static_cast<std::size_t>(i)] = *uniform(-0.69, 0.69) * any.state_size(i);
        if constexpr (std::is_same_v<Law, SevenParameterFriction<>>)
            for (std::size_t i : {2u, 3u, 4u}) x[i] = std::abs(x[i]);
        if constexpr (std::is_same_v<Law, HaessigFriedlandFriction<>>) x.back() = 7;
        if constexpr (std::is_same_v<Law, ElastoPlasticFriction<>>) {
            if (coin()) {  // beyond break-away, and outwards
                const double u_ss = law.steady(V) / law.stiffness;
                put_vector<double>(x, 0, V.normalized() * (law.breakaway() + *uniform(0, 1.2) * u_ss));
                V = test::Turn(*uniform(-1.4, 1.4)) * V;
                phase = Phase::slip;
            }
        }
        if constexpr (std::is_same_v<Law, DahlFriction<>>) {
            if (law.coefficient == 0) std::fill(x.begin(), x.end(), 0.0);  // nothing can stretch it
        }
        if constexpr (Law::states >= 2) RC_PRE(x[0] == 0 || std::hypot(x[0], x[1]) > 1e-3 * any.state_size(0));
        if constexpr (std::is_same_v<Law, SevenParameterFriction<>> || std::is_same_v<Law, ResetIntegratorFriction<>>) {
            if (coin()) {  // slipping: on the circle, and outwards
                if (x[0] * V.x() + x[1] * V.y() < 0) V = -V;
                put_vector<double>(x, 0, vector_at<double>(x) * 1e9);
                phase = any.jump(Phase::stick, V, x);
                RC_PRE(any.margin(phase, V, x) > 0);
            }
        }
    }
    RateResponse<double> response() const {
        std::vector<double> rate(x.size());
        return any.respond(phase, V, x, rate);
    }
    double clutch() const {
        const auto r = response();
        return -r.traction.dot(V) - r.stored_rate - r.damper_power;
    }
    double power_size() const {
        const auto r = response();
        double fastest = V.norm();
        if constexpr (Law::states > 0) fastest /= any.state_size(0);
        return r.traction.norm() * V.norm() + std::abs(r.stored_rate) + r.damper_power + any.stored(phase, x) * fastest;
    }
};

/// Whether a law is passive under Barahanov & Ortega's condition alone (stribeck_bristle.hpp).
template <class Law>
constexpr bool is_stribeck_bristle = requires(const Law law) {
    law.static_coefficient;
    law.damping;
};

template <class Law>
class RateFrictionTest : public ::testing::Test {};
TYPED_TEST_SUITE(RateFrictionTest, RateLaws, LawNames);

TYPED_TEST(RateFrictionTest, WhatIsStoredGrowsAlongTheRatesAsItSays) {
    check_property([] {
        const RateCase<TypeParam> c;
        std::vector<double> rate(c.x.size());
        const auto r = c.any.respond(c.phase, c.V, c.x, rate);
        using D = Dual<double, 1>;
        std::vector<D> moving;
        for (std::size_t i = 0; i < rate.size(); ++i) moving.push_back(D(c.x[i], {rate[i]}));
        const D w = c.any.template cast<D>().stored(c.phase, moving);
        double size = 0;  // of the terms, before they cancel
        for (std::size_t i = 0; i < rate.size(); ++i) {
            auto only = moving;
            for (std::size_t k = 0; k < rate.size(); ++k)
                if (k != i) only[k].gradient = {0};
            size += std::abs(c.any.template cast<D>().stored(c.phase, only).gradient[0]);
        }
        RC_ASSERT(near(r.stored_rate, w.gradient[0], 1e-12 * size));
    });
}

TYPED_TEST(RateFrictionTest, StoresNothingNegativeAndItsDamperOnlyTakes) {
    check_property([] {
        const RateCase<TypeParam> c;
        RC_ASSERT(c.any.stored(c.phase, c.x) >= 0);
        RC_ASSERT(c.response().damper_power >= 0);
    });
}

TYPED_TEST(RateFrictionTest, ANewContactHasNoForceAtRestAndStoresNothing) {
    check_property([] {
        const AnyRateFriction<> law(random_law<TypeParam>());
        std::vector<double> x(static_cast<std::size_t>(law.state_count())), rate = x;
        RC_ASSERT(law.respond(law.first_phase(), Vector::Zero(), x, rate).traction.norm() == 0);
        RC_ASSERT(law.stored(law.first_phase(), x) == 0);
    });
}

TYPED_TEST(RateFrictionTest, IsPassiveAtConstantLoadWhereItsFileSaysSo) {
    check_property([] {
        RateCase<TypeParam> c;
        if constexpr (std::is_same_v<TypeParam, BlimanSorineFriction<>>) {
            RC_PRE(c.law.coefficient > 0 || c.law.fast_share < 1);  // two bristles that are one
        }
        if constexpr (is_stribeck_bristle<TypeParam>) {
            // Barahanov & Ortega's condition, and a bristle that sliding can reach.
            auto& l = c.law;
            if (l.static_coefficient < l.kinetic_coefficient) std::swap(l.static_coefficient, l.kinetic_coefficient);
            l.viscous = l.damping * (l.static_coefficient / l.kinetic_coefficient - 1) * *uniform(1, 2);
            c.any = AnyRateFriction<>(l);
            const double most = l.static_coefficient / l.stiffness;
            put_vector<double>(c.x, 0, vector_at<double>(c.x).normalized() * (most * *uniform(0, 1)));
        }
        // There what the damper takes covers what the clutch gives back.
        const double covered = is_stribeck_bristle<TypeParam> ? c.response().damper_power : 0;
        RC_ASSERT(c.clutch() + covered >= -1e-12 * c.power_size());
    });
}

TYPED_TEST(RateFrictionTest, TurningThePlaneTurnsTheAnswer) {
    check_property([] {
        const RateCase<TypeParam> c;
        const test::Turn turn(*uniform(0, 6.283185307179586));
        constexpr int vectors = std::is_same_v<TypeParam, SevenParameterFriction<>> ? 1 : TypeParam::states / 2;
        std::vector<double> x = c.x, here(x.size()), there(x.size());
        for (std::size_t i = 0; i < static_cast<std::size_t>(vectors); ++i)
            put_vector<double>(x, 2 * i, turn * vector_at<double>(c.x, 2 * i));
        const auto a = c.any.respond(c.phase, c.V, c.x, here), b = c.any.respond(c.phase, turn * c.V, x, there);
        double size = c.V.norm();
        for (const double rate : here) size = std::max(size, std::abs(rate));
        for (std::size_t i = 0; i < here.size(); ++i) {
            if (i < 2 * static_cast<std::size_t>(vectors)) {
                if (i % 2 == 0)
                    RC_ASSERT((turn * vector_at<double>(here, i) - vector_at<double>(there, i)).norm() <= 1e-11 * size);
            } else {
                RC_ASSERT(near(here[i], there[i], 1e-11 * std::abs(here[i])));
            }
        }
        RC_ASSERT(near(c.any.stored(c.phase, c.x), c.any.stored(c.phase, x), 1e-12 * c.any.stored(c.phase, x)));
        RC_ASSERT((turn * a.traction - b.traction).norm() <= 1e-9 * (1 + a.traction.norm()));
    });
}

TYPED_TEST(RateFrictionTest, DualNumbersGiveTheSlopesThatDifferencesGive) {
    check_property([] {
        const RateCase<TypeParam> c;
        using D = Dual<double, 1>;
        const auto dual = c.any.template cast<D>();
        const auto precise = c.any.template cast<long double>();
        const std::size_t n = c.x.size();
        for (std::size_t in = 0; in < std::min<std::size_t>(n, 6) + 2; ++in) {
            const auto all = [&](const auto& law, const auto& moved) {
                using T = std::remove_cvref_t<decltype(moved)>;
                std::vector<T> x(c.x.begin(), c.x.end()), out(n);
                Vector2<T> V(T(c.V.x()), T(c.V.y()));
                (in < n ? x[in] : V[static_cast<int>(in - n) % 2]) = moved;
                const auto r = law.respond(c.phase, V, x, out);
                out.push_back(r.traction.x());
                out.push_back(r.traction.y());
                return out;
            };
            if (std::is_same_v<TypeParam, HaessigFriedlandFriction<>> && in >= n) continue;
            const double value = in < n ? c.x[in] : c.V[static_cast<int>(in - n) % 2];
            RC_PRE(std::abs(value) > 1e-6 * (in < n ? c.any.state_size(static_cast<int>(in)) : c.V.norm()));
            const auto slopes = all(dual, D::variable(value, 0));
            const long double h = 1e-7L * std::abs(value);
            const auto up = all(precise, value + h), down = all(precise, value - h);
            for (std::size_t out = 0; out < n + 2; ++out) {
                const double slope = static_cast<double>((up[out] - down[out]) / (2 * h));
                const double size = std::abs(slope) + static_cast<double>(std::abs(up[out]) / std::abs(value));
                RC_ASSERT(near(slopes[out].gradient[0], slope, 1e-5 * size));
            }
        }
    });
}

TYPED_TEST(RateFrictionTest, UnderALoadThatChangesTheLedgerOfTheContactCloses) {
    check_property([] {
        const RateCase<TypeParam> c;
        const ContactLaw<AzadFeatherstoneNormal<>, TypeParam> contact{{8.5e6, 3.1e3}, c.law};
        const double s = *uniform(5e-3, 2e-2), z_rate = *uniform(-0.05, 1), z_accel = *uniform(-1e3, 1e3);
        // (13) by hand: F_n = s (K z + D zdot).
        const double s_rate = z_rate / (2 * s);
        const double F_n = s * (8.5e6 * s * s + 3.1e3 * z_rate);
        const double F_n_rate = s_rate * (3 * 8.5e6 * s * s + 3.1e3 * z_rate) + s * 3.1e3 * z_accel;
        RC_PRE(F_n > 0);
        std::vector<double> rate(c.x.size());
        const auto r = contact.evaluate(Mode{c.phase}, Touch<double>{s, z_rate, c.V}, c.x, rate, F_n_rate);
        RC_ASSERT(near(r.normal_force, F_n, 1e-13 * F_n));
        // Along the motion, by differences of the response itself.
        const auto W = [&](double t) {
            std::vector<double> x = c.x, none(x.size());
            for (std::size_t i = 0; i < x.size(); ++i) x[i] += t * rate[i];
            const Touch<double> then{s + s_rate * t, z_rate + z_accel * t, c.V};
            return contact.evaluate(Mode{c.phase}, then, x, none).tangential_spring;
        };
        double fastest = std::abs(F_n_rate) / F_n;
        for (std::size_t i = 0; i < rate.size(); ++i)
            fastest = std::max(fastest, std::abs(rate[i]) / c.any.state_size(static_cast<int>(i)));
        const double h = 1e-4 / fastest;
        const double growth = (8 * (W(h / 2) - W(-h / 2)) - (W(h) - W(-h))) / (6 * h);
        const double booked = growth + r.tangential_damper_power + r.clutch_power + r.stiffness_change_power;
        const double size = F_n * c.power_size() + std::abs(r.stiffness_change_power) + W(0) * fastest +
                            F_n * (c.x.empty() ? 0 : std::hypot(c.x[0], c.x[1])) * fastest;
        RC_ASSERT(near(-r.friction_force.dot(c.V), booked, 1e-9 * size));
    });
}

TYPED_TEST(RateFrictionTest, WithoutALoadThereIsNoForceAndTheStatesStandStill) {
    check_property([] {
        const RateCase<TypeParam> c;
        const ContactLaw<AzadFeatherstoneNormal<>, TypeParam> contact{{8.5e6, 3.1e3}, c.law};
        for (const Phase phase : {Phase::flight, Phase::recovering}) {
            std::vector<double> rate(c.x.size(), 1.0);
            const auto r = contact.evaluate(Mode{phase}, Touch<double>{1e-2, -1.0, c.V}, c.x, rate, 1e3);
            RC_ASSERT(r.friction_force.norm() == 0);
            RC_ASSERT(r.normal_force == 0);
            RC_ASSERT(r.tangential_spring == 0);
            RC_ASSERT(r.clutch_power == 0);
            RC_ASSERT(r.stiffness_change_power == 0);
            for (const double value : rate) RC_ASSERT(value == 0);
        }
        RC_ASSERT(contact.mode_at({}, Touch<double>{1e-2, -1.0, c.V}, c.x).phase == Phase::recovering);
        RC_ASSERT(contact.mode_at({}, Touch<double>{1e-2, 1.0, c.V}, c.x).phase == c.any.first_phase());
    });
}

// ---- Dahl ----------------------------------------------------------------------------------------------------------

TEST(DahlFriction, FollowsItsClosedFormBeforeSlidingAndAfterAReversal) {
    const double sigma = 2e4, mu = 0.3;
    Rig rig(DahlFriction<>{sigma, mu});
    for (int k = 0; k < 5; ++k) {
        rig.move({1, 0}, 1e-5, 200);
        EXPECT_NEAR(rig.pull(), mu * (1 - std::exp(-sigma * rig.distance / mu)), 1e-12);
    }
    const double turned_at = rig.distance, F_0 = rig.pull();
    for (int k = 0; k < 5; ++k) {
        rig.move({-0.1, 0}, 1e-4, 200);
        EXPECT_NEAR(rig.pull(), -mu + (F_0 + mu) * std::exp(-sigma * (turned_at - rig.distance) / mu), 1e-12);
    }
}

// Between two pulls below Coulomb friction it goes (F_C/sigma) ln((F_C - low)/(F_C - high)) forwards and
// (F_C/sigma) ln((F_C + high)/(F_C + low)) back.
TEST(DahlFriction, DriftsUnderAPullThatSwingsBelowCoulombFriction) {
    const double sigma = 2e4, mu = 0.3, low = 0.05, high = 0.2;
    Rig rig(DahlFriction<>{sigma, mu});
    rig.pull_to(low, 1e-7);
    const double drift = mu / sigma * (std::log((mu - low) / (mu - high)) - std::log((mu + high) / (mu + low)));
    ASSERT_GT(drift, 0);
    for (int k = 1; k <= 3; ++k) {
        const double before = rig.distance;
        rig.pull_to(high, 1e-7);
        rig.pull_to(low, 1e-7);
        EXPECT_NEAR(rig.distance - before, drift, 1e-6 * drift) << k;
    }
}

// ---- LuGre ---------------------------------------------------------------------------------------------------------

TEST(LuGreFriction, SlidesSteadilyOnItsStribeckCurve) {
    for (const double v : {1e-4, 3e-3, 0.01, 0.02, 1.0}) {
        Rig rig(lugre);
        rig.move({v, 0}, 2e-4 / v, 20000);
        EXPECT_NEAR(rig.pull(v), 0.3 + 0.2 * std::exp(-(v / 0.01) * (v / 0.01)) + 0.4 * v, 1e-10) << v;
    }
}

TEST(LuGreFriction, DriftsUnderAPullThatSwingsBelowBreakAway) {
    LuGreFriction<> slow = lugre;  // without the terms of the speed, at which the rig moves
    slow.damping = slow.viscous = 0;
    slow.static_coefficient = slow.kinetic_coefficient;
    Rig rig(slow);
    rig.pull_to(0.05, 1e-7);
    for (int k = 0; k < 5; ++k) {
        const double before = rig.distance;
        rig.pull_to(0.2, 1e-7);
        rig.pull_to(0.05, 1e-7);
        EXPECT_GT(rig.distance - before, 0.1 * 0.15 / 1e5);  // a tenth of how far the spring itself gives
    }
}

// Canudas de Wit et al. 1995, figure 3: friction lags behind a change of speed, so that it is higher while the speed
// grows.
TEST(LuGreFriction, FrictionLagsBehindTheSpeed) {
    Rig rig(lugre);
    const auto V = [](double t) { return Vector(0.01 * (1 + 0.9 * std::sin(25 * t)), 0); };
    const double period = 2 * std::numbers::pi / 25;
    rig.move(V, 5 * period, 50000);
    const double rising = rig.pull(0.01);
    rig.move(V, period / 2, 5000);
    EXPECT_GT(rising, rig.pull(0.01) + 1e-4);
}

// Barahanov & Ortega 2000: without enough viscous friction a large sigma_1 makes energy where friction falls fast with
// the speed. The bristle that rest has left at the static coefficient pushes on while it relaxes.
TEST(LuGreFriction, MakesEnergyWhereItsDampingIsTooLargeForItsViscousTerm) {
    const double V = 1, u = 0.5 / 1e5;
    const auto given = [&](double damping) {
        const LuGreFriction<> law{1e5, damping, 0.5, 0.3, 0.01, 0};
        std::array<double, 2> rate;
        const auto r = law.respond({V, 0}, std::array{u, 0.0}, rate);
        return -r.traction.x() * V - r.stored_rate;
    };
    EXPECT_GT(given(0), 0);
    EXPECT_LT(given(10), 0);
}

// ---- elasto-plastic ------------------------------------------------------------------------------------------------

TEST(ElastoPlasticFriction, DoesNotDriftBelowBreakAway) {
    ElastoPlasticFriction<> law = elasto_plastic;
    law.damping = law.viscous = 0;
    Rig rig(law);
    for (int k = 0; k < 20; ++k) {
        rig.pull_to(0.2, 1e-7);
        rig.pull_to(0.05, 1e-7);
        EXPECT_NEAR(rig.distance, 0.05 / 1e5, 1e-14) << k;
    }
}

// The paper's: inside the cone its spring follows the sphere, there and back.
TEST(AzadFeatherstoneFriction, DoesNotDriftBelowTheCone) {
    const ContactLaw<AzadFeatherstoneNormal<>, AzadFeatherstoneFriction<>> law{{8.5e6, 0}, {{12.75e6, 0, 0.3, 0.1}}};
    const double depth = 1e-4, F_n = 8.5, step = 1e-9;
    double x = 0, u = 0, settled = 0;
    for (int k = 0; k < 20; ++k) {
        for (const double way : {1.0, -1.0}) {
            const double target = way > 0 ? 0.2 * F_n : 0.05 * F_n;
            for (;;) {
                const auto r = law.evaluate(depth, 0, {way, 0}, {u, 0});
                if (way * (-r.friction_force.x() - target) >= 0) break;
                x += way * step;
                u += r.bristle_rate.x() * step;
            }
        }
        if (k == 0) settled = x;
    }
    EXPECT_NEAR(x, settled, 2 * step);
}

TEST(ElastoPlasticFriction, IsElasticUpToBreakAwayAndPlasticBeyondIt) {
    ElastoPlasticFriction<> law = elasto_plastic;
    law.damping = law.viscous = 0;
    Rig rig(law);
    const double breakaway = 0.7 * 0.3 / 1e5;
    rig.move({1e-3, 0}, 0.999 * breakaway / 1e-3, 100);
    EXPECT_NEAR(rig.pull(), 0.999 * 0.7 * 0.3, 1e-12);
    rig.move({1e-3, 0}, 0.5 * breakaway / 1e-3, 100);
    EXPECT_LT(rig.pull(), 1e5 * rig.distance - 1e-4);
}

TEST(ElastoPlasticFriction, SticksWhereItIsElasticAndSlipsWhereItGivesWay) {
    Rig rig(elasto_plastic);
    const double breakaway = 0.7 * 0.3 / 1e5, v = 1e-3;
    rig.move({v, 0}, 0.999 * breakaway / v, 100);
    EXPECT_EQ(rig.phase(), Phase::stick);
    rig.move({v, 0}, 0.002 * breakaway / v, 100);
    EXPECT_EQ(rig.phase(), Phase::slip);
    rig.move({v, 0}, 10 * breakaway / v, 5000);  // at u_ss, beyond u_ba
    EXPECT_EQ(rig.phase(), Phase::slip);
    const double steady = rig.states()[0];
    rig.move({-v, 0}, 0.01 * breakaway / v, 100);  // it relaxes: elastic, and still beyond u_ba
    EXPECT_EQ(rig.phase(), Phase::stick);
    EXPECT_GT(rig.states()[0], breakaway);
    EXPECT_NEAR(steady - rig.states()[0], 0.01 * breakaway, 1e-12 * breakaway);
    rig.move({v, 0}, 1e-6 * breakaway / v, 100);
    EXPECT_EQ(rig.phase(), Phase::slip);
}

// With u_ba = u_ss and no Stribeck curve it is Prandtl's element: a spring with an end.
TEST(ElastoPlasticFriction, WithoutARiseBetweenItIsASpringWithAnEnd) {
    Rig rig(ElastoPlasticFriction<>{1e5, 0, 0.3, 0.3, 0.01, 0, 1});
    rig.move({1, 0}, 2.9e-6, 100);
    EXPECT_NEAR(rig.pull(), 0.29, 1e-13);
    rig.move({1, 0}, 1e-5, 100);
    EXPECT_NEAR(rig.pull(), 0.3, 1e-13);
    EXPECT_EQ(rig.phase(), Phase::slip);
    rig.move({-1, 0}, 5e-6, 100);
    EXPECT_NEAR(rig.pull(), -0.2, 1e-13);
    rig.move({-1, 0}, 1e-5, 100);
    EXPECT_NEAR(rig.pull(), -0.3, 1e-13);
    // What slid, 9.9e-6 m there and 9e-6 m back, and what is stored.
    EXPECT_NEAR(rig.work, 0.3 * (9.9e-6 + 9e-6) + rig.stored(), 1e-15);
}

TEST(ElastoPlasticFriction, SlidesSteadilyOnLuGresCurve) {
    for (const double v : {1e-4, 0.01, 1.0}) {
        Rig rig(elasto_plastic);
        rig.move({0.6 * v, 0.8 * v}, 2e-4 / v, 20000);
        const Vector expected = -Vector(0.6, 0.8) * (0.3 + 0.2 * std::exp(-(v / 0.01) * (v / 0.01)) + 0.4 * v);
        EXPECT_NEAR((rig.traction({0.6 * v, 0.8 * v}) - expected).norm(), 0, 1e-9) << v;
    }
}

// ---- Bliman & Sorine -----------------------------------------------------------------------------------------------

TEST(BlimanSorineFriction, BreaksAwayWithThePublishedPeakAtThePublishedPath) {
    const double mu = 0.3, f_2 = 0.5, eps = 1e-4, eta = 0.2, f_1 = mu + f_2;
    Rig rig(BlimanSorineFriction<>{mu, f_2, eps, eta});
    const double peak_at = eps * eta / (1 - eta) * std::log(f_1 / (eta * f_2));
    const double peak = f_1 * (1 - std::exp(-peak_at / (eta * eps))) - f_2 * (1 - std::exp(-peak_at / eps));
    rig.move({1, 0}, 0.9 * peak_at, 500);
    EXPECT_LT(rig.pull(), peak - 1e-4);
    rig.move({1, 0}, 0.1 * peak_at, 500);
    EXPECT_NEAR(rig.pull(), peak, 1e-10);
    rig.move({1, 0}, 0.1 * peak_at, 500);
    EXPECT_LT(rig.pull(), peak - 1e-4);
    rig.move({1, 0}, 30 * eps, 5000);
    EXPECT_NEAR(rig.pull(), mu, 1e-9);
    EXPECT_GT(peak, 1.2 * mu);
}

TEST(BlimanSorineFriction, DependsOnThePathAloneNotOnTheSpeed) {
    Rig fast(BlimanSorineFriction<>{0.3, 0.5, 1e-4, 0.2}), slow = fast;
    fast.move({10, 0}, 5e-6, 500);
    slow.move({1e-3, 0}, 5e-2, 500);
    EXPECT_NEAR(fast.pull(), slow.pull(), 1e-12);
}

TEST(BlimanSorineFriction, WithoutASlowBristleIsDahls) {
    Rig first_order(BlimanSorineFriction<>{0.3, 0, 1e-4, 0.2}), dahl(DahlFriction<>{0.3 / 2e-5, 0.3});
    for (Rig* rig : {&first_order, &dahl}) {
        rig->move({0.6, 0.8}, 3e-5, 500);
        rig->move({-0.8, 0.1}, 1e-5, 500);
    }
    EXPECT_NEAR((first_order.traction() - dahl.traction()).norm(), 0, 1e-12);
    EXPECT_NEAR(first_order.stored(), dahl.stored(), 1e-16);
}

TEST(BlimanSorineFriction, NoWayBackGivesMoreThanIsStored) {
    const double mu = 0.3, f_2 = 0.5, eps = 1e-4, eta = 0.2;
    Rig start(BlimanSorineFriction<>{mu, f_2, eps, eta});
    start.move({1, 0}, 2e-5, 500);
    double most = 0;
    for (double back = 1e-7; back < 1e-4; back *= 1.1) {
        Rig rig = start;
        rig.move({-1, 0}, back, 300);
        most = std::max(most, start.work - rig.work);
        EXPECT_LE(start.work - rig.work, start.stored() * (1 + 1e-9));
    }
    EXPECT_GT(most, 0.1 * start.stored());
}

// ---- seven parameters ----------------------------------------------------------------------------------------------

TEST(SevenParameterFriction, SlidesSteadilyOnItsCurve) {
    // Just after touchdown it has not rested, and the static friction that it slides with is what it broke away with.
    for (const double v : {1e-3, 0.01, 0.05}) {
        Rig rig(seven);
        rig.move({0, 0}, 6.0, 10);  // three quarters of f_inf: 6/(6 + 2)
        rig.move({v, 0}, 0.3, 30000);
        const double rested = 6.0 + 0.35 / 1e5 / v;  // the time until it breaks away, nearly
        const double f_s = 0.2 * rested / (rested + 2);
        EXPECT_NEAR(rig.pull(v), 0.3 + f_s / (1 + (v / 0.01) * (v / 0.01)) + 0.4 * v, 3e-5) << v;
        EXPECT_EQ(rig.phase(), Phase::slip);
    }
}

TEST(SevenParameterFriction, StaticFrictionRisesWithTheTimeOfRest) {
    for (const double rest : {0.0, 0.5, 2.0, 20.0}) {
        Rig rig(seven);
        rig.move({0, 0}, rest + 1e-12, 10);
        double highest = 0;
        while (rig.phase() == Phase::stick) {
            rig.move({1e-2, 0}, 1e-6, 10);
            highest = std::max(highest, rig.pull());
        }
        EXPECT_NEAR(highest, 0.3 + 0.2 * rest / (rest + 2), 1e-3) << rest;
    }
}

TEST(SevenParameterFriction, AfterSlidingStaticFrictionBeginsWhereSlidingFrictionEnded) {
    Rig rig(seven);
    rig.move({0, 0}, 2.0, 10);
    rig.move({0.03, 0}, 0.1, 20000);  // f_s = 0.1, at v = 3 v_s: a tenth of it
    EXPECT_NEAR(rig.pull(0.03) - 0.4 * 0.03, 0.3 + 0.01, 1e-4);
    rig.move({-0.03, 0}, 1e-7, 10);
    EXPECT_EQ(rig.phase(), Phase::stick);
    EXPECT_NEAR(rig.states()[3], 0.01, 1e-4);
}

// It stops faster than friction remembers: the spring is still stretched when the clutch comes to a stop.
TEST(SevenParameterFriction, HoldsWhereItTakesHold) {
    Rig rig(seven);
    rig.move({0, 0}, 20.0, 10);
    rig.move({0.03, 0}, 0.1, 20000);
    const double from = rig.time, stop = 2e-3, dt = 1e-7;
    const auto V = [&](double t) { return Vector(0.03 * (1 - (t - from) / stop), 0); };
    while (rig.phase() == Phase::slip && rig.time < from + stop) rig.move(V, dt, 1);
    ASSERT_EQ(rig.phase(), Phase::stick);
    ASSERT_LT(rig.time, from + stop - 10 * dt);
    const double held = rig.pull(), rested = rig.states()[4];
    while (rig.time < from + stop - dt) {
        rig.move(V, dt, 1);
        ASSERT_EQ(rig.phase(), Phase::stick) << rig.time - from;
        EXPECT_EQ(rig.states()[4], rested);
    }
    EXPECT_GT(rig.pull(), held);
    // Once it stands the rest begins, at the friction that the memory has come to.
    rig.move({0, 0}, 1e-3, 10);
    rig.move({-1e-6, 0}, 1e-3, 10);
    EXPECT_EQ(rig.states()[2], 0);
    EXPECT_NEAR(rig.states()[4], 1e-3, 1e-5);
}

TEST(SevenParameterFriction, FrictionLagsBehindTheSpeedByTheMemoryTime) {
    // In small swings about a speed, Stribeck friction is late by atan(omega tau_L), a first-order lag.
    SevenParameterFriction<> law = seven;
    law.viscous = 0;
    Rig rig(law);
    rig.move({0, 0}, 20.0, 10);
    const double omega = 100, v_0 = 0.01, swing = 1e-4;
    const auto V = [&](double t) { return Vector(v_0 + swing * std::sin(omega * (t - 20)), 0); };
    const double period = 2 * std::numbers::pi / omega;
    rig.move(V, 5 * period, 20000);
    double in_phase = 0, quadrature = 0;
    const int points = 400;
    for (int k = 0; k < points; ++k) {
        rig.move(V, period / points, 5);
        const double phase = omega * (rig.time - 20);
        in_phase += rig.pull() * std::sin(phase);
        quadrature += rig.pull() * std::cos(phase);
    }
    // Friction falls with speed: minus the lagged sine.
    EXPECT_NEAR(std::atan2(quadrature, -in_phase), std::atan(omega * 0.005), 2e-2);
    EXPECT_LT(in_phase, 0);
}

// ---- Haessig & Friedland -------------------------------------------------------------------------------------------

TEST(ResetIntegratorFriction, BreaksAwayAtStaticAndSlidesAtKineticFriction) {
    Rig rig(ResetIntegratorFriction<>{1e5, 0, 3e-6, 0.5});
    rig.move({1, 0}, 2.999e-6, 100);
    EXPECT_NEAR(rig.pull(), 1.5 * 0.2999, 1e-12);
    rig.move({1, 0}, 1e-5, 100);
    EXPECT_NEAR(rig.pull(), 0.3, 1e-12);
    EXPECT_EQ(rig.phase(), Phase::slip);
    rig.move({-1, 0}, 1e-6, 100);
    EXPECT_EQ(rig.phase(), Phase::stick);
    EXPECT_NEAR(rig.pull(), 1.5 * 0.2, 1e-9);
}

TEST(ResetIntegratorFriction, HoldsExactly) {
    Rig rig(ResetIntegratorFriction<>{1e5, 0, 3e-6, 0.5});
    for (int k = 0; k < 20; ++k) {
        rig.pull_to(0.44, 1e-7);
        rig.pull_to(-0.1, 1e-7);
        EXPECT_NEAR(rig.distance, -0.1 / 1.5e5, 1e-14) << k;
    }
}

TEST(ResetIntegratorFriction, FrictionTurnsToOpposeTheMotion) {
    Rig rig(ResetIntegratorFriction<>{1e5, 0, 3e-6, 0.5});
    rig.move({1, 0}, 1e-5, 100);
    rig.move({0, 1}, 6e-5, 2000);
    EXPECT_NEAR((rig.traction() - Vector(0, -0.3)).norm(), 0, 1e-7);
}

TEST(HaessigFriedlandFriction, BreaksAwayWithAllItsBondsAndSlidesAtTwoThirdsOfThat) {
    const double sigma = 1e5, reach = 3e-6;
    Rig rig(HaessigFriedlandFriction<>{sigma, reach});
    rig.move({1, 0}, 0.9999 * reach, 100);
    EXPECT_NEAR(rig.pull(), 0.9999 * sigma * reach, 1e-9);
    rig.move({1, 0}, 10 * reach, 2000);
    const double from = rig.distance, work = rig.work;
    rig.move({1, 0}, 80 * reach, 4000);
    // 3,200 snaps, far apart in random phases.
    EXPECT_NEAR((rig.work - work) / (rig.distance - from), 2.0 / 3 * sigma * reach, 0.01 * sigma * reach);
}

TEST(HaessigFriedlandFriction, RepeatsExactly) {
    const auto slid = [] {
        Rig rig(HaessigFriedlandFriction<>{1e5, 3e-6});
        rig.move({0.6, 0.8}, 2e-5, 400);
        return rig.states();
    };
    EXPECT_EQ(slid(), slid());
}

// ---- regularised Coulomb -------------------------------------------------------------------------------------------

TEST(RegularizedCoulombFriction, IsCoulombsAtSpeedAndViscousNearRest) {
    const AnyRateFriction<> law(RegularizedCoulombFriction<>{0.4, 1e-3});
    const auto friction = [&](double v) { return -law.respond(Phase::slip, {v, 0}, {}, {}).traction.x(); };
    EXPECT_NEAR(friction(10), 0.4, 1e-8);
    EXPECT_NEAR(friction(1e-7), 0.4 * 1e-4, 1e-12);
    EXPECT_NEAR(friction(1e-3), 0.4 / std::sqrt(2.0), 1e-15);
    EXPECT_EQ(friction(0), 0);
}

}  // namespace
}  // namespace footfall
