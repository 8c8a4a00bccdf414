// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/base/progress.h"
#include "mesamis/image/volume.h"
#include "mesamis/method/mes_amis.h"

namespace mesamis::detail::method {

/// Makes one mesh that is adapted to the edges of an image and to the boundaries of labels.
///
/// Algorithm 2 runs on the image. For each label image Algorithm 1 is minimised as well, on the
/// grid and on each mesh, with an edge of a label as high as the image's own; the metrics that both
/// ask for are intersected (intersect()), so that cells are fine where either has an edge.
/// @param image     native units.
/// @param labels    label_image()s on the grid of the image.
/// @param settings  of the run on the image; no surface is made.
/// @param progress  optional; stages as mes_amis().
/// @return as mes_amis(), without a surface.
/// @throws InputError  as mes_amis(), or if a label image has another grid.
/// @throws Cancelled   if progress says stop.
///
/// Cost as mes_amis(), times one more than there are label images. The same bits for any number of
/// threads.
Result mesh_beside_labels(const VolumeView& image, std::span<const Volume> labels,
                          const ImageSettings& settings, const Progress& progress = {});

}  // namespace mesamis::detail::method
