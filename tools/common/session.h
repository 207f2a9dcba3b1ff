// What every stage's main shares: common options, outputs, progress, statistics, exit statuses.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/history.h"
#include "base/progress.h"
#include "base/stats.h"
#include "common/command_line.h"
#include "common/progress_line.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace eikonal::gpu {
class Device;
}

namespace eikonal::tool {

/// One run of a tool. The tool adds its own options to app(), then calls run().
class Session {
public:
    Session(const std::string& name, const std::string& description);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    CLI::App& app() { return mApp; }

    /// Parses the command line, does `work`, and returns the exit status. Every error becomes one
    /// line on standard error, the only one but for --verbose and --progress, whatever libraries
    /// write there; no output is left unless all went well. Where the reader of a pipe has gone, it
    /// ends the process as SIGPIPE does.
    int run(int argc, char** argv, const std::function<void(Session&)>& work);

    /// One of these options must be given, but where `unless` says yes after parsing: named with
    /// the others where several are missing.
    void requireOneOf(const std::vector<std::string>& options,
                      const std::function<bool()>& unless = {}) {
        mAlternatives.push_back({options, unless});
    }

    /// Takes `oldName`, which --help leaves out, for `option`, and warns; `more` goes on with the
    /// warning. Throws UsageError where both are given.
    void acceptOldName(CLI::Option* option, const std::string& oldName,
                       const std::string& more = "");

    // For `work`:

    std::uint32_t seed() const { return mSeed; }
    bool explains() const { return mExplain; }
    /// Prints the plan on standard output: effects, and further "name: text" lines.
    void explain(const std::vector<Effect>& effects, const std::vector<std::string>& warnings,
                 const std::vector<std::pair<std::string, std::string>>& facts) const;

    /// Refuses an output that is one of the inputs, an output given twice, or two inputs from
    /// standard input. `further` are outputs beside -o; empty names count as not given.
    void guardInputs(const std::vector<std::string>& inputs,
                     const std::vector<std::string>& further = {}) const;
    /// The outputs, created on the first call; in the order of -o.
    std::vector<std::unique_ptr<AtomicFile>>& outputs();
    const std::vector<std::string>& outputPaths() const { return mOutputPaths; }
    /// Takes these names in place of -o's, as where those are patterns. They are created by
    /// extraOutputs(), not outputs().
    void nameOutputs(std::vector<std::string> paths) { mOutputPaths = std::move(paths); }
    /// So many of them from `first` on, created; they last until the next call.
    std::span<const std::unique_ptr<AtomicFile>> extraOutputs(size_t first, size_t count);
    /// Creates the file of --stats, which outputs() does, too.
    void openStats();
    /// A further output beside -o, written with them.
    AtomicFile& extraOutput(const std::string& path);

    gpu::Device& device(); ///< opened on the first call
    /// To use on the host; 0: all. Fewer than were asked for where the system grants no more.
    int threads() const { return mThreads; }
    Stats& stats() { return mStats; }
    /// Times `work` on the host alone as a pass.
    void pass(const std::string& name, const std::function<void()>& work);
    Progress progress();
    void say(const std::string& line) const; ///< under --verbose, at once
    // A script reads the first line of a run that failed: so these two wait until it has not.
    void note(const std::string& line); ///< at the end of a run that succeeded, unless --quiet
    void warn(const std::string& line); ///< the same; kept for --stats
    History history() const;

private:
    int guarded(const std::function<void()>& body);
    void shareThreads();
    void finish();
    void dropOutputs();
    void printRemarks() const;

    std::string mName;
    CLI::App mApp;
    CLI::Option* mOutputOption = nullptr;
    CLI::Option* mConfigOption = nullptr;
    std::vector<Alternatives> mAlternatives;
    std::vector<std::string> mArguments;
    std::vector<std::string> mOutputPaths;
    std::string mStatsPath, mDeviceName = "auto", mProgressMode;
    bool mExplain = false, mRequireGpu = false, mQuiet = false, mVerbose = false;
    bool mNoClobber = false;
    int mThreads = 0;
    std::uint32_t mSeed = 0;
    std::vector<std::unique_ptr<AtomicFile>> mOutputs, mExtraOutputs;
    std::unique_ptr<AtomicFile> mStatsFile;
    std::unique_ptr<gpu::Device> mDevice;
    Stats mStats;
    std::vector<std::string> mRemarks; // notes and warnings, in order
    double mBegan = 0;
    ProgressLine mProgress;
};

/// `--grid-ior NAME` and its like for the named grids.
void addGridNames(CLI::App& app, std::map<std::string, std::string>& names,
                  const std::vector<std::string>& grids);

/// "X,Y,Z" into a vector; one number stands for all three where `splat`. Throws UsageError naming
/// the option.
glm::dvec3 parseVector(const std::string& option, const std::string& text, bool splat = false);

/// An option whose text is a vector "X,Y,Z", parsed by parseVector.
CLI::Option* addVector(CLI::App& app, const std::string& name, glm::dvec3& value,
                       const std::string& help, bool splat = false);

} // namespace eikonal::tool
