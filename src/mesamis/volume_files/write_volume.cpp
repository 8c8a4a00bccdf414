// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/write_volume.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/files/atomic_file.h"
#include "mesamis/files/deflate.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/nrrd_header.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

/// Rounded; @throws InputError  if one does not fit.
std::vector<std::int16_t> rounded(const fs::path& path, std::span<const float> samples) {
  using Limits = std::numeric_limits<std::int16_t>;
  std::vector<std::int16_t> shorts(samples.size());
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const float value = std::round(samples[n]);
    if (!(value >= float{Limits::lowest()} && value <= float{Limits::max()})) {
      refuse(path, "cannot be written: expected samples that fit into 16 bits, found " +
                       std::to_string(samples[n]));
    }
    shorts[n] = static_cast<std::int16_t>(value);
  }
  return shorts;
}

template <class Number>
std::string_view bytes_of(std::span<const Number> numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

/// A .nrrd file, written from its begin to its end.
class NrrdFile {
 public:
  NrrdFile(const OutputPath& path, const VoxelGrid& grid, const NrrdOptions& options)
      : path_(path),
        type_(options.type),
        file_(path),
        out_(file_.temporary_path(), std::ios::binary) {
    const char* type = type_ == SampleType::kFloat ? "float" : "int16";
    put(nrrd_header(grid, {.type = type, .gzip = options.gzip}));
    if (options.gzip) packer_.emplace(path);
  }

  void add(std::span<const float> samples) {
    if (type_ == SampleType::kFloat) return add_bytes(bytes_of(samples));
    const std::vector<std::int16_t> shorts = rounded(path_, samples);
    add_bytes(bytes_of(std::span<const std::int16_t>(shorts)));
  }

  void commit() {
    if (packer_) put(packer_->finish());
    out_.close();
    require_written();
    file_.commit();
  }

 private:
  void add_bytes(std::string_view bytes) { packer_ ? put(packer_->add(bytes)) : put(bytes); }

  void put(std::string_view bytes) {
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    require_written();
  }

  void require_written() const {
    if (!out_) refuse(path_, "cannot be written; is the disk full?");
  }

  fs::path path_;
  SampleType type_;
  AtomicFile file_;
  std::ofstream out_;
  std::optional<Deflater> packer_;
};

}  // namespace

void write_nrrd(const OutputPath& path, const Volume& volume, const NrrdOptions& options) {
  if (volume.samples.size() != volume.voxel_count()) {
    refuse(path, "cannot be written: expected " + std::to_string(volume.voxel_count()) +
                     " samples, found " + std::to_string(volume.samples.size()));
  }
  write_nrrd(path, VolumeSlices(volume), options);
}

void write_nrrd(const OutputPath& path, const SliceSource& source, const NrrdOptions& options) {
  if (path.extension() != ".nrrd" && path.extension() != ".NRRD") {
    refuse(path, "cannot be written: expected a name that ends with .nrrd");
  }
  const VoxelGrid& grid = source.grid();
  const Index slab = options.slab > 0 ? options.slab : slab_slices(grid);
  const std::size_t slice = grid.offset(0, 0, 1);
  NrrdFile file(path, grid, options);
  for (Index first = 0; first < grid.size[2]; first += slab) {
    const Index count = std::min(slab, grid.size[2] - first);
    const std::vector<float> samples = source.read(first, count);
    for (std::size_t at = 0; at < samples.size(); at += slice) {
      file.add(std::span(samples).subspan(at, slice));
    }
  }
  file.commit();
}

}  // namespace mesamis::detail::volume_files
