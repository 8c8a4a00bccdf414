// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/write_volume.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "mesamis/files/atomic_file.h"
#include "mesamis/files/deflate.h"
#include "mesamis/files/refuse.h"
#include "mesamis/scan_files/nrrd_header.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

std::string short_bytes(const fs::path& path, const Volume& volume) {
  using Limits = std::numeric_limits<std::int16_t>;
  std::string bytes;
  bytes.reserve(volume.samples.size() * sizeof(std::int16_t));
  for (const float sample : volume.samples) {
    const float rounded = std::round(sample);
    if (!(rounded >= float{Limits::lowest()} && rounded <= float{Limits::max()})) {
      detail::refuse(path, "cannot be written: expected samples that fit into 16 bits, found " +
                               std::to_string(sample));
    }
    const auto value = static_cast<std::int16_t>(rounded);
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  }
  return bytes;
}

std::string sample_bytes(const fs::path& path, const Volume& volume, SampleType type) {
  if (type == SampleType::kShort) return short_bytes(path, volume);
  std::string bytes(volume.samples.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), volume.samples.data(), bytes.size());
  return bytes;
}

}  // namespace

void write_nrrd(const fs::path& path, const Volume& volume, const NrrdOptions& options) {
  if (path.extension() != ".nrrd" && path.extension() != ".NRRD") {
    detail::refuse(path, "cannot be written: expected a name that ends with .nrrd");
  }
  if (volume.samples.size() != volume.voxel_count()) {
    detail::refuse(path, "cannot be written: expected " + std::to_string(volume.voxel_count()) +
                             " samples, found " + std::to_string(volume.samples.size()));
  }
  std::string bytes = sample_bytes(path, volume, options.type);
  if (options.gzip) bytes = detail::gzipped(path, bytes);
  const char* type = options.type == SampleType::kFloat ? "float" : "int16";
  write_file(path, detail::nrrd_header(volume, {.type = type, .gzip = options.gzip}) + bytes);
}

}  // namespace mesamis
