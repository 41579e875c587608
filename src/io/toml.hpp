// toml++ as footfall includes it, and what its readers share. Only document.cpp and document_settings.cpp do.
#pragma once

// The assertions of toml++ 3.3 fail on some malformed files ("[" and the end of the line) that it reports correctly
// without them.
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <string_view>

#include <toml++/toml.h>

#include "footfall/io/setting.hpp"

namespace footfall::io {

/// "a table", "a number"
[[nodiscard]] std::string_view type_of(const toml::node& node);

/// Puts the setting's value into the document. Its nodes have the setting's place as the path of their source. Throws
/// InvalidInput where there is no such place in the document.
void apply(const Setting& setting, toml::table& root);

}  // namespace footfall::io
