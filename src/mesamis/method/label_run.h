// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/image/label_map.h"
#include "mesamis/method/label_surfaces.h"
#include "mesamis/method/passes.h"
#include "mesamis/method/settings.h"
#include "mesamis/surface/partition.h"

/// What the steps from a label map to surfaces hand on.
namespace mesamis::detail::method {

/// What the steps of a run on labels know.
struct LabelRun {
  const LabelRequest& request;
  const ImageSettings& of_image;
  const Settings& settings;
  const Progress& progress;
  std::vector<Segment> chosen;
  double margin = 0;  ///< mm

  LabelRun(const LabelRequest& asked, const ImageSettings& how, const Progress& tell)
      : request(asked),
        of_image(how),
        settings(how.asked),
        progress(tell),
        chosen(asked.chosen.empty() ? asked.map.segments : asked.chosen) {
    require_chosen(chosen, asked.map);
  }
  /// Whether boundaries in an image of these voxels start from the labels; else labels flow.
  bool starts_from_labels(const VoxelGrid& scan) const {
    return method::starts_from_labels(settings, scan, request.map);
  }
  bool makes_mesh() const { return request.mesh && !settings.preview; }
  /// Whether boundaries are smoothed where they are extracted.
  bool smooths() const { return settings.fit && request.probabilities == nullptr; }
  void begin(const char* stage) const { begin_stage(progress, stage); }
};

/// The boundaries of the chosen objects of a layer, which have not been decimated.
struct LayerBoundaries {
  Index layer = 0;
  PartitionSurface partition;     ///< world frame, mm; material 0 is whatever is not chosen
  std::vector<double> volumes{};  ///< of the voxels of each label, mm^3; empty: they have flowed
  std::vector<LabelBoundary> boundaries{};
  std::vector<char> placed{};     ///< of each label: not 0 where the image placed a boundary of it
  std::optional<Volume> image{};  ///< label_image(), for the mesh
  bool converged = true;
};

}  // namespace mesamis::detail::method
