#include "study/driven_contact.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "footfall/law/any_normal.hpp"
#include "footfall/law/any_rate_friction.hpp"
#include "footfall/law/contact_law.hpp"
#include "footfall/math/dual.hpp"
#include "footfall/math/value_of.hpp"

namespace footfall {
namespace {

using Slope = Dual<double, 8>;
using Along = Dual<double, 1>;

/// The normal law of a rig; under a prescribed load its spring alone acts.
template <class S>
class RigNormal {
public:
    using value_type = S;

    RigNormal(AnyNormal<S> law, bool spring_alone) : law_(std::move(law)), spring_alone_(spring_alone) {}

    template <int Over = 0>
    [[nodiscard]] NormalForce<S> force(const S& s, const S& z_rate) const noexcept {
        if (!spring_alone_) return law_.template force<Over>(s, z_rate);
        return {law_.template force<Over>(s, S(0)).elastic, S(0)};
    }
    [[nodiscard]] S stored_energy(const S& s) const noexcept { return law_.stored_energy(s); }
    void begin_impact(const S& speed) noexcept { law_.begin_impact(speed); }

    template <class T>
    [[nodiscard]] RigNormal<T> cast() const noexcept {
        return {law_.template cast<T>(), spring_alone_};
    }

private:
    AnyNormal<S> law_;
    bool spring_alone_;
};

/// What the contact does, and how far it is from the end of its phase.
template <class S>
struct Answer : ContactResponse<S> {
    S guard = S(1);
};

/// A friction law of spring, damper and clutch, or none.
template <class S, class Friction>
struct ClutchedContact : ContactLaw<RigNormal<S>, Friction> {
    using Law = ContactLaw<RigNormal<S>, Friction>;
    using Law::friction, Law::normal;
    static constexpr int states = Friction::has_bristle ? 2 : 0;
    static constexpr bool turns = false;

    /// `load_rate` is d(F_n / s^ScalePower)/dt.
    Answer<S> respond(Phase phase, const S& s, const S& z_rate, const S& load_rate, const Vector2<S>& V,
                      std::span<const S> x, std::span<S> x_rate) const {
        const Vector2<S> u = bristle(x);
        Answer<S> a{Law::respond(phase, s, z_rate, V, u, load_rate)};
        if constexpr (states > 0) {
            x_rate[0] = a.bristle_rate.x();
            x_rate[1] = a.bristle_rate.y();
            if (phase == Phase::stick || phase == Phase::slip) {
                const S phi_n = scaled_load(s, z_rate);
                a.guard = phase == Phase::stick ? friction.cone_margin(phi_n, V, u)
                                                : friction.slip_margin(friction.scale(s), phi_n, load_rate, V, u);
            }
        }
        return a;
    }

    [[nodiscard]] static int state_count() { return states; }
    [[nodiscard]] static Vector2<S> bristle(std::span<const S> x) {
        if constexpr (states > 0) return {x[0], x[1]};
        return Vector2<S>::Zero();
    }
    [[nodiscard]] S scaled_load(const S& s, const S& z_rate) const {
        return normal.template force<Friction::ScalePower>(s, z_rate).total();
    }
    [[nodiscard]] double state_size(int) const { return 0; }

    template <class T>
    [[nodiscard]] auto cast() const {
        auto other = friction.template cast<T>();
        return ClutchedContact<T, decltype(other)>{{normal.template cast<T>(), other}};
    }
};

/// A friction law with states of its own.
template <class S>
struct RateContact : ContactLaw<RigNormal<S>, AnyRateFriction<S>> {
    using Law = ContactLaw<RigNormal<S>, AnyRateFriction<S>>;
    using Law::friction, Law::normal;

    bool turns;  ///< it has |V| in its rates, and no phases that would end where V turns

    /// `load_rate` is dF_n/dt.
    Answer<S> respond(Phase phase, const S& s, const S& z_rate, const S& load_rate, const Vector2<S>& V,
                      std::span<const S> x, std::span<S> x_rate) const {
        Answer<S> a{Law::respond(phase, s, z_rate, V, x, x_rate, load_rate)};
        if (phase == Phase::stick || phase == Phase::slip) a.guard = friction.margin(phase, V, x);
        return a;
    }

    [[nodiscard]] int state_count() const { return friction.state_count(); }
    [[nodiscard]] Vector2<S> bristle(std::span<const S> x) const { return friction.bristle(x); }
    [[nodiscard]] double state_size(int i) const { return friction.state_size(i); }

    template <class T>
    [[nodiscard]] RateContact<T> cast() const {
        return {{normal.template cast<T>(), friction.template cast<T>()}, turns};
    }
};

template <class Contact>
class DrivenContactUnder final : public DrivenContact {
public:
    using SlopeContact = decltype(std::declval<Contact>().template cast<Slope>());
    static constexpr bool clutched = !Contact::has_states;

    DrivenContactUnder(const Rig& rig, const Timeline& timeline, Contact contact)
        : rig_(rig), timeline_(timeline), contact_(std::move(contact)), slopes_(contact_.template cast<Slope>()) {
        layout_.state_count = contact_.state_count();
    }

    void differentiate(const DrivenState& y, Eigen::MatrixXd& J) override {
        using SlopeState = Eigen::Array<Slope, Eigen::Dynamic, 1>;
        constexpr int directions = 8;
        const int n = layout_.motion_size();
        J.resize(n, n);
        SlopeState point = y.cast<Slope>(), rate = point;
        for (int first = 0; first < n; first += directions) {
            const int last = std::min(first + directions, n);
            for (int c = first; c < last; ++c) point[c] = Slope::variable(y[c], c - first);
            compute<Slope>(slopes_, point, rate);
            for (int c = first; c < last; ++c) {
                for (int r = 0; r < n; ++r) J(r, c) = rate[r].gradient[static_cast<std::size_t>(c - first)];
                point[c] = Slope(y[c]);
            }
        }
    }

    DrivenMoment moment(const DrivenState& y) override {
        DrivenState rate = y;
        Vector2<double> V;
        const Answer<double> a = compute<double>(contact_, y, rate, nullptr, &V);
        return {a.normal_force, a.normal_spring, a.tangential_spring, V, a.friction_force, bristle(y)};
    }

    void enter(const Interval& interval, DrivenState& y) override {
        // A load that jumps changes what a spring in proportion to it holds; no force pays for that.
        if constexpr (!clutched) y[layout_.ledger() + DrivenLayout::stiffness_change] += moment(y).tangential_spring;
        begin(interval, y);
        if constexpr (!clutched) y[layout_.ledger() + DrivenLayout::stiffness_change] -= moment(y).tangential_spring;
    }
    void switch_phase(DrivenState& y) override {
        if constexpr (clutched) {
            phase_ = phase_ == Phase::stick ? Phase::slip : Phase::stick;
            if (phase_ == Phase::slip) enter_slip(y);
        } else {
            // What the spring loses at once, the clutch takes.
            double& clutch = y[layout_.ledger() + DrivenLayout::clutch];
            clutch += moment(y).tangential_spring;
            phase_ = contact_.friction.jump(phase_, slip_velocity(y), states_of(y));
            clutch -= moment(y).tangential_spring;
        }
    }

    [[nodiscard]] bool turns() const noexcept override { return contact_.turns; }
    [[nodiscard]] double state_size(int i) const override { return contact_.state_size(i); }

private:
    void begin(const Interval& interval, DrivenState& y) {
        const bool loaded_before = phase_ == Phase::stick || phase_ == Phase::slip;
        const bool loaded = interval.normal == Phase::slip;
        if (loaded_before && !loaded) release(y);
        interval_ = interval;
        y[DrivenLayout::theta] = 0;
        if (interval.touchdown_speed > 0) {
            contact_.normal.begin_impact(interval.touchdown_speed);
            slopes_.normal = contact_.normal.template cast<Slope>();
        }
        if (loaded) {
            begin_load(loaded_before, y);
        } else {
            phase_ = interval.normal;
        }
    }

    /// A value that is prescribed, over S: it changes with theta alone.
    template <class S>
    static S prescribed(double value, double rate, const Instant& now, const S& theta) {
        if constexpr (std::is_same_v<S, double>) {
            return value;
        } else {
            return S(value) + (theta - S(value_of(theta))) * S(rate * now.time_rate);
        }
    }
    template <class S>
    static Vector2<S> prescribed(const Eigen::Vector2d& value, const Eigen::Vector2d& rate, const Instant& now,
                                 const S& theta) {
        return {prescribed(value.x(), rate.x(), now, theta), prescribed(value.y(), rate.y(), now, theta)};
    }

    template <class S, class ContactOverS, class State>
    Answer<S> compute(const ContactOverS& contact, const State& y, State& rate, DrivenGuards* guards = nullptr,
                      Vector2<S>* slip = nullptr) const {
        using L = DrivenLayout;
        const S theta = y[L::theta];
        const Instant now = timeline_.at(interval_, value_of(theta));
        const S g = prescribed(now.time_rate, now.time_curvature / now.time_rate, now, theta);
        const S s = prescribed(now.s, now.s_rate, now, theta);
        const S z_rate = prescribed(now.depth_rate, now.depth_acceleration, now, theta);
        const Vector2<S> x{y[L::position], y[L::position + 1]}, v{y[L::velocity], y[L::velocity + 1]};
        const bool carries = rig_.drag == Drag::mass;
        const Vector2<S> belt = prescribed(now.belt, now.belt_rate, now, theta);
        const Vector2<S> V = carries ? Vector2<S>(v - belt) : prescribed(now.slip, now.slip_rate, now, theta);
        if (slip) *slip = V;

        const std::size_t n = static_cast<std::size_t>(layout_.state_count);
        const std::span<const S> states(y.data() + L::states, n);
        const std::span<S> state_rates(rate.data() + L::states, n);
        Answer<S> a = contact.respond(phase_, s, z_rate, S(load_rate(now)), V, states, state_rates);

        for (S& r : state_rates) r *= g;
        rate[L::theta] = S(1);
        S dragging, holding(0);
        if (carries) {
            const HeldMass& m = rig_.mass;
            const Vector2<S> x_s = prescribed(now.support, now.support_velocity, now, theta);
            const Vector2<S> v_s = prescribed(now.support_velocity, now.support_acceleration, now, theta);
            const Vector2<S> force = prescribed(now.force, now.force_rate, now, theta);
            const Vector2<S> pull = S(m.stiffness) * (x_s - x) + S(m.damping) * (v_s - v);
            const Vector2<S> acceleration = (a.friction_force + pull + force) / S(m.mass);
            for (int i = 0; i < 2; ++i) {
                rate[L::position + i] = v[i] * g;
                rate[L::velocity + i] = acceleration[i] * g;
            }
            holding = S(m.damping) * (v_s - v).squaredNorm();
            dragging = a.friction_force.dot(belt) + force.dot(v) + pull.dot(v_s);
        } else {
            for (int i = 0; i < 2; ++i) rate[L::position + i] = rate[L::velocity + i] = S(0);
            dragging = -a.friction_force.dot(V);
        }
        rate[layout_.displacement()] = V.x() * g;
        rate[layout_.displacement() + 1] = V.y() * g;
        const int e = layout_.ledger();
        rate[e + L::normal_damper] = a.normal_damper_power * g;
        rate[e + L::tangential_damper] = a.tangential_damper_power * g;
        rate[e + L::clutch] = a.clutch_power * g;
        rate[e + L::stiffness_change] = a.stiffness_change_power * g;
        rate[e + L::holding_damper] = holding * g;
        rate[e + L::pressing_work] = a.normal_force * z_rate * g;
        rate[e + L::dragging_work] = dragging * g;
        if (guards) {
            guards->clutch = value_of(a.guard);
            const bool looks = contact_.turns && phase_ == Phase::slip && !direction_.isZero(0);
            guards->turn = looks ? value_of(V.x()) * direction_.x() + value_of(V.y()) * direction_.y() : 1;
        }
        return a;
    }

    void do_evaluate(const DrivenState& y, DrivenState& rate, DrivenGuards* guards) override {
        compute<double>(contact_, y, rate, guards);
    }

    /// How fast the load changes, over the scale of the friction law.
    [[nodiscard]] double load_rate(const Instant& now) const {
        if (phase_ != Phase::slip && phase_ != Phase::stick) return 0;
        if constexpr (clutched) {
            // It matters to a clutch without damping alone, while it slips.
            if constexpr (Contact::states > 0) {
                if (phase_ == Phase::slip && contact_.friction.plastic())
                    return load_rate_over<decltype(contact_.friction)::ScalePower>(now);
            }
            return 0;
        } else {
            return load_rate_over<0>(now);
        }
    }
    template <int Over>
    [[nodiscard]] double load_rate_over(const Instant& now) const {
        const Along s(now.s, {now.s_rate}), z_rate(now.depth_rate, {now.depth_acceleration});
        return contact_.normal.template cast<Along>().template force<Over>(s, z_rate).total().gradient[0];
    }

    [[nodiscard]] std::span<double> states_of(DrivenState& y) const {
        return {y.data() + DrivenLayout::states, static_cast<std::size_t>(layout_.state_count)};
    }
    [[nodiscard]] std::span<const double> states_of(const DrivenState& y) const {
        return {y.data() + DrivenLayout::states, static_cast<std::size_t>(layout_.state_count)};
    }
    [[nodiscard]] Vector2<double> bristle(const DrivenState& y) const { return contact_.bristle(states_of(y)); }
    [[nodiscard]] Vector2<double> slip_velocity(const DrivenState& y) const {
        DrivenState rate = y;
        Vector2<double> V;
        compute<double>(contact_, y, rate, nullptr, &V);
        return V;
    }

    /// The load has gone. A bristle without damping is back at once, and what it stored goes where a damper, however
    /// weak, would have taken it; the other laws keep nothing without a load.
    void release(DrivenState& y) {
        if constexpr (clutched) {
            if constexpr (Contact::states > 0) {
                if (contact_.friction.damping > 0) return;
                y[layout_.ledger() + DrivenLayout::tangential_damper] += moment(y).tangential_spring;
                for (double& x : states_of(y)) x = 0;
            }
        } else {
            for (double& x : states_of(y)) x = 0;
        }
    }

    void begin_load([[maybe_unused]] bool loaded_before, DrivenState& y) {
        if constexpr (clutched) {
            if constexpr (Contact::states == 0) {
                phase_ = Phase::slip;
            } else {
                decide(loaded_before, y);
                if (phase_ == Phase::slip) enter_slip(y);
            }
        } else {
            if (!loaded_before) {
                for (double& x : states_of(y)) x = 0;
                phase_ = contact_.friction.first_phase();
            }
        }
    }

    /// Stick or slip: by the force now, or a moment later where the load begins now.
    void decide(bool loaded_before, DrivenState& y) {
        constexpr double later = 1e-6;
        const Instant now = timeline_.at(interval_, loaded_before ? 0 : later);
        const Eigen::Vector2d V = rig_.drag == Drag::mass ? slip_velocity(y) : now.slip;
        const Eigen::Vector2d u = bristle(y) + V * (now.time - interval_.from);
        const auto& friction = contact_.friction;
        const double phi_n = contact_.scaled_load(now.s, now.depth_rate);
        const double on_cone = 1e-9 * friction.coefficient * phi_n;
        if (loaded_before && phase_ == Phase::slip && friction.plastic() &&
            std::abs(friction.cone_margin(phi_n, V, u)) < on_cone) {
            // On its cone, to rounding, whether the clutch goes on tells.
            const bool goes_on = friction.slip_margin(friction.scale(now.s), phi_n, load_rate(now), V, u) > 0;
            phase_ = goes_on ? Phase::slip : Phase::stick;
        } else {
            phase_ = phi_n > 0 && friction.holds(phi_n, V, u) ? Phase::stick : Phase::slip;
        }
    }

    void enter_slip(DrivenState& y) {
        if constexpr (Contact::states > 0) {
            const auto& friction = contact_.friction;
            if (!friction.plastic()) return;
            const Instant now = timeline_.at(interval_, y[DrivenLayout::theta]);
            const double phi_n = contact_.scaled_load(now.s, now.depth_rate);
            const Vector2<double> u = friction.enter_slip(phi_n, slip_velocity(y), bristle(y));
            // Where the load has jumped and the bristle springs back to a smaller cone, the clutch takes it.
            double& clutch = y[layout_.ledger() + DrivenLayout::clutch];
            clutch += moment(y).tangential_spring;
            y[DrivenLayout::states] = u.x();
            y[DrivenLayout::states + 1] = u.y();
            clutch -= moment(y).tangential_spring;
        }
    }

    const Rig& rig_;
    const Timeline& timeline_;
    Contact contact_;
    SlopeContact slopes_;
    Interval interval_;
};

}  // namespace

std::unique_ptr<DrivenContact> DrivenContact::make(const Rig& rig, const Timeline& timeline,
                                                   const ContactParameters& laws) {
    const RigNormal<double> normal(std::visit([](const auto& law) { return AnyNormal<>(law); }, laws.normal),
                                   rig.press == Press::load);
    return std::visit(
        [&]<class Friction>(const Friction& friction) -> std::unique_ptr<DrivenContact> {
            if constexpr (requires { Friction::has_bristle; }) {
                using Contact = ClutchedContact<double, Friction>;
                return std::make_unique<DrivenContactUnder<Contact>>(rig, timeline, Contact{{normal, friction}});
            } else {
                const bool turns = SmoothRateFriction<Friction> && Friction::states > 0;
                return std::make_unique<DrivenContactUnder<RateContact<double>>>(
                    rig, timeline, RateContact<double>{{normal, AnyRateFriction<>(friction)}, turns});
            }
        },
        laws.friction);
}

}  // namespace footfall
