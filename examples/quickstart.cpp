// SPDX-License-Identifier: Apache-2.0
// Quickstart: from a span of voxels to an STL. The voxels are read where they lie.
//
//   quickstart [SURFACE.stl]
#include <mesamis/mesamis.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

namespace {

/// Stands for your own data: a bright ball of 8 voxels in a dark cube of 24, x fastest.
std::vector<float> make_voxels() {
  std::vector<float> voxels;
  for (int k = 0; k < 24; ++k) {
    for (int j = 0; j < 24; ++j) {
      for (int i = 0; i < 24; ++i) {
        const double r = std::hypot(i - 11.5, j - 11.5, k - 11.5);
        voxels.push_back(r < 8 ? 1000.F : 0.F);
      }
    }
  }
  return voxels;
}

}  // namespace

int main(int count, char** arguments) try {
  const std::vector<float> voxels = make_voxels();

  mesamis::VolumeView scan;
  scan.size = {24, 24, 24};
  scan.spacing = {0.5, 0.5, 0.5};  // mm
  scan.samples = voxels;           // any std::span<const float>

  mesamis::Request request;
  request.scan = scan;
  const mesamis::Outcome outcome = mesamis::segment(request);
  mesamis::write(outcome, {.surfaces = {count > 1 ? arguments[1] : "quickstart.stl"}});

  const mesamis::OutcomeObject object = outcome.objects().front();
  const bool closed = object.check.closed();
  std::printf("%zu triangles, %s\n", object.surface.triangles.size(), closed ? "closed" : "open");
  return closed ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "quickstart: %s\n", error.what());
  return 1;
}
