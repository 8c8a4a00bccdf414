// SPDX-License-Identifier: Apache-2.0
// Example 2: read a scan, print its facts, draw its middle slice.
//
//   ex2_volume SCAN [OUT.png]
#include <mesamis/mesamis.h>

#include <algorithm>
#include <cstdio>
#include <exception>

using namespace mesamis;

int main(int count, char** arguments) try {
  if (count < 2) {
    std::fprintf(stderr, "ex2_volume: expected a scan: .nii .nrrd .mha .tif or a DICOM folder\n");
    return 2;
  }
  // 1. Read. Anything that cannot be trusted throws an InputError that says why.
  const VolumeFile file = read_volume(arguments[1]);
  const Volume& volume = file.volume;
  for (const auto& warning : file.warnings) std::printf("note: %s\n", warning.c_str());

  // 2. The grid: voxels, spacing, and where it lies in the patient (LPS, mm).
  std::printf("%s: %d x %d x %d voxels of %g x %g x %g mm\n", file.format.c_str(), volume.size[0],
              volume.size[1], volume.size[2], volume.spacing.x, volume.spacing.y, volume.spacing.z);
  const Vec3 first = volume.to_world({0, 0, 0}), last = volume.to_world(volume.box().hi);
  std::printf("from (%g, %g, %g) to (%g, %g, %g) mm\n", first.x, first.y, first.z, last.x, last.y,
              last.z);

  // 3. The samples, in native units.
  const auto [low, high] = std::minmax_element(volume.samples.begin(), volume.samples.end());
  std::printf("values from %g to %g\n", *low, *high);

  // 4. The coronal slice through the middle, as a radiologist would look at it.
  PictureOptions options;
  options.clip = Clip{1, volume.to_world(0.5 * volume.box().hi).y};
  draw_slice(count > 2 ? arguments[2] : "slice.png", volume, nullptr, options);
} catch (const std::exception& error) {
  std::fprintf(stderr, "ex2_volume: %s\n", error.what());
  return 1;
}
