// Two laws that are not in the registry, as it would take them: a conical stud and friction rounded by a tanh.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

#include "footfall/law/contact_law.hpp"
#include "footfall/law/friction/none.hpp"
#include "footfall/math/scalar.hpp"

using footfall::FrictionStates, footfall::LawDescription, footfall::NormalForce, footfall::Parameter;
using footfall::power, footfall::RateResponse, footfall::Vector2;

// [normal]
/// f = k z^2 + d z zdot. Sneddon 1965: k = (2/pi) E* cot(angle to the ground); the damper grows as the contact radius.
template <class S = double>
struct ConeNormal {
    using value_type = S;
    S stiffness, damping;  ///< k [N/m^2], > 0; d [N s/m^2], >= 0

    /// The force over s^Over, s = sqrt(z), its two parts apart.
    template <int Over = 0>
    constexpr NormalForce<S> force(const S& s, const S& z_rate) const noexcept {
        return {stiffness * power<4 - Over>(s), damping * power<2 - Over>(s) * z_rate};
    }
    /// The force over its lowest power of s, z: the contact lets go where this falls through zero.
    constexpr S load(const S& s, const S& z_rate) const noexcept { return stiffness * power<2>(s) + damping * z_rate; }
    /// The integral of the elastic part over z [J].
    constexpr S stored_energy(const S& s) const noexcept { return stiffness * power<6>(s) / S(3); }
    template <class T>
    constexpr ConeNormal<T> cast() const noexcept {
        return {T(stiffness), T(damping)};
    }
    static constexpr LawDescription description{
        .name = "cone", .formula = "f = max(k z^2 + d z zdot, 0)", .source = "Sneddon 1965", .limits = "no adhesion"};
    static constexpr auto parameters() noexcept {
        using Law = ConeNormal<S>;
        return std::array{
            Parameter<Law>{"stiffness", "k", "N/m^2", &Law::stiffness, "normal stiffness", ""},
            Parameter<Law>{"damping", "d", "N s/m^2", &Law::damping, "normal damping", "elastic, restitution 1"}};
    }
};
// [friction]
/// F_f = -mu F_n tanh(|V|/v_eps) V/|V|. No internal states; description and parameters as above.
template <class S = double>
struct TanhFriction {
    using value_type = S;
    static constexpr int states = 0;
    S coefficient, rounding_speed;  ///< mu [1], >= 0; v_eps [m/s], > 0

    RateResponse<S> respond(const Vector2<S>& V, FrictionStates<S>, std::span<S>) const noexcept {
        using std::tanh;
        const S speed = footfall::length_of(V);
        const S slope = speed > S(0) ? S(tanh(speed / rounding_speed) / speed) : S(1) / rounding_speed;
        return {-coefficient * slope * V, S(0), S(0)};  // traction; dw/dt of what is stored; what a damper takes
    }
    S stored(FrictionStates<S>) const noexcept { return S(0); }
    double state_size(int) const noexcept { return 1; }
};
static_assert(footfall::RateFriction<TanhFriction<>>);
// [end]

int main() {
    const footfall::ContactLaw<ConeNormal<>, footfall::NoFriction<>> law{{4e6, 2e3}, {}};
    const double mass = 0.154, dt = 1e-7;
    double z = 0, z_rate = 1, taken = 0, force = 0;  // it comes in at 1 m/s
    do {
        const auto contact = law.evaluate(z, z_rate, {0.1, 0}, {0, 0});
        z_rate -= dt * contact.normal_force / mass;
        z += dt * z_rate;
        taken += dt * contact.normal_damper_power;
        force = std::max(force, contact.normal_force);
    } while (z > 0);
    const auto slip = TanhFriction<>{0.6, 0.01}.respond({0.1, 0}, {}, {});
    const double account = 0.5 * mass * z_rate * z_rate + taken - 0.5 * mass;
    std::printf("restitution %.4f, peak force %.1f N, account off by %.1e J; friction over load %.3f\n", -z_rate, force,
                account, slip.traction.x());
    return std::abs(account) < 1e-6 ? 0 : 1;
}
