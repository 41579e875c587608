// The text of a table, whoever wrote it, as cells.
#include "io/table_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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

[[noreturn]] void refuse(const std::string& name, const Position& at, const std::string& message) {
    Problems(name).throw_with(at, message);
}

constexpr std::size_t none = std::string_view::npos;

/// The end of the cell that a quote at `place` opens: behind the quote that closes it. `none` where none does.
std::size_t end_of_quoted(std::string_view text, std::size_t place) {
    for (std::size_t i = place + 1; i < text.size(); ++i) {
        if (text[i] != '"') continue;
        if (i + 1 == text.size() || text[i + 1] != '"') return i + 1;
        ++i;  // a doubled quote stands for one
    }
    return none;
}

bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// What a spreadsheet puts in place of a number that it could not compute: "#DIV/0!", "#N/A", "#NV".
bool is_error_word(std::string_view line) {
    const std::string_view word = line.substr(0, line.find_first_of(" \t,;\r\n"));
    const auto fits = [](char c) { return (c >= 'A' && c <= 'Z') || c == '/' || c == '0' || c == '!' || c == '?'; };
    return word.size() > 2 && word.front() == '#' && std::all_of(word.begin() + 1, word.end(), fits);
}

bool is_comment(std::string_view line) {
    line = trimmed(line);
    return !line.empty() && (line.front() == '#' || line.front() == '%') && !is_error_word(line);
}

/// Where the line that begins at `begin` ends: at the first line end that is in no quoted cell.
std::size_t end_of_line(std::string_view text, std::size_t begin, int number, const std::string& name) {
    bool cell_begins = true, after_blank = false;
    std::size_t i = begin;
    while (i < text.size() && !is_line_end(text[i])) {
        const char c = text[i];
        if (c == '"' && (cell_begins || after_blank)) {
            const std::size_t end = end_of_quoted(text, i);
            if (end == none && cell_begins) {
                refuse(name, Cell{{}, text.substr(begin, i - begin), number}.at(),
                       "a quote (\") opens here and none closes it");
            }
            // Behind a blank inside a cell a quote may be the sign for inches.
            const bool opens = cell_begins || text.substr(i, end - i).find_first_of("\r\n") == none;
            if (end != none && opens) {
                i = end;
                cell_begins = after_blank = false;
                continue;
            }
        }
        after_blank = c == ' ';
        if (c != ' ') cell_begins = c == ',' || c == ';' || c == '\t';
        ++i;
    }
    return i;
}

/// Lines with something in them, and the comments among them.
struct Lines {
    std::vector<Line> lines, comments;
    Position end;
};

Lines lines_of(std::string_view text, const std::string& name) {
    Lines all;
    int number = 1;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t plain_end = std::min(text.find_first_of("\r\n", i), text.size());
        const bool comment = is_comment(text.substr(i, plain_end - i));
        const std::size_t end = comment ? plain_end : end_of_line(text, i, number, name);
        const Line line{text.substr(i, end - i), number};
        all.end = {number, 1};
        number += 1 + static_cast<int>(std::count(line.text.begin(), line.text.end(), '\n'));
        i = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
        if (!trimmed(line.text).empty()) (comment ? all.comments : all.lines).push_back(line);
    }
    return all;
}

constexpr std::array separators{Separator::tab, Separator::semicolon, Separator::comma, Separator::wide_blank,
                                Separator::blank};

std::string_view name_of(Separator separator) {
    constexpr std::array<std::string_view, 6> names{"tabs", "semicolons", "commas", "wide blanks", "blanks", "nothing"};
    return names[static_cast<std::size_t>(separator)];
}

/// The character that is the separator; blanks are looked at apart.
char mark_of(Separator separator) {
    switch (separator) {
        case Separator::tab:
            return '\t';
        case Separator::semicolon:
            return ';';
        case Separator::comma:
            return ',';
        case Separator::wide_blank:
        case Separator::blank:
        case Separator::none:
            break;
    }
    return '\0';
}

class Splitter {
public:
    explicit Splitter(std::deque<std::string>& unquoted) : unquoted_(unquoted) {}

    Cells split(const Line& line, Separator separator) {
        Cells cells;
        std::string_view text = line.text;
        // Blanks at the ends separate nothing.
        const bool blank = separator == Separator::wide_blank || separator == Separator::blank;
        const char mark = mark_of(separator);
        std::size_t begin = blank ? std::min(text.find_first_not_of(" \t"), text.size()) : 0;
        if (blank) text = text.substr(0, text.find_last_not_of(" \t") + 1);
        for (;;) {
            std::size_t end = begin;
            std::size_t length = 0;
            int brackets = 0;
            while (end < text.size()) {
                const char c = text[end];
                if (c == '"' && trimmed(text.substr(begin, end - begin)).empty()) {
                    end = std::min(end_of_quoted(text, end), text.size());
                    continue;
                }
                if (blank && is_blank(c)) {
                    // A blank inside a unit separates nothing, nor does one before it: "force [N]".
                    const std::size_t next = std::min(text.find_first_not_of(" \t", end), text.size());
                    const bool unit = next < text.size() && (text[next] == '[' || text[next] == '(');
                    const bool wide_enough = separator == Separator::blank || next - end >= 2;
                    if (brackets == 0 && wide_enough && !(unit && separator == Separator::blank)) {
                        length = next - end;
                        break;
                    }
                    end = next;
                    continue;
                }
                if (c == '[' || c == '(') ++brackets;
                if ((c == ']' || c == ')') && brackets > 0) --brackets;
                if (c == mark) {
                    length = 1;
                    break;
                }
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
            // "speed, restitution": the blank only stands beside another separator.
            const bool blank = separator == Separator::wide_blank || separator == Separator::blank;
            if (blank && (best == Separator::semicolon || best == Separator::comma)) continue;
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
bool is_separator_line(std::string_view line) {
    line = trimmed(line, "\r\"");
    return line.size() == 5 && (line.starts_with("sep=") || line.starts_with("SEP="));
}

Cells uncommented(Line line, Splitter& splitter, Separator separator) {
    line.text.remove_prefix(line.text.find_first_of("#%") + 1);
    return splitter.split(line, separator);
}

/// A comment right below the header may hold the units, and others may be rows that somebody has taken out.
void look_at_comments(const std::vector<Line>& comments, Splitter& splitter, TableText& table) {
    const int header = table.header.front().line;
    const int first_row = table.rows.empty() ? table.end.line + 1 : table.rows.front().front().line;
    for (const Line& comment : comments) {
        if (comment.number < header) continue;
        Cells cells = uncommented(comment, splitter, table.separator);
        if (cells.size() != table.header.size()) continue;
        const auto number = [](const Cell& cell) { return is_number(cell.text); };
        if (std::any_of(cells.begin(), cells.end(), number)) {
            table.commented_rows.push_back(comment.number);
        } else if (comment.number < first_row) {
            table.comment_below = std::move(cells);
        }
    }
}

}  // namespace

Position Cell::at() const {
    // Characters, not bytes; a quoted cell before it may have gone over lines.
    const auto breaks = static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t start = breaks == 0 ? 0 : before.rfind('\n') + 1;
    return {line + breaks, static_cast<int>(text::width(before.substr(start))) + 1};
}

bool is_number(std::string_view cell) {
    std::string word(cell);
    std::replace(word.begin(), word.end(), ',', '.');
    const auto value = plain_number(word);
    return value.has_value() && std::isfinite(*value);
}

bool is_gap(std::string_view cell) {
    std::string word;
    for (const char c : cell) word += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    constexpr std::array gaps{"", "-", "--", "na", "n/a", "#n/a", "#nv", "n.a.", "nan", "null", "none", "inf", "-inf"};
    return std::find(gaps.begin(), gaps.end(), word) != gaps.end();
}

DecodedText decoded(std::string text, const std::string& name) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        refuse(name, {}, "the file is in UTF-16; save it as UTF-8, or as plain CSV");
    const std::size_t zero = text.find('\0');
    if (zero != std::string::npos) {
        const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n');
        refuse(name, {static_cast<int>(lines) + 1, 1}, "this is no table of text: there is a zero byte in it");
    }
    const bool was_utf8 = is_utf8(text);
    if (!was_utf8) text = from_windows_1252(text);
    // Blanks that do not break a line are blanks.
    std::string plain;
    plain.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = std::string_view(text).substr(i);
        std::size_t size = 0;
        for (const std::string_view blank : {"\u00a0", "\u202f", "\u2007"})
            if (rest.starts_with(blank)) size = blank.size();
        plain += size > 0 ? ' ' : text[i];
        i += std::max(size, std::size_t{1});
    }
    return {std::move(plain), was_utf8};
}

TableText split_table(std::string_view text, const std::string& name, std::string_view wanted) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // the byte order mark of a spreadsheet
    Lines all = lines_of(text, name);
    if (!all.lines.empty() && is_separator_line(all.lines.front().text)) all.lines.erase(all.lines.begin());
    if (all.lines.empty())
        refuse(name, all.end, fmt::format("there is no header line that names the columns; {}", wanted));

    TableText table;
    table.end = all.end;
    Splitter splitter(table.unquoted);
    table.separator = Detector(all.lines, splitter).find(name);
    table.header = splitter.split(all.lines.front(), table.separator);
    drop_empty_end(table.header, 1);
    const std::size_t width = table.header.size();
    for (std::size_t i = 1; i < all.lines.size(); ++i) {
        Cells row = splitter.split(all.lines[i], table.separator);
        const std::size_t cells = row.size();
        drop_empty_end(row, width);
        if (cells == width + 1 && row.size() == width) table.longer_rows = true;
        table.rows.push_back(std::move(row));
    }
    // Spreadsheets write rows of nothing but separators below the last one.
    while (!table.rows.empty() && table.rows.back().size() > 1 && is_empty(table.rows.back())) table.rows.pop_back();
    look_at_comments(all.comments, splitter, table);

    const auto number = [](const Cell& cell) { return is_number(cell.text) || is_gap(cell.text); };
    if (std::all_of(table.header.begin(), table.header.end(), number)) {
        // numpy.savetxt and others write the header as a comment.
        std::string where = "write one above this line, such as \"speed [m/s],restitution\"";
        const int first_line = table.header.front().line;
        for (const Line& comment : all.comments) {
            if (comment.number < first_line && uncommented(comment, splitter, table.separator).size() == width)
                where = fmt::format("line {} looks like one: remove the '{}' before it", comment.number,
                                    trimmed(comment.text).front());
        }
        refuse(name, table.header.front().at(),
               fmt::format("there is no header line that names the columns: {}; {}", where, wanted));
    }
    return table;
}

}  // namespace footfall::io
