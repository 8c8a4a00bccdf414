// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/page/run_page.h"
#include "mesamis/scan_files/read_volume.h"
#include "outputs.h"

namespace CLI {
class App;
}  // namespace CLI

/// A run as a page and as pictures: what `segment` and `report` share.
namespace mesamis {

struct PageArguments {
  std::filesystem::path html;      ///< --html; may be empty
  std::filesystem::path pictures;  ///< --pictures, a folder; may be empty
  bool names = false;              ///< --html-names

  bool given() const { return !html.empty() || !pictures.empty(); }
};

/// Adds the options. `arguments` must outlive the parsing.
void add_page_options(CLI::App& command, PageArguments& arguments);

/// Checks before any work that page and pictures can be written.
/// @throws CLI::ValidationError, InputError  as require_output().
void require_page(const PageArguments& arguments);

/// The files that write_page() may write.
Paths page_outputs(const PageArguments& arguments);

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

/// Writes the page and the pictures that are asked for; into the OutputSet that is open.
/// @throws InputError  as run_page() and write_file().
void write_page(const PageArguments& arguments, const RunPage& page);

}  // namespace mesamis
