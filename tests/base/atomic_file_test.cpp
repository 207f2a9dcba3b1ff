// Outputs that exist only when they are whole.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/atomic_file.h"

#include "base/error.h"
#include "support/scratch.h"

#include <csignal>
#include <fcntl.h>
#include <unistd.h>

using namespace eikonal;
namespace fs = std::filesystem;

namespace {

class AtomicFileTest : public ScratchTest {
protected:
    std::string read(const std::string& name) const { return bytesOf(name); }
    size_t files() const {
        return static_cast<size_t>(std::distance(fs::directory_iterator(folder), {}));
    }
    ExitStatus failure(const std::string& path, bool noClobber = false) const {
        try {
            AtomicFile file(path, noClobber);
            file.stream() << "new";
            file.commit();
        } catch (const Error& error) {
            return error.status();
        }
        return ExitStatus::done;
    }
};

} // namespace

TEST_F(AtomicFileTest, ExistsOnlyAfterCommit) {
    AtomicFile file(at("a.txt"));
    file.stream() << "hello";
    EXPECT_FALSE(fs::exists(at("a.txt")));
    file.commit();
    EXPECT_EQ(read("a.txt"), "hello");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, DroppedLeavesTheOldFileAndNoTemporary) {
    std::ofstream(at("a.txt")) << "old";
    { AtomicFile(at("a.txt")).stream() << "new"; }
    EXPECT_EQ(read("a.txt"), "old");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, FollowsSymbolicLinks) {
    std::ofstream(at("real.txt")) << "old";
    fs::create_symlink("real.txt", at("link.txt"));
    AtomicFile file(at("link.txt"));
    file.stream() << "new";
    file.commit();
    EXPECT_TRUE(fs::is_symlink(at("link.txt")));
    EXPECT_EQ(read("real.txt"), "new");
}

TEST_F(AtomicFileTest, SeeksForWritersThatPatchTheirHeaders) {
    AtomicFile file(at("a.txt"));
    file.stream() << "hello";
    file.stream().seekp(1);
    file.stream() << "u";
    file.commit();
    EXPECT_EQ(read("a.txt"), "hullo");
}

TEST_F(AtomicFileTest, ADescriptorIsWrittenOnFromWhereItStands) {
    const int file = ::open(at("a.txt").c_str(), O_RDWR | O_CREAT, 0600);
    ASSERT_EQ(::write(file, "old ", 4), 4);
    const std::string number = std::to_string(file);
    fs::create_symlink("/dev/fd/" + number, at("link"));
    for (const std::string& path : {"/dev/fd/" + number, "/proc/self/fd/" + number, at("link")}) {
        EXPECT_TRUE(writtenInPlace(path)) << path;
        AtomicFile out(path);
        EXPECT_FALSE(out.seekable());
        out.stream() << "new ";
        out.commit();
    }
    EXPECT_EQ(read("a.txt"), "old new new new ");
    EXPECT_EQ(files(), 2u);
    ::close(file);
    EXPECT_EQ(failure("/dev/fd/" + number), ExitStatus::cantCreate) << "it is closed";
    EXPECT_FALSE(writtenInPlace(at("a.txt")));
}

TEST_F(AtomicFileTest, AReaderThatHasGoneIsToldApart) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    EXPECT_FALSE(readerIsGone(ends[1]));
    ::close(ends[0]);
    EXPECT_TRUE(readerIsGone(ends[1]));
    std::signal(SIGPIPE, SIG_IGN);
    AtomicFile out("/dev/fd/" + std::to_string(ends[1]));
    out.stream() << "nobody reads this";
    EXPECT_THROW(out.finish(), ClosedPipe);
    ::close(ends[1]);
}

TEST_F(AtomicFileTest, EachFailureHasItsStatus) {
    std::ofstream(at("a.txt")) << "old";
    EXPECT_EQ(failure(at("a.txt"), true), ExitStatus::cantCreate);
    EXPECT_EQ(read("a.txt"), "old");
    EXPECT_EQ(failure(at("none/a.txt")), ExitStatus::cantCreate);
    EXPECT_EQ(failure(folder.string()), ExitStatus::cantCreate);
    EXPECT_EQ(failure("/dev/full"), ExitStatus::io);
    EXPECT_EQ(failure("/dev/null"), ExitStatus::done);
}
