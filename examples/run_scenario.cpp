// A scenario file, run: its events and how well its energy adds up.
#include <exception>
#include <iostream>

#include "footfall/io/scenario.hpp"
#include "footfall/simulate/run.hpp"

int main(int argc, char** argv) try {
    if (argc != 2) {
        std::cerr << "usage: run_scenario SCENARIO.toml\n";
        return 2;
    }
    const footfall::Scenario scenario = footfall::load_scenario(argv[1]);
    const footfall::Run run = footfall::run(scenario.simulation);

    std::cout << scenario.title << '\n';
    for (const auto& event : run.events) {
        std::cout << event.time << " s: " << footfall::name_of(event.kind) << ", sphere " << event.sphere << '\n';
    }
    std::cout << "final position [m]: " << run.final.body.position.transpose() << '\n'
              << "largest residual of the ledger: " << run.max_residual << '\n';
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
