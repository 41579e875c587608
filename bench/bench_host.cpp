// What a step of a contact set costs: a slab on 4, 12 or 64 feet that drops, slides, comes to rest and lies.
//
//   build/bench/bench_host [DT]     DT in seconds, 1e-3 by default
//
// For each: the mean over all steps, the dearest step, and a step at rest, in microseconds; evaluations of the
// contacts' equations; and how often memory was asked for.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "footfall/host/contact_set.hpp"
#include "host/random_host.hpp"

namespace {

long allocations = 0;

}  // namespace

// Eigen asks malloc itself. These are the C library's own.
extern "C" {
void* __libc_malloc(std::size_t size);
void* malloc(std::size_t size) {
    ++allocations;
    return __libc_malloc(size);
}
}

namespace {

using namespace footfall;
using Clock = std::chrono::steady_clock;

/// `side` by `count / side` feet on 0.4 m by 0.4 m, a kilogram for each; it drops a centimetre at an angle.
test::LinearHost slab(int count, int side) {
    const double m = count, inertia = 0.0125 * m, size = 0.4, height = -0.1, gravity = 9.81, tilt = 0.02;
    std::vector<double> J, position;
    for (int i = 0; i < count; ++i) {
        const double x = size * (i % side / (side - 1.0) - 0.5), y = size * (i / side / (count / side - 1.0) - 0.5);
        J.insert(J.end(), {1, 0, 0, 0, height, -y});
        J.insert(J.end(), {0, 1, 0, -height, 0, x});
        J.insert(J.end(), {0, 0, 1, y, -x, 0});
        position.insert(position.end(), {0, 0, 0.01 + tilt * (x + size / 2)});
    }
    return {{1 / m, 1 / m, 1 / m, 1 / inertia, 1 / inertia, 1 / inertia},
            J,
            position,
            {0.3, 0.1, 0, 0, 0, 0},
            {0, 0, -m * gravity, 0, 0, 0}};
}

void time_slab(int count, int side, double dt) {
    test::LinearHost host = slab(count, side);
    const ContactParameters foot{AzadFeatherstoneNormal<>{1e6, 4e2}, AzadFeatherstoneFriction<>{1.5e6, 4e2, 0.6, 0.1}};
    ContactSet set(std::vector<ContactParameters>(static_cast<std::size_t>(count), foot));
    const int steps = static_cast<int>(1 / dt), last = steps / 10;
    double all = 0, dearest = 0, rest = 0, evaluations = 0, unresolved = 0, asked = 0, asked_at_rest = 0;
    for (int k = 0; k < steps; ++k) {
        const HostStep given = host.given(dt);
        const long before = allocations;
        const auto start = Clock::now();
        const ContactSetStep& step = set.step(given);
        const double spent = 1e6 * std::chrono::duration<double>(Clock::now() - start).count();
        const auto here = static_cast<double>(allocations - before);
        all += spent;
        asked += here;
        dearest = std::max(dearest, spent);
        if (k >= steps - last) rest += spent, asked_at_rest += here;
        evaluations += static_cast<double>(step.evaluations);
        unresolved += step.unresolved_time > 0 ? 1 : 0;
        host.move(dt, step.impulse, step.double_impulse);
    }
    std::printf(
        "%3d contacts: mean %8.1f us, dearest %9.1f us, at rest %8.1f us; %5.1f evaluations a step; allocations "
        "%.1f a step, %.1f at rest; %.0f unresolved\n",
        count, all / steps, dearest, rest / last, evaluations / steps, asked / steps, asked_at_rest / last, unresolved);
}

}  // namespace

int main(int argc, char** argv) {
    const double dt = argc > 1 ? std::atof(argv[1]) : 1e-3;
    time_slab(4, 2, dt);
    time_slab(12, 4, dt);
    time_slab(64, 8, dt);
}
