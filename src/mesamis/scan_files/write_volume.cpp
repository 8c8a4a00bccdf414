// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/write_volume.h"

#include <zlib.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>

#include "mesamis/files/atomic_file.h"
#include "mesamis/files/refuse.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

std::string tuple(const Vec3& v) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  text << '(' << v.x << ',' << v.y << ',' << v.z << ')';
  return text.str();
}

std::string header_of(const Volume& volume, const NrrdOptions& options) {
  const Mat3 axes = transpose(volume.direction);
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "NRRD0004\ntype: " << (options.type == SampleType::kFloat ? "float" : "int16")
       << "\ndimension: 3\nspace: left-posterior-superior\nsizes: " << volume.size[0] << ' '
       << volume.size[1] << ' ' << volume.size[2] << "\nspace directions:";
  for (int a = 0; a < 3; ++a) {
    text << ' ' << tuple(volume.spacing[a] * axes.rows[static_cast<std::size_t>(a)]);
  }
  text << "\nkinds: domain domain domain\nspace units: \"mm\" \"mm\" \"mm\"\nspace origin: "
       << tuple(volume.origin)
       << "\nendian: " << (std::endian::native == std::endian::little ? "little" : "big")
       << "\nencoding: " << (options.gzip ? "gzip" : "raw") << "\n\n";
  return text.str();
}

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

std::string gzipped(const fs::path& path, std::string bytes) {
  constexpr int kGzipWindow = 15 + 16, kFast = 1, kMemory = 8;
  constexpr std::size_t kAtOnce = std::size_t{1} << 30;  // zlib counts in 32 bits
  z_stream stream{};
  if (deflateInit2(&stream, kFast, Z_DEFLATED, kGzipWindow, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
    detail::refuse(path, "cannot be written: zlib could not be started");
  }
  std::string packed, part(std::size_t{1} << 20, '\0');
  std::size_t begin = 0;
  int status = Z_OK;
  do {
    if (stream.avail_in == 0) {
      const std::size_t count = std::min(kAtOnce, bytes.size() - begin);
      stream.next_in = reinterpret_cast<Bytef*>(bytes.data() + begin);
      stream.avail_in = static_cast<uInt>(count);
      begin += count;
    }
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    status = deflate(&stream, begin == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    packed.append(part, 0, part.size() - stream.avail_out);
  } while (status == Z_OK);
  deflateEnd(&stream);
  return packed;
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
  if (options.gzip) bytes = gzipped(path, std::move(bytes));
  write_file(path, header_of(volume, options) + bytes);
}

}  // namespace mesamis
