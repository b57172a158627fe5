// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

namespace orbslam {

/// All files named like PNG or JPEG below the folders, folder by folder, sorted within each.
inline std::vector<std::string> FindPictures(const std::vector<std::string>& folders) {
  namespace fs = std::filesystem;
  const std::set<std::string> extensions{".png", ".jpg", ".jpeg"};
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    const auto first_of_folder = static_cast<std::ptrdiff_t>(files.size());
    std::error_code unreadable_ends_the_walk;
    for (fs::recursive_directory_iterator it(folder, unreadable_ends_the_walk), end; it != end;
         it.increment(unreadable_ends_the_walk)) {
      std::string extension = it->path().extension().string();
      std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
      if (extensions.contains(extension) && it->is_regular_file()) files.push_back(it->path().string());
    }
    std::sort(files.begin() + first_of_folder, files.end());
  }
  return files;
}

}  // namespace orbslam
