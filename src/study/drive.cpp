// Drives the contact of a rig through the intervals of its timeline.
#include "footfall/study/drive.hpp"

#include <chrono>

#include "footfall/simulate/budget.hpp"
#include "footfall/solve/solver.hpp"
#include "study/force_peaks.hpp"
#include "study/rig_law.hpp"
#include "study/rig_system.hpp"
#include "study/rig_watchers.hpp"
#include "study/swing.hpp"
#include "study/timeline.hpp"

namespace footfall {
namespace {

Drive drive_once(const Rig& rig, const ContactParameters& laws) {
    const auto started = std::chrono::steady_clock::now();
    const RigLaw law = rig_law(rig, laws);
    const Timeline timeline(rig, law);
    RigSystem system(rig, timeline, law);
    RigRecording recording(rig, system);
    system.listen([&](EventKind kind, const auto& y) { recording.event(kind, y); });
    ForcePeaks peaks(system);
    Swing swing(rig, timeline);
    SwingWatcher swings(system, swing);
    RigBudget budget(rig, system);
    Solver<RigSystem> solver(system);
    solver.add(recording);
    solver.add(peaks);
    solver.add(swings);
    solver.add(budget);
    // The caller is asked about once a step.
    solver.look_every(Solver<RigSystem>::evaluations_of_a_step);

    RigSystem::State y = system.initial_state();
    for (const Interval& interval : timeline.intervals()) {
        system.enter(interval, y);
        solver.run(y, 1);
        y = solver.state();
    }
    Drive result = recording.close(y);
    result.largest_normal_force = peaks.largest_normal();
    result.largest_friction_force = peaks.largest_friction();
    result.stick_slip = swing.result();
    const SolverCost& spent = solver.cost();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    result.cost = {spent.steps, spent.rejected, spent.evaluations, spent.stiff_steps, seconds};
    return result;
}

}  // namespace

Drive drive(const Rig& rig, const ContactParameters& laws) {
    check(rig);
    check(laws, "contact");
    return in_own_words([&] { return drive_once(rig, laws); });
}

}  // namespace footfall
