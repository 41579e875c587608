// The channels of energy of a contact, said once: the ledger's sums, columns, files, tables of rigs and the Python
// package follow from this table.
//
// To add one: a member of ContactEnergy, a row of contact_channels, and the law that gives it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "footfall/law/contact_response.hpp"

namespace footfall {

/// What a channel does with its energy.
enum class ChannelKind : std::uint8_t {
    held,    ///< kept, and given back: it follows from the state
    taken,   ///< dissipated: it never falls
    unpaid,  ///< taken with no force paying for it; where it is negative, the law has made energy
    worked,  ///< done from outside: what the other three have got
};

/// "held", "taken", "unpaid" or "worked".
[[nodiscard]] std::string_view name_of(ChannelKind kind) noexcept;

/// One entry of the account `Of`.
template <class Of>
struct Channel {
    std::string_view name;    ///< the key in files and tables, and the attribute in Python
    std::string_view symbol;  ///< of docs/theory.md; empty where it has none
    std::string_view unit;
    std::string_view brief;  ///< a few words for a person
    ChannelKind kind;
    double Of::*member;

    /// Whether it is the integral of a power, which a state vector carries; else it follows from the state.
    [[nodiscard]] constexpr bool is_integral() const noexcept { return kind != ChannelKind::held; }
};

/// The sum of the entries of one kind, added to `sum` in the table's order [J].
template <class Of, class Table>
[[nodiscard]] constexpr double sum_of(const Of& energy, const Table& channels, ChannelKind kind,
                                      double sum = 0) noexcept {
    for (const auto& channel : channels)
        if (channel.kind == kind) sum += energy.*channel.member;
    return sum;
}

/// The same without their signs.
template <class Of, class Table>
[[nodiscard]] double size_of(const Of& energy, const Table& channels, ChannelKind kind) noexcept {
    double sum = 0;
    for (const auto& channel : channels)
        if (channel.kind == kind) sum += std::abs(energy.*channel.member);
    return sum;
}

/// How many entries of a table a state vector carries.
template <class Table>
[[nodiscard]] constexpr std::size_t integral_count(const Table& channels) noexcept {
    std::size_t count = 0;
    for (const auto& channel : channels) count += channel.is_integral() ? 1 : 0;
    return count;
}

/// Reads the integrals out of a state vector that carries them in the table's order, from `first` on.
template <class Of, class Table, class State>
void read_integrals(Of& energy, const Table& channels, const State& y, int first) {
    for (const auto& channel : channels)
        if (channel.is_integral()) energy.*channel.member = static_cast<double>(y[first++]);
}

/// The energies of one contact, or their sum over contacts [J].
struct ContactEnergy {
    double normal_spring = 0;      ///< held by the normal spring. (17)
    double tangential_spring = 0;  ///< W = (1/2) K_t sqrt(z) |u|^2, held by the bristle
    double normal_damper = 0;      ///< taken by the normal damper, with the clamp (14). (16)
    double tangential_damper = 0;  ///< taken by the tangential damper. (28)
    double clutch = 0;             ///< taken by the clutch: minus (29) as printed
    /// P = -integral of (1/4) K_t zdot |u|^2 / sqrt(z) dt. Where it is negative, the changing stiffness has
    /// put that much into the motion with no force paying for it: the law has made energy.
    double stiffness_change = 0;

    // The sums over the channels of a kind.
    [[nodiscard]] constexpr double stored() const noexcept;
    [[nodiscard]] constexpr double dissipated() const noexcept;
    [[nodiscard]] constexpr double unpaid() const noexcept;
    [[nodiscard]] constexpr double worked() const noexcept;
    /// (33) as printed: W + P.
    [[nodiscard]] constexpr double tangential_spring_paper() const noexcept;

    constexpr ContactEnergy& operator+=(const ContactEnergy& other) noexcept;
};

/// A channel of a contact.
struct ContactChannel : Channel<ContactEnergy> {
    std::string_view label;        ///< what holds or takes it: for legends
    std::string_view description;  ///< of a file's variable: "energy held by the ..."
    /// What a law gives: the energy where it is held [J], else its rate [W].
    double ContactResponse<double>::*response;
};

/// In the order of every output.
inline constexpr std::array contact_channels{
    ContactChannel{
        {"normal_spring", "", "J", "held by the normal spring", ChannelKind::held, &ContactEnergy::normal_spring},
        "normal spring",
        "energy held by the normal spring",
        &ContactResponse<double>::normal_spring},
    ContactChannel{
        {"tangential_spring", "W", "J", "held by the bristle", ChannelKind::held, &ContactEnergy::tangential_spring},
        "tangential spring",
        "energy held by the tangential spring",
        &ContactResponse<double>::tangential_spring},
    ContactChannel{
        {"normal_damper", "", "J", "taken by the normal damper", ChannelKind::taken, &ContactEnergy::normal_damper},
        "normal damper",
        "energy taken by the normal damper",
        &ContactResponse<double>::normal_damper_power},
    ContactChannel{{"tangential_damper", "", "J", "taken by the tangential damper", ChannelKind::taken,
                    &ContactEnergy::tangential_damper},
                   "tangential damper",
                   "energy taken by the tangential damper",
                   &ContactResponse<double>::tangential_damper_power},
    ContactChannel{{"clutch", "", "J", "taken by the clutch", ChannelKind::taken, &ContactEnergy::clutch},
                   "clutch",
                   "energy taken by the clutch",
                   &ContactResponse<double>::clutch_power},
    ContactChannel{{"stiffness_change", "P", "J", "taken by the changing stiffness", ChannelKind::unpaid,
                    &ContactEnergy::stiffness_change},
                   "changing stiffness",
                   "energy taken by the changing tangential stiffness; negative: made by it",
                   &ContactResponse<double>::stiffness_change_power},
};

/// A number that the outputs show behind the channels, of which it is made.
struct ContactSum {
    std::string_view name, unit, description;
    double (ContactEnergy::*value)() const noexcept;
};

inline constexpr std::array contact_sums{
    ContactSum{"tangential_spring_paper", "J", "Azad & Featherstone 2010, (33): tangential_spring + stiffness_change",
               &ContactEnergy::tangential_spring_paper},
};

constexpr double ContactEnergy::stored() const noexcept { return sum_of(*this, contact_channels, ChannelKind::held); }
constexpr double ContactEnergy::dissipated() const noexcept {
    return sum_of(*this, contact_channels, ChannelKind::taken);
}
constexpr double ContactEnergy::unpaid() const noexcept { return sum_of(*this, contact_channels, ChannelKind::unpaid); }
constexpr double ContactEnergy::worked() const noexcept { return sum_of(*this, contact_channels, ChannelKind::worked); }
constexpr double ContactEnergy::tangential_spring_paper() const noexcept {
    return tangential_spring + stiffness_change;
}
constexpr ContactEnergy& ContactEnergy::operator+=(const ContactEnergy& other) noexcept {
    for (const auto& channel : contact_channels) this->*channel.member += other.*channel.member;
    return *this;
}

}  // namespace footfall
