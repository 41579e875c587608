// The text of a table, whoever wrote it, as cells.
#include "io/table_text.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "io/nearest.hpp"
#include "io/read.hpp"
#include "io/text.hpp"
#include "io/utf8.hpp"

namespace footfall::io {
namespace {

/// A line of the table, or several where a quoted cell goes over their ends.
struct Line {
    std::string_view text;
    int number = 1;
};

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// What may stand before a quote that opens a cell.
bool may_precede_cell(char c) { return is_blank(c) || c == ',' || c == ';'; }

[[noreturn]] void refuse(const std::string& name, Position at, std::string message) {
    Problems problems(name);
    problems.add(at, std::move(message));
    problems.throw_if_any();
    std::abort();  // not reached: there is one
}

/// The end of the cell that a quote at `place` opens: behind the quote that closes it. Nothing where none does.
std::optional<std::size_t> end_of_quoted(std::string_view text, std::size_t place) {
    for (std::size_t i = place + 1; i < text.size(); ++i) {
        if (text[i] != '"') continue;
        if (i + 1 < text.size() && text[i + 1] == '"') {
            ++i;  // a doubled quote stands for one
        } else {
            return i + 1;
        }
    }
    return std::nullopt;
}

/// Lines with something in them that are no comments, and the last comment above the first of them.
struct Lines {
    std::vector<Line> lines;
    std::optional<Line> comment;
    Position end;
};

Lines lines_of(std::string_view text, const std::string& name) {
    Lines all;
    int number = 1;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t begin = i;
        const int first = number;
        bool cell_may_begin = true;
        const std::size_t content = std::min(text.find_first_not_of(" \t", i), text.size());
        const bool comment = content < text.size() && (text[content] == '#' || text[content] == '%');
        while (i < text.size() && text[i] != '\n' && text[i] != '\r') {
            if (text[i] == '"' && cell_may_begin && !comment) {
                const auto end = end_of_quoted(text, i);
                if (!end) {
                    refuse(name, Cell{{}, text.substr(begin, i - begin), first}.at(),
                           "a quote (\") opens here and none closes it");
                }
                number += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                                      text.begin() + static_cast<std::ptrdiff_t>(*end), '\n'));
                i = *end;
                cell_may_begin = false;
            } else {
                cell_may_begin = may_precede_cell(text[i]);
                ++i;
            }
        }
        const Line line{text.substr(begin, i - begin), first};
        if (i < text.size()) i += text.substr(i).starts_with("\r\n") ? 2 : 1;
        all.end = {number, 1};
        ++number;
        if (trimmed(line.text).empty()) continue;
        if (!comment) {
            all.lines.push_back(line);
        } else if (all.lines.empty()) {
            all.comment = line;
        }
    }
    return all;
}

constexpr std::array separators{Separator::tab, Separator::semicolon, Separator::comma, Separator::wide_blank,
                                Separator::blank};

std::string_view name_of(Separator separator) {
    constexpr std::array<std::string_view, 6> names{"tabs", "semicolons", "commas", "wide blanks", "blanks", "nothing"};
    return names[static_cast<std::size_t>(separator)];
}

/// The length of the separator at `place`; 0 where there is none.
std::size_t separator_at(std::string_view text, std::size_t place, Separator separator) {
    const auto blanks = [&] {
        std::size_t end = place;
        while (end < text.size() && is_blank(text[end])) ++end;
        return end - place;
    };
    switch (separator) {
        case Separator::tab:
            return text[place] == '\t' ? 1 : 0;
        case Separator::semicolon:
            return text[place] == ';' ? 1 : 0;
        case Separator::comma:
            return text[place] == ',' ? 1 : 0;
        case Separator::wide_blank: {
            const std::size_t width = blanks();
            return width >= 2 ? width : 0;
        }
        case Separator::blank: {
            // A unit in brackets belongs to the name before it: "force [N]".
            const std::size_t width = blanks();
            const std::size_t next = place + width;
            const bool unit = next < text.size() && (text[next] == '[' || text[next] == '(');
            return unit ? 0 : width;
        }
        case Separator::none:
            break;
    }
    return 0;
}

class Splitter {
public:
    explicit Splitter(std::deque<std::string>& unquoted) : unquoted_(unquoted) {}

    Cells split(const Line& line, Separator separator) {
        Cells cells;
        std::string_view text = line.text;
        // Blanks at the ends separate nothing.
        const bool blank = separator == Separator::wide_blank || separator == Separator::blank;
        std::size_t begin = blank ? std::min(text.find_first_not_of(" \t"), text.size()) : 0;
        if (blank) text = text.substr(0, text.find_last_not_of(" \t") + 1);
        for (;;) {
            std::size_t end = begin;
            std::size_t length = 0;
            int brackets = 0;
            while (end < text.size()) {
                const char c = text[end];
                if (c == '"' && trimmed(text.substr(begin, end - begin)).empty()) {
                    end = end_of_quoted(text, end).value_or(text.size());
                    continue;
                }
                if (c == '[' || c == '(') ++brackets;
                if ((c == ']' || c == ')') && brackets > 0) --brackets;
                // A blank inside a unit separates nothing.
                length = blank && brackets > 0 ? 0 : separator_at(text, end, separator);
                if (length > 0) break;
                ++end;
            }
            cells.push_back(cell(line, text, begin, end));
            if (end >= text.size()) return cells;
            begin = end + length;
        }
    }

private:
    Cell cell(const Line& line, std::string_view text, std::size_t begin, std::size_t end) {
        std::string_view inside = trimmed(text.substr(begin, end - begin));
        const std::size_t place = inside.empty() ? begin : static_cast<std::size_t>(inside.data() - line.text.data());
        Cell made{inside, line.text.substr(0, place), line.number, false};
        if (inside.size() >= 2 && inside.front() == '"' && inside.back() == '"') {
            made.quoted = true;
            made.text = trimmed(inside.substr(1, inside.size() - 2), " \t\r\n");
            if (made.text.find('"') != std::string_view::npos) {
                std::string& single = unquoted_.emplace_back();
                for (std::size_t i = 0; i < made.text.size(); ++i) {
                    single += made.text[i];
                    if (made.text.substr(i, 2) == "\"\"") ++i;
                }
                made.text = single;
            }
        }
        return made;
    }

    std::deque<std::string>& unquoted_;
};

/// Spreadsheets end lines with separators where one line was longer.
void drop_empty_end(Cells& cells, std::size_t width) {
    while (cells.size() > width && cells.back().text.empty()) cells.pop_back();
}

bool is_empty(const Cells& cells) {
    return std::all_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.text.empty(); });
}

/// Finds what separates the cells: what splits the header into two or more, and the rows that are looked at into as
/// many.
class Detector {
public:
    Detector(const std::vector<Line>& lines, Splitter& splitter) : lines_(lines), splitter_(splitter) {}

    Separator find(const std::string& name) {
        constexpr std::size_t looked_at = 200;  // rows: enough to tell, and no more work than that
        const std::size_t rows = std::min(lines_.size() - 1, looked_at);
        Separator best = Separator::none;
        std::size_t best_count = 0;
        for (const Separator separator : separators) {
            Cells header = splitter_.split(lines_.front(), separator);
            drop_empty_end(header, 1);
            const std::size_t width = header.size();
            if (width < 2) continue;
            const auto fits = [&](const Line& line) {
                Cells row = splitter_.split(line, separator);
                drop_empty_end(row, width);
                return row.size() == width;
            };
            const auto first = lines_.begin() + 1;
            const auto count =
                static_cast<std::size_t>(std::count_if(first, first + static_cast<std::ptrdiff_t>(rows), fits));
            if (count == rows) return separator;
            if (best == Separator::none || count > best_count) {
                best = separator;
                best_count = count;
            }
        }
        if (best_count == 0 && rows > 0) refuse_if_the_row_is_split_otherwise(best, name);
        return best;
    }

private:
    void refuse_if_the_row_is_split_otherwise(Separator of_header, const std::string& name) {
        const Line& row = lines_[1];
        if (splitter_.split(row, of_header).size() > 1) return;  // only its length is wrong
        for (const Separator separator : {Separator::tab, Separator::semicolon, Separator::comma, Separator::blank}) {
            const std::size_t width = splitter_.split(row, separator).size();
            const std::size_t names = splitter_.split(lines_.front(), of_header).size();
            if (separator == of_header || width < 2) continue;
            if (of_header == Separator::none && separator == Separator::comma) continue;  // a decimal comma
            refuse(name, {row.number, 1},
                   fmt::format("cannot tell what separates the columns: {} make {} of this line, but the header is {}; "
                               "separate all lines alike, by commas, semicolons, tabs or blanks",
                               footfall::io::name_of(separator), width,
                               of_header == Separator::none ? std::string("a single name")
                                                            : fmt::format("{} names with {} between them", names,
                                                                          footfall::io::name_of(of_header))));
        }
    }

    const std::vector<Line>& lines_;
    Splitter& splitter_;
};

/// "sep=;", with which a spreadsheet is told how to split a file.
bool is_separator_line(std::string_view line) { return line.size() == 5 && line.starts_with("sep="); }

}  // namespace

Position Cell::at() const {
    // Characters, not bytes; a quoted cell before it may have gone over lines.
    const auto breaks = static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t start = breaks == 0 ? 0 : before.rfind('\n') + 1;
    return {line + breaks, static_cast<int>(text::width(before.substr(start))) + 1};
}

bool is_number_or_gap(std::string_view cell) {
    std::string word;
    for (const char c : cell) word += c == ',' ? '.' : static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    if (plain_number(word)) return true;
    constexpr std::array gaps{"", "-", "--", "na", "n/a", "#n/a", "nan", "null", "none"};
    return std::find(gaps.begin(), gaps.end(), word) != gaps.end();
}

std::string decoded(std::string text, const std::string& name) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        refuse(name, {}, "the file is in UTF-16; save it as UTF-8, or as plain CSV");
    const std::size_t zero = text.find('\0');
    if (zero != std::string::npos) {
        const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n');
        refuse(name, {static_cast<int>(lines) + 1, 1}, "this is no table of text: there is a zero byte in it");
    }
    return is_utf8(text) ? std::move(text) : from_windows_1252(text);
}

TableText split_table(std::string_view text, const std::string& name, std::string_view wanted) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // the byte order mark of a spreadsheet
    Lines all = lines_of(text, name);
    if (!all.lines.empty() && is_separator_line(trimmed(all.lines.front().text))) all.lines.erase(all.lines.begin());
    if (all.lines.empty())
        refuse(name, all.end, fmt::format("there is no header line that names the columns; {}", wanted));

    TableText table;
    table.end = all.end;
    Splitter splitter(table.unquoted);
    table.separator = Detector(all.lines, splitter).find(name);
    table.header = splitter.split(all.lines.front(), table.separator);
    drop_empty_end(table.header, 1);
    for (std::size_t i = 1; i < all.lines.size(); ++i) {
        Cells row = splitter.split(all.lines[i], table.separator);
        drop_empty_end(row, table.header.size());
        if (row.size() > 1 && is_empty(row)) continue;  // nothing but separators
        table.rows.push_back(std::move(row));
    }

    const auto number = [](const Cell& cell) { return is_number_or_gap(cell.text); };
    if (std::all_of(table.header.begin(), table.header.end(), number)) {
        // numpy.savetxt and others write the header as a comment.
        std::string where = "write one above this line, such as \"speed [m/s],restitution\"";
        if (all.comment) {
            Line comment = *all.comment;
            comment.text.remove_prefix(comment.text.find_first_of("#%") + 1);
            if (splitter.split(comment, table.separator).size() == table.header.size())
                where = fmt::format("line {} looks like one: remove the '{}' before it", comment.number,
                                    trimmed(all.comment->text).front());
        }
        refuse(name, table.header.front().at(),
               fmt::format("there is no header line that names the columns: {}; {}", where, wanted));
    }
    return table;
}

}  // namespace footfall::io
