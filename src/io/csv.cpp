// A run as three tables of comma-separated values.
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "footfall/io/output.hpp"
#include "footfall/io/staged_files.hpp"
#include "io/atomic_file.hpp"
#include "io/columns.hpp"

namespace footfall {
namespace fs = std::filesystem;
namespace {

/// One table: a row is started, filled cell by cell, and ended. Numbers are written so that they read back exactly.
class TableFile {
public:
    explicit TableFile(io::Writer file) : file_(std::move(file)) {}

    void heading(std::string_view name, std::string_view unit) {
        separate();
        fmt::format_to(std::back_inserter(pending_), "{} [{}]", name, unit);
    }
    void text(std::string_view value) {
        separate();
        pending_ += value;
    }
    void number(double value) {
        separate();
        fmt::format_to(std::back_inserter(pending_), "{}", value);
    }
    void number(int value) {
        separate();
        fmt::format_to(std::back_inserter(pending_), "{}", value);
    }
    /// An empty cell stands for what has not happened.
    void number_or_empty(double value) {
        if (std::isnan(value)) {
            separate();
        } else {
            number(value);
        }
    }
    void end_row() {
        constexpr std::size_t block = 1 << 20;
        pending_ += '\n';
        first_ = true;
        if (pending_.size() >= block) flush();
    }

    void finish() {
        flush();
        file_.finish();
    }

private:
    void separate() {
        if (!first_) pending_ += ',';
        first_ = false;
    }
    void flush() {
        file_.write(pending_);
        pending_.clear();
    }

    io::Writer file_;
    std::string pending_;
    bool first_ = true;
};

template <class Of>
void headings(TableFile& table, std::span<const columns::Column<Of>> list, std::string_view prefix,
              std::string_view suffix) {
    for (const auto& column : list) {
        const std::string name = fmt::format("{}{}{}", prefix, column.name, suffix);
        if (column.shape == columns::Shape::scalar) table.heading(name, column.unit);
        for (const std::string_view label : columns::labels(column.shape)) {
            table.heading(fmt::format("{}_{}", name, label), column.unit);
        }
    }
}

template <class Of>
void cells(TableFile& table, std::span<const columns::Column<Of>> list, const Of& object) {
    for (const auto& column : list) {
        std::array<double, 4> values{};
        column.read(object, values.data());
        for (std::size_t i = 0; i < columns::size(column.shape); ++i) table.number_or_empty(values[i]);
    }
}

void fill_samples(TableFile& table, const Scenario& scenario, const Run& run) {
    const std::size_t spheres = scenario.simulation.body.spheres.size();
    table.heading("time", "s");
    headings<BodyState>(table, columns::body, "", "");
    for (std::size_t i = 0; i < spheres; ++i) {
        const std::string suffix = fmt::format("_{}", i);
        table.text("phase" + suffix);
        headings<ContactSnapshot>(table, columns::contact, "", suffix);
        headings<ContactEnergy>(table, columns::contact_energy, "energy_", suffix);
    }
    headings<Ledger>(table, columns::body_energy, "energy_", "");
    headings<ContactEnergy>(table, columns::contact_energy, "energy_", "");
    table.heading("energy_total", "J");
    table.heading("energy_residual", "1");
    table.end_row();

    for (const Snapshot& sample : run.samples) {
        table.number(sample.time);
        cells<BodyState>(table, columns::body, sample.body);
        for (const ContactSnapshot& contact : sample.contacts) {
            table.text(name_of(contact.phase));
            cells<ContactSnapshot>(table, columns::contact, contact);
            cells<ContactEnergy>(table, columns::contact_energy, contact.energy);
        }
        cells<Ledger>(table, columns::body_energy, sample.ledger);
        cells<ContactEnergy>(table, columns::contact_energy, sample.ledger.contact);
        table.number(sample.ledger.total());
        table.number(columns::residual(run, sample.ledger));
        table.end_row();
    }
}

void fill_events(TableFile& table, const Run& run) {
    table.heading("time", "s");
    table.text("kind");
    table.text("sphere");
    headings<BodyState>(table, columns::body, "", "");
    headings<ContactSnapshot>(table, columns::contact, "", "");
    table.end_row();
    for (const Event& event : run.events) {
        table.number(event.time);
        table.text(name_of(event.kind));
        table.number(event.sphere);
        cells<BodyState>(table, columns::body, event.state.body);
        cells<ContactSnapshot>(table, columns::contact, event.state.contacts.at(event.sphere));
        table.end_row();
    }
}

void fill_impacts(TableFile& table, const Run& run) {
    table.text("sphere");
    headings<Impact>(table, columns::impact, "", "");
    table.end_row();
    for (const Impact& impact : run.impacts) {
        table.number(impact.sphere);
        cells<Impact>(table, columns::impact, impact);
        table.end_row();
    }
}

}  // namespace

void check_csv_directory(const fs::path& directory) { io::check_tables(directory); }

void StagedFiles::add_csv(const fs::path& directory, const Scenario& scenario, const Run& run) {
    auto tables = std::make_unique<io::AtomicTables>(directory);
    const auto fill = [&](const char* name, const auto& with) {
        io::within_memory(directory / name, "give [time] a larger sample, or an earlier end", [&] {
            TableFile table(tables->table(name));
            with(table);
            table.finish();
        });
    };
    fill("samples.csv", [&](TableFile& table) { fill_samples(table, scenario, run); });
    fill("events.csv", [&](TableFile& table) { fill_events(table, run); });
    fill("impacts.csv", [&](TableFile& table) { fill_impacts(table, run); });
    parts_.push_back(std::move(tables));
}

void write_csv(const fs::path& directory, const Scenario& scenario, const Run& run) {
    StagedFiles files;
    files.add_csv(directory, scenario, run);
    files.commit();
}

}  // namespace footfall
