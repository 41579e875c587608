// A run as one JSON object.
#include <nlohmann/json.hpp>

#include "footfall/io/output.hpp"
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

Json event_list(const std::vector<Event>& events) {
    Json list = Json::array();
    for (const Event& event : events) {
        list.push_back({{"time", event.time}, {"kind", name_of(event.kind)}, {"sphere", event.sphere}});
    }
    return list;
}

Json impact_list(const std::vector<Impact>& impacts) {
    Json list = Json::array();
    for (const Impact& impact : impacts) {
        list.push_back({{"sphere", impact.sphere},
                        {"touchdown", impact.touchdown},
                        {"separation", or_null(impact.separation)},
                        {"recovered", or_null(impact.recovered)},
                        {"speed_in", impact.speed_in},
                        {"speed_out", or_null(impact.speed_out)},
                        {"restitution", or_null(impact.restitution())},
                        {"stick_time", impact.stick_time},
                        {"peak_normal_force", impact.peak_normal_force},
                        {"peak_indentation", impact.peak_indentation}});
    }
    return list;
}

Json energy(const Run& run) {
    const Ledger& ledger = run.final.ledger;
    const ContactEnergy& contact = ledger.contact;
    return {{"initial", run.initial.ledger.total()},
            {"kinetic", ledger.kinetic},
            {"potential", ledger.potential},
            {"normal_spring", contact.normal_spring},
            {"tangential_spring", contact.tangential_spring},
            {"normal_damper", contact.normal_damper},
            {"tangential_damper", contact.tangential_damper},
            {"clutch", contact.clutch},
            {"stiffness_change", contact.stiffness_change},
            {"tangential_spring_paper", contact.tangential_spring_paper()},
            {"residual", run.residual()},
            {"max_residual", run.max_residual}};
}

}  // namespace

std::string to_json(const Scenario& /*scenario*/, const Run& run) {
    const Json json{{"final", final_state(run.final)},
                    {"events", event_list(run.events)},
                    {"impacts", impact_list(run.impacts)},
                    {"energy", energy(run)},
                    {"steps", run.cost.steps},
                    {"evaluations", run.cost.evaluations},
                    {"wall_seconds", run.cost.wall_seconds},
                    {"version", version}};
    return json.dump(2);
}

}  // namespace footfall
