// The command lines that files carry.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/history.h"

#include <gtest/gtest.h>

using namespace eikonal;

TEST(History, PathsAreCutToBaseNames) {
    EXPECT_EQ(commandLine({"/usr/bin/render", "/data/in.vdb", "--output=/tmp/x.exr", "-"}),
              "render in.vdb --output=x.exr -");
}

TEST(History, WordsWithBlanksAreQuotedAndStayOnOneLine) {
    EXPECT_EQ(commandLine({"render", "my file.vdb", "a\nb"}), "render 'my file.vdb' 'a b'");
}

TEST(History, LinesAreOldestFirst) {
    EXPECT_EQ(appendHistory("", "one"), "one");
    EXPECT_EQ(appendHistory("one", "two"), "one\ntwo");
}
