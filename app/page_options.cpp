// SPDX-License-Identifier: Apache-2.0
#include "page_options.h"

#include <CLI/CLI.hpp>

#include "mesamis/base/error.h"
#include "mesamis/files/sha256.h"
#include "outputs.h"
#include "scan.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

void require_picture_folder(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  const fs::path parent = (whole.has_filename() ? whole : whole.parent_path()).parent_path();
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw InputError(folder.string() + ": expected a folder for --pictures, found a file");
  }
  if (!fs::is_directory(parent)) {
    throw InputError(folder.string() + ": there is no folder " + parent.string());
  }
}

}  // namespace

void add_page_options(CLI::App& command, PageFiles& a) {
  command.add_option("--html", a.html,
                     "Page of the run for a browser, one file that needs no network: .html");
  command
      .add_option("--pictures", a.pictures,
                  "Folder for pictures (PNG) of the surface, of slices and of the mesh")
      ->type_name("DIR");
  command.add_flag("--html-names", a.names,
                   "Show paths and file names in the page, which may name the patient");
}

void require_page(const PageFiles& a) {
  if (!a.html.empty()) require_output(a.html, {".html", ".htm"}, "--html");
  if (a.names && a.html.empty()) {
    throw CLI::ValidationError("--html-names", "expected --html for it, found none");
  }
  if (a.pictures.empty()) return;
  require_picture_folder(a.pictures);
  if (!fs::is_directory(a.pictures)) return;
  for (const fs::path& path : page_outputs({{}, a.pictures})) require_writable(path);
}

std::optional<Volume> read_shown_scan(const ScanToShow& scan) {
  if (scan.path.empty()) return {};
  VolumeFile file = read_any_volume(scan.path, scan.read);
  if (!scan.sha256.empty() && sha256(file.files) != scan.sha256) {
    throw InputError(scan.path.string() +
                     ": expected the scan of the run, found another one: its sha256 differs");
  }
  return std::move(file.volume);
}

}  // namespace mesamis
