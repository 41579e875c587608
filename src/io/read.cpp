#include "io/read.hpp"

#include <cerrno>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "footfall/math/error.hpp"

namespace footfall::io {

std::string read_file(const std::filesystem::path& file, std::size_t limit) {
    const auto fail = [&file](int error) {
        throw std::system_error(error != 0 ? error : EIO, std::generic_category(),
                                fmt::format("cannot read {}", file.string()));
    };
    const auto refuse_size = [&](const std::string& size) {
        constexpr std::size_t mebi = std::size_t{1} << 20;
        throw InvalidInput(
            fmt::format("cannot read {}: it holds {}, and {} MiB are the most", file.string(), size, limit / mebi));
    };
    // A directory opens as a file on some systems and reads as an empty one.
    std::error_code unknown;
    if (std::filesystem::is_directory(file, unknown)) fail(EISDIR);
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(errno);
    const std::uintmax_t size = std::filesystem::file_size(file, unknown);  // of a pipe or a device, unknown
    if (!unknown && size > limit) refuse_size(fmt::format("{} bytes", size));
    constexpr std::size_t block = std::size_t{1} << 20;
    std::string text;
    while (stream) {
        const std::size_t before = text.size();
        text.resize(before + block);
        stream.read(text.data() + before, static_cast<std::streamsize>(block));
        text.resize(before + static_cast<std::size_t>(stream.gcount()));
        if (text.size() > limit) refuse_size(fmt::format("more than {} bytes", limit));
    }
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
