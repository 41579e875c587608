// The contact law over arrays as a C++ program would write it: what law.evaluate from NumPy is measured against.
#include <cstddef>
#include <cstdint>

#include "footfall/law/contact_law.hpp"
#include "footfall/law/friction/azad_featherstone.hpp"
#include "footfall/law/normal/azad_featherstone.hpp"

/// Section 4's law over `count` contacts; vectors are pairs.
extern "C" void evaluate(std::size_t count, const double* parameters, const double* depth, const double* depth_rate,
                         const double* V, const double* u, std::int8_t* phase, double* normal_force,
                         double* friction_force, double* bristle_rate, double* normal_spring, double* tangential_spring,
                         double* normal_damper_power, double* tangential_damper_power, double* clutch_power,
                         double* stiffness_change_power) {
    const footfall::ContactLaw<footfall::AzadFeatherstoneNormal<>, footfall::AzadFeatherstoneFriction<>> law{
        {parameters[0], parameters[1]}, {{parameters[2], parameters[3], parameters[4], parameters[5]}}};
    for (std::size_t i = 0; i < count; ++i) {
        const auto r = law.evaluate(depth[i], depth_rate[i], {V[2 * i], V[2 * i + 1]}, {u[2 * i], u[2 * i + 1]});
        phase[i] = static_cast<std::int8_t>(r.phase);
        normal_force[i] = r.normal_force;
        friction_force[2 * i] = r.friction_force.x();
        friction_force[2 * i + 1] = r.friction_force.y();
        bristle_rate[2 * i] = r.bristle_rate.x();
        bristle_rate[2 * i + 1] = r.bristle_rate.y();
        normal_spring[i] = r.normal_spring;
        tangential_spring[i] = r.tangential_spring;
        normal_damper_power[i] = r.normal_damper_power;
        tangential_damper_power[i] = r.tangential_damper_power;
        clutch_power[i] = r.clutch_power;
        stiffness_change_power[i] = r.stiffness_change_power;
    }
}
