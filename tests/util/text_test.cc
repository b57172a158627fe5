// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/text.h"

#include <gmock/gmock.h>

#include <bit>

#include "orbslam/util/random.h"

namespace orbslam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Text, LinesKeepTheirNumbers) {
  const std::vector<TextLine> lines = SplitLines(
      "\xEF\xBB\xBF"
      "a\r\n\nb");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].text, "a");
  EXPECT_EQ(lines[1].text, "");
  EXPECT_EQ(lines[2].text, "b");
  EXPECT_EQ(lines[2].number, 3);
  EXPECT_THAT(SplitLines(""), IsEmpty());
}

TEST(Text, FieldsMayBeSeparatedByMany) {
  EXPECT_THAT(SplitFields(" a,\t b  c "), ElementsAre("a", "b", "c"));
  EXPECT_THAT(SplitFields(" \t,"), IsEmpty());
}

TEST(Text, OnlyWholeFiniteNumbersAreNumbers) {
  for (const char* text :
       {"", " 1", "1 ", "1.5m", "nan", "inf", "-inf", "1e999", "+-1", "0x10", "1,5", "+"}) {
    EXPECT_EQ(ParseDouble(text), std::nullopt) << text;
    EXPECT_EQ(ParseInt(text), std::nullopt) << text;
  }
  EXPECT_EQ(ParseDouble("+1.5e1"), 15.0);
  EXPECT_EQ(ParseInt("-12"), -12);
  EXPECT_EQ(ParseInt("1.0"), std::nullopt);
}

TEST(Text, FormattedNumbersReadBack) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::bit_cast<double>(rng());
    if (value - value != 0) continue;  // not finite
    EXPECT_EQ(ParseDouble(FormatDouble(value)), value);
  }
  EXPECT_EQ(FormatFixed(-0.5, 9), "-0.500000000");
  EXPECT_EQ(FormatFixed(1.7976931348623157e308, 17).size(), 309u + 1 + 17);
}

TEST(Text, EditDistanceIsADistance) {
  const std::vector<std::string> words = {"",          "a",        "Camera.fx", "camera.fx",
                                          "Camera.fy", "Camra.fx", "ThDepth"};
  for (const std::string& a : words) {
    for (const std::string& b : words) {
      EXPECT_EQ(EditDistance(a, b), EditDistance(b, a));
      for (const std::string& c : words)
        EXPECT_LE(EditDistance(a, c), EditDistance(a, b) + EditDistance(b, c));
    }
    EXPECT_EQ(EditDistance(a, a), 0);
    EXPECT_EQ(EditDistance(a, ""), static_cast<int>(a.size()));
  }
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
}

}  // namespace
}  // namespace orbslam
