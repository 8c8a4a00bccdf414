// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace mesamis {

class OutputSet;
struct RunPage;

/// Where a page and pictures go.
struct PageFiles {
  std::filesystem::path html{};      ///< empty: no page
  std::filesystem::path pictures{};  ///< a folder, which is made; empty: no pictures
  bool names = false;                ///< show paths and file names, which may name the patient

  /// Whether there is anything to write.
  bool given() const { return !html.empty() || !pictures.empty(); }
};

/// The files that write_page() may write. O(1) time and memory.
std::vector<std::filesystem::path> page_outputs(const PageFiles& files);

/// Writes the page and the pictures that are asked for into a set.
/// @throws InputError  as run_page() and run_pictures(), or if a file cannot be written. Cost as
///                     there.
void write_page(const PageFiles& files, const RunPage& page, OutputSet& set);

}  // namespace mesamis
