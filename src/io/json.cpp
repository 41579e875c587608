// A run as one JSON object.
#include <string>

#include <nlohmann/json.hpp>

#include "footfall/energy/ledger.hpp"
#include "footfall/io/output.hpp"
#include "footfall/io/printable.hpp"
#include "footfall/version.hpp"

namespace footfall {
namespace {

using Json = nlohmann::ordered_json;

Json array(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Json array(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json final_state(const Snapshot& state) {
    return {{"time", state.time},
            {"position", array(state.body.position)},
            {"velocity", array(state.body.velocity)},
            {"angular_velocity", array(state.body.angular_velocity)},
            {"orientation", array(state.body.orientation)}};
}

Json of(const Event& event) { return {{"time", event.time}, {"kind", name_of(event.kind)}, {"sphere", event.sphere}}; }

Json of(const Impact& impact) {
    return {{"sphere", impact.sphere},
            {"touchdown", impact.touchdown},
            {"separation", or_null(impact.separation)},
            {"recovered", or_null(impact.recovered)},
            {"speed_in", impact.speed_in},
            {"speed_out", or_null(impact.speed_out)},
            {"restitution", or_null(impact.restitution())},
            {"peak_normal_force", impact.peak_normal_force},
            {"peak_indentation", impact.peak_indentation},
            {"stick_time", impact.stick_time}};
}

Json energy(const Run& run) {
    const Ledger& ledger = run.final.ledger;
    Json json{{"initial", run.initial.ledger.total()}};
    for (const auto& channel : body_channels) json[std::string(channel.name)] = ledger.*channel.member;
    for (const auto& channel : contact_channels) json[std::string(channel.name)] = ledger.contact.*channel.member;
    for (const auto& sum : contact_sums) json[std::string(sum.name)] = (ledger.contact.*sum.value)();
    json["residual"] = run.residual();
    json["max_residual"] = run.max_residual;
    return json;
}

constexpr int indent = 2;

/// The JSON as it stands inside `depth` objects or lists, its first line without an indent.
std::string inside(const Json& json, std::size_t depth) {
    const std::string blanks(depth * indent, ' ');
    std::string text;
    for (const char c : json.dump(indent)) {
        text += c;
        if (c == '\n') text += blanks;
    }
    return text;
}

/// A list, one element after the other: as a tree it would take several times the memory of the run.
template <class Element>
void write_list(std::string& text, const std::vector<Element>& list) {
    text += '[';
    for (const Element& element : list) {
        if (&element != list.data()) text += ',';
        text += "\n    " + inside(of(element), 2);
    }
    text += list.empty() ? "]" : "\n  ]";
}

}  // namespace

std::string to_json(const Scenario& /*scenario*/, const Run& run) {
    std::string text = "{\n  \"final\": " + inside(final_state(run.final), 1);
    text += ",\n  \"events\": ";
    write_list(text, run.events);
    text += ",\n  \"impacts\": ";
    write_list(text, run.impacts);
    text += ",\n  \"energy\": " + inside(energy(run), 1);
    const Json rest{{"steps", run.cost.steps},
                    {"evaluations", run.cost.evaluations},
                    {"wall_seconds", run.cost.wall_seconds},
                    {"version", version}};
    // The rest of the object, without the brace that opens it.
    return text + ',' + rest.dump(indent).substr(1);
}

}  // namespace footfall
