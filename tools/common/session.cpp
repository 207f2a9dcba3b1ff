// What every stage's main shares: common options, outputs, progress, statistics, exit statuses.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/session.h"

#include "base/last_line.h"
#include "base/resources.h"
#include "base/standard_error.h"
#include "base/text.h"
#include "common/command_line.h"
#include "common/stats_json.h"
#include "gpu/device.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iostream>
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

/// Libraries start threads before main, which may fail; the loader calls this first of all.
void beforeLibraries(int, char** argv, char**) {
    const char* const slash = std::strrchr(argv[0], '/');
    endExceptionsInOneLine(slash == nullptr ? argv[0] : slash + 1);
}
[[gnu::section(".preinit_array"),
  gnu::used]] void (*const callBeforeLibraries)(int, char**, char**) = beforeLibraries;

} // namespace

Session::Session(const std::string& name, const std::string& description)
    : mName(name), mApp(description, name), mProgress(name, "none") {
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
    acceptPlainLists(mApp);
}

Session::~Session() = default;

int Session::run(int argc, char** argv, const std::function<void(Session&)>& work) {
    endInOneLine(mName.c_str());
    removeTemporariesOnSignals();
    saveAddressSpace();
    mArguments.assign(argv, argv + argc);
    if (!asksFor(mArguments, "--verbose", "")) keepStandardError();
    const int status = guarded([&] {
        if (asksFor(mArguments, "--device", "list")) return printDevices();
        if (!asksFor(mArguments, "--explain", "")) mOutputOption->required();
        if (!parseCommandLine(mApp, argc, argv, mAlternatives)) return;
        shareThreads();
        work(*this);
        if (!mExplain) finish();
    });
    endOrderly(status);
    return status;
}

void Session::shareThreads() {
    const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    int threads = mThreads > 0 ? mThreads : cores;
    // TBB's beside the caller's, a software device's two pools and its cache's one, OpenEXR's.
    const auto needed = [](int n) { return n - 1 + 2 * std::min(n, 16) + 1 + n; };
    const int granted = startableThreads(needed(threads));
    if (granted < needed(threads)) {
        while (threads > 1 && needed(threads) > granted) --threads;
        mThreads = threads;
    }
    // For good: TBB would start its threads anew when the limit goes.
    static const auto* const limit = new tbb::global_control(
        tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    static_cast<void>(limit);
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
    try {
        body();
        if (!std::cout.flush()) {
            if (readerIsGone(STDOUT_FILENO)) throw ClosedPipe("standard output");
            throw IoError("standard output: write failed");
        }
        mProgress.end();
        printRemarks();
        return 0;
    } catch (const ClosedPipe&) {
        dropOutputs();
        endByClosedPipe();
    } catch (const std::exception& thrown) {
        const Error error = meaningOf(thrown);
        std::string line = mName + ": error: " + error.what();
        std::replace(line.begin(), line.end(), '\n', ' ');
        mProgress.end();
        tell(line + "\n");
        return static_cast<int>(error.status());
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
        openStats();
    }
    return mOutputs;
}

std::span<const std::unique_ptr<AtomicFile>> Session::extraOutputs(size_t first, size_t count) {
    for (size_t k = 0; k < count; ++k) extraOutput(mOutputPaths.at(first + k));
    return std::span(mExtraOutputs).last(count);
}

void Session::openStats() {
    if (!mStatsPath.empty() && !mStatsFile)
        mStatsFile = std::make_unique<AtomicFile>(mStatsPath, mNoClobber);
}

void Session::dropOutputs() {
    mOutputs.clear();
    mExtraOutputs.clear();
    mStatsFile.reset();
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
    if (mProgressMode == "none" || (mProgressMode.empty() && (mQuiet || !tellsTerminal())))
        return {};
    mProgress = ProgressLine(mName, mProgressMode);
    return [this](double fraction) { mProgress(fraction); };
}

void Session::say(const std::string& line) const {
    if (mVerbose) tell(mName + ": " + line + "\n");
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
    for (const std::string& line : mRemarks) tell(mName + ": " + line + "\n");
}

History Session::history() const {
    return {mName, EIKONAL_VERSION, commandLine(mArguments)};
}

void Session::finish() {
    if (mStatsFile)
        mStatsFile->stream() << statsText(mStats, history(), mDevice ? &mDevice->info() : nullptr,
                                          nowMs() - mBegan);
    std::vector<AtomicFile*> files;
    for (const auto& file : mOutputs) files.push_back(file.get());
    for (const auto& file : mExtraOutputs) files.push_back(file.get());
    if (mStatsFile) files.push_back(mStatsFile.get());
    for (AtomicFile* file : files) file->finish();
    for (AtomicFile* file : files) file->commit();
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
