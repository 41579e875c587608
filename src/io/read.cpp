#include "io/read.hpp"

#include <cerrno>
#include <charconv>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

namespace footfall::io {

std::string read_file(const std::filesystem::path& file) {
    const auto fail = [&file](int error) {
        throw std::system_error(error != 0 ? error : EIO, std::generic_category(),
                                fmt::format("cannot read {}", file.string()));
    };
    // A directory opens as a file on some systems and reads as an empty one.
    if (std::filesystem::is_directory(file)) fail(EISDIR);
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(errno);
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (stream.bad()) fail(errno);
    return text;
}

std::string_view trimmed(std::string_view text, std::string_view blank) {
    const std::size_t first = text.find_first_not_of(blank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::optional<double> plain_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace footfall::io
