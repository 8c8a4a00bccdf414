// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/error.h"
#include "mesamis/page/run_page.h"
#include "mesamis/page/shown_run.h"
#include "mesamis/page/surface_view.h"

namespace mesamis::detail::page {

std::vector<RunPicture> run_pictures(const RunPage& page, int pixels) {
  constexpr int kSmallest = 64, kLargest = 4096;
  if (pixels < kSmallest || pixels > kLargest) {
    throw InputError("pictures: expected 64 to 4096 pixels, found " + std::to_string(pixels));
  }
  const ShownRun run = shown_run(page);
  std::vector<RunPicture> pictures;
  if (!run.surfaces.empty()) {
    for (const std::string& view : surface_views()) {
      pictures.push_back(
          {"surface-" + view + ".png", png_bytes(surface_view(run.surfaces, view, pixels))});
    }
  }
  for (const SliceView& slice : run.slices) {
    pictures.push_back(
        {"slice-" + slice.name + ".png", png_bytes(slice_picture(slice, run.surfaces, pixels))});
  }
  if (run.mesh) pictures.push_back({"mesh-cut.png", png_bytes(cut_picture(run, pixels))});
  return pictures;
}

}  // namespace mesamis::detail::page
