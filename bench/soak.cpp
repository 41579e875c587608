// Runs many random valid scenarios and checks each: it ends, every number in it is finite, the ledger closes, and no
// dissipation channel ever gives anything back. A failure prints its seed; `soak --seed N --scenarios 1` repeats it.
#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "tests/simulate/random_scenario.hpp"

namespace {

using namespace footfall;
using soak::RandomScenario, soak::verdict;

/// The scenario in a few words: its laws, what is zero in them, how many spheres.
std::string description(const Simulation& s) {
    std::string zeros;
    const auto note = [&](const auto& law) {
        for (const auto& p : law.parameters())
            if (law.*p.member == 0) zeros += fmt::format(" {}=0", p.symbol);
    };
    std::visit(note, s.contacts[0].normal);
    std::visit(note, s.contacts[0].friction);
    return fmt::format("{} + {},{} {} sphere(s){}{}", name_of(s.contacts[0].normal), name_of(s.contacts[0].friction),
                       zeros, s.body.spheres.size(), s.gravity.isZero() ? ", no gravity" : "",
                       s.options.allow_initial_penetration ? ", starts in the ground" : "");
}

struct Tally {
    std::atomic<std::int64_t> good{0}, bad{0}, expensive{0}, stiff{0}, evaluations{0};
    std::mutex print;
    double worst_residual = 0, slowest = 0;
};

void soak_one(std::uint64_t seed, Tally& tally) {
    const auto started = std::chrono::steady_clock::now();
    const Simulation simulation = RandomScenario(seed).draw();
    std::string wrong;
    double residual = 0;
    try {
        const Run run = footfall::run(simulation);
        wrong = verdict(run, simulation.options.tolerance);
        residual = run.max_residual;
        tally.evaluations += run.cost.evaluations;
        tally.stiff += run.cost.stiff_steps > 0;
    } catch (const TooExpensive& e) {
        ++tally.expensive;
        const std::scoped_lock lock(tally.print);
        fmt::print("seed {} ({}): refused: {}\n", seed, description(simulation), e.what());
        return;
    } catch (const std::exception& e) {
        wrong = e.what();
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    const std::scoped_lock lock(tally.print);
    tally.worst_residual = std::max(tally.worst_residual, residual);
    tally.slowest = std::max(tally.slowest, seconds);
    ++(wrong.empty() ? tally.good : tally.bad);
    if (!wrong.empty()) fmt::print("seed {} ({}): FAILED: {}\n", seed, description(simulation), wrong);
    if (seconds > 5) fmt::print("seed {} ({}): took {:.1f} s\n", seed, description(simulation), seconds);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Runs random valid scenarios and checks each");
    std::uint64_t scenarios = 100000, seed = 1;
    unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    app.add_option("--scenarios", scenarios, "how many")->capture_default_str();
    app.add_option("--seed", seed, "seed of the first; the next has the next number")->capture_default_str();
    app.add_option("--threads", threads, "how many at a time")->capture_default_str();
    CLI11_PARSE(app, argc, argv);

    Tally tally;
    std::atomic<std::uint64_t> next{0};
    std::vector<std::thread> workers;
    for (unsigned t = 0; t < threads; ++t)
        workers.emplace_back([&] {
            for (std::uint64_t k = next++; k < scenarios; k = next++) soak_one(seed + k, tally);
        });
    for (std::thread& w : workers) w.join();
    fmt::print("{} scenarios: {} passed, {} failed, {} refused as too expensive; {} used the implicit method\n",
               scenarios, tally.good.load(), tally.bad.load(), tally.expensive.load(), tally.stiff.load());
    fmt::print("worst residual {:.2e}; slowest {:.2f} s; {:.3g} evaluations in all\n", tally.worst_residual,
               tally.slowest, static_cast<double>(tally.evaluations.load()));
    return tally.bad == 0 ? 0 : 1;
}
