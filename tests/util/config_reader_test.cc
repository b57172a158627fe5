// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/config_reader.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "orbslam/util/config_table.h"
#include "util/temp_dir.h"

namespace orbslam {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr ConfigRange kAny;

ConfigReader Parsed(const std::string& yaml) {
  Result<ConfigReader> reader = ConfigReader::Parse(yaml, "test.yaml");
  EXPECT_TRUE(reader.ok()) << reader.error().message;
  return *std::move(reader);
}

std::string ParseError(const std::string& yaml) {
  const Result<ConfigReader> reader = ConfigReader::Parse(yaml, "test.yaml");
  return reader.ok() ? "" : reader.error().message;
}

/// What is wrong with "key: value" in the third line, for a getter that asks for the key.
template <class Getter>
std::string ValueError(const std::string& value, const Getter& getter) {
  ConfigReader reader = Parsed("%YAML:1.0\n\nkey: " + value + "\n");
  getter(&reader);
  const Status status = reader.Finish();
  return status.ok() ? "" : status.error().message;
}

TEST(ConfigReader, AllDialectsSayTheSame) {
  const std::vector<std::string> dialects = {
      "Camera.fx: 517.3\nCamera.RGB: 1\nname: dog\n",
      "---\nCamera.fx: 517.3\nCamera.RGB: true\nname: \"dog\"\n",
      "%YAML:1.0\n---\nCamera.fx: 517.3 # px\nCamera.RGB: 1\t# flag\nname: 'dog'\t\n",
      "\xEF\xBB\xBF%YAML:1.0\r\nCamera.fx: 5.173e2\r\nCamera.RGB: True\r\nname: dog",
      "%YAML 1.2\n---\nCamera:\n  fx: +517.3\n  RGB: 1\nname: dog\n",
      "{Camera: {fx: 517.3, RGB: 1}, name: dog}",
  };
  for (const std::string& yaml : dialects) {
    ConfigReader reader = Parsed(yaml);
    EXPECT_EQ(reader.GetDouble("Camera.fx", kAny), 517.3) << yaml;
    EXPECT_TRUE(reader.GetBool("Camera.RGB")) << yaml;
    EXPECT_EQ(reader.GetString("name", {"cat", "dog"}), "dog") << yaml;
    EXPECT_TRUE(reader.Finish().ok());
    EXPECT_THAT(reader.Warnings(), IsEmpty());
  }
}

TEST(ConfigReader, WrongValuesAreNamedWithLineAndRange) {
  const auto number = [](ConfigReader* reader) { reader->GetDouble("key", {0, 10, true}); };
  for (const std::string value : {"abc", "nan", ".nan", "inf", "1e999", "0", "-1", "10.5", "1,5", "3 px"}) {
    EXPECT_EQ(ValueError(value, number),
              "test.yaml:3: key: found '" + value + "', expected a number in (0, 10]");
  }
  EXPECT_EQ(ValueError("10", number), "");
  EXPECT_THAT(ValueError("\"5\"", number), HasSubstr("found the text \"5\""));
  EXPECT_THAT(ValueError("", number), HasSubstr("found nothing"));
  EXPECT_THAT(ValueError("[1, 2]", number), HasSubstr("found a list"));
  EXPECT_THAT(ValueError("!!opencv-matrix\n  rows: 1\n  data: [1]", number), HasSubstr("found a matrix"));

  const auto whole = [](ConfigReader* reader) { reader->GetInt("key", {1, 8}); };
  for (const std::string value : {"1.0", "0", "9", "1e1", "x", "99999999999"}) {
    EXPECT_EQ(ValueError(value, whole),
              "test.yaml:3: key: found '" + value + "', expected a whole number in [1, 8]");
  }
  EXPECT_EQ(ValueError("8", whole), "");

  const auto flag = [](ConfigReader* reader) { reader->GetBool("key"); };
  EXPECT_THAT(ValueError("2", flag), HasSubstr("test.yaml:3: key: found '2', expected true, false, 1 or 0"));
  const auto choice = [](ConfigReader* reader) { reader->GetString("key", {"cat", "dog"}); };
  EXPECT_THAT(ValueError("cow", choice),
              HasSubstr("test.yaml:3: key: found 'cow', expected one of cat, dog"));
}

TEST(ConfigReader, AllErrorsAreToldAtOnceAndAMissingKeysMisspellingIsFound) {
  ConfigReader reader = Parsed("a: x\nCamera.Fx: 3\n");
  EXPECT_EQ(reader.GetInt("a", {0, 1}, 7), 7);
  EXPECT_EQ(reader.GetDouble("optional", {0, 1}, 0.5), 0.5);
  reader.GetDouble("Camera.fx", {0, 9});
  EXPECT_EQ(reader.Finish().error().message,
            "test.yaml:1: a: found 'x', expected a whole number in [0, 1]\n"
            "test.yaml: Camera.fx is missing, expected a number in [0, 9] (is 'Camera.Fx' in line 2 meant?)");
}

TEST(ConfigReader, UnknownKeysAreWarnedAbout) {
  ConfigReader reader = Parsed(
      "ThDept: 1\nViewer.Size: 2\nLEFT.D: !!opencv-matrix\n  rows: 1\n  dt: d\n  data: [1, 2]\nzebra: 1\n");
  reader.GetDouble("ThDepth", kAny, 40);
  reader.Ignore("Viewer.");
  EXPECT_TRUE(reader.Finish().ok());
  EXPECT_THAT(reader.Warnings(), ElementsAre("test.yaml:3: unknown key LEFT.D is ignored",
                                             "test.yaml:1: unknown key ThDept is ignored; is ThDepth meant?",
                                             "test.yaml:7: unknown key zebra is ignored"));
}

TEST(ConfigReader, WhatIsNotYamlIsToldWithItsLine) {
  EXPECT_THAT(ParseError("a: 1\n\tb: 2\n"), HasSubstr("test.yaml:2: a tab"));
  EXPECT_THAT(ParseError("a: 1\nb:\t2\n"), HasSubstr("test.yaml:2: a tab"));
  EXPECT_EQ(ParseError("a: \"x\ty\"  # a\ttab\n"), "");
  EXPECT_THAT(ParseError("%YAML:1.0\na: 1\nb:2\n"),
              HasSubstr("test.yaml:3: a blank is missing after the colon of 'b'"));
  EXPECT_THAT(ParseError("a: 1\nb: [1, 2\n"), AllOf(HasSubstr("test.yaml:"), HasSubstr("not valid YAML")));
  EXPECT_THAT(ParseError("a: 1\n\nc: 2\na: 3\n"), HasSubstr("test.yaml:4: a: given before, in line 1"));
  EXPECT_THAT(ParseError("a.b: 1\na:\n  b: 3\n"), HasSubstr("test.yaml:3: a.b: given before"));
  EXPECT_THAT(ParseError("a: 1\n---\nb: 1\n"), HasSubstr("one YAML document is expected"));
  EXPECT_THAT(ParseError("a: 1\n}\nb: 1\n"), HasSubstr("test.yaml:2: "));
  EXPECT_THAT(ParseError(",YAML:1.0\n---\na: 1\n"), HasSubstr("test.yaml"));
  EXPECT_THAT(ParseError("a: &x\n  b: *x\n"), HasSubstr("test.yaml:2: references"));
  EXPECT_THAT(ParseError("just some words\n"), HasSubstr("test.yaml: no settings file"));
  EXPECT_THAT(ParseError("- 1\n- 2\n"), HasSubstr("test.yaml: no settings file"));
  EXPECT_THAT(ParseError("%YAML:1.0\n---\n# only this\n"), HasSubstr("test.yaml: no settings in it"));
  EXPECT_THAT(ParseError(std::string("a: \0", 4)), HasSubstr("test.yaml: not a text file"));
  EXPECT_THAT(ParseError("? [a]\n: 1\n"), HasSubstr("test.yaml:1: a key must be a word"));
}

TEST(ConfigReader, FilesThatCannotBeReadAreNamed) {
  const TempDir dir;
  EXPECT_THAT(ConfigReader::Open(dir.Path("none")).error().message,
              HasSubstr("none: cannot open: No such file"));
  EXPECT_THAT(ConfigReader::Open(dir.Path("")).error().message, HasSubstr("Is a directory"));
  EXPECT_THAT(ConfigReader::Open(dir.Write("empty", "")).error().message,
              HasSubstr("empty: the file is empty"));
  if (geteuid() == 0) GTEST_SKIP() << "the superuser may read everything";
  ASSERT_EQ(chmod(dir.Path("empty").c_str(), 0), 0);
  EXPECT_THAT(ConfigReader::Open(dir.Path("empty")).error().message, HasSubstr("Permission denied"));
}

TEST(ConfigTable, WhatIsWrittenReadsBackEqual) {
  struct Values {
    double ratio = 0.1 + 0.2;
    int count = -7;
    bool flag = true;
    std::string name = "a \"b\" \\c # d";
  } written, read{0, 0, false, ""};
  const auto describe = [](Values* values) {
    return std::vector<ConfigRow>{{"A.ratio", &values->ratio, ConfigRow::kRequired, {0, 1}, "m"},
                                  {"A.count", &values->count, ConfigRow::kRequired},
                                  {"B.flag", &values->flag, ConfigRow::kOptional, {}, "yes or no"},
                                  {"B.name", &values->name}};
  };
  const std::string yaml = WriteConfigRows(describe(&written));
  EXPECT_THAT(yaml, AllOf(HasSubstr("A.ratio: 0.30000000000000004  # m\n"),
                          HasSubstr("\n\nB.flag: 1  # yes or no\n")));
  ConfigReader reader = Parsed(yaml);
  ReadConfigRows(describe(&read), &reader);
  EXPECT_TRUE(reader.Finish().ok());
  EXPECT_THAT(reader.Warnings(), IsEmpty());
  EXPECT_EQ(read.ratio, written.ratio);
  EXPECT_EQ(read.count, written.count);
  EXPECT_EQ(read.flag, written.flag);
  EXPECT_EQ(read.name, written.name);
}

}  // namespace
}  // namespace orbslam
