#include "io/toml_scan.hpp"

#include <string>
#include <vector>

namespace footfall::io {
namespace {

class Scanner {
public:
    explicit Scanner(std::string_view text) : text_(text) {}

    TomlScan scan() {
        while (next_ < text_.size() && !done_) step();
        if (!done_ && !open_.empty()) scan_.unclosed = open_.back();
        return scan_;
    }

private:
    void step() {
        const char c = text_[next_];
        switch (c) {
            case '#':
                while (next_ < text_.size() && text_[next_] != '\n') advance();
                return;
            case '"':
            case '\'':
                string(c);
                return;
            case '[':
            case '{':
                open_.push_back({here_, c});
                if (open_.size() > deepest_toml) refuse();
                dots_ = 0;
                break;
            case ']':
            case '}':
                // One that closes nothing of its kind is an error that the parser finds here at the latest.
                if (open_.empty() || open_.back().what != (c == ']' ? '[' : '{')) done_ = true;
                if (!done_) open_.pop_back();
                dots_ = 0;
                break;
            case '.':
                if (++dots_ > deepest_toml) refuse();
                break;
            case '=':
            case ',':
            case '\n':
                dots_ = 0;
                break;
            default:
                break;
        }
        advance();
    }

    /// A string: on one line, or between three quotes over several.
    void string(char quote) {
        const Unclosed opening{here_, quote};
        const std::string three(3, quote);
        const bool several_lines = text_.substr(next_, 3) == three;
        for (int i = several_lines ? 3 : 1; i > 0; --i) advance();
        while (next_ < text_.size()) {
            const char c = text_[next_];
            if (c == '\\' && quote == '"') {
                advance();
                if (next_ < text_.size() && (several_lines || text_[next_] != '\n')) advance();
            } else if (several_lines && text_.substr(next_, 3) == three) {
                while (next_ < text_.size() && text_[next_] == quote) advance();  // up to two quotes may stand before
                return;
            } else if (!several_lines && c == quote) {
                advance();
                return;
            } else if (!several_lines && c == '\n') {
                break;
            } else {
                advance();
            }
        }
        scan_.unclosed = opening;
        done_ = true;
    }

    void refuse() {
        scan_.too_deep = here_;
        done_ = true;
    }

    void advance() {
        const char c = text_[next_++];
        if (c == '\n') {
            here_ = {here_.line + 1, 1};
        } else if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {  // not within a character of several bytes
            ++here_.column;
        }
    }

    std::string_view text_;
    std::size_t next_ = 0;
    Position here_;
    std::vector<Unclosed> open_;
    int dots_ = 0;
    bool done_ = false;
    TomlScan scan_;
};

}  // namespace

TomlScan scan_toml(std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    return Scanner(text).scan();
}

}  // namespace footfall::io
