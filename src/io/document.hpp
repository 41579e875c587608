// A TOML text, read along a description of its tables.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "footfall/io/setting.hpp"
#include "io/keys.hpp"
#include "io/problems.hpp"
#include "io/record.hpp"

namespace footfall::io {

/// A text that is TOML, though perhaps not a scenario.
class Document {
public:
    /// The text with the settings put into it, in their order. Throws ScenarioError where the text is not TOML, and
    /// InvalidInput, naming its place, where a setting cannot be put.
    Document(std::string_view text, const std::string& file, const std::vector<Setting>& settings = {});
    ~Document();
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    /// There is anything at this dotted path.
    [[nodiscard]] bool has(std::string_view path) const;
    /// The string at this dotted path, if there is one.
    [[nodiscard]] std::optional<std::string> text(std::string_view path) const;
    /// The whole as TOML again, under a comment that names the settings.
    [[nodiscard]] std::string written(const std::vector<Setting>& settings) const;
    /// Reads the whole along `table`. What is wrong is added to `problems`; the record is complete only where
    /// nothing is.
    [[nodiscard]] Record read(const Table& table, Problems& problems) const;

private:
    struct Parsed;
    std::unique_ptr<const Parsed> parsed_;
};

}  // namespace footfall::io
