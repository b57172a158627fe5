// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "util/temp_dir.h"

namespace orbslam {
namespace {

using testing::HasSubstr;

/// Lets no file grow beyond some bytes, as a full disk does, until the end of the scope.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t max_bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{max_bytes, old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int);
};

TEST(File, WhatIsWrittenIsRead) {
  const TempDir dir;
  for (const size_t size : {0, 1, 4096, 1000000}) {
    std::string content(size, 'x');
    if (size > 1) content[size / 2] = '\0';
    ASSERT_TRUE(WriteFileAtomically(dir.Path("file"), content).ok());
    EXPECT_EQ(*ReadFile(dir.Path("file")), content);
  }
  EXPECT_EQ(dir.NumFiles(), 1);
}

TEST(File, AFullDiskLeavesTheOldFileAndNoRest) {
  const TempDir dir;
  const std::string path = dir.Write("file", "old");
  {
    const SmallDisk disk(1000);
    const Status status = WriteFileAtomically(path, std::string(5000, 'x'));
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().message, HasSubstr(path + ": cannot write"));
  }
  EXPECT_EQ(*ReadFile(path), "old");
  EXPECT_EQ(dir.NumFiles(), 1);
}

TEST(File, DevicesAndLinksStayWhatTheyAre) {
  const TempDir dir;
  EXPECT_TRUE(WriteFileAtomically("/dev/null", "text").ok());
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_THAT(WriteFileAtomically("/dev/full", "text").error().message, HasSubstr("No space left"));

  std::filesystem::create_symlink(dir.Write("file", "old"), dir.Path("link"));
  EXPECT_TRUE(WriteFileAtomically(dir.Path("link"), "new").ok());
  EXPECT_TRUE(std::filesystem::is_symlink(dir.Path("link")));
  EXPECT_EQ(*ReadFile(dir.Path("file")), "new");
}

TEST(File, WhatCannotBeReadOrWrittenIsNamed) {
  const TempDir dir;
  EXPECT_THAT(ReadFile(dir.Path("none")).error().message, HasSubstr("none: cannot open: No such file"));
  EXPECT_THAT(ReadFile(dir.Path("")).error().message, HasSubstr("Is a directory"));
  EXPECT_THAT(ReadFile("/dev/zero", 1000).error().message, HasSubstr("/dev/zero: larger than 1000 bytes"));
  EXPECT_THAT(WriteFileAtomically(dir.Path("none/file"), "").error().message,
              HasSubstr("none/file: cannot write"));
  EXPECT_THAT(WriteFileAtomically(dir.Path(""), "").error().message, HasSubstr("Is a directory"));
}

TEST(File, PermissionsAreKept) {
  if (geteuid() == 0) GTEST_SKIP() << "the superuser may read and write everything";
  const TempDir dir;
  const std::string path = dir.Write("file", "old");
  ASSERT_EQ(chmod(path.c_str(), 0), 0);
  EXPECT_THAT(ReadFile(path).error().message, HasSubstr("Permission denied"));
  EXPECT_THAT(WriteFileAtomically(path, "new").error().message, HasSubstr("Permission denied"));
}

}  // namespace
}  // namespace orbslam
