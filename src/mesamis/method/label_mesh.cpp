// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/label_mesh.h"

#include <deque>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/method/loop.h"
#include "mesamis/method/passes.h"
#include "mesamis/method/prepare.h"

namespace mesamis::detail::method {
namespace {

/// A label image as the loop works on it: numbers that differ by one are apart by a contrast.
/// @param contrast  grey values.
Prepared prepare_labels(const Volume& labels, const Prepared& image, double contrast) {
  Prepared prepared{image.parameters, image.measured, labels, {}};
  parallel_for(prepared.grey.samples.size(),
               [&](std::size_t n) { prepared.grey.samples[n] *= static_cast<float>(contrast); });
  prepared.image = interpolating_spline(prepared.grey);
  return prepared;
}

}  // namespace

Result mesh_beside_labels(const VolumeView& image, std::span<const Volume> labels,
                          const ImageSettings& settings, const Progress& progress) {
  Stopwatch watch;
  Result result;
  begin_stage(progress, "preparation");
  const Prepared prepared = prepare_image(image, settings);
  RunInput run(prepared);
  std::deque<Prepared> others;
  std::deque<RunInput> inputs;  // refer to those, which therefore must stay where they are
  for (const Volume& one : labels) {
    if (one.size != image.size) throw InputError("label image: expected the grid of the image");
    others.push_back(prepare_labels(one, prepared, run.error.contrast));
    run.beside.push_back(&inputs.emplace_back(others.back()));
  }
  result.parameters = prepared.parameters;
  result.image = prepared.measured;
  result.seconds.prepare = watch.lap();
  deliver_mesh(run, run_loop(run, progress), result);
  result.seconds.total = result.seconds.prepare + watch.lap();
  return result;
}

}  // namespace mesamis::detail::method
