// The contact law inside a time loop of your own: a block slides onto the ground and stops.
#include <cstdio>

#include "footfall/law/contact_law.hpp"
#include "footfall/law/registry.hpp"

int main() {
    const footfall::ContactLaw<footfall::AzadFeatherstoneNormal<>, footfall::AzadFeatherstoneFriction<>> law{
        {8.5e6, 3.1e3},               // K_n [N/m^1.5], D_n [N s/m^1.5]
        {12.75e6, 3.1e3, 0.2, 0.1}};  // K_t [N/m^1.5], D_t [N s/m^1.5], mu [1], C_V [N s/m]
    const double mass = 0.154, dt = 1e-7;
    const footfall::Vector3<double> gravity{0, 0, -9.81};
    footfall::Vector3<double> position{0, 0, 0.01}, velocity{0.5, 0, 0};  // of the point that touches
    footfall::Vector2<double> bristle{0, 0};
    double damper = 0, clutch = 0;  // where the energy went [J]

    for (int step = 0; step < 5'000'000; ++step) {
        const auto contact = law.evaluate(-position.z(), -velocity.z(), velocity.in_plane(), bristle);
        const auto& friction = contact.friction_force;
        velocity += dt * (gravity + footfall::Vector3<double>{friction.x(), friction.y(), contact.normal_force} / mass);
        position += dt * velocity;
        bristle += dt * contact.bristle_rate;
        damper += dt * (contact.normal_damper_power + contact.tangential_damper_power);
        clutch += dt * contact.clutch_power;
    }
    std::printf("stopped at x = %.4f m, speed %.1e m/s; dampers took %.2f mJ, the clutch %.2f mJ\n", position.x(),
                velocity.norm(), 1e3 * damper, 1e3 * clutch);
}
