// What every friction law of the registry owes a contact, whatever kind it is, in states that it has come to itself: it
// is moved along a path that slides, spins and rolls, under a load that changes.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/law/contact_law.hpp"
#include "footfall/math/dual.hpp"
#include "law/laws.hpp"
#include "math/property.hpp"

namespace footfall {
namespace {

using namespace test;
using FrictionLaws = TypesOf<FrictionLaw>::type;
/// One type for all, so that this is compiled once.
using Contact = Pair<AzadFeatherstoneNormal<>, FrictionLaw>;

constexpr AzadFeatherstoneNormal<> normal{8.5e6, 3.1e3};

/// How the contact stands at one moment, and how that changes. The depth and the velocities vary slowly.
struct Path {
    double s = *uniform(5e-3, 2e-2), z_rate = *uniform(-0.02, 0.5), z_accel = *uniform(-1e2, 1e2);
    Vector2<double> V = random_vector(1e-3, 1e0), rolling = random_vector(1e-2, 1e1);
    double spin = (coin() ? 1 : -1) * *decades(1e-2, 1e2), radius = *decades(3e-3, 0.1);

    template <class T>
    [[nodiscard]] Touch<T> at(const T& t) const {
        using std::sqrt;
        const T z = T(s * s) + T(z_rate) * t + T(0.5 * z_accel) * t * t;
        return {sqrt(z), T(z_rate) + T(z_accel) * t,       {T(V.x()), T(V.y())},
                T(spin), {T(rolling.x()), T(rolling.y())}, T(radius)};
    }
};

/// A law that has been moved along a path for a while from a new contact on.
struct Moved {
    Contact law;
    Path path;
    double duration = 0;
    std::vector<double> x = std::vector<double>(static_cast<std::size_t>(law.states())), rates = x;
    Mode mode;

    explicit Moved(const FrictionLaw& friction) : law(normal, friction) {
        duration = *uniform(0, 2) * stretch_time();
        follow(duration);
    }

    /// Over which the path takes the law's states across their natural size.
    [[nodiscard]] double stretch_time() const {
        const double size = law.states() > 0 ? law.state_size(0, path.s) : 1e-4;
        return std::min(size / path.V.norm(), 1e-3);
    }

    /// By Euler's method: any states that the law can come to will do.
    void follow(double time, int steps = 50) {
        const Touch<double> start = path.at(0.0);
        mode = law.start(start, x).mode;
        for (int k = 0; k < steps; ++k) {
            const Touch<double> now = path.at(time * k / steps);
            settle(now);
            (void)law.evaluate(mode, now, x, rates);
            for (std::size_t i = 0; i < x.size(); ++i) x[i] += time / steps * rates[i];
        }
        settle(path.at(time));
    }
    void settle(const Touch<double>& now) {
        mode = law.mode_at(mode, now, x);
        for (int jumps = 0; jumps < 100; ++jumps) {
            const Mode next = law.settled(mode, now, x);
            if (next.phase == mode.phase) break;
            mode = next;
        }
    }

    [[nodiscard]] Touch<double> touch() const { return path.at(duration); }
    /// Both rounds.
    Response<double> respond() {
        const Touch<double> t = touch();
        Response<double> r;
        law.respond(mode, t, x, rates, r);
        if (r.asks_for_load_rate) law.complete(mode, t, x, law.load_rate(t, x, path.z_accel), rates, r);
        return r;
    }
};

template <class Law>
class EveryFrictionLaw : public ::testing::Test {};
TYPED_TEST_SUITE(EveryFrictionLaw, FrictionLaws, LawNames);

void ledger_closes(Moved& m) {
    RC_PRE(m.mode.loaded());
    const Response<double> r = m.respond();
    const Touch<double> t = m.touch();
    const double given =
        -(r.push.friction.dot(t.slip) + r.push.spin_torque * t.spin + r.push.rolling_torque.dot(t.rolling));
    // dW/dt along the path, by dual numbers.
    using D = Dual<double, 1>;
    std::vector<D> moving;
    for (std::size_t i = 0; i < m.x.size(); ++i) moving.push_back(D(m.x[i], {m.rates[i]}));
    const auto over = m.law.template cast<D>();
    const D W = over.held(m.mode, m.path.at(D(m.duration, {1})), moving).tangential_spring;
    const double taken = r.power[by_tangential_damper] + r.power[by_clutch] + r.power[unpaid];
    const double size = std::abs(given) + std::abs(r.power[by_tangential_damper]) + std::abs(r.power[by_clutch]) +
                        std::abs(r.power[unpaid]) + std::abs(W.gradient[0]) + r.push.friction.norm() * t.slip.norm() +
                        W.value / std::max(m.duration, 1e-9);
    RC_ASSERT(near(given, W.gradient[0] + taken, 1e-10 * size));
    RC_ASSERT(W.value >= 0);
    RC_ASSERT(r.power[by_tangential_damper] >= 0);
}

TYPED_TEST(EveryFrictionLaw, TakesAndStoresWhatItsForceAndTorquesAreGiven) {
    check_property([] {
        Moved moved(random_law<TypeParam>());
        ledger_closes(moved);
    });
}

void turns_with_its_path(Moved& here) {
    RC_PRE(here.mode.loaded());
    Moved there = here;
    const double angle = *uniform(0, 6.283185307179586), c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](const Vector2<double>& v) -> Vector2<double> {
        return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
    };
    there.path.V = turned(here.path.V);
    there.path.rolling = turned(here.path.rolling);
    std::fill(there.x.begin(), there.x.end(), 0.0);
    there.mode = {};
    there.follow(there.duration);
    RC_PRE(there.mode.phase == here.mode.phase);  // on a border rounding decides
    const Response<double> a = here.respond(), b = there.respond();
    const double force = a.push.friction.norm(), arm = std::sqrt(here.path.radius) * here.path.s;
    RC_ASSERT((turned(a.push.friction) - b.push.friction).norm() <= 1e-7 * (force + 1e-3 * a.push.normal));
    RC_ASSERT(near(a.push.spin_torque, b.push.spin_torque, 1e-7 * a.push.normal * arm));
    RC_ASSERT((turned(a.push.rolling_torque) - b.push.rolling_torque).norm() <= 1e-7 * a.push.normal * arm);
}

TYPED_TEST(EveryFrictionLaw, TurningThePathTurnsTheAnswer) {
    check_property([] {
        Moved moved(random_law<TypeParam>());
        turns_with_its_path(moved);
    });
}

void gives_nothing_without_a_load(Moved& m) {
    RC_PRE(m.mode.loaded());
    const Touch<double> t = m.touch();
    Response<double> r;
    m.law.respond({Phase::recovering}, t, m.x, m.rates, r);
    RC_ASSERT(r.push.friction.norm() == 0);
    RC_ASSERT(r.push.spin_torque == 0);
    RC_ASSERT(r.push.rolling_torque.norm() == 0);
    RC_ASSERT(r.power[by_clutch] == 0);
    RC_ASSERT(r.power[by_tangential_damper] >= 0);
}

TYPED_TEST(EveryFrictionLaw, WithoutALoadGivesNothing) {
    check_property([] {
        Moved moved(random_law<TypeParam>());
        gives_nothing_without_a_load(moved);
    });
}

void has_positive_finite_sizes(const Moved& m) {
    for (int i = 0; i < m.law.states(); ++i) {
        const double size = m.law.state_size(i, m.path.s);
        RC_ASSERT(std::isfinite(size));
        RC_ASSERT(size > 0);
    }
}

TYPED_TEST(EveryFrictionLaw, HasStatesOfAPositiveFiniteSize) {
    check_property([] {
        Moved moved(random_law<TypeParam>());
        has_positive_finite_sizes(moved);
    });
}

// Forces, torques, rates and powers by dual numbers, along the change of everything that the contact sees.
void slopes_are_exact(Moved& m) {
    RC_PRE(m.mode.loaded());
    const auto all = [&](const auto& law, const auto& by) {
        using T = std::remove_cvref_t<decltype(by)>;
        Touch<T> t = m.path.at(T(m.duration));
        const T factor = T(1) + by;
        t.slip = {t.slip.x() * factor, t.slip.y() * (T(1) - by)};
        t.spin = t.spin * factor;
        t.root_depth = t.root_depth * factor;
        t.depth_rate = t.depth_rate * (T(1) - by);
        std::vector<T> x(m.x.begin(), m.x.end()), out(m.x.size());
        for (T& state : x) state = state * factor;
        Response<T> r;
        law.respond(m.mode, t, x, out, r);
        for (const T& value : {r.push.friction.x(), r.push.friction.y(), r.push.spin_torque, r.push.rolling_torque.x(),
                               r.push.rolling_torque.y(), r.power[by_tangential_damper]})
            out.push_back(value);
        return out;
    };
    const auto slopes = all(m.law.template cast<Dual<double, 1>>(), Dual<double, 1>::variable(0, 0));
    const auto precise = m.law.template cast<long double>();
    const long double h = 1e-7L;
    const auto up = all(precise, h), down = all(precise, -h);
    double fastest = m.path.V.norm();
    for (std::size_t k = 0; k < m.x.size(); ++k) fastest = std::max(fastest, static_cast<double>(std::abs(up[k])));
    for (std::size_t k = 0; k < slopes.size(); ++k) {
        const auto slope = static_cast<double>((up[k] - down[k]) / (2 * h));
        // Of the terms, before they cancel.
        const double terms = k < m.x.size() ? fastest : 1e-2 * m.law.normal_force(m.touch(), m.x);
        const double size = std::abs(slope) + static_cast<double>(std::abs(up[k])) + terms;
        RC_ASSERT(near(slopes[k].gradient[0], slope, 1e-5 * size));
    }
}

TYPED_TEST(EveryFrictionLaw, DualNumbersGiveTheSlopesThatDifferencesGive) {
    check_property([] {
        Moved moved(random_law<TypeParam>());
        slopes_are_exact(moved);
    });
}

}  // namespace
}  // namespace footfall
