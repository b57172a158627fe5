// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace orbslam {

/// A folder of its own for one test, gone when the test ends.
class TempDir {
 public:
  TempDir() {
    std::string name = testing::TempDir() + "/orbslam_XXXXXX";
    EXPECT_NE(::mkdtemp(name.data()), nullptr);
    path_ = name;
  }
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;
  ~TempDir() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::string Path(const std::string& name) const { return (path_ / name).string(); }

  /// Writes a file and returns its path. A new one each time: ext4 waits for the disk when one is overwritten.
  std::string Write(const std::string& name, std::string_view content) const {
    std::filesystem::remove(Path(name));
    std::ofstream(Path(name), std::ios::binary) << content;
    return Path(name);
  }

  int NumFiles() const {
    const auto files = std::filesystem::directory_iterator(path_);
    return static_cast<int>(std::distance(begin(files), end(files)));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace orbslam
