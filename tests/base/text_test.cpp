// Numbers to text and back.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"

#include <gtest/gtest.h>
#include <limits>

using namespace eikonal;

TEST(Text, SmallNumbersKeepTheirDigits) {
    EXPECT_EQ(toText(5.8e-6f), "5.8e-06");
    EXPECT_EQ(parseNumber(toText(0.1 + 0.2)), 0.1 + 0.2);
}

TEST(Text, NumbersAreReadWholeOrNotAtAll) {
    EXPECT_EQ(parseNumber("1.5"), 1.5);
    EXPECT_EQ(parseNumber("+2e3"), 2000.0);
    for (const char* bad : {"", "1.5x", " 1", "nan", "inf", "1e999", "--1", "0x10"})
        EXPECT_FALSE(parseNumber(bad)) << bad;
}

TEST(Text, ListsNeedEveryItem) {
    EXPECT_EQ(parseNumbers("1,-2,3.5"), (std::vector<double>{1, -2, 3.5}));
    EXPECT_FALSE(parseNumbers("1,,3"));
    EXPECT_FALSE(parseNumbers("1,2,"));
}

TEST(Text, BytesAreGroupedByThousands) {
    EXPECT_EQ(bytesText(0), "0 bytes (0.0 MiB)");
    EXPECT_EQ(bytesText(134217728), "134,217,728 bytes (128.0 MiB)");
}

TEST(Text, BaseNames) {
    EXPECT_EQ(baseName("/a/b.vdb"), "b.vdb");
    EXPECT_EQ(baseName("-"), "-");
}
