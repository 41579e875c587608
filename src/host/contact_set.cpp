#include "footfall/host/contact_set.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "footfall/host/held_system.hpp"
#include "footfall/law/turn.hpp"
#include "footfall/math/error.hpp"
#include "host/check_step.hpp"
#include "host/implicit_rest.hpp"

namespace footfall {
namespace {

using Law = ContactLawOver<double>;
using System = HeldSystem<Law>;
using State = System::State;

struct BudgetSpent {};

/// Ends the work on a step that needs too many evaluations.
class StepBudget final : public Watcher<State> {
public:
    explicit StepBudget(std::int64_t most) : most_(most) {}
    void look(const SolverCost& cost, const double& /*clock*/) override {
        if (cost.evaluations > most_) throw BudgetSpent{};
    }

private:
    std::int64_t most_;
};

std::vector<Law> checked(const std::vector<ContactParameters>& parameters) {
    if (parameters.empty())
        throw InvalidInput("laws: there are none; a set has one law for each of its contacts, >= 1");
    std::vector<Law> laws;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        check(parameters[i], fmt::format("laws[{}]", i));
        laws.emplace_back(parameters[i].normal, parameters[i].friction);
    }
    return laws;
}

}  // namespace

class ContactSet::Inside {
public:
    Inside(std::vector<ContactParameters> parameters, const ContactSetOptions& options)
        : parameters_(std::move(parameters)),
          options_((host::check_options(options), options)),
          laws_(checked(parameters_)),
          asks_(first_that_sees_turning(laws_)),
          given_(laws_.size()),
          system_(given_, laws_, options.tolerance, asks_ >= 0),
          budget_(options.max_evaluations),
          solver_(system_),
          rest_(system_),
          begin_(State::Zero(system_.hybrid().size())),
          phases_(laws_.size(), Phase::flight) {
        offsets_.push_back(0);
        for (const Law& law : laws_) offsets_.push_back(offsets_.back() + static_cast<std::size_t>(law.states()));
        states_.assign(offsets_.back(), 0.0);
        const std::size_t n = laws_.size();
        result_.impulse.resize(3 * n);
        result_.double_impulse.resize(3 * n);
        result_.angular_impulse.resize(3 * n);
        result_.energy.resize(n);
        solver_.add(budget_);
        constexpr std::int64_t between_looks = 64;  // evaluations
        solver_.look_every(std::min(between_looks, options.max_evaluations));
    }

    const ContactSetStep& step(const HostStep& host) {
        const std::size_t n = laws_.size();
        host::check_step(host, n, asks_, asks_ < 0 ? "" : name_of(laws_[index(asks_)].friction));
        turn(host, 0.5);  // half before and half after: of second order in dt
        if (flies(host)) {
            fly(host.dt);
        } else {
            take(host);
            integrate(host.dt);
        }
        turn(host, 0.5);
        result_.ground_work = 0;
        for (std::size_t k = 0; k < host.ground_velocity.size(); ++k)
            result_.ground_work += host.ground_velocity[k] * result_.impulse[k];
        return result_;
    }

    void take_memory(const Inside& other) {
        states_ = other.states_;
        phases_ = other.phases_;
        result_ = other.result_;
    }
    void restore(std::span<const double> states, std::span<const Phase> phases) {
        if (states.size() != states_.size())
            throw InvalidInput(
                fmt::format("states: has {} numbers; the laws of this set have {}", states.size(), states_.size()));
        if (phases.size() != phases_.size())
            throw InvalidInput(
                fmt::format("phases: has {} entries; this set has {} contacts", phases.size(), phases_.size()));
        for (std::size_t k = 0; k < states.size(); ++k)
            if (!std::isfinite(states[k]))
                throw InvalidInput(fmt::format("states[{}] is {}; must be finite", k, states[k]));
        for (std::size_t i = 0; i < phases.size(); ++i) (void)host::phase_at(i, static_cast<int>(phases[i]));
        std::copy(states.begin(), states.end(), states_.begin());
        std::copy(phases.begin(), phases.end(), phases_.begin());
    }
    void reset() {
        std::fill(states_.begin(), states_.end(), 0.0);
        std::fill(phases_.begin(), phases_.end(), Phase::flight);
    }

    [[nodiscard]] const std::vector<ContactParameters>& parameters() const noexcept { return parameters_; }
    [[nodiscard]] const ContactSetOptions& options() const noexcept { return options_; }
    [[nodiscard]] const ContactSetStep& result() const noexcept { return result_; }
    [[nodiscard]] std::span<const double> states() const noexcept { return states_; }
    [[nodiscard]] std::span<const std::size_t> offsets() const noexcept { return offsets_; }
    [[nodiscard]] std::span<const Phase> phases() const noexcept { return phases_; }
    [[nodiscard]] Vector2<double> bristle(int i) const {
        if (i < 0 || index(i) >= laws_.size())
            throw InvalidInput(fmt::format("contact {} is asked for; this set has {}, from 0 on", i, laws_.size()));
        return laws_[index(i)].bristle(own_states(index(i)));
    }

private:
    static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
    [[nodiscard]] std::span<double> own_states(std::size_t i) noexcept {
        return std::span<double>(states_).subspan(offsets_[i], offsets_[i + 1] - offsets_[i]);
    }
    [[nodiscard]] std::span<const double> own_states(std::size_t i) const noexcept {
        return std::span<const double>(states_).subspan(offsets_[i], offsets_[i + 1] - offsets_[i]);
    }
    [[nodiscard]] static int first_that_sees_turning(const std::vector<Law>& laws) {
        for (std::size_t i = 0; i < laws.size(); ++i)
            if (sees_turning(laws[i].friction)) return static_cast<int>(i);
        return -1;
    }

    void turn(const HostStep& host, double share) {
        for (std::size_t i = 0; i < host.frame_spin.size(); ++i) {
            const double angle = share * host.dt * host.frame_spin[i];
            if (angle == 0) continue;
            const auto before = static_cast<std::size_t>(laws_[i].normal_state_count());
            turn_frame(laws_[i].friction, angle, own_states(i).subspan(before));
        }
    }

    // ---- flight ----------------------------------------------------------------------------------------------------

    /// Whether no contact touches in this step: then nothing has to be integrated.
    [[nodiscard]] bool flies(const HostStep& host) const noexcept {
        for (std::size_t i = 0; i < laws_.size(); ++i) {
            if (phases_[i] != Phase::flight) return false;
            const double z = host.depth[i], v = host.velocity[3 * i + 2], a = host.free_acceleration[3 * i + 2];
            const auto depth = [&](double t) { return z - v * t - 0.5 * a * t * t; };
            const double turns = a > 0 ? std::clamp(-v / a, 0.0, host.dt) : 0;
            if (!(depth(0) < 0 && depth(turns) < 0 && depth(host.dt) < 0)) return false;
        }
        return true;
    }
    void fly(double dt) {
        clear_result();
        const Touch<double> above{0, 0, Vector2<double>::Zero()};
        for (std::size_t i = 0; i < laws_.size(); ++i) {
            ContactEnergy& e = result_.energy[i];
            result_.held_before += laws_[i].held({}, above, own_states(i)).tangential_spring;
            e = {};
            e.tangential_damper = laws_[i].relax(dt, own_states(i));
            e.tangential_spring = laws_[i].held({}, above, own_states(i)).tangential_spring;
        }
        close_account(0);
    }

    // ---- contact ---------------------------------------------------------------------------------------------------

    void take(const HostStep& host) {
        constexpr double far = -1e30;  // [m]: what minus infinity is counted as
        HeldStep<double>& to = given_;
        const std::size_t n = 3 * laws_.size();
        const auto copy_or_zero = [](std::span<const double> from, std::vector<double>& into) {
            if (from.empty()) {
                std::fill(into.begin(), into.end(), 0.0);
            } else {
                std::copy(from.begin(), from.end(), into.begin());
            }
        };
        for (std::size_t i = 0; i < laws_.size(); ++i) to.depth[i] = std::max(host.depth[i], far);
        copy_or_zero(host.velocity, to.velocity);
        copy_or_zero(host.free_acceleration, to.acceleration);
        for (std::size_t i = 0; i < n; ++i) {
            to.delassus[i * n + i] = host.delassus[i * n + i];
            for (std::size_t j = 0; j < i; ++j)
                to.delassus[i * n + j] = to.delassus[j * n + i] =
                    0.5 * (host.delassus[i * n + j] + host.delassus[j * n + i]);
        }
        copy_or_zero(host.radius, to.radius);
        copy_or_zero(host.spin, to.spin);
        copy_or_zero(host.rolling, to.rolling);
        begin_.setZero();
        for (std::size_t k = 0; k < n; ++k) begin_[System::Plant::velocity + static_cast<int>(k)] = host.velocity[k];
        for (std::size_t i = 0; i < laws_.size(); ++i) {
            const std::span<const double> from = own_states(i);
            std::copy(from.begin(), from.end(), system_.hybrid().states(begin_, static_cast<int>(i)).begin());
        }
    }

    void integrate(double dt) {
        clear_result();
        system_.begin(phases_, dt);
        solver_.forget();
        try {
            solver_.run(begin_, dt);
            end_ = solver_.state();
            if (!end_.isFinite().all()) throw std::runtime_error("overflow");
        } catch (const BudgetSpent&) {
            take_rest(dt);
        } catch (const std::runtime_error&) {  // the search for an event has failed
            take_rest(dt);
        } catch (const std::domain_error&) {
            take_rest(dt);
        }
        read(dt);
    }
    /// From where the solver has come to, or from the start, where its numbers have overflowed.
    void take_rest(double dt) {
        end_ = solver_.state();
        if (!end_.isFinite().all()) {
            system_.begin(phases_, dt);
            solver_.forget();
            end_ = begin_;
            solver_.run(begin_, 0);
            end_ = solver_.state();
        }
        result_.unresolved_time = dt - end_[system_.clock()];
        rest_.take(end_, result_.unresolved_time);
    }

    void read(double dt) {
        const auto& hybrid = system_.hybrid();
        const auto& plant = hybrid.plant();
        const auto motion = plant.motion(end_);
        const std::size_t n = 3 * laws_.size();
        for (std::size_t k = 0; k < n; ++k) {
            result_.impulse[k] = end_[hybrid.follow() + static_cast<int>(k)];
            result_.double_impulse[k] = plant.double_impulse(end_, dt, hybrid.follow(), static_cast<int>(k));
        }
        // v . dJ = d(v0 . J + a . (t J - double impulse) + J . D J / 2): no velocity at the end is needed.
        for (std::size_t k = 0; k < n; ++k) {
            double response = 0;
            for (std::size_t l = 0; l < n; ++l) response += given_.delassus[k * n + l] * result_.impulse[l];
            result_.contact_work += result_.impulse[k] * (given_.velocity[k] + 0.5 * response) +
                                    given_.acceleration[k] * (dt * result_.impulse[k] - result_.double_impulse[k]);
        }
        double scale = system_.scales().energy();
        for (std::size_t i = 0; i < laws_.size(); ++i) {
            const int contact = static_cast<int>(i);
            if (plant.torques()) read_torques(i);
            const Held<double>& before = system_.held_before(contact);
            result_.held_before += before.normal_spring + before.tangential_spring;
            ContactEnergy& e = result_.energy[i];
            e = {};
            const Held<double> held = hybrid.held(end_, plant.touch(end_, motion, contact), contact);
            e.normal_spring = held.normal_spring;
            e.tangential_spring = held.tangential_spring;
            read_integrals(e, contact_channels, end_, hybrid.taken(contact));
            const std::span<const double> x = std::as_const(hybrid).states(std::as_const(end_), contact);
            std::copy(x.begin(), x.end(), own_states(i).begin());
            phases_[i] = hybrid.mode(contact).phase;
        }
        for (const System::Event& event : system_.events())
            result_.events.push_back({event.time, event.contact, event.kind});
        result_.evaluations = solver_.cost().evaluations;
        close_account(scale);
    }
    void read_torques(std::size_t i) {
        const auto& hybrid = system_.hybrid();
        const int first = hybrid.follow() + hybrid.plant().angular_impulse(static_cast<int>(i));
        for (int k = 0; k < 3; ++k) result_.angular_impulse[3 * i + index(k)] = end_[first + k];
        result_.contact_work += given_.rolling[2 * i] * end_[first] + given_.rolling[2 * i + 1] * end_[first + 1] +
                                given_.spin[i] * end_[first + 2];
    }

    void clear_result() {
        for (auto* numbers : {&result_.impulse, &result_.double_impulse, &result_.angular_impulse})
            std::fill(numbers->begin(), numbers->end(), 0.0);
        result_.events.clear();
        result_.held_before = result_.contact_work = result_.ground_work = 0;
        result_.unresolved_time = result_.unresolved_loss = 0;
        result_.evaluations = 0;
    }
    void close_account(double scale) {
        double missing = result_.contact_work - result_.held_before;
        for (const ContactEnergy& e : result_.energy) missing += e.stored() + e.dissipated() + e.unpaid();
        result_.energy_scale = std::max({scale, result_.held_before, std::abs(result_.contact_work)});
        const bool resolved = !(result_.unresolved_time > 0);
        result_.residual = resolved ? missing : 0;
        result_.unresolved_loss = resolved ? 0 : -missing;
    }

    std::vector<ContactParameters> parameters_;
    ContactSetOptions options_;
    std::vector<Law> laws_;
    int asks_;  // a contact whose law sees how its sphere turns, or -1
    HeldStep<double> given_;
    System system_;
    StepBudget budget_;
    Solver<System> solver_;
    host::ImplicitRest<System> rest_;
    State begin_, end_;
    std::vector<std::size_t> offsets_;
    std::vector<double> states_;
    std::vector<Phase> phases_;
    ContactSetStep result_;
};

ContactSet::ContactSet(std::vector<ContactParameters> laws, const ContactSetOptions& options)
    : inside_(std::make_unique<Inside>(std::move(laws), options)) {}
ContactSet::ContactSet(const ContactSet& other) : ContactSet(other.laws(), other.options()) {
    inside_->take_memory(*other.inside_);
}
ContactSet& ContactSet::operator=(const ContactSet& other) {
    if (this != &other) *this = ContactSet(other);
    return *this;
}
ContactSet::ContactSet(ContactSet&&) noexcept = default;
ContactSet& ContactSet::operator=(ContactSet&&) noexcept = default;
ContactSet::~ContactSet() = default;

const ContactSetStep& ContactSet::step(const HostStep& host) { return inside_->step(host); }
int ContactSet::contacts() const noexcept { return static_cast<int>(inside_->phases().size()); }
const std::vector<ContactParameters>& ContactSet::laws() const noexcept { return inside_->parameters(); }
const ContactSetOptions& ContactSet::options() const noexcept { return inside_->options(); }
const ContactSetStep& ContactSet::last() const noexcept { return inside_->result(); }
std::span<const double> ContactSet::states() const noexcept { return inside_->states(); }
std::span<const std::size_t> ContactSet::state_offsets() const noexcept { return inside_->offsets(); }
std::span<const Phase> ContactSet::phases() const noexcept { return inside_->phases(); }
Vector2<double> ContactSet::bristle(int i) const { return inside_->bristle(i); }
void ContactSet::restore(std::span<const double> states, std::span<const Phase> phases) {
    inside_->restore(states, phases);
}
void ContactSet::reset() { inside_->reset(); }

}  // namespace footfall
