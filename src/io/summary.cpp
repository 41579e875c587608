// A run as a page of text for a person.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "footfall/energy/ledger.hpp"
#include "footfall/io/output.hpp"
#include "footfall/io/printable.hpp"
#include "footfall/version.hpp"
#include "io/columns.hpp"
#include "io/text.hpp"

namespace footfall {
namespace {

using text::Align;
using text::number;
using text::quantity;
using text::Table;

constexpr std::size_t page_width = 96;
constexpr std::size_t law_width = page_width - 14;  ///< beside the labels
constexpr std::string_view nothing = "–";

std::string heading(std::string_view title) { return fmt::format("\n{}\n", title); }

std::string or_nothing(const std::optional<double>& value, std::string_view unit) {
    return value ? quantity(*value, unit) : std::string(nothing);
}

std::string plural(long long count, std::string_view what) {
    return fmt::format("{} {}{}", text::count(count), what, count == 1 ? "" : "s");
}

/// A vector that the user gave: "(0.5, 0.5, 0)".
std::string given(const Eigen::Vector3d& v) {
    return fmt::format("({}, {}, {})", number(v.x()), number(v.y()), number(v.z()));
}

/// A moment with the decimals that tell two events of this run apart.
std::string moment(double time, double end) {
    const int before_point = end >= 10 ? static_cast<int>(std::floor(std::log10(end))) : 0;
    return fmt::format("{:.{}f}", time, std::max(9 - before_point, 3));
}

/// The rows of a list of `total` things that are shown; the rest, between the two parts, is counted.
struct Excerpt {
    std::size_t head, tail_begin, total;

    static Excerpt of(std::size_t total, std::size_t most, std::size_t tail) {
        if (total <= most) return {total, total, total};
        return {most - tail - 1, total - tail, total};
    }
    [[nodiscard]] std::size_t left_out() const { return tail_begin - head; }

    template <class Show>
    void rows(Table& table, Show show) const {
        for (std::size_t i = 0; i < head; ++i) show(i);
        if (left_out() > 0) table.note(fmt::format("   … {} more …", text::count(static_cast<long long>(left_out()))));
        for (std::size_t i = tail_begin; i < total; ++i) show(i);
    }
};

// What was run -------------------------------------------------------------------------------------------------------

/// "K_n = 8.5e6 N/m^1.5, D_n = 3100 N s/m^1.5", broken into lines.
template <class Law>
std::vector<std::string> parameters_of(const Law& law) {
    std::string line;
    std::vector<std::string> lines;
    for (const auto& parameter : Law::parameters()) {
        std::string item = fmt::format("{} = {}", parameter.symbol, number(law.*parameter.member));
        if (parameter.unit != "1") item += fmt::format(" {}", parameter.unit);
        if (!line.empty() && text::width(line) + text::width(item) + 2 > law_width) {
            lines.push_back(line + ",");
            line.clear();
        }
        if (!line.empty()) line += ", ";
        line += item;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

/// A formula with each of its clauses, "...; ...", on a line.
std::vector<std::string> formula_lines(std::string_view formula) {
    std::vector<std::string> lines;
    while (!formula.empty()) {
        const std::string_view clause = formula.substr(0, formula.find("; "));
        for (std::string& line : text::wrap(clause, law_width)) lines.push_back(std::move(line));
        formula.remove_prefix(std::min(formula.size(), clause.size() + 2));
    }
    return lines;
}

/// "spheres 0, 2, 5, ... 9"
std::string spheres_in_words(const std::vector<std::size_t>& spheres) {
    constexpr std::size_t most = 6;
    std::string words = spheres.size() == 1 ? "sphere" : "spheres";
    const std::size_t shown = spheres.size() > most ? most - 1 : spheres.size();
    for (std::size_t k = 0; k < shown; ++k) words += fmt::format("{} {}", k == 0 ? "" : ",", spheres[k]);
    if (shown < spheres.size()) words += fmt::format(", ... {}", spheres.back());
    return words;
}

/// A law's name, its formula, and its parameters: once where all its spheres share them, else for each of them.
template <class Law, class OfContact>
void show_law(Table& table, std::string label, const std::vector<ContactParameters>& contacts, OfContact of_contact) {
    const std::vector<std::size_t> under = contacts_under<Law>(contacts, of_contact);
    if (under.empty()) return;
    std::string name(Law::description.name);
    if (under.size() < contacts.size()) name += ", " + spheres_in_words(under);
    table.row({std::move(label), std::move(name)});
    for (std::string& line : formula_lines(Law::description.formula)) table.row({"", std::move(line)});
    std::vector<std::vector<std::string>> each;
    for (const std::size_t i : under) each.push_back(parameters_of(std::get<Law>(of_contact(contacts[i]))));
    if (std::all_of(each.begin(), each.end(), [&](const auto& lines) { return lines == each.front(); })) {
        for (const std::string& line : each.front()) table.row({"", line});
        return;
    }
    constexpr std::size_t most = 6, tail = 1;
    Excerpt::of(each.size(), most, tail).rows(table, [&](std::size_t k) {
        for (std::size_t line = 0; line < each[k].size(); ++line) {
            table.row({"", fmt::format("{} {}", line == 0 ? fmt::format("sphere {}:", under[k]) : "         ",
                                       each[k][line])});
        }
    });
}

std::string mass_in_words(double mass) {
    return mass < 1 ? fmt::format("{} g", number(mass * 1e3)) : fmt::format("{} kg", number(mass));
}

std::string inertia_in_words(const Eigen::Matrix3d& inertia) {
    const Eigen::Vector3d diagonal = inertia.diagonal();
    if (!inertia.isApprox(Eigen::Matrix3d(diagonal.asDiagonal()))) {
        return fmt::format("inertia [{}, {}, {}; {}, {}; {}] kg m²", number(inertia(0, 0)), number(inertia(0, 1)),
                           number(inertia(0, 2)), number(inertia(1, 1)), number(inertia(1, 2)), number(inertia(2, 2)));
    }
    if (diagonal.isApproxToConstant(diagonal.x())) return fmt::format("inertia {} kg m²", number(diagonal.x()));
    return fmt::format("inertia {} kg m²", given(diagonal));
}

std::string sphere_in_words(const Sphere& sphere) {
    std::string words = "radius " + [&] {
        const text::Prefix prefix = sphere.radius < 1 ? text::Prefix{1e-3, "m"} : text::Prefix{1, ""};
        return fmt::format("{} {}m", number(sphere.radius / prefix.factor), prefix.symbol);
    }();
    words += sphere.center.isZero(0) ? ", at the centre of mass" : fmt::format(", at {} m", given(sphere.center));
    return words;
}

std::string setup(const Scenario& scenario) {
    const Simulation& simulation = scenario.simulation;
    const std::vector<Sphere>& spheres = simulation.body.spheres;
    Table table({Align::left, Align::left});
    table.row({"Body",
               fmt::format("{}, {}", mass_in_words(simulation.body.mass), inertia_in_words(simulation.body.inertia))});
    if (spheres.size() == 1) {
        table.row({"Sphere", sphere_in_words(spheres.front())});
    } else {
        constexpr std::size_t most = 8, tail = 1;
        Excerpt::of(spheres.size(), most, tail).rows(table, [&](std::size_t i) {
            table.row({i == 0 ? "Spheres" : "", fmt::format("{}: {}", i, sphere_in_words(spheres[i]))});
        });
    }
    table.row({"Ground", fmt::format("normal {}, height {} m; gravity {} m/s²", given(simulation.ground.normal),
                                     number(simulation.ground.height), given(simulation.gravity))});
    const BodyState& initial = simulation.initial;
    table.row(
        {"Start", fmt::format("position {} m, velocity {} m/s", given(initial.position), given(initial.velocity))});
    if (!initial.angular_velocity.isZero(0)) {
        table.row({"", fmt::format("angular velocity {} rad/s", given(initial.angular_velocity))});
    }
    const auto normal_of = [](const ContactParameters& c) -> const NormalLaw& { return c.normal; };
    const auto friction_of = [](const ContactParameters& c) -> const FrictionLaw& { return c.friction; };
    for_each_law<NormalLaw>(
        [&]<class Law>(const Law&) { show_law<Law>(table, "Normal", simulation.contacts, normal_of); });
    for_each_law<FrictionLaw>(
        [&]<class Law>(const Law&) { show_law<Law>(table, "Friction", simulation.contacts, friction_of); });
    // It may have been forgotten; law = "none" says that there is to be none.
    if (scenario.friction_left_out) table.row({"", "No friction: [contact.friction] is not given."});
    return table.str();
}

// Events and impacts -------------------------------------------------------------------------------------------------

/// "3 touchdown, 4 stick, 2 slip".
std::string tally(const std::vector<Event>& events) {
    std::string words;
    for (const EventKind kind : columns::event_kinds) {
        const auto times = std::count_if(events.begin(), events.end(), [&](const Event& e) { return e.kind == kind; });
        if (times == 0) continue;
        if (!words.empty()) words += ", ";
        words += fmt::format("{} {}", text::count(times), name_of(kind));
    }
    return words;
}

std::string event_table(const std::vector<Event>& events, double end, bool several_spheres) {
    if (events.empty()) return heading("Events") + "  none\n";
    std::vector<Align> alignment{Align::right, Align::unit, Align::left};
    std::vector<std::string> head{"at [s]", "after", "event"};
    if (several_spheres) {
        alignment.push_back(Align::right);
        head.emplace_back("sphere");
    }
    Table table(alignment);
    table.head(std::move(head));
    constexpr std::size_t most = 16, tail = 5;
    Excerpt::of(events.size(), most, tail).rows(table, [&](std::size_t i) {
        const Event& event = events[i];
        std::vector<std::string> row{moment(event.time, end),
                                     i == 0 ? "" : quantity(event.time - events[i - 1].time, "s"),
                                     std::string(name_of(event.kind))};
        if (several_spheres) row.push_back(std::to_string(event.sphere));
        table.row(std::move(row));
    });
    return heading(fmt::format("Events  ({})", tally(events))) + table.str();
}

std::string impact_table(const std::vector<Impact>& impacts, double end, bool several_spheres) {
    if (impacts.empty()) return heading("Impacts") + "  none: no sphere touched the ground\n";
    std::vector<Align> alignment{Align::right, Align::unit,  Align::unit, Align::unit,
                                 Align::unit,  Align::right, Align::unit, Align::unit};
    std::vector<std::string> head{"touchdown\n[s]", "duration",    "sticking",    "speed\nin",
                                  "speed\nout",     "restitution", "peak\nforce", "peak\ndepth"};
    if (several_spheres) {
        alignment.insert(alignment.begin(), Align::right);
        head.insert(head.begin(), "sphere");
    }
    Table table(alignment);
    table.head(std::move(head));
    constexpr std::size_t most = 14, tail = 4;
    Excerpt::of(impacts.size(), most, tail).rows(table, [&](std::size_t i) {
        const Impact& impact = impacts[i];
        const auto restitution = impact.restitution();
        std::vector<std::string> row{moment(impact.touchdown, end),
                                     impact.recovered ? quantity(*impact.recovered - impact.touchdown, "s") : "lasting",
                                     quantity(impact.stick_time, "s"),
                                     quantity(impact.speed_in, "m/s"),
                                     or_nothing(impact.speed_out, "m/s"),
                                     restitution ? fmt::format("{:.4f}", *restitution) : std::string(nothing),
                                     quantity(impact.peak_normal_force, "N"),
                                     quantity(impact.peak_indentation, "m")};
        if (several_spheres) row.insert(row.begin(), std::to_string(impact.sphere));
        table.row(std::move(row));
    });
    const auto lasting = std::count_if(impacts.begin(), impacts.end(), [](const Impact& i) { return !i.recovered; });
    std::string title = fmt::format("Impacts  ({}", impacts.size());
    if (lasting > 0) title += fmt::format(", {} lasting at the end", lasting);
    return heading(title + "; speeds normal to the ground)") + table.str();
}

// The end ------------------------------------------------------------------------------------------------------------

/// The components with as many decimals as give the largest six digits, then the unit.
std::vector<std::string> measured(std::string label, std::span<const double> values, std::string_view unit) {
    double largest = 0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    const text::Prefix prefix = largest >= 0.01 && largest < 1e5 ? text::Prefix{1, ""} : text::prefix_of(largest);
    const double scaled = largest / prefix.factor;
    const int before_point = scaled >= 1 ? 1 + static_cast<int>(std::floor(std::log10(scaled))) : 0;
    const int decimals = std::clamp(6 - before_point, 0, 6);
    std::vector<std::string> row{std::move(label)};
    for (const double value : values) {
        std::string cell = fmt::format("{:.{}f}", value / prefix.factor, decimals);
        if (cell.find_first_not_of("-0.") == std::string::npos && cell.front() == '-') cell.erase(0, 1);
        row.push_back(std::move(cell));
    }
    row.resize(5);
    row.push_back(unit == "" ? "" : fmt::format("{}{}", prefix.symbol, unit));
    return row;
}

std::string final_state(const Snapshot& state) {
    const BodyState& body = state.body;
    const auto vector = [](const Eigen::Vector3d& v) { return std::span<const double>(v.data(), 3); };
    const std::array q{body.orientation.w(), body.orientation.x(), body.orientation.y(), body.orientation.z()};
    Table table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::left});
    table.row(measured("position", vector(body.position), "m"));
    table.row(measured("velocity", vector(body.velocity), "m/s"));
    table.row(measured("angular velocity", vector(body.angular_velocity), "rad/s"));
    table.row(measured("orientation (w, x, y, z)", q, ""));

    Table contacts({Align::left, Align::left, Align::unit, Align::unit, Align::unit, Align::unit});
    contacts.head({"sphere", "phase", "depth", "normal force", "friction", "slip speed"});
    constexpr std::size_t most = 10, tail = 1;
    Excerpt::of(state.contacts.size(), most, tail).rows(contacts, [&](std::size_t i) {
        const ContactSnapshot& contact = state.contacts[i];
        contacts.row({std::to_string(i), std::string(name_of(contact.phase)), quantity(contact.depth, "m"),
                      quantity(contact.normal_force, "N"), quantity(contact.friction_force.norm(), "N"),
                      quantity(contact.slip_velocity.norm(), "m/s")});
    });
    return heading(fmt::format("At the end  ({} s; speed {})", number(state.time, 9),
                               quantity(body.velocity.norm(), "m/s"))) +
           table.str() + "\n" + contacts.str();
}

// The ledger ---------------------------------------------------------------------------------------------------------

/// The heading of the entries of one kind.
std::string_view group_of(ChannelKind kind) { return kind == ChannelKind::unpaid ? "law" : name_of(kind); }

/// "tangential spring, W"
template <class Of>
std::string words(const Channel<Of>& channel) {
    std::string said(channel.name);
    std::replace(said.begin(), said.end(), '_', ' ');
    if (!channel.symbol.empty()) said += fmt::format(", {}", channel.symbol);
    return said;
}

std::string ledger(const Run& run) {
    const Ledger &start = run.initial.ledger, &end = run.final.ledger;
    // Shares are of what there was, unless the zero of the potential makes that a number without meaning.
    const bool of_total = start.total() > 0.1 * run.energy_scale;
    const double whole = of_total ? start.total() : run.energy_scale;
    const text::Prefix prefix = text::prefix_of(run.energy_scale);
    const double scaled = run.energy_scale / prefix.factor;
    const int decimals = scaled >= 100 ? 3 : scaled >= 10 ? 4 : 5;
    const auto amount = [&](double energy) {
        const double shown = energy / prefix.factor;
        if (shown == 0) return std::string("0");
        if (std::abs(shown) < 0.5 * std::pow(10.0, -decimals)) return number(shown, 1);
        return fmt::format("{:.{}f}", shown, decimals);
    };
    const auto share = [&](double energy) {
        if (!(whole > 0)) return std::string(nothing);
        if (energy == 0) return std::string("0 %");
        const double thousandths = std::round(1e5 * energy / whole);  // of a percent, so that there is no "-0.000"
        return fmt::format("{:.3f} %", thousandths == 0 ? 0.0 : thousandths / 1e3);
    };

    Table table({Align::left, Align::left, Align::right, Align::right, Align::unit});
    table.head({"", "", fmt::format("start [{}J]", prefix.symbol), fmt::format("end [{}J]", prefix.symbol), "share"});
    const auto entry = [&](std::string_view group, std::string name, double before, double after) {
        table.row({std::string(group), std::move(name), amount(before), amount(after), share(after)});
    };
    std::string_view last_group;
    const auto entry_of = [&](std::string_view group, const auto& channel, const auto& before, const auto& after) {
        entry(group == last_group ? "" : group, words(channel), before.*channel.member, after.*channel.member);
        last_group = group;
    };
    for (const auto& channel : body_channels) entry_of("body", channel, start, end);
    for (const auto& channel : contact_channels) entry_of(group_of(channel.kind), channel, start.contact, end.contact);
    table.rule();
    entry("", "total", start.total(), end.total());

    std::string page = heading(of_total ? "Energy"
                                        : "Energy  (shares of the largest account seen, since the total "
                                          "depends on where the potential is zero)");
    page += table.str();
    page += fmt::format("\n  residual {:.1e} at the end, {:.1e} at most in any step, of {}\n", run.residual(),
                        run.max_residual, quantity(run.energy_scale, "J"));
    page += fmt::format("  tangential spring as printed in the paper, W + P: {}\n",
                        quantity(end.contact.tangential_spring_paper(), "J"));
    if (end.contact.unpaid() < 0) {
        const std::string sentence = fmt::format(
            "The tangential law has made {}: body, springs and losses together hold more than was put in "
            "(docs/theory.md, stiffness change).",
            quantity(-end.contact.unpaid(), "J"));
        page += "\n";
        for (const std::string& line : text::wrap(sentence, page_width)) page += fmt::format("  {}\n", line);
    }
    return page;
}

std::string cost(const Run& run) {
    const Cost& cost = run.cost;
    std::string line = plural(cost.steps, "step");
    if (cost.stiff_steps > 0) line += fmt::format(" ({} of them implicit)", text::count(cost.stiff_steps));
    if (cost.rejected > 0) line += fmt::format(", {} rejected", text::count(cost.rejected));
    line += fmt::format(", {} in {}", plural(cost.evaluations, "evaluation"), quantity(cost.wall_seconds, "s"));
    return heading("Cost") + fmt::format("  {}\n  footfall {}\n", line, version);
}

}  // namespace

std::string summary(const Scenario& scenario) {
    const RunOptions& options = scenario.simulation.options;
    const std::string title = scenario.title.empty() ? "A run without a title" : printable(scenario.title);
    return fmt::format("{}\n{}\n  {} s at a relative tolerance of {}\n\n{}", title,
                       text::repeat("━", std::min(text::width(title), page_width)), number(options.end_time),
                       number(options.tolerance), setup(scenario));
}

std::string summary(const Scenario& scenario, const Run& run) {
    const RunOptions& options = scenario.simulation.options;
    const bool several_spheres = scenario.simulation.body.spheres.size() > 1;
    std::string page = summary(scenario);
    page += event_table(run.events, options.end_time, several_spheres);
    page += impact_table(run.impacts, options.end_time, several_spheres);
    page += final_state(run.final);
    page += ledger(run);
    page += cost(run);
    return page;
}

}  // namespace footfall
