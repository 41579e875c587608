// A run as a NetCDF-4 file. The variables are listed in docs/cli.md.
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include "footfall/io/output.hpp"
#include "footfall/io/staged_files.hpp"
#include "io/atomic_file.hpp"
#include "io/run_dataset.hpp"

namespace footfall {
namespace fs = std::filesystem;
namespace {

using io::RunDataset;
using io::Variable;

/// A NetCDF file being written, in memory: with a file of its own HDF5 1.10 crashes where the disk is full. Variables
/// are all defined first and filled after, which NetCDF does fastest. One at a time: see netcdf_mutex.
class NetcdfImage {
public:
    explicit NetcdfImage(io::Writer file) : file_(std::move(file)) {
        constexpr std::size_t initial_bytes = 1 << 16;  // it grows
        expect(nc_create_mem("run.nc", NC_NETCDF4, initial_bytes, &id_));
        open_ = true;
    }
    ~NetcdfImage() {
        if (open_) nc_abort(id_);
    }
    NetcdfImage(const NetcdfImage&) = delete;
    NetcdfImage& operator=(const NetcdfImage&) = delete;

    void write(const RunDataset& data) {
        for (const auto& [name, length] : data.dimensions) {
            int dimension = 0;
            // NetCDF keeps the length 0 for dimensions that can grow; an empty one is one of those.
            expect(nc_def_dim(id_, name.c_str(), length == 0 ? NC_UNLIMITED : length, &dimension));
        }
        for (const auto& [name, value] : data.attributes) {
            std::visit([&, &key = name](const auto& v) { attribute(NC_GLOBAL, key.c_str(), v); }, value);
        }
        std::vector<std::function<void()>> fills;
        for (const Variable& variable : data.variables) {
            std::visit([&](const auto& values) { fills.push_back(define(variable, values)); }, variable.values);
        }
        expect(nc_enddef(id_));
        for (const auto& fill : fills) fill();
        NC_memio image{};
        open_ = false;
        expect(nc_close_memio(id_, &image));
        const std::unique_ptr<void, decltype(&std::free)> owner(image.memory, std::free);
        file_.write({static_cast<const char*>(image.memory), image.size});
        file_.finish();
    }

private:
    /// Returns what fills the variable.
    std::function<void()> define(const Variable& variable, const io::Gather<double>& gather) {
        const int id = define(variable, NC_DOUBLE);
        if (variable.may_be_missing) {
            const double missing = std::nan("");
            expect(nc_def_var_fill(id_, id, NC_FILL, &missing));
        }
        // Contacts are at rest or in flight for much of a run: the values repeat and pack well.
        constexpr int shuffle = 1, deflate = 1, level = 1;
        if (!variable.dimensions.empty()) expect(nc_def_var_deflate(id_, id, shuffle, deflate, level));
        return [this, id, &gather] {
            const std::vector<double> values = gather();
            if (!values.empty()) expect(nc_put_var_double(id_, id, values.data()));
        };
    }
    std::function<void()> define(const Variable& variable, const io::Gather<int>& gather) {
        const int id = define(variable, NC_INT);
        return [this, id, &gather] {
            const std::vector<int> values = gather();
            if (!values.empty()) expect(nc_put_var_int(id_, id, values.data()));
        };
    }
    std::function<void()> define(const Variable& variable, const io::Gather<signed char>& gather) {
        const int id = define(variable, NC_BYTE);
        std::vector<signed char> flag_values(variable.flag_count);
        for (std::size_t i = 0; i < flag_values.size(); ++i) flag_values[i] = static_cast<signed char>(i);
        expect(nc_put_att_schar(id_, id, "flag_values", NC_BYTE, flag_values.size(), flag_values.data()));
        attribute(id, "flag_meanings", variable.flag_meanings);
        return [this, id, &gather] {
            const std::vector<signed char> values = gather();
            if (!values.empty()) expect(nc_put_var_schar(id_, id, values.data()));
        };
    }
    std::function<void()> define(const Variable& variable, const std::span<const std::string_view>& labels) {
        const int id = define(variable, NC_STRING);
        return [this, id, labels] {
            const std::vector<std::string> owned(labels.begin(), labels.end());
            std::vector<const char*> pointers;
            for (const std::string& label : owned) pointers.push_back(label.c_str());
            expect(nc_put_var_string(id_, id, pointers.data()));
        };
    }

    int define(const Variable& variable, nc_type type) {
        std::vector<int> dimensions;
        for (const std::string& name : variable.dimensions) {
            expect(nc_inq_dimid(id_, name.c_str(), &dimensions.emplace_back()));
        }
        int id = 0;
        expect(
            nc_def_var(id_, variable.name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &id));
        attribute(id, "units", variable.units);
        attribute(id, "long_name", variable.long_name);
        return id;
    }

    void attribute(int variable, const char* name, const std::string& text) {
        expect(nc_put_att_text(id_, variable, name, text.size(), text.data()));
    }
    void attribute(int variable, const char* name, double value) {
        expect(nc_put_att_double(id_, variable, name, NC_DOUBLE, 1, &value));
    }
    void attribute(int variable, const char* name, std::int64_t value) {
        const long long wide = value;
        expect(nc_put_att_longlong(id_, variable, name, NC_INT64, 1, &wide));
    }

    void expect(int status) const {
        if (status == NC_NOERR) return;
        if (status == NC_ENOMEM || status == ENOMEM) throw std::bad_alloc();
        // Positive ones are the system's.
        io::fail_to_write(file_.target(),
                          status > 0 ? std::generic_category().message(status)
                                     : std::string("its content could not be put together as NetCDF-4; most often the "
                                                   "memory does not suffice: give [time] a larger sample"));
    }

    io::Writer file_;
    int id_ = 0;
    bool open_ = false;
};

/// The NetCDF library, and HDF5 under it, are for one thread at a time.
std::mutex& netcdf_mutex() {
    static std::mutex one;
    return one;
}

}  // namespace

void check_netcdf_file(const fs::path& file) { const io::AtomicFile attempt(file); }

void StagedFiles::add_netcdf(const fs::path& file, const Scenario& scenario, const Run& run) {
    auto atomic = std::make_unique<io::AtomicFile>(file);
    io::within_memory(file, "give [time] a larger sample, or an earlier end", [&] {
        const RunDataset data = io::run_dataset(scenario, run);
        const std::lock_guard alone(netcdf_mutex());
        NetcdfImage(atomic->writer()).write(data);
    });
    parts_.push_back(std::move(atomic));
}

void write_netcdf(const fs::path& file, const Scenario& scenario, const Run& run) {
    StagedFiles files;
    files.add_netcdf(file, scenario, run);
    files.commit();
}

}  // namespace footfall
