// A simulator of your own in C++17, through footfall.h: a block on three feet lands on a slope at 1 ms and sticks.
//
// The block does not turn: its three contacts move together, so that the Delassus matrix has rank three of nine.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <footfall.h>

namespace {

void check(footfall_status status) {
    if (status == FOOTFALL_OK) return;
    std::fprintf(stderr, "footfall: %s\n", footfall_last_error());
    std::exit(EXIT_FAILURE);
}

}  // namespace

int main() {
    constexpr double mass = 2, gravity = 9.81, slope = 0.2, dt = 1e-3, end = 0.5, drop = 0.01;
    constexpr int feet = 3, steps = static_cast<int>(end / dt + 0.5);
    const std::vector<footfall_parameter> normal{{"stiffness", 1e7}, {"damping", 5e3}};
    const std::vector<footfall_parameter> friction{{"stiffness", 1.5e7}, {"damping", 5e3}, {"coefficient", 0.6}};
    const footfall_law law{"azad-featherstone", normal.data(),   normal.size(),
                           "azad-featherstone", friction.data(), friction.size()};
    const std::vector<footfall_law> laws(feet, law);
    footfall_contact_set* made = nullptr;
    check(footfall_contact_set_create(FOOTFALL_INTERFACE, laws.data(), laws.size(), 0, 0, &made));
    const std::unique_ptr<footfall_contact_set, decltype(&footfall_contact_set_destroy)> contacts(
        made, footfall_contact_set_destroy);

    // In the slope's frame: x down the slope, z along its normal.
    const double pull[3] = {gravity * std::sin(slope), 0, -gravity * std::cos(slope)};
    double x[3] = {0, 0, drop}, v[3] = {0, 0, 0}, taken = 0, held = 0;
    std::vector<double> depth(feet), velocity(3 * feet), acceleration(3 * feet), delassus(9 * feet * feet);
    for (int a = 0; a < 3 * feet; ++a)
        for (int b = 0; b < 3 * feet; ++b) delassus[a * 3 * feet + b] = a % 3 == b % 3 ? 1 / mass : 0;
    std::vector<double> J(3 * feet), JJ(3 * feet);
    for (int step = 0; step < steps; ++step) {
        for (int i = 0; i < feet; ++i) {
            depth[i] = -x[2];
            for (int k = 0; k < 3; ++k) {
                velocity[3 * i + k] = v[k];
                acceleration[3 * i + k] = pull[k];
            }
        }
        footfall_host_step host{};
        host.dt = dt;
        host.depth = depth.data();
        host.velocity = velocity.data();
        host.free_acceleration = acceleration.data();
        host.delassus = delassus.data();
        footfall_step_result result{};
        result.impulse = J.data();
        result.double_impulse = JJ.data();
        check(footfall_contact_set_step(contacts.get(), &host, &result));
        for (int k = 0; k < 3; ++k) {
            double impulse = 0, double_impulse = 0;
            for (int i = 0; i < feet; ++i) impulse += J[3 * i + k], double_impulse += JJ[3 * i + k];
            x[k] += dt * v[k] + 0.5 * dt * dt * pull[k] + double_impulse / mass;
            v[k] += dt * pull[k] + impulse / mass;
        }
        taken += result.taken;
        held = result.held;
    }
    double left = held + taken;
    for (int k = 0; k < 3; ++k) left += 0.5 * mass * v[k] * v[k] - mass * pull[k] * (x[k] - (k == 2 ? drop : 0));
    std::vector<int> phases(feet);
    check(footfall_contact_set_save(contacts.get(), nullptr, phases.data()));
    const double speed = std::sqrt(v[0] * v[0] + v[2] * v[2]);
    std::printf("slid %.3f mm, speed %.1e m/s, phase %d (1 sticks); the account misses %.1e mJ\n", 1e3 * x[0], speed,
                phases[0], 1e3 * left);
    return phases[0] == 1 && speed < 1e-3 && std::fabs(left) < 1e-6 * taken ? EXIT_SUCCESS : EXIT_FAILURE;
}
