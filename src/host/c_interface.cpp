// The C interface (include/footfall.h): plain arrays in and out, no exception beyond it.
#include <algorithm>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "footfall.h"
#include "footfall/host/contact_set.hpp"
#include "footfall/math/error.hpp"
#include "footfall/version.hpp"
#include "host/check_step.hpp"
#include "host/law_by_name.hpp"

struct footfall_contact_set {
    footfall::ContactSet set;
};

namespace {

using footfall::ContactSet;
using footfall::InvalidInput;

std::string& last_error() {
    thread_local std::string text;
    return text;
}

/// What `work` does, its exceptions as a status and a text.
template <class Work>
footfall_status guarded(const Work& work) noexcept {
    try {
        last_error().clear();
        work();
        return FOOTFALL_OK;
    } catch (const InvalidInput& error) {
        last_error() = error.what();
        return FOOTFALL_INVALID_INPUT;
    } catch (const std::bad_alloc&) {
        last_error().clear();  // a text might need memory
        return FOOTFALL_OUT_OF_MEMORY;
    } catch (const std::exception& error) {
        last_error() = error.what();
        return FOOTFALL_FAILED;
    } catch (...) {
        return FOOTFALL_FAILED;
    }
}

template <class Pointer>
Pointer given(Pointer pointer, const char* name) {
    if (!pointer) throw InvalidInput(fmt::format("{}: is NULL", name));
    return pointer;
}

std::vector<footfall::host::NamedValue> values_of(const footfall_parameter* parameters, std::size_t count,
                                                  const char* name) {
    std::vector<footfall::host::NamedValue> values;
    if (count > 0) given(parameters, name);
    for (std::size_t k = 0; k < count; ++k) values.push_back({given(parameters[k].name, name), parameters[k].value});
    return values;
}

footfall::ContactParameters contact_of(const footfall_law& law, std::size_t i) {
    using footfall::host::law_by_name;
    try {
        footfall::ContactParameters contact;
        contact.normal = law_by_name<footfall::NormalLaw>(
            "normal", given(law.normal, "normal"),
            values_of(law.normal_parameters, law.normal_parameter_count, "normal_parameters"));
        if (law.friction)
            contact.friction = law_by_name<footfall::FrictionLaw>(
                "friction", law.friction,
                values_of(law.friction_parameters, law.friction_parameter_count, "friction_parameters"));
        return contact;
    } catch (const InvalidInput& error) {
        throw InvalidInput(fmt::format("laws[{}]: {}", i, error.what()));
    }
}

std::span<const double> required(const double* data, std::size_t count, const char* name) {
    return {given(data, name), count};
}
std::span<const double> optional(const double* data, std::size_t count) {
    return data ? std::span<const double>(data, count) : std::span<const double>();
}

void put(const std::vector<double>& values, double* out) {
    if (out) std::copy(values.begin(), values.end(), out);
}

}  // namespace

extern "C" {

int footfall_interface(void) { return FOOTFALL_INTERFACE; }

const char* footfall_version(void) {
    static const std::string text(footfall::version);
    return text.c_str();
}

const char* footfall_last_error(void) { return last_error().c_str(); }

footfall_status footfall_contact_set_create(int interface_version, const footfall_law* laws, size_t contacts,
                                            double tolerance, int64_t max_evaluations, footfall_contact_set** set) {
    if (set) *set = nullptr;
    if (interface_version != FOOTFALL_INTERFACE) {
        const footfall_status status = guarded([&] {
            throw InvalidInput(fmt::format("footfall.h has interface {}, the library has {}: they do not go together",
                                           interface_version, FOOTFALL_INTERFACE));
        });
        return status == FOOTFALL_INVALID_INPUT ? FOOTFALL_WRONG_INTERFACE : status;
    }
    return guarded([&] {
        given(set, "set");
        if (contacts > 0) given(laws, "laws");
        std::vector<footfall::ContactParameters> all;
        for (std::size_t i = 0; i < contacts; ++i) all.push_back(contact_of(laws[i], i));
        footfall::ContactSetOptions options;
        if (tolerance != 0) options.tolerance = tolerance;
        if (max_evaluations != 0) options.max_evaluations = max_evaluations;
        *set = new footfall_contact_set{ContactSet(std::move(all), options)};
    });
}

void footfall_contact_set_destroy(footfall_contact_set* set) { delete set; }

footfall_status footfall_contact_set_copy(const footfall_contact_set* set, footfall_contact_set** copy) {
    return guarded([&] {
        given(copy, "copy");
        *copy = nullptr;
        *copy = new footfall_contact_set{given(set, "set")->set};
    });
}

footfall_status footfall_contact_set_step(footfall_contact_set* set, const footfall_host_step* host,
                                          footfall_step_result* result) {
    return guarded([&] {
        given(set, "set");
        given(host, "host");
        given(result, "result");
        const auto n = static_cast<std::size_t>(set->set.contacts());
        footfall::HostStep step;
        step.dt = host->dt;
        step.depth = required(host->depth, n, "depth");
        step.velocity = required(host->velocity, 3 * n, "velocity");
        step.free_acceleration = required(host->free_acceleration, 3 * n, "free_acceleration");
        step.delassus = required(host->delassus, 9 * n * n, "delassus");
        step.ground_velocity = optional(host->ground_velocity, 3 * n);
        step.frame_spin = optional(host->frame_spin, n);
        step.radius = optional(host->radius, n);
        step.spin = optional(host->spin, n);
        step.rolling = optional(host->rolling, 2 * n);
        const footfall::ContactSetStep& r = set->set.step(step);
        put(r.impulse, result->impulse);
        put(r.double_impulse, result->double_impulse);
        put(r.angular_impulse, result->angular_impulse);
        result->held_before = r.held_before;
        result->held = result->taken = 0;
        for (const footfall::ContactEnergy& e : r.energy) {
            result->held += e.stored();
            result->taken += e.dissipated() + e.unpaid();
        }
        result->contact_work = r.contact_work;
        result->ground_work = r.ground_work;
        result->residual = r.residual;
        result->energy_scale = r.energy_scale;
        result->unresolved_time = r.unresolved_time;
        result->unresolved_loss = r.unresolved_loss;
        result->evaluations = r.evaluations;
        result->events = r.events.size();
    });
}

footfall_status footfall_contact_set_event(const footfall_contact_set* set, size_t index, footfall_event* event) {
    return guarded([&] {
        const auto& events = given(set, "set")->set.last().events;
        given(event, "event");
        if (index >= events.size())
            throw InvalidInput(fmt::format("event {} is asked for; the last step has {}", index, events.size()));
        static_assert(static_cast<int>(footfall::EventKind::touchdown) == FOOTFALL_TOUCHDOWN &&
                      static_cast<int>(footfall::EventKind::recovered) == FOOTFALL_RECOVERED);
        *event = {events[index].time, events[index].contact,
                  static_cast<footfall_event_kind>(static_cast<int>(events[index].kind))};
    });
}

footfall_status footfall_contact_set_energy(const footfall_contact_set* set, size_t contact,
                                            footfall_contact_energy* energy) {
    return guarded([&] {
        const auto& all = given(set, "set")->set.last().energy;
        given(energy, "energy");
        if (contact >= all.size())
            throw InvalidInput(fmt::format("contact {} is asked for; this set has {}", contact, all.size()));
        const footfall::ContactEnergy& e = all[contact];
        *energy = {e.normal_spring, e.tangential_spring, e.normal_damper, e.tangential_damper,
                   e.clutch,        e.stiffness_change};
    });
}

size_t footfall_contact_set_contacts(const footfall_contact_set* set) {
    return set ? static_cast<std::size_t>(set->set.contacts()) : 0;
}
size_t footfall_contact_set_states(const footfall_contact_set* set) { return set ? set->set.states().size() : 0; }

footfall_status footfall_contact_set_save(const footfall_contact_set* set, double* states, int* phases) {
    return guarded([&] {
        given(set, "set");
        if (states) std::copy(set->set.states().begin(), set->set.states().end(), states);
        if (!phases) return;
        for (const footfall::Phase phase : set->set.phases()) *phases++ = static_cast<int>(phase);
    });
}

footfall_status footfall_contact_set_restore(footfall_contact_set* set, const double* states, const int* phases) {
    return guarded([&] {
        given(set, "set");
        const std::size_t count = set->set.states().size();
        std::vector<footfall::Phase> all;
        given(phases, "phases");
        for (std::size_t i = 0; i < static_cast<std::size_t>(set->set.contacts()); ++i)
            all.push_back(footfall::host::phase_at(i, phases[i]));
        set->set.restore(count > 0 ? required(states, count, "states") : std::span<const double>(), all);
    });
}

}  // extern "C"
