// The contact of a rig as a Solver sees it, one interval of its timeline after another.
//
// When the contact begins, is loaded and ends is known beforehand: these are ends of intervals. Two guards are left to
// be found, the clutch and the slip velocity's turning.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "footfall/simulate/derivatives.hpp"
#include "footfall/simulate/hybrid.hpp"
#include "footfall/solve/method.hpp"
#include "footfall/solve/plain_system.hpp"
#include "footfall/solve/solver.hpp"
#include "footfall/study/drive.hpp"
#include "study/rig_law.hpp"
#include "study/rig_plant.hpp"
#include "study/timeline.hpp"

namespace footfall {

class RigSystem : public PlainSystem<double> {
public:
    using Law = RigLaw;
    using Plant = RigPlant<double>;
    using HybridType = Hybrid<Plant, Law>;
    using State = HybridType::State;
    using Guards = Eigen::Array<double, 2, 1>;
    using Contact = HybridType::Contact;

    static constexpr int motion_at_compile_time = Eigen::Dynamic;
    static constexpr int guards_per_group = 2;
    static constexpr int clutch_guard = 0;
    static constexpr int turn_guard =
        1;  ///< V along where it pointed: laws with |V| in them have a kink where it turns
    /// All that tells slip from stick may be the lag of a stiff bristle, which no interpolant knows.
    static constexpr bool locates_by_secants = true;
    /// Changes of phase without time going on: two phases may each push the motion into the other.
    static constexpr int longest_visit = 50;
    // A rig has 5 to 9 components of motion, more with bonds: an implicit step costs some five explicit ones, and a
    // look costs less than one.
    static constexpr Switching switching{
        .look = 16, .border = 0.5, .price = 5, .patience = 4, .gentle = 0.25, .follows_turning = true};

    /// Hears of every event, in its new mode.
    using Listener = std::function<void(EventKind, const State&)>;

    RigSystem(const Rig& rig, const Timeline& timeline, const RigLaw& law);
    RigSystem(const RigSystem&) = delete;  // its plants look at its interval
    RigSystem& operator=(const RigSystem&) = delete;

    void listen(Listener listener) { listener_ = std::move(listener); }
    [[nodiscard]] const HybridType& hybrid() const noexcept { return hybrid_; }
    [[nodiscard]] const Law& law() const noexcept { return hybrid_.law(0); }
    [[nodiscard]] const Plant& plant() const noexcept { return hybrid_.plant(); }
    [[nodiscard]] Mode mode() const noexcept { return hybrid_.mode(0); }
    [[nodiscard]] const Timeline& timeline() const noexcept { return timeline_; }

    /// The first state of a run.
    [[nodiscard]] State initial_state() const { return State::Zero(hybrid_.size()); }
    /// The interval that `start` begins; y is the state so far.
    void enter(const Interval& interval, const State& y);
    [[nodiscard]] const Interval& interval() const noexcept { return interval_; }
    /// [s]
    [[nodiscard]] double time_at(double theta) const { return timeline_.at(interval_, theta).time; }
    [[nodiscard]] Instant instant(const State& y) const { return timeline_.at(interval_, y[Plant::theta]); }

    /// All that is measured of the rig at y.
    [[nodiscard]] RigState measure(const State& y) const;
    [[nodiscard]] RigEnergy energy(const State& y) const;
    /// How the contact stands, and what it does.
    [[nodiscard]] Contact contact(const State& y) const { return hybrid_.contacts_at(y).front(); }
    /// The size of the account, for the errors that are allowed in it [J].
    void see_energy(double scale) noexcept { energy_scale_ = scale; }

    // ---- what a Solver asks for ----------------------------------------------------------------------------------

    [[nodiscard]] int size() const noexcept { return hybrid_.size(); }
    [[nodiscard]] int motion_size() const noexcept { return hybrid_.motion_size(); }
    [[nodiscard]] static int guard_count() noexcept { return guards_per_group; }
    [[nodiscard]] static int clock() noexcept { return Plant::theta; }

    void evaluate(const State& y, State& rate, Guards* guards);
    template <class Vector, class Matrix>
    std::int64_t jacobian(const Vector& y, Matrix& J) {
        return derivatives_.jacobian(hybrid_, y, J);
    }

    void weights(const State& y, State& weight);
    [[nodiscard]] double longest_step(const State&) const { return timeline_.longest_step(interval_); }
    [[nodiscard]] double first_step() const;
    void stepped(double next) noexcept { last_step_ = next * interval_.length(); }
    void tidy(State& y, double from, double to);
    /// What the states of a contact in flight have become between two places of the clock.
    void relax(State& y, double from, double to) const;

    [[nodiscard]] static bool outranks(int j, int) noexcept { return j == clutch_guard; }
    [[nodiscard]] bool quick(int guard) const { return guard == turn_guard || law().quick(Law::clutch_guard); }
    /// A contact may be left sticking.
    [[nodiscard]] bool may_wait(int guard) const noexcept {
        return guard == clutch_guard && mode().phase == Phase::stick;
    }
    [[nodiscard]] double moment() const noexcept;

    void start(State& y, std::vector<bool>& armed);
    GoesOn<double> jump(std::span<const int> guards, State& y, std::vector<bool>& armed);

private:
    void set_floors();
    [[nodiscard]] double largest_depth() const noexcept;
    void see(const State& y);
    void look_along(const State& y);
    [[nodiscard]] double turning_noise() const;
    void begin_contact(State& y);
    void apply(const Jump<double>& jump, State& y);

    const Rig& rig_;
    const Timeline& timeline_;
    Listener listener_ = [](EventKind, const State&) {};
    Interval interval_;
    HybridType hybrid_;
    Derivatives<HybridType> derivatives_;
    HybridType::Guards all_guards_;

    std::optional<Touch<double>> before_;  // at the end of the last interval
    Vector2<double> direction_{0, 0};      // where V has pointed
    State seen_, floor_;
    double largest_bristle_error_ = 0;  // [m]; 0: the tolerance alone says
    double energy_scale_ = 0;           // [J]
    double last_step_ = 0;              // [s]
    double last_switch_ = -1;           // [s]
    int switches_ = 0;                  // in a row without time going on
};

}  // namespace footfall
