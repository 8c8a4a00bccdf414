// SPDX-License-Identifier: Apache-2.0
// Example 3: the whole method on a ball made on the spot; its surface, its mesh and what it used.
//
//   ex3_segment [SURFACE.stl [MESH.vtu]]
#include <mesamis/mesamis.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <random>
#include <utility>

using namespace mesamis;

int main(int count, char** arguments) try {
  // 1. A scan: a bright ball of 9 mm on a dark ground, 1 mm voxels, with noise.
  Volume volume;
  volume.size = {32, 32, 32};
  volume.spacing = {1, 1, 1};
  volume.samples.resize(32 * 32 * 32);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 20);
  for (std::size_t i = 0; i < volume.samples.size(); ++i) {
    const Vec3 from_centre{static_cast<double>(i % 32) - 15.5,
                           static_cast<double>(i / 32 % 32) - 15.5,
                           static_cast<double>(i / 1024) - 15.5};
    volume.samples[i] = static_cast<float>((norm(from_centre) < 9 ? 1000 : 0) + noise(random));
  }

  // 2. The run. Everything it depends on is in the settings; the progress may stop it.
  Request request;
  request.scan = std::move(volume);
  request.settings.max_tets = 20000;
  Listener listener;
  listener.progress = [](std::string_view stage, double done) {
    if (done == 0) std::printf("%.*s\n", static_cast<int>(stage.size()), stage.data());
    return true;
  };
  const Outcome outcome = segment(std::move(request), listener);

  // 3. What came out: the adapted mesh with its fields, the surface, and what was chosen.
  if (const auto mesh = outcome.mesh()) {
    std::printf("%zu cells, grey value %.1f at the first node\n", mesh->mesh.cells.size(),
                mesh->u[0]);
  }
  const OutcomeObject object = outcome.objects().front();
  std::printf("level %.4g, %zu triangles, closed: %s, volume %.0f mm3 (the ball: %.0f)\n",
              *outcome.settings_used().level, object.surface.triangles.size(),
              object.check.closed() ? "yes" : "no", object.check.volume,
              4.0 / 3 * 3.141592653589793 * 9 * 9 * 9);

  // 4. Files, which appear together or not at all, in LPS mm.
  Outputs outputs;
  if (count > 1) outputs.surfaces = {arguments[1]};
  if (count > 2) outputs.meshes = {arguments[2]};
  write(outcome, outputs);
} catch (const std::exception& error) {
  std::fprintf(stderr, "ex3_segment: %s\n", error.what());
  return 1;
}
