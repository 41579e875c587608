// The equations of a driven contact in a known phase, for any friction law, behind one face: the integrator that
// drives them is compiled once.
//
//   theta  x (2) v (2)  | the states of the friction law |  d (2)  | the ledger (7)
//   \---------------- the motion -----------------------/  \-- what follows from it --/
//
// x, v: the mass, where there is one. d: the slip displacement, the integral of V_sph.
#pragma once

#include <memory>

#include <Eigen/Core>

#include "footfall/law/friction/rate_friction.hpp"
#include "footfall/law/registry.hpp"
#include "study/timeline.hpp"

namespace footfall {

struct DrivenLayout {
    static constexpr int most_states = max_friction_states;
    static constexpr int theta = 0, position = 1, velocity = 3, states = 5;
    static constexpr int most = states + most_states + 2 + 7;

    int state_count = 0;

    [[nodiscard]] int motion_size() const noexcept { return states + state_count; }
    [[nodiscard]] int displacement() const noexcept { return motion_size(); }
    [[nodiscard]] int ledger() const noexcept { return motion_size() + 2; }
    [[nodiscard]] int size() const noexcept { return ledger() + 7; }
    // Offsets in the ledger: what is dissipated, P, what the drive has done.
    static constexpr int normal_damper = 0, tangential_damper = 1, clutch = 2, stiffness_change = 3, holding_damper = 4,
                         pressing_work = 5, dragging_work = 6;
};

using DrivenState = Eigen::Array<double, Eigen::Dynamic, 1, 0, DrivenLayout::most, 1>;

/// What bounds a phase: each is positive while it lasts.
struct DrivenGuards {
    double clutch = 1;  ///< stick or slip
    double turn = 1;    ///< the slip velocity along where it pointed: laws with |V| in them have a kink where it turns
};

/// One moment of a driven contact, for a person.
struct DrivenMoment {
    double normal_force = 0, normal_spring = 0, tangential_spring = 0;
    Eigen::Vector2d slip{0, 0}, friction_force{0, 0}, bristle{0, 0};
};

class DrivenContact {
public:
    virtual ~DrivenContact() = default;

    [[nodiscard]] const DrivenLayout& layout() const noexcept { return layout_; }
    [[nodiscard]] Phase phase() const noexcept { return phase_; }

    void evaluate(const DrivenState& y, DrivenState& rate, DrivenGuards* guards) { do_evaluate(y, rate, guards); }
    /// d(rate)/dy of the motion.
    virtual void differentiate(const DrivenState& y, Eigen::MatrixXd& J) = 0;
    [[nodiscard]] virtual DrivenMoment moment(const DrivenState& y) = 0;

    /// The interval that follows begins at y: sets the phase and what of the states and the ledger jumps.
    virtual void enter(const Interval& interval, DrivenState& y) = 0;
    /// The clutch's guard has reached zero at y.
    virtual void switch_phase(DrivenState& y) = 0;
    /// Where the slip velocity points, for the guard of turning; zero where it has no direction yet.
    void look_along(const Eigen::Vector2d& direction) noexcept { direction_ = direction; }
    [[nodiscard]] const Eigen::Vector2d& direction() const noexcept { return direction_; }
    /// The law has a kink where the slip velocity turns.
    [[nodiscard]] virtual bool turns() const noexcept = 0;
    /// The natural size of a state of the friction law, where the law knows it; else 0.
    [[nodiscard]] virtual double state_size(int i) const = 0;

    [[nodiscard]] static std::unique_ptr<DrivenContact> make(const Rig& rig, const Timeline& timeline,
                                                             const ContactParameters& laws);

protected:
    virtual void do_evaluate(const DrivenState& y, DrivenState& rate, DrivenGuards* guards) = 0;

    DrivenLayout layout_;
    Phase phase_ = Phase::flight;
    Eigen::Vector2d direction_{0, 0};
};

}  // namespace footfall
