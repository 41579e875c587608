// Runs many random valid scenarios, over every law of the registry, and checks each: it ends, every number in it is
// finite, the ledger closes, and no dissipation channel ever gives anything back that its law says it cannot. A failure
// prints its seed; `soak --seed N --scenarios 1`, with the other options as they were, repeats it.
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "tests/simulate/random_scenario.hpp"

namespace {

using namespace footfall;
using soak::Laws, soak::RandomScenario, soak::verdict;

/// The names of the laws of one kind, each once.
template <class Kind>
std::set<std::string> names_of(const Simulation& s, Kind ContactParameters::*kind) {
    std::set<std::string> names;
    for (const ContactParameters& c : s.contacts) names.emplace(name_of(c.*kind));
    return names;
}

/// The scenario in a few words: its laws, what is zero in them, how many spheres.
std::string description(const Simulation& s) {
    std::set<std::string> zeros;
    const auto note = [&](const auto& law) {
        for (const auto& p : law.parameters())
            if (law.*p.member == 0) zeros.insert(fmt::format("{}=0", p.symbol));
    };
    for (const ContactParameters& c : s.contacts) {
        std::visit(note, c.normal);
        std::visit(note, c.friction);
    }
    return fmt::format("{} + {}, {}{}{} sphere(s){}{}", fmt::join(names_of(s, &ContactParameters::normal), "|"),
                       fmt::join(names_of(s, &ContactParameters::friction), "|"), fmt::join(zeros, " "),
                       zeros.empty() ? "" : ", ", s.body.spheres.size(), s.gravity.isZero() ? ", no gravity" : "",
                       s.options.allow_initial_penetration ? ", starts in the ground" : "");
}

enum class Outcome : std::uint8_t { passed, failed, refused };

/// How many scenarios came out how.
struct Outcomes {
    std::array<std::int64_t, 3> count{};
    std::int64_t& operator[](Outcome o) { return count[static_cast<std::size_t>(o)]; }
};

struct Tally {
    std::mutex print;
    Outcomes all;
    std::map<std::string, Outcomes> normal, friction;  // by the law's name
    std::int64_t stiff = 0, evaluations = 0;
    double worst_residual = 0, slowest = 0;

    void add(const Simulation& s, Outcome outcome) {
        ++all[outcome];
        for (const std::string& name : names_of(s, &ContactParameters::normal)) ++normal[name][outcome];
        for (const std::string& name : names_of(s, &ContactParameters::friction)) ++friction[name][outcome];
    }
};

void print_by_law(const char* kind, std::map<std::string, Outcomes>& laws) {
    fmt::print("{:<28}{:>10}{:>10}{:>10}\n", kind, "passed", "failed", "refused");
    for (auto& [name, o] : laws)
        fmt::print("  {:<26}{:>10}{:>10}{:>10}\n", name, o[Outcome::passed], o[Outcome::failed], o[Outcome::refused]);
}

void soak_one(std::uint64_t seed, bool mixed, const std::string& friction, Tally& tally) {
    const auto started = std::chrono::steady_clock::now();
    const Simulation simulation = RandomScenario(seed, Laws::every, mixed, friction).draw();
    std::string wrong;
    double residual = 0;
    Cost cost;
    try {
        const Run run = footfall::run(simulation);
        wrong = verdict(run, simulation);
        residual = run.max_residual;
        cost = run.cost;
    } catch (const TooExpensive& e) {
        const std::scoped_lock lock(tally.print);
        tally.add(simulation, Outcome::refused);
        fmt::print("seed {} ({}): refused: {}\n", seed, description(simulation), e.what());
        return;
    } catch (const std::exception& e) {
        wrong = e.what();
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    const std::scoped_lock lock(tally.print);
    tally.worst_residual = std::max(tally.worst_residual, residual);
    tally.slowest = std::max(tally.slowest, seconds);
    tally.add(simulation, wrong.empty() ? Outcome::passed : Outcome::failed);
    tally.evaluations += cost.evaluations;
    tally.stiff += cost.stiff_steps > 0 ? 1 : 0;
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
    bool mixed = false;
    app.add_flag("--mixed", mixed, "the spheres of a body have different laws");
    std::set<std::string> frictions;
    for_each_law<FrictionLaw>([&](const auto& law) { frictions.emplace(law.description.name); });
    std::string friction;
    app.add_option("--friction", friction, "the friction law of every contact")->check(CLI::IsMember(frictions));
    CLI11_PARSE(app, argc, argv);

    Tally tally;
    std::atomic<std::uint64_t> next{0};
    std::vector<std::thread> workers;
    for (unsigned t = 0; t < threads; ++t)
        workers.emplace_back([&] {
            for (std::uint64_t k = next++; k < scenarios; k = next++) soak_one(seed + k, mixed, friction, tally);
        });
    for (std::thread& w : workers) w.join();
    fmt::print("{} scenarios: {} passed, {} failed, {} refused as too expensive; {} used the implicit method\n",
               scenarios, tally.all[Outcome::passed], tally.all[Outcome::failed], tally.all[Outcome::refused],
               tally.stiff);
    print_by_law("friction law", tally.friction);
    print_by_law("normal law", tally.normal);
    fmt::print("worst residual {:.2e}; slowest {:.2f} s; {:.3g} evaluations in all\n", tally.worst_residual,
               tally.slowest, static_cast<double>(tally.evaluations));
    return tally.all[Outcome::failed] == 0 ? 0 : 1;
}
