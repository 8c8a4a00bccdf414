// SPDX-License-Identifier: Apache-2.0
// What the room object finds in a scan: padding, body, levels of tissues. With labels of anatomy,
// how many of their voxels the body lacks.
//
//   bench_objects SCAN [LABELS]
#include <cstdio>
#include <exception>
#include <optional>

#include "mesamis/base/stopwatch.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/object/padding.h"
#include "mesamis/object/patient.h"
#include "mesamis/object/tissue_level.h"
#include "mesamis/volume_files/read_volume.h"

namespace {

using namespace mesamis;

double percent(std::size_t part, std::size_t whole) {
  return 100 * static_cast<double>(part) / static_cast<double>(whole);
}

void print_padding(const VolumeView& scan) {
  Stopwatch watch;
  const auto padding = find_padding(scan);
  const double seconds = watch.lap();
  if (padding) {
    std::printf("padding: %g, %.1f %% of the voxels", padding->value,
                percent(padding->voxels, scan.samples.size()));
  } else {
    std::printf("padding: none");
  }
  std::printf(" (%.2f s)\n", seconds);
}

std::optional<Patient> print_patient(const VolumeView& scan) {
  Stopwatch watch;
  auto patient = find_patient(scan);
  std::printf("body: %s (%.2f s)\n", patient ? "found" : "none", watch.lap());
  if (!patient) return patient;
  std::printf("  %.0f cm3 on a grain of %.2g mm\n", patient->mm3 / 1000, patient->grain);
  for (const Surroundings& thing : patient->removed) {
    std::printf("  without %s: %.1f cm3\n", thing.what.c_str(), thing.mm3 / 1000);
  }
  return patient;
}

void print_missing(const VolumeView& scan, const Patient& patient, const char* labels) {
  const LabelMap map = read_label_map(labels).map;
  const auto anatomy = mask_on(map, map.segments, scan);
  std::size_t missing = 0;
  for (std::size_t n = 0; n < anatomy.size(); ++n) {
    missing += anatomy[n] != 0 && patient.mask[n] == 0;
  }
  std::printf("  lacks %zu of %zu labelled voxels\n", missing, count_marked(anatomy));
}

void print_level(const char* where, const VolumeView& scan, const Tissue& tissue) {
  const TissueLevel found = find_tissue_level(scan, tissue);
  std::printf("%s of the %s: %.0f%s\n", tissue.name.c_str(), where, found.level,
              found.bounded     ? ", the end of its range"
              : !found.measured ? ", not measured"
                                : "");
}

void print_levels(const VolumeView& scan) {
  const bool in_hounsfield = is_hounsfield(scan);
  for (const Tissue& tissue : tissue_table()) {
    if (in_hounsfield || !tissue.hounsfield) print_level("whole", scan, tissue);
  }
  if (!in_hounsfield || scan.size[2] < 4) return;
  const Tissue bone = parse_tissue("bone");
  CropRange lower, upper;
  lower.end = scan.size;
  lower.end[2] = upper.begin[2] = scan.size[2] / 2;
  print_level("lower half", crop(scan, lower), bone);
  print_level("upper half", crop(scan, upper), bone);
  print_level("stride 2,2,1", subsample(scan, {2, 2, 1}), bone);
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2 || count > 3) {
    std::fprintf(stderr, "usage: bench_objects SCAN [LABELS]\n");
    return 2;
  }
  try {
    const Volume scan = read_volume(arguments[1]).volume;
    print_padding(scan);
    const auto patient = print_patient(scan);
    if (patient && count == 3) print_missing(scan, *patient, arguments[2]);
    print_levels(scan);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "bench_objects: %s\n", failure.what());
    return 3;
  }
}
