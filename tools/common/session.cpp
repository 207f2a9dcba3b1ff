// What every stage's main shares: common options, outputs, progress, statistics, exit statuses.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/session.h"

#include "base/text.h"
#include "gpu/device.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <thread>
#include <unistd.h>

namespace eikonal::tool {

namespace {

double nowMs() {
    return std::chrono::duration<double, std::milli>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Two names of one file, there or not yet, give the same path.
std::filesystem::path wholePath(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
}

std::string firstLine(const std::string& text) {
    const std::string line = split(text, '\n').front();
    return line.empty() ? "unknown error" : line;
}

bool asksFor(const std::vector<std::string>& arguments, const std::string& option,
             const std::string& value) {
    for (size_t i = 1; i < arguments.size(); ++i) {
        if (arguments[i] == "--") return false;
        if (arguments[i] == option + (value.empty() ? "" : "=" + value)) return true;
        if (!value.empty() && arguments[i] == option && i + 1 < arguments.size() &&
            arguments[i + 1] == value)
            return true;
    }
    return false;
}

void printDevices() {
    const auto devices = gpu::listDevices();
    if (devices.empty())
        throw DeviceError("no device gives an OpenGL 4.5 core context through EGL");
    for (size_t i = 0; i < devices.size(); ++i)
        std::cout << i << "  " << devices[i].renderer << "  (" << devices[i].vendor << ", "
                  << devices[i].version << (devices[i].software ? ", software" : "") << ")\n";
}

nlohmann::ordered_json rgb(const Energy::Rgb& value) {
    return nlohmann::ordered_json::array({value[0], value[1], value[2]});
}

} // namespace

struct Session::ThreadLimit {
    tbb::global_control control;
};

Session::Session(const std::string& name, const std::string& description)
    : mName(name), mApp(description, name) {
    mBegan = nowMs();
    mApp.get_formatter()->column_width(34);
    mApp.set_version_flag("--version", name + " " + EIKONAL_VERSION, "print the version and stop");
    mApp.set_help_flag("-h,--help", "print this help and stop");
    mOutputOption =
        mApp.add_option("-o,--output", mOutputPaths, "file to write; - is standard output")
            ->type_name("FILE")
            ->allow_extra_args(false) // what follows is an input
            ->group("Output");
    mApp.add_flag("--no-clobber", mNoClobber, "refuse to replace an existing file")
        ->group("Output");
    mApp.add_option("--stats", mStatsPath, "write what the run measured, as JSON")
        ->type_name("FILE.json")
        ->group("Output");
    mApp.add_flag("--explain", mExplain, "print what would be simulated, and why, and stop")
        ->group("Output");
    mApp.add_option("--device", mDeviceName, "auto, software, list, or a number from the list")
        ->type_name("DEVICE")
        ->capture_default_str()
        ->group("Run");
    mApp.add_flag("--require-gpu", mRequireGpu, "refuse a software device")->group("Run");
    mApp.add_option("--threads", mThreads, "threads to use on the host; 0: all")
        ->type_name("N")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str()
        ->group("Run");
    mApp.add_option("--seed", mSeed, "seed of everything random")
        ->type_name("N")
        ->capture_default_str()
        ->group("Run");
    auto* quiet = mApp.add_flag("--quiet", mQuiet, "say nothing but errors")->group("Run");
    mApp.add_flag("--verbose", mVerbose, "say what is done")->excludes(quiet)->group("Run");
    mApp.add_option("--progress", mProgressMode,
                    "none, text, alf (Tractor, Houdini), openjd (Deadline Cloud) or json, on "
                    "standard error; a bar where that is a terminal")
        ->type_name("MODE")
        ->check(CLI::IsMember({"none", "text", "alf", "openjd", "json"}))
        ->group("Run");
    mConfigOption =
        mApp.set_config("--config", "",
                        "read options by name from this file: lines of name=value, lists in quotes")
            ->type_name("FILE")
            ->group("Run");
    mApp.allow_config_extras(CLI::config_extras_mode::error);
}

Session::~Session() = default;

int Session::run(int argc, char** argv, const std::function<void(Session&)>& work) {
    removeTemporariesOnSignals();
    mArguments.assign(argv, argv + argc);
    int parsed = -1; // the status of --help and --version, which end the run
    const int status = guarded([&] {
        if (asksFor(mArguments, "--device", "list")) {
            printDevices();
            parsed = 0;
            return;
        }
        if (!asksFor(mArguments, "--explain", "")) mOutputOption->required();
        try {
            mApp.parse(argc, argv);
        } catch (const CLI::FileError& error) {
            throw MissingError(firstLine(error.what()));
        } catch (const CLI::ParseError& error) {
            if (error.get_exit_code() != 0) throw UsageError(firstLine(error.what()));
            parsed = mApp.exit(error);
            return;
        }
        mThreadLimit.reset(new ThreadLimit{
            tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                mThreads > 0 ? static_cast<size_t>(mThreads)
                                             : std::max(1u, std::thread::hardware_concurrency()))});
        work(*this);
        if (!mExplain) finish();
    });
    if (mBarDrawn) std::fputc('\n', stderr);
    if (status == 0 && !std::cout.flush()) {
        std::cerr << mName << ": error: standard output: write failed\n";
        return static_cast<int>(ExitStatus::io);
    }
    if (status == 0) printRemarks();
    return status != 0 ? status : std::max(parsed, 0);
}

void Session::acceptOldName(CLI::Option* option, const std::string& oldName,
                            const std::string& more) {
    mApp.add_option_function<std::string>(oldName,
                                          [=, this](const std::string& text) {
                                              const std::string name = option->get_name();
                                              if (option->count() > 0)
                                                  throw UsageError(oldName + ": is " + name +
                                                                   " by its old name, and that is "
                                                                   "given, too");
                                              option->add_result(text);
                                              option->run_callback();
                                              warn(oldName + " is called " + name + " now" + more);
                                          })
        ->group(""); // not in --help
}

int Session::guarded(const std::function<void()>& body) {
    const auto fail = [this](ExitStatus status, const std::string& message) {
        if (mBarDrawn) std::fputc('\n', stderr);
        mBarDrawn = false;
        std::string line = message;
        std::replace(line.begin(), line.end(), '\n', ' ');
        std::cerr << mName << ": error: " << line << std::endl;
        return static_cast<int>(status);
    };
    try {
        body();
        return 0;
    } catch (const Error& error) {
        return fail(error.status(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(ExitStatus::memory, "not enough memory on the host");
    } catch (const std::exception& error) {
        return fail(ExitStatus::internal, error.what());
    }
}

void Session::explain(const std::vector<Effect>& effects, const std::vector<std::string>& warnings,
                      const std::vector<std::pair<std::string, std::string>>& facts) const {
    for (const auto& [name, text] : facts) std::cout << name << ": " << text << "\n";
    for (const Effect& effect : effects)
        std::cout << effect.name << ": " << (effect.on ? "on" : "off") << " (" << effect.why
                  << ")\n";
    for (const std::string& warning : warnings) std::cout << "warning: " << warning << "\n";
}

void Session::guardInputs(const std::vector<std::string>& inputs,
                          const std::vector<std::string>& further) const {
    if (std::count(inputs.begin(), inputs.end(), "-") > 1)
        throw UsageError("standard input is given more than once");
    std::vector<std::string> read = inputs;
    if (mConfigOption->count() > 0) read.push_back(mConfigOption->as<std::string>());
    std::vector<std::string> written = mOutputPaths;
    for (const std::string& path : further) written.push_back(path);
    written.push_back(mStatsPath);
    written.erase(std::remove(written.begin(), written.end(), ""), written.end());
    for (size_t i = 0; i < written.size(); ++i) {
        for (const std::string& input : read)
            if (sameFile(input, written[i]))
                throw UsageError(written[i] + ": is an input, which would be overwritten");
        // Twice the same device is no loss.
        std::error_code ignored;
        const auto status = std::filesystem::status(written[i], ignored);
        if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) continue;
        for (size_t j = 0; j < i; ++j)
            if (wholePath(written[i]) == wholePath(written[j]))
                throw UsageError(written[i] + ": is given twice as output");
    }
}

std::vector<std::unique_ptr<AtomicFile>>& Session::outputs() {
    if (mOutputs.empty()) {
        for (const std::string& path : mOutputPaths)
            mOutputs.push_back(std::make_unique<AtomicFile>(path, mNoClobber));
        if (!mStatsPath.empty()) mStatsFile = std::make_unique<AtomicFile>(mStatsPath, mNoClobber);
    }
    return mOutputs;
}

AtomicFile& Session::extraOutput(const std::string& path) {
    mExtraOutputs.push_back(std::make_unique<AtomicFile>(path, mNoClobber));
    return *mExtraOutputs.back();
}

gpu::Device& Session::device() {
    if (!mDevice) {
        gpu::DeviceChoice choice = gpu::parseDeviceChoice(mDeviceName);
        choice.requireGpu = mRequireGpu;
        choice.threads = mThreads;
        pass("device", [&] { mDevice = std::make_unique<gpu::Device>(choice); });
        say("device: " + mDevice->info().renderer);
    }
    return *mDevice;
}

void Session::pass(const std::string& name, const std::function<void()>& work) {
    const double began = nowMs();
    work();
    mStats.addPass(name, 0, nowMs() - began);
}

Progress Session::progress() {
    if (mProgressMode == "none" || (mProgressMode.empty() && (mQuiet || !isatty(STDERR_FILENO))))
        return {};
    return [this](double fraction) {
        const int percent = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * 100 + 1e-9);
        if (percent <= mLastPercent) return;
        const bool bar =
            (mProgressMode.empty() || mProgressMode == "text") && isatty(STDERR_FILENO);
        if (mProgressMode == "alf") {
            std::fprintf(stderr, "ALF_PROGRESS %d%%\n", percent);
        } else if (mProgressMode == "openjd") {
            std::fprintf(stderr, "openjd_progress: %d\n", percent);
        } else if (mProgressMode == "json") {
            std::fprintf(stderr, "{\"tool\":\"%s\",\"progress\":%.2f}\n", mName.c_str(),
                         percent / 100.0);
        } else if (bar) {
            const std::string full(static_cast<size_t>(percent / 2), '#');
            std::fprintf(stderr, "\r%s [%-50s] %3d%%", mName.c_str(), full.c_str(), percent);
            mBarDrawn = true;
        } else if (percent / 10 > mLastPercent / 10 || mLastPercent < 0) {
            std::fprintf(stderr, "%s: %d%%\n", mName.c_str(), percent);
        }
        mLastPercent = percent;
    };
}

void Session::say(const std::string& line) const {
    if (mVerbose) std::cerr << mName << ": " << line << "\n";
}

void Session::note(const std::string& line) {
    mRemarks.push_back(line);
}

void Session::warn(const std::string& line) {
    mStats.warnings.push_back(line);
    mRemarks.push_back("warning: " + line);
}

void Session::printRemarks() const {
    if (mQuiet) return;
    for (const std::string& line : mRemarks) std::cerr << mName << ": " << line << "\n";
}

History Session::history() const {
    return {mName, EIKONAL_VERSION, commandLine(mArguments)};
}

void Session::finish() {
    if (mStatsFile) mStatsFile->stream() << statsText();
    std::vector<AtomicFile*> files;
    for (const auto& file : mOutputs) files.push_back(file.get());
    for (const auto& file : mExtraOutputs) files.push_back(file.get());
    if (mStatsFile) files.push_back(mStatsFile.get());
    for (AtomicFile* file : files) file->finish();
    for (AtomicFile* file : files) file->commit();
}

std::string Session::statsText() const {
    using Json = nlohmann::ordered_json;
    Json json;
    json["tool"] = mName;
    json["version"] = EIKONAL_VERSION;
    json["command"] = commandLine(mArguments);
    if (mDevice) {
        const gpu::DeviceInfo& info = mDevice->info();
        json["device"] = {{"vendor", info.vendor},
                          {"renderer", info.renderer},
                          {"version", info.version},
                          {"software", info.software}};
    } else {
        json["device"] = nullptr;
    }
    json["effects"] = Json::object();
    for (const Effect& effect : mStats.effects)
        json["effects"][effect.name] = {{"on", effect.on}, {"why", effect.why}};
    json["passes"] = Json::array();
    for (const PassTime& pass : mStats.passes)
        json["passes"].push_back(
            {{"name", pass.name}, {"gpu_ms", pass.gpuMs}, {"cpu_ms", pass.cpuMs}});
    json["counters"] = Json::object();
    for (const auto& [name, value] : mStats.counters)
        if (value == std::floor(value))
            json["counters"][name] = static_cast<std::uint64_t>(value);
        else
            json["counters"][name] = value;
    if (mStats.hasEnergy) {
        const Energy& energy = mStats.energy;
        json["energy"] = {{"emitted", rgb(energy.emitted)},   {"entered", rgb(energy.entered)},
                          {"absorbed", rgb(energy.absorbed)}, {"scattered", rgb(energy.scattered)},
                          {"escaped", rgb(energy.escaped)},   {"lost", rgb(energy.lost)}};
    }
    if (!mStats.warnings.empty()) json["warnings"] = mStats.warnings;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    json["memory"] = {{"gpu_peak_bytes", mStats.gpuPeakBytes},
                      {"rss_peak_bytes", static_cast<std::uint64_t>(usage.ru_maxrss) * 1024}};
    json["wall_ms"] = nowMs() - mBegan;
    return json.dump(2) + "\n";
}

void addGridNames(CLI::App& app, std::map<std::string, std::string>& names,
                  const std::vector<std::string>& grids) {
    for (const std::string& grid : grids) {
        std::string option = grid;
        std::replace(option.begin(), option.end(), '_', '-');
        app.add_option_function<std::string>(
               "--grid-" + option, [&names, grid](const std::string& name) { names[grid] = name; },
               "read '" + grid + "' under this name")
            ->type_name("NAME")
            ->group("Grid names");
    }
}

glm::dvec3 parseVector(const std::string& option, const std::string& text, bool splat) {
    const auto numbers = parseNumbers(text);
    if (numbers && numbers->size() == 3) return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    if (numbers && splat && numbers->size() == 1) return glm::dvec3((*numbers)[0]);
    throw UsageError(option + ": found '" + text + "', expected " +
                     (splat ? "one number or " : "") + "three numbers X,Y,Z");
}

CLI::Option* addVector(CLI::App& app, const std::string& name, glm::dvec3& value,
                       const std::string& help, bool splat) {
    return app
        .add_option_function<std::string>(
            name,
            [&value, name, splat](const std::string& text) {
                value = parseVector(name, text, splat);
            },
            help)
        ->type_name("X,Y,Z");
}

} // namespace eikonal::tool
