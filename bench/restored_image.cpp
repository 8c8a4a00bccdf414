// SPDX-License-Identifier: Apache-2.0
// The image that segment works on: restored, with default settings, in native units.
//
//   bench_restored_image SCAN OUT.nrrd
#include <cstdio>
#include <exception>

#include "mesamis/method/prepare.h"
#include "mesamis/volume_files/read_volume.h"
#include "mesamis/volume_files/write_volume.h"

int main(int count, char** arguments) {
  using namespace mesamis;
  if (count != 3) {
    std::fprintf(stderr, "usage: bench_restored_image SCAN OUT.nrrd\n");
    return 2;
  }
  try {
    Prepared prepared = prepare_image(read_volume(arguments[1]).volume, {});
    for (float& sample : prepared.grey.samples) {
      sample = static_cast<float>(prepared.parameters.grey.to_native(sample));
    }
    write_nrrd(arguments[2], prepared.grey);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "bench_restored_image: %s\n", failure.what());
    return 3;
  }
}
