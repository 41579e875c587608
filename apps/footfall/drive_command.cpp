// footfall drive: a test rig in; loops, stick-slip and drift out, for one pair of laws or for several side by side.
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "context.hpp"
#include "footfall/io/law_text.hpp"
#include "footfall/io/rig.hpp"
#include "footfall/io/table_output.hpp"
#include "footfall/study/drive.hpp"
#include "places.hpp"
#include "settings.hpp"
#include "shipped.hpp"
#include "terminal.hpp"
#include "usage.hpp"

namespace footfall::cli {
namespace {

struct DriveArguments {
    std::filesystem::path rig;
    std::vector<std::string> normal, friction;  ///< in place of the file's
    SettingArguments settings;
    std::optional<std::filesystem::path> csv;
    bool json = false;
    bool list = false;
    bool print = false;
};

RigFile load(const DriveArguments& arguments) {
    const std::vector<Setting> settings = arguments.settings.all("rig.tolerance");
    if (const auto text = shipped_text(FileKind::rig, arguments.rig)) return parse_rig(*text, arguments.rig, settings);
    return load_rig(arguments.rig, settings);
}

/// The laws to drive, each pair with a name that no other has.
std::vector<RigRun> laws_to_drive(const DriveArguments& arguments, const ContactParameters& in_file) {
    std::vector<NormalLaw> normals;
    std::vector<FrictionLaw> frictions;
    for (const std::string& text : arguments.normal) normals.push_back(parse_normal_law(text));
    for (const std::string& text : arguments.friction) frictions.push_back(parse_friction_law(text));
    if (normals.empty()) normals.push_back(in_file.normal);
    if (frictions.empty()) frictions.push_back(in_file.friction);

    std::vector<RigRun> runs;
    std::map<std::string, int> taken;
    for (const NormalLaw& normal : normals) {
        for (const FrictionLaw& friction : frictions) {
            std::string name(name_of(friction));
            if (normals.size() > 1)
                name = frictions.size() > 1 ? fmt::format("{} + {}", name_of(normal), name) : name_of(normal);
            const int nth = ++taken[name];
            if (nth > 1) name += fmt::format(" ({})", nth);
            runs.push_back({{normal, friction}, {name, {}}});
        }
    }
    return runs;
}

int drive_rig(const DriveArguments& arguments) {
    work_on(arguments.rig);
    const RigFile file = load(arguments);
    if (arguments.print) {
        print_as_it_is(file.text);
        return ExitCode::success;
    }
    std::vector<Place> inputs, outputs;
    if (!shipped_text(FileKind::rig, arguments.rig)) inputs.push_back({"RIG", arguments.rig});
    for (const std::filesystem::path& table : file.tables) inputs.push_back({"a table of the rig", table});
    if (arguments.csv) outputs.push_back({"--csv", *arguments.csv});
    keep_apart(inputs, outputs);
    if (arguments.csv) check_csv_file(*arguments.csv);
    std::vector<RigRun> runs = laws_to_drive(arguments, file.laws);
    for (RigRun& run : runs) {
        const std::string where = fmt::format("{}: {}", arguments.rig.string(), run.named.name);
        run.named.drive = in_context(where, [&] { return drive(file.rig, run.laws); });
    }
    std::vector<std::filesystem::path> written;
    if (arguments.csv) {
        std::vector<NamedDrive> named;
        for (const RigRun& run : runs) named.push_back(run.named);
        write_csv(*arguments.csv, drive_table(file.rig, named));
        written.push_back(*arguments.csv);
    }
    if (arguments.json) {
        print(to_json(file.rig, runs) + "\n");
    } else {
        std::string page = summary(file.rig, runs);
        if (file.friction_left_out && arguments.friction.empty()) {
            page += "\nNo friction: [contact.friction] is not given.\n";
        }
        print_page(std::move(page), written);
    }
    return ExitCode::success;
}

int list_rigs() {
    print(shipped_list(FileKind::rig, [](std::string_view text) { return parse_rig(std::string(text)).rig.title; }));
    return ExitCode::success;
}

}  // namespace

CLI::App* add_drive(CLI::App& app, Command& command) {
    auto arguments = std::make_shared<DriveArguments>();
    CLI::App* drive = app.add_subcommand("drive", "Drive one contact along a path: loops, stick-slip, drift");
    CLI::Option* rig =
        drive->add_option("RIG", arguments->rig, "A TOML file, or the name of a rig of --list")->type_name("");
    drive
        ->add_option("--normal", arguments->normal,
                     "A normal law in place of the file's, NAME:key=value,...; again for another run beside it")
        ->type_name("LAW")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    drive
        ->add_option("--friction", arguments->friction,
                     "A friction law in place of the file's, likewise; `footfall laws` lists them all")
        ->type_name("LAW")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    arguments->settings.add_to(*drive, "rig");
    CLI::Option* csv = drive->add_option("--csv", arguments->csv, "Write the samples as a table")->type_name("FILE");
    CLI::Option* json = drive->add_flag("--json", arguments->json, "Print JSON instead of the summary");
    CLI::Option* show =
        drive->add_flag("--print", arguments->print, "Print the rig, as --set makes it")->excludes(csv, json);
    drive->add_flag("--list", arguments->list, "List the rigs that come with footfall")->excludes(rig, csv, json, show);
    drive->footer(
        "Example:\n"
        "  footfall drive presliding-loop\n"
        "  footfall drive presliding-loop --friction dahl:stiffness=1e4,coefficient=0.4 \\\n"
        "      --friction linear:stiffness=1e5,damping=0,coefficient=0.4 --csv loops.csv\n");
    drive->final_callback([&command, arguments, rig] {
        if (arguments->list) {
            command = list_rigs;
            return;
        }
        if (rig->count() == 0) throw missing(*rig);
        command = [arguments] { return drive_rig(*arguments); };
    });
    return drive;
}

}  // namespace footfall::cli
