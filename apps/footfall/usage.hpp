// The page of --help, and what is wrong with a command line, in this program's words.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace footfall::cli {

/// Lays out --help; the command's messages, not the page, say which options exclude each other.
[[nodiscard]] std::shared_ptr<CLI::Formatter> help_formatter();

/// What is wrong with words that are parsed without an error: a value that is empty, or the name of an option; a value
/// for a flag. `words` are those after the program's name.
[[nodiscard]] std::optional<std::string> misused(const CLI::App& app, const std::vector<std::string>& words);

/// The error that this option, which some others stand in for, was not given: for a final_callback to throw.
[[nodiscard]] CLI::RequiredError missing(CLI::Option& option);

/// What `error` is about: unknown words with the nearest known one, missing values, options that exclude each other.
[[nodiscard]] std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                                      const std::vector<std::string>& words);

}  // namespace footfall::cli
