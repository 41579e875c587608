// How often the intervals of a fit contain the truth: force-time traces, and restitution curves, made by an integration
// that shares nothing with the library (tests/study/synthetic_impact.hpp), with Gaussian noise, fitted from starts that
// the fit finds itself.
//
//   fit_coverage [--repetitions 1000] [--noise 0.01] [--seed 1]
//   fit_coverage --write-data DIR     writes the synthetic measurements of data/synthetic
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ostream.h>

#include "bench/timing.hpp"
#include "footfall/study/fit.hpp"
#include "study/synthetic_impact.hpp"

namespace {

using footfall::FitData;
using footfall::FitStudy;
using footfall::FitValue;
using footfall::Measured;

// Azad & Featherstone 2010, section 2.2.
constexpr double K_n = 8.5e6, D_n = 3.1e3, mass = 0.154;
constexpr double trace_speed = 1;
constexpr int trace_samples = 200, curve_speeds = 40;
constexpr double coverage_wanted = 0.95, coverage_margin = 0.03;

using Random = std::mt19937_64;

/// A force-time trace with noise of `noise` times the peak force, a tenth of the contact before touchdown and after it.
FitData force_trace(double noise, Random& random) {
    const synthetic::Impact impact{K_n, D_n, mass, trace_speed};
    const double duration = impact.duration();
    FitData data{.kind = Measured::force_time, .source = "synthetic"};
    for (int i = 0; i < trace_samples; ++i) data.x.push_back(duration * (-0.1 + 1.2 * i / (trace_samples - 1)));
    std::vector<double> during;
    for (const double t : data.x) {
        if (t > 0) during.push_back(t);
    }
    const std::vector<double> forces = impact.force_at(during);
    data.y.assign(data.x.size() - during.size(), 0);
    data.y.insert(data.y.end(), forces.begin(), forces.end());
    double peak = 0;
    for (const double f : forces) peak = std::fmax(peak, f);
    std::normal_distribution<double> gaussian(0, noise * peak);
    for (double& f : data.y) f += gaussian(random);
    return data;
}

/// Restitution at speeds from 1 cm/s to 5 m/s, with noise in units of restitution.
FitData restitution_curve(double noise, Random& random) {
    FitData data{.kind = Measured::restitution, .source = "synthetic"};
    std::normal_distribution<double> gaussian(0, noise);
    for (int i = 0; i < curve_speeds; ++i) {
        const double speed = 0.01 * std::pow(500, static_cast<double>(i) / (curve_speeds - 1));
        const synthetic::Impact impact{K_n, D_n, mass, speed};
        synthetic::Impact::State y{0, speed, 0};
        while (!impact.over(y)) y = impact.step(y, impact.step_size());
        data.x.push_back(speed);
        data.y.push_back(std::fmin(std::fmax(-y[1] / speed + gaussian(random), 0), 1));
    }
    return data;
}

FitStudy study_of(FitData data, const std::vector<std::string>& free) {
    FitStudy study{.data = std::move(data)};
    footfall::FitLaw law{footfall::AzadFeatherstoneNormal<>{1, 1}, {}};
    for (const std::string& key : free) law.free.push_back({key, FitValue{.free = true}});
    study.laws = {law};
    study.mass = FitValue{.value = mass};
    study.speed = FitValue{.value = trace_speed};
    return study;
}

bool contains(const std::optional<footfall::FitInterval>& interval, double truth) {
    return interval && interval->low <= truth && truth <= interval->high;
}

/// How often of how many, as a line; false where it is too far from what the interval promises.
bool say(const char* what, int hits, int of) {
    const double share = static_cast<double>(hits) / of;
    const bool good = std::abs(share - coverage_wanted) <= coverage_margin;
    fmt::print("  {:<44} {:5} of {}   {:.1f} %   {}\n", what, hits, of, 100 * share, good ? "" : "outside 95 +- 3 %");
    return good;
}

bool measure(int repetitions, double noise, std::uint64_t seed) {
    Random random(seed);
    int stiffness = 0, damping = 0, combination = 0;
    const double truth = D_n * std::pow(K_n, -0.6) * std::pow(mass, -0.4);
    const double begin = bench::processor_time();
    for (int i = 0; i < repetitions; ++i) {
        const auto trace = footfall::fit(study_of(force_trace(noise, random), {"stiffness", "damping"}));
        const auto& estimates = trace.fits[0].result.estimates;
        stiffness += contains(estimates[0].interval, K_n);
        damping += contains(estimates[1].interval, D_n);
    }
    const double after_traces = bench::processor_time();
    for (int i = 0; i < repetitions; ++i) {
        const auto curve = footfall::fit(study_of(restitution_curve(noise, random), {"stiffness", "damping"}));
        const auto& known = curve.fits[0].result.combinations;
        combination += known.size() == 1 && contains(known[0].interval, truth);
    }
    const double end = bench::processor_time();
    fmt::print("The truth inside the 95 % interval, noise {:g} % of the peak force, or {:g} of restitution, seed {}:\n",
               100 * noise, noise, seed);
    bool good = say("force-time traces: K_n", stiffness, repetitions);
    good = say("force-time traces: D_n", damping, repetitions) && good;
    good = say("restitution curves: D_n K_n^(-3/5) m^(-2/5)", combination, repetitions) && good;
    fmt::print("  {:.2f} ms for a trace of {} samples, {:.2f} ms for a curve of {} speeds\n",
               1e3 * (after_traces - begin) / repetitions, trace_samples, 1e3 * (end - after_traces) / repetitions,
               curve_speeds);
    return good;
}

/// A force-indentation loop, with the rate of indentation, without noise in either.
FitData force_loop(double noise, Random& random) {
    const synthetic::Impact impact{K_n, D_n, mass, trace_speed};
    FitData data{.kind = Measured::force_indentation, .source = "synthetic"};
    int step = 0;
    for (synthetic::Impact::State y{0, trace_speed, 0}; !impact.over(y); y = impact.step(y, impact.step_size())) {
        if (step++ % 20 != 0) continue;
        data.x.push_back(y[0] * y[0]);
        data.rate.push_back(y[1]);
        data.y.push_back(impact.force(y));
    }
    double peak = 0;
    for (const double f : data.y) peak = std::fmax(peak, f);
    std::normal_distribution<double> gaussian(0, noise * peak);
    for (double& f : data.y) f += gaussian(random);
    return data;
}

void write(const std::filesystem::path& file, const std::string& what, const std::string& header, const FitData& data) {
    std::ofstream out(file);
    fmt::print(out,
               "# Synthetic, not measured: {}\n"
               "# The law of Azad & Featherstone 2010, (13), K_n = {:g} N/m^1.5, D_n = {:g} N s/m^1.5, m = {:g} kg.\n"
               "# Made by: build/bench/fit_coverage --write-data data/synthetic\n"
               "{}\n",
               what, K_n, D_n, mass, header);
    for (std::size_t i = 0; i < data.x.size(); ++i) {
        fmt::print(out, "{:.6g},{:.6g}", data.x[i], data.y[i]);
        if (!data.rate.empty()) fmt::print(out, ",{:.6g}", data.rate[i]);
        fmt::print(out, "\n");
    }
    if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

void write_data(const std::filesystem::path& folder, double noise) {
    Random random(2010);
    write(
        folder / "force-time.csv",
        fmt::format("force of an impact at {:g} m/s, Gaussian noise of {:g} % of the peak.", trace_speed, 100 * noise),
        "time [s],force [N]", force_trace(noise, random));
    write(folder / "restitution.csv", fmt::format("restitution, Gaussian noise of {:g}.", noise),
          "speed [m/s],restitution", restitution_curve(noise, random));
    write(
        folder / "force-indentation.csv",
        fmt::format("force of an impact at {:g} m/s, Gaussian noise of {:g} % of the peak.", trace_speed, 100 * noise),
        "indentation [m],force [N],rate [m/s]", force_loop(noise, random));
}

}  // namespace

int main(int argc, char** argv) {
    int repetitions = 1000;
    double noise = 0.01;
    std::uint64_t seed = 1;
    std::filesystem::path folder;
    CLI::App app{"How often the intervals of a fit contain the truth"};
    app.add_option("--repetitions", repetitions, "Data sets of each kind")->check(CLI::PositiveNumber);
    app.add_option("--noise", noise, "Of the peak force, and of restitution")->check(CLI::PositiveNumber);
    app.add_option("--seed", seed, "Of the noise");
    app.add_option("--write-data", folder, "Write synthetic data into a folder instead");
    CLI11_PARSE(app, argc, argv);
    if (!folder.empty()) {
        write_data(folder, noise);
        return 0;
    }
    return measure(repetitions, noise, seed) ? 0 : 1;
}
