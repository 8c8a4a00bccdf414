// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace mesamis {

namespace detail::files {
class OutputSet;
}
namespace detail::page {
struct RunPage;
}

/// The files of a page and pictures.
struct PageFiles {
  std::filesystem::path html{};      ///< empty: no page
  std::filesystem::path pictures{};  ///< a folder, created if missing; empty: no pictures
  bool names = false;                ///< show paths and file names, which may name the patient

  /// Whether any file is requested.
  bool given() const { return !html.empty() || !pictures.empty(); }
};

/// The files that write_page() may write. O(1) time and memory.
std::vector<std::filesystem::path> page_outputs(const PageFiles& files);

/// Writes the requested page and pictures into a set.
/// @throws InputError  as run_page() and run_pictures(), or if a file cannot be written. Cost as
///                     there.
void write_page(const PageFiles& files, const detail::page::RunPage& page,
                detail::files::OutputSet& set);

}  // namespace mesamis
