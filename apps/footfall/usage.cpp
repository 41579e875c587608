// The page of --help, and what is wrong with a command line, in this program's words. CLI11's exceptions only say of
// which kind an error is; what it is about is read from the state in which they leave the parser.
#include "usage.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include <fmt/format.h>

#include "io/nearest.hpp"

namespace footfall::cli {
namespace {

/// The command that was given, or the program itself.
const CLI::App& given_command(const CLI::App& app) {
    const std::vector<CLI::App*> given = app.get_subcommands();
    return given.empty() ? app : *given.back();
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// What a command line calls it: "--output", or "SCENARIO".
std::string name_of(const CLI::Option& option) { return option.get_name(); }

const CLI::Option* option_named(const CLI::App& command, std::string_view word) {
    if (!word.starts_with('-')) return nullptr;
    const std::string name(word.substr(0, word.find('=')));
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional()) continue;
        if (option->check_name(name)) return option;
    }
    return nullptr;
}

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

/// "RIG", or "SCENARIO and DATA": what a command takes without the name of an option.
std::string positionals(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional()) names.push_back(name_of(*option));
    }
    return fmt::format("{}", fmt::join(names, " and "));
}

std::string unknown_command(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    const std::string meant = word.ends_with(".toml") ? fmt::format(": did you mean 'footfall run {}'?", word)
                                                      : io::did_you_mean(word, names);
    return fmt::format("unknown command '{}'{} (commands: {})", word, meant, io::listed(names));
}

/// What the parser had no place for.
std::optional<std::string> left_over(const CLI::App& app) {
    const CLI::App& command = given_command(app);
    std::vector<std::string> words = app.remaining(true);
    words.erase(std::remove(words.begin(), words.end(), "--"), words.end());  // ends the options, and is none
    for (const std::string& word : words) {
        if (word.size() < 2 || !word.starts_with('-')) continue;
        const std::string name = word.substr(0, word.find('='));
        if (option_named(command, word)) {
            return fmt::format("{} stands before the command: write footfall {} ... {}", name, command.get_name(),
                               name);
        }
        const std::vector<std::string> names = option_names(command);
        return fmt::format("unknown option '{}'{} (options: {})", name, io::did_you_mean(name, names),
                           io::listed(names));
    }
    if (words.empty()) return std::nullopt;
    if (&command == &app) return unknown_command(app, words.front());
    const std::string takes = positionals(command);
    return fmt::format("unexpected argument '{}': footfall {} takes {}", words.front(), command.get_name(),
                       takes.empty() ? "only options" : fmt::format("one {} and options", takes));
}

std::string needs_value(const CLI::Option& option, const std::string& next) {
    std::string message =
        fmt::format("{} needs a value: {} {}", name_of(option), name_of(option), option.get_type_name());
    if (!next.empty()) message += fmt::format("; '{}' is an option", next);
    return message;
}

/// The last word names an option that takes a value.
std::optional<std::string> without_value(const CLI::App& command, const std::vector<std::string>& words) {
    if (words.empty()) return std::nullopt;
    const CLI::Option* option = option_named(command, words.back());
    const std::size_t equals = words.back().find('=');
    const bool empty = equals == std::string::npos || equals + 1 == words.back().size();
    if (!option || !takes_value(*option) || !empty) return std::nullopt;
    return needs_value(*option, "");
}

std::optional<std::string> given_too_often(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        const bool once = option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw;
        if (once && takes_value(*option) && static_cast<int>(option->count()) > option->get_items_expected_max())
            return fmt::format("{} is given {} times: give it once", name_of(*option), option->count());
    }
    return std::nullopt;
}

std::optional<std::string> required_options(const CLI::App& command) {
    std::vector<std::string> names;
    std::string description;
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_required() || option->count() > 0) continue;
        names.push_back(name_of(*option));
        description = option->get_description();
    }
    if (names.empty()) return std::nullopt;
    if (names.size() == 1) {
        // "A file", but "CSV with a header"
        const bool word = description.size() > 1 && !std::isupper(static_cast<unsigned char>(description[1]));
        if (word) description[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(description[0])));
        return fmt::format("{} is required: {}", names.front(), description);
    }
    const std::string last = names.back();
    names.pop_back();
    return fmt::format("{} and {} are required", fmt::join(names, ", "), last);
}

std::optional<std::string> excluded(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0) continue;
        for (const CLI::Option* other : option->get_excludes()) {
            if (other->count() > 0)
                return fmt::format("{} and {} cannot be given together", name_of(*option), name_of(*other));
        }
        for (const CLI::Option* other : option->get_needs()) {
            if (other->count() == 0) return fmt::format("{} needs {} beside it", name_of(*option), name_of(*other));
        }
    }
    return std::nullopt;
}

}  // namespace

std::shared_ptr<CLI::Formatter> help_formatter() {
    class Help : public CLI::Formatter {
    public:
        std::string make_option_opts(const CLI::Option* option) const override {
            std::string text;
            if (!option->get_type_name().empty()) text += " " + option->get_type_name();
            if (!option->get_default_str().empty()) text += "=" + option->get_default_str();
            if (option->get_items_expected_max() > 1) text += " ...";
            if (option->get_required()) text += " REQUIRED";
            return text;
        }
    };
    auto help = std::make_shared<Help>();
    help->column_width(28);
    return help;
}

std::optional<std::string> misused(const CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App& command = given_command(app);
    for (const std::string& word : words) {
        const CLI::Option* option = option_named(command, word);
        if (option && !takes_value(*option) && word.find('=') != std::string::npos)
            return fmt::format("{} takes no value", word.substr(0, word.find('=')));
    }
    for (const CLI::Option* option : command.get_options()) {
        if (!takes_value(*option)) continue;
        for (const std::string& value : option->results()) {
            if (value.empty()) return fmt::format("{} is empty", name_of(*option));
            if (!option->get_positional() && option_named(command, value)) return needs_value(*option, value);
        }
    }
    return std::nullopt;
}

CLI::RequiredError missing(CLI::Option& option) {
    option.required();
    return CLI::RequiredError(option.get_name());
}

std::string usage_error(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
    const CLI::App& command = given_command(app);
    // An unknown option may be the one that is missing, misspelt; and a value taken from another option leaves that one
    // missing.
    if (const auto said = misused(app, words)) return *said;
    if (const auto said = left_over(app)) return *said;
    if (const auto said = without_value(command, words)) return *said;
    if (const auto said = given_too_often(command)) return *said;
    if (dynamic_cast<const CLI::RequiredError*>(&error)) {
        if (const auto said = required_options(command)) return *said;
    }
    if (dynamic_cast<const CLI::ExcludesError*>(&error) || dynamic_cast<const CLI::RequiresError*>(&error)) {
        if (const auto said = excluded(command)) return *said;
    }
    return error.what();  // a check of checks.hpp, behind the option's name
}

}  // namespace footfall::cli
