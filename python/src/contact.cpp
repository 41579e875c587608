// The contact law by itself over arrays of contacts, with the GIL released.
//
// footfall/contact.py gives arrays of the right types and shapes. Whatever is given, nothing here reads or writes past
// the end of an array: sizes, alignment and overlap are checked before the GIL is let go.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/variant.h>

#include "bind.hpp"
#include "channels.hpp"
#include "footfall/energy/channels.hpp"
#include "footfall/law/contact_response.hpp"
#include "footfall/law/contact_step.hpp"
#include "footfall/law/registry.hpp"
#include "footfall/math/error.hpp"
#include "footfall/simulate/run.hpp"

namespace footfall::python {
namespace {

template <class Value>
using Array = nb::ndarray<Value, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Input = Array<const double>;
using Numbers = Array<double>;
using Phases = Array<std::int8_t>;

// Memory -------------------------------------------------------------------------------------------------------------

/// The memory of one array that a call reads or writes.
struct Block {
    const char* name;  ///< in messages
    std::uintptr_t begin, end;
    bool written, is_phase;

    template <class Value>
    Block(const char* called, const Array<Value>& array)
        : name(called),
          begin(reinterpret_cast<std::uintptr_t>(array.data())),
          end(begin + array.size() * sizeof(Value)),
          written(!std::is_const_v<Value>),
          is_phase(sizeof(Value) == sizeof(std::int8_t)) {
        if (begin % alignof(Value) != 0) throw InvalidInput(fmt::format("{}: is not aligned in memory", name));
    }
    [[nodiscard]] bool overlaps(const Block& other) const noexcept {
        return begin < other.end && other.begin < end && begin != end && other.begin != other.end;
    }
};

template <class Value>
Block writable(const char* name, const Array<Value>& array, std::size_t count, std::size_t width) {
    if (array.size() == count * width) return {name, array};
    throw InvalidInput(
        fmt::format("{}: has {} numbers; {} contacts have {}", name, array.size(), count, count * width));
}

template <class Value>
Block readable(const char* name, const Array<const Value>& array, std::size_t count, std::size_t width) {
    if (array.size() == count * width || array.size() == width) return {name, array};
    throw InvalidInput(fmt::format("{}: has {} numbers; one contact has {}, {} contacts have {}", name, array.size(),
                                   width, count, count * width));
}

/// What is written must share memory with nothing else. The one exception is a phase that is read where the next is
/// written, in a loop that feeds it back: each contact's is read before it is written.
void check_apart(std::span<const Block> blocks) {
    for (const Block& out : blocks) {
        if (!out.written) continue;
        for (const Block& other : blocks) {
            if (&other == &out || !other.overlaps(out)) continue;
            if (out.is_phase && other.is_phase && other.begin == out.begin && other.end == out.end) continue;
            throw InvalidInput(fmt::format("{}: shares memory with {}{}, and would be overwritten while it is in use",
                                           out.name, other.written ? "" : "the argument ", other.name));
        }
    }
}

/// Values of every contact, or those of one for all of them; `width` numbers for each.
template <class Value = double>
struct Column {
    const Value* data;
    std::size_t step;

    Column(const Array<const Value>& input, std::size_t width)
        : data(input.data()), step(input.size() == width ? 0 : width) {}
    [[nodiscard]] Value number(std::size_t i) const noexcept { return data[i * step]; }
    [[nodiscard]] Vector2<double> vector(std::size_t i) const noexcept { return {data[i * step], data[i * step + 1]}; }
    [[nodiscard]] const Value* at(std::size_t i) const noexcept { return data + i * step; }
};

struct Contacts {
    Column<> depth, depth_rate, slip_velocity, bristle;
    Column<std::int8_t> phase;  // as it was; laws whose forces decide it do not look
};

constexpr std::size_t channel_count = contact_channels.size();

struct Responses {
    std::int8_t* phase;
    double *normal_force, *friction_force, *bristle_rate;
    std::array<double*, channel_count> channels;  ///< in the order of contact_channels
};

struct Steps {
    std::int8_t* phase;
    double *normal_force, *friction_force, *bristle, *tangential_damper, *clutch;
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Whether a response follows from a contact's numbers: none is NaN or infinite. A depth of minus infinity is far above
/// the ground, where nothing depends on it.
inline bool computable(double depth, double rate, const Vector2<double>& V, std::span<const double> bristle) noexcept {
    // 0 x is NaN where x is not finite: additions are cheaper than a branch for each number.
    double zero = 0 * rate + 0 * V[0] + 0 * V[1];
    for (const double value : bristle) zero += 0 * value;
    if (depth != -std::numeric_limits<double>::infinity()) zero += 0 * depth;
    return zero == 0;
}

inline void put_nan(const Responses& out, std::size_t states, std::size_t i) noexcept {
    out.phase[i] = static_cast<std::int8_t>(Phase::flight);
    std::fill_n(out.friction_force + 2 * i, 2, nan);
    std::fill_n(out.bristle_rate + states * i, states, nan);
    out.normal_force[i] = nan;
    for (double* column : out.channels) column[i] = nan;
}

inline void put_nan(const Steps& out, std::size_t states, std::size_t i) noexcept {
    out.phase[i] = static_cast<std::int8_t>(Phase::flight);
    std::fill_n(out.friction_force + 2 * i, 2, nan);
    std::fill_n(out.bristle + states * i, states, nan);
    for (double* column : {out.normal_force, out.tangential_damper, out.clutch}) column[i] = nan;
}

/// A depth at which the steppers can be called: far above the ground is above it.
inline double bounded(double depth) noexcept { return std::max(depth, -1.0); }

inline void put(const Vector2<double>& v, double* out) noexcept {
    out[0] = v[0];
    out[1] = v[1];
}

/// Unrolled, so that the table's members are known where this is compiled.
template <std::size_t... k>
void put_channels(const ContactResponse<double>& r, const Responses& out, std::size_t i,
                  std::index_sequence<k...> /*channels*/) noexcept {
    ((out.channels[k][i] =
          r.*std::integral_constant<decltype(contact_channels[k].response), contact_channels[k].response>::value),
     ...);
}

inline void put(const ContactResponse<double>& r, const Responses& out, std::size_t i) noexcept {
    out.phase[i] = static_cast<std::int8_t>(r.phase);
    out.normal_force[i] = r.normal_force;
    put(r.friction_force, out.friction_force + 2 * i);
    put_channels(r, out, i, std::make_index_sequence<channel_count>());
}

/// Lets Ctrl-C end long work, now and then.
inline void check_signals(std::size_t i) {
    constexpr std::size_t between = 1 << 14;
    if ((i + 1) % between != 0) return;
    const nb::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
}

/// A step that could not be followed to its end must not pass for one that was.
inline void check_whole(double left, double dt, std::size_t i) {
    if (!(left > 0)) return;
    throw TooExpensive(fmt::format(
        "step: contact {} needs too many sub-steps: after the most that are taken, {:.3g} s of dt = {:.3g} s are left; "
        "take shorter steps or a larger tolerance",
        i, left, dt));
}

/// One contact's states as its law has them: those of the normal law, which are the same for all contacts, then the
/// bristle. Of a law that is known the sizes are, too, so that nothing is copied in a loop.
template <class Law>
class States {
public:
    States(const Law& law, std::span<const double> landed) : law_(law) { land(landed); }

    void land(std::span<const double> landed) noexcept {
        for (std::size_t k = 0; k < landed.size(); ++k) all_[k] = landed[k];
    }
    // Number by number, for a block would go through memory.
    void take(const double* bristle) noexcept {
        for (std::size_t k = 0; k < width(); ++k) all_[before() + k] = bristle[k];
    }
    void give(double* bristle) const noexcept {
        for (std::size_t k = 0; k < width(); ++k) bristle[k] = all_[before() + k];
    }
    [[nodiscard]] std::span<double> bristle() noexcept { return {all_.data() + before(), width()}; }
    [[nodiscard]] std::span<double> all() noexcept { return {all_.data(), before() + width()}; }
    [[nodiscard]] std::size_t width() const noexcept { return static_cast<std::size_t>(law_.bristle_size()); }

private:
    [[nodiscard]] std::size_t before() const noexcept { return static_cast<std::size_t>(law_.normal_state_count()); }

    const Law& law_;
    std::array<double, static_cast<std::size_t>(Law::most_states)> all_{};
};

/// The mode that a contact was in, as a caller tells it.
inline Mode told(std::int8_t phase) noexcept { return {Phase{static_cast<std::uint8_t>(phase)}}; }

template <class Law>
void evaluate(const Law law, std::span<const double> landed, const Contacts in, const Responses out,
              std::size_t count) noexcept {
    States x(law, landed), rates(law, {});
    for (std::size_t i = 0; i < count; ++i) {
        const double depth = in.depth.number(i), rate = in.depth_rate.number(i);
        const Vector2<double> V = in.slip_velocity.vector(i);
        x.take(in.bristle.at(i));
        if (!computable(depth, rate, V, x.bristle())) [[unlikely]] {
            put_nan(out, x.width(), i);
            continue;
        }
        const Touch<double> t{root_of_depth(depth), rate, V};
        const Mode mode = law.settled(law.mode_at(told(in.phase.number(i)), t, x.all()), t, x.all());
        put(law.evaluate(mode, t, x.all(), rates.all()), out, i);
        rates.give(out.bristle_rate + x.width() * i);
    }
}

template <class Law>
void step(const Law& law, std::span<const double> landed, const Contacts& in, double dt, double tolerance,
          const Steps& out, std::size_t count) {
    const ContactStepper stepper(law, tolerance);
    States x(law, landed);
    for (std::size_t i = 0; i < count; ++i) {
        check_signals(i);
        const double depth = in.depth.number(i), rate = in.depth_rate.number(i);
        const Vector2<double> V = in.slip_velocity.vector(i);
        x.take(in.bristle.at(i));
        if (!computable(depth, rate, V, x.bristle())) {
            put_nan(out, x.width(), i);
            continue;
        }
        const ContactStep r = stepper(told(in.phase.number(i)).phase, bounded(depth), rate, V, x.all(), dt);
        check_whole(r.left, dt, i);
        out.phase[i] = static_cast<std::int8_t>(r.phase);
        out.normal_force[i] = r.normal_force;
        put(r.mean_friction_force, out.friction_force + 2 * i);
        x.give(out.bristle + x.width() * i);
        out.tangential_damper[i] = r.tangential_damper;
        out.clutch[i] = r.clutch;
        if (std::isnan(r.normal_force)) x.land(landed);
    }
}

/// A contact law, and the states of its normal law in an impact that begins at the speed that was given.
class Law {
public:
    Law(const NormalLaw& normal, const FrictionLaw& friction, std::optional<double> impact_speed)
        : law_(normal, friction), landed_(static_cast<std::size_t>(law_.normal_state_count())) {
        if (impact_speed) law_.land({0, *impact_speed, Vector2<double>::Zero()}, landed_);
    }

    [[nodiscard]] const NormalLaw& normal() const noexcept { return law_.normal; }
    [[nodiscard]] const FrictionLaw& friction() const noexcept { return law_.friction; }
    [[nodiscard]] const ContactLawOver<double>& law() const noexcept { return law_; }
    [[nodiscard]] std::span<const double> landed() const noexcept { return landed_; }

    /// How many numbers the bristle of a contact has, or the internal states that a law has in its place.
    [[nodiscard]] int states() const noexcept { return law_.bristle_size(); }
    /// states(), as a count of numbers in an array.
    [[nodiscard]] std::size_t width() const noexcept { return static_cast<std::size_t>(states()); }

private:
    ContactLawOver<double> law_;
    std::vector<double> landed_;
};

Contacts contacts_of(const Law& law, const Input& depth, const Input& depth_rate, const Input& slip_velocity,
                     const Input& bristle, const Array<const std::int8_t>& phase) {
    return {{depth, 1}, {depth_rate, 1}, {slip_velocity, 2}, {bristle, law.width()}, {phase, 1}};
}

// The channels of energy --------------------------------------------------------------------------------------------

/// With "out." before it, for messages.
const char* output_name(std::size_t channel) {
    static const auto names = [] {
        std::array<std::string, channel_count> all;
        for (std::size_t k = 0; k < channel_count; ++k) all[k] = "out." + response_name(contact_channels[k]);
        return all;
    }();
    return names[channel].c_str();
}

template <class Type, std::size_t>
using Each = Type;

template <std::size_t... k>
void bind_evaluate(nb::class_<Law>& law, std::index_sequence<k...> /*channels*/) {
    law.def(
        "evaluate",
        [](const Law& self, const Input& depth, const Input& depth_rate, const Input& slip_velocity,
           const Input& bristle, const Array<const std::int8_t>& was, const Phases& phase, const Numbers& normal_force,
           const Numbers& friction_force, const Numbers& bristle_rate, const Each<Numbers, k>&... channels) {
            const std::size_t count = phase.size(), states = self.width();
            const std::array blocks{readable("depth", depth, count, 1),
                                    readable("depth_rate", depth_rate, count, 1),
                                    readable("slip_velocity", slip_velocity, count, 2),
                                    readable("bristle", bristle, count, states),
                                    readable("phase", was, count, 1),
                                    writable("out.phase", phase, count, 1),
                                    writable("out.normal_force", normal_force, count, 1),
                                    writable("out.friction_force", friction_force, count, 2),
                                    writable("out.bristle_rate", bristle_rate, count, states),
                                    writable(output_name(k), channels, count, 1)...};
            check_apart(blocks);
            const Contacts in = contacts_of(self, depth, depth_rate, slip_velocity, bristle, was);
            const Responses out{
                phase.data(), normal_force.data(), friction_force.data(), bristle_rate.data(), {channels.data()...}};
            const nb::gil_scoped_release free;
            // The loop is compiled for each law: a choice for every contact would double its time.
            with_known_parts(self.law(), [&](const auto& known) { evaluate(known, self.landed(), in, out, count); });
        },
        // Nothing is converted: a copy would be written in place of the array.
        nb::arg().noconvert(), nb::arg().noconvert(), nb::arg().noconvert(), nb::arg().noconvert(),
        nb::arg().noconvert(), nb::arg().noconvert(), nb::arg().noconvert(), nb::arg().noconvert(),
        nb::arg().noconvert(), (static_cast<void>(k), nb::arg().noconvert())...,
        nb::sig("def evaluate(self, *arrays: object) -> None"));
}

}  // namespace

void bind_contact(nb::module_& module) {
    nb::list phases;
    for (const Phase phase : {Phase::flight, Phase::stick, Phase::slip, Phase::recovering}) {
        phases.append(nb::str(name_of(phase).data(), name_of(phase).size()));
    }
    module.attr("PHASES") = nb::tuple(phases);

    nb::class_<Law> contact_law(module, "ContactLaw", "A normal law and a friction law over flat arrays.");
    contact_law
        .def(nb::init<const NormalLaw&, const FrictionLaw&, std::optional<double>>(), nb::arg("normal"),
             nb::arg("friction"), nb::arg("impact_speed").none())
        .def_prop_ro("normal", &Law::normal)
        .def_prop_ro("friction", &Law::friction)
        .def_prop_ro("states", &Law::states)
        .def(
            "step",
            [](const Law& self, const Input& depth, const Input& depth_rate, const Input& slip_velocity,
               const Input& bristle, const Array<const std::int8_t>& was, double dt, double tolerance,
               const Phases& phase, const Numbers& normal_force, const Numbers& friction_force,
               const Numbers& new_bristle, const Numbers& tangential_damper, const Numbers& clutch) {
                const std::size_t count = phase.size(), states = self.width();
                const std::array blocks{readable("depth", depth, count, 1),
                                        readable("depth_rate", depth_rate, count, 1),
                                        readable("slip_velocity", slip_velocity, count, 2),
                                        readable("bristle", bristle, count, states),
                                        readable("phase", was, count, 1),
                                        writable("out.phase", phase, count, 1),
                                        writable("out.normal_force", normal_force, count, 1),
                                        writable("out.friction_force", friction_force, count, 2),
                                        writable("out.bristle", new_bristle, count, states),
                                        writable("out.tangential_damper", tangential_damper, count, 1),
                                        writable("out.clutch", clutch, count, 1)};
                check_apart(blocks);
                const Contacts in = contacts_of(self, depth, depth_rate, slip_velocity, bristle, was);
                const Steps out{phase.data(),       normal_force.data(),      friction_force.data(),
                                new_bristle.data(), tangential_damper.data(), clutch.data()};
                const nb::gil_scoped_release free;
                with_law(self.friction(), [&](const auto& friction) {
                    step(Pair(self.normal(), friction), self.landed(), in, dt, tolerance, out, count);
                });
            },
            nb::arg().noconvert(), nb::arg().noconvert(), nb::arg().noconvert(), nb::arg().noconvert(),
            nb::arg().noconvert(), nb::arg(), nb::arg(), nb::arg().noconvert(), nb::arg().noconvert(),
            nb::arg().noconvert(), nb::arg().noconvert(), nb::arg().noconvert(), nb::arg().noconvert(),
            nb::sig("def step(self, *arrays: object) -> None"));
    bind_evaluate(contact_law, std::make_index_sequence<channel_count>());
}

}  // namespace footfall::python
