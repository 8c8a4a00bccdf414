// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mesamis/page/page_files.h"
#include "mesamis/volume_files/read_volume.h"

namespace CLI {
class App;
}  // namespace CLI

/// A run as a page and as pictures: what `segment` and `report` share.
namespace mesamis {

/// Adds the options. `arguments` must outlive the parsing.
void add_page_options(CLI::App& command, PageFiles& arguments);

/// Checks before any work that page and pictures can be written.
/// @throws CLI::ValidationError, InputError  as require_output().
void require_page(const PageFiles& arguments);

/// A scan to be shown.
struct ScanToShow {
  std::filesystem::path path;  ///< empty: none
  ReadOptions read{};
  std::string sha256{};  ///< of the scan of the run; empty: not known
};

/// Reads a scan again, to be shown as it is in its file.
/// @return nothing where there is no path.
/// @throws InputError  as read_volume(), or if it is not the scan of the run.
std::optional<Volume> read_shown_scan(const ScanToShow& scan);

}  // namespace mesamis
