// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace mesamis {

/// The project's files below a folder whose names end in one of the given ways, in name order.
inline std::vector<std::filesystem::path> project_files(const std::filesystem::path& folder,
                                                        const std::set<std::string>& extensions) {
  std::vector<std::filesystem::path> files;
  const auto root = std::filesystem::path(MESAMIS_SOURCE_DIR) / folder;
  if (!std::filesystem::exists(root)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.is_regular_file() && extensions.count(entry.path().extension().string())) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace mesamis
