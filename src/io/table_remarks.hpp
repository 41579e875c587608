// What was found about a table that was read, for a person and as JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "footfall/io/printable.hpp"
#include "footfall/study/table.hpp"
#include "io/text.hpp"

namespace footfall::io {

/// A line for each note and warning, indented by two.
[[nodiscard]] inline std::string remarks_text(const TableRemarks& remarks) {
    std::string page;
    for (const std::string& note : remarks.notes) page += text::hanging(printable(note));
    for (const std::string& warning : remarks.warnings) page += text::hanging("Warning: " + printable(warning));
    return page;
}

/// [{"kind": "table", "text": "..."}, ...]
[[nodiscard]] inline nlohmann::ordered_json warnings_json(const TableRemarks& remarks) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const std::string& warning : remarks.warnings) list.push_back({{"kind", "table"}, {"text", warning}});
    return list;
}

}  // namespace footfall::io
