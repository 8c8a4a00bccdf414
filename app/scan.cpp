// SPDX-License-Identifier: Apache-2.0
#include "scan.h"

#include <algorithm>
#include <string>

#include "arguments.h"
#include "log.h"
#include "mesamis/base/error.h"

namespace mesamis {

void add_read_options(CLI::App& command, ReadOptions& options) {
  command.add_option("--series", options.series, "DICOM series UID");
  command.add_option_function<std::string>(
      "--raw",
      [&options](const std::string& text) {
        options.raw = parsed("--raw", [&] { return parse_raw_layout(text); });
      },
      "NX,NY,NZ,TYPE[,HEADERBYTES]: the input is a raw file; TYPE uint8 int16 uint16 int32 float32 "
      "float64, with be behind it if big endian");
  command.add_option_function<std::string>(
      "--spacing",
      [&options](const std::string& text) {
        const auto mm = parse_numbers(text, 3, "--spacing");
        if (std::any_of(mm.begin(), mm.end(), [](double x) { return !(x > 0); })) {
          throw CLI::ValidationError("--spacing", "expected numbers above 0, found '" + text + "'");
        }
        options.spacing = Vec3{mm[0], mm[1], mm[2]};
      },
      "X,Y,Z: distance of voxels, mm, for raw files, slices and whatever does not state it");
  command.add_flag("--resample", options.resample,
                   "Interpolate DICOM slices of a tilted gantry or at uneven distances onto a "
                   "regular grid, instead of refusing them");
}

VolumeFile read_scan(const std::filesystem::path& path, const ReadOptions& options) {
  VolumeFile file = read_volume(path, options);
  for (const std::string& warning : file.warnings) log_warning(warning);
  try {
    require_usable(file.volume);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  return file;
}

}  // namespace mesamis
