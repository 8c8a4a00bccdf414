// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mesamis/volume_files/read_volume.h"
#include "support/read_scan.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"

namespace mesamis {

/// The pages of the ramp that read_scan.h expects.
inline std::vector<TiffPage> five_pages() {
  std::vector<TiffPage> pages(5);
  for (std::size_t k = 0; k < 5; ++k) {
    pages[k].pixels = bytes_of_all(ramp<std::int16_t>(12, -40 + 12 * static_cast<int>(k)));
  }
  return pages;
}

/// A stack of five pages with a description, and how long their pixels are.
inline VolumeFile described(const TempFolder& folder, const std::string& text,
                            const ReadOptions& options = {}) {
  auto pages = five_pages();
  pages[0].description = text;
  write_bytes(folder / "a.tif", tiff_bytes(pages));
  return read_volume(folder / "a.tif", options);
}

}  // namespace mesamis
