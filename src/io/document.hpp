// A TOML text, read along a description of its tables.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/keys.hpp"
#include "io/problems.hpp"
#include "io/record.hpp"

namespace footfall::io {

/// A text that is TOML, though perhaps not a scenario.
class Document {
public:
    /// Throws ScenarioError where the text is not TOML.
    Document(std::string_view text, const std::string& file);
    ~Document();
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    /// There is anything at this dotted path.
    [[nodiscard]] bool has(std::string_view path) const;
    /// The string at this dotted path, if there is one.
    [[nodiscard]] std::optional<std::string> text(std::string_view path) const;
    /// Reads the whole along `table`. What is wrong is added to `problems`; the record is complete only where
    /// nothing is.
    [[nodiscard]] Record read(const Table& table, Problems& problems) const;

private:
    struct Parsed;
    std::unique_ptr<const Parsed> parsed_;
};

}  // namespace footfall::io
