// SPDX-License-Identifier: Apache-2.0
// The readers of scans. A volume that is read has a finite grid and a sample for each voxel.
#include <cmath>
#include <cstring>

#include "mesamis/image/label_map.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/volume_files/chunked_scan.h"
#include "mesamis/volume_files/open_slices.h"
#include "mesamis/volume_files/read_volume.h"
#include "reader_targets.h"
#include "support/dicom_bytes.h"
#include "support/picture_bytes.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void require_grid(const VoxelGrid& grid) {
  for (const Index n : grid.size) require_law(n >= 1, "an empty axis");
  const Vec3& s = grid.spacing;
  require_law(is_finite(s) && s.x > 0 && s.y > 0 && s.z > 0, "a spacing that is no length");
  require_law(is_finite(grid.origin), "an origin that is nowhere");
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      const double product = dot(grid.direction.rows[a], grid.direction.rows[b]);
      require_law(std::abs(product - (a == b)) < 1e-6, "axes that are not orthonormal");
    }
  }
}

void require_scan(const VolumeFile& scan) {
  require_grid(scan.volume);
  require_law(scan.volume.samples.size() == scan.volume.voxel_count(), "samples are missing");
  require_law(!scan.format.empty(), "no format");
  for (const std::string& warning : scan.warnings) require_one_line(warning);
}

void list(const fs::path& file, const ReadOptions& options) {
  read_or_refuse(file, [&](const fs::path& path) {
    const auto all = list_volumes(path, options);
    require_law(!all.empty(), "an empty list");
    for (const VolumeInfo& info : all) require_one_line(info.problem);
  });
}

/// The last slice, read alone, has the bits that it has in the whole volume.
void require_slices(const fs::path& path, const ReadOptions& options) {
  const auto slices = open_slices(path, options);
  const VolumeFile whole = read_volume(path, options);
  const VoxelGrid& grid = slices->grid();
  require_law(grid.size == whole.volume.size && grid.spacing == whole.volume.spacing &&
                  grid.origin == whole.volume.origin && slices->head().warnings == whole.warnings,
              "slices of another grid");
  const std::vector<float> last = slices->read(grid.size[2] - 1, 1);
  require_law(last.size() == grid.offset(0, 0, 1), "samples of a slice are missing");
  const float* expected = whole.volume.samples.data() + grid.offset(0, 0, grid.size[2] - 1);
  require_law(std::memcmp(last.data(), expected, last.size() * sizeof(float)) == 0,
              "a slice of other samples");
}

void read_scan(const fs::path& file, ReadOptions options = {}) {
  options.limits = fuzz_limits();
  list(file, options);
  read_or_refuse(file, [&](const fs::path& path) { require_scan(read_volume(path, options)); });
  read_or_refuse(file, [&](const fs::path& path) { require_slices(path, options); });
  options.spacing = Vec3{0.5, 1, 2};
  options.resample = true;
  options.volume = options.channel = 0;
  read_or_refuse(file, [&](const fs::path& path) { require_scan(read_volume(path, options)); });
}

/// Beside the case lie files that it may name as its data.
void with_data_files() {
  static const bool written = [] {
    const std::string data = bytes_of_all(ramp<std::int16_t>(60));
    for (const char* name : {"data.raw", "scan.img", "s1.raw"}) input_folder().write(name, data);
    for (const char* name : {"s2.raw", "s3.raw"}) input_folder().write(name, data.substr(0, 24));
    input_folder().write("data.raw.gz", packed(data));
    return true;
  }();
  static_cast<void>(written);
}

template <const char* kName>
void run_scan(std::string_view bytes) {
  with_data_files();
  read_scan(input_folder().write(kName, bytes));
}

/// Labels have other values than a scan where a picture has a table of colours.
void read_as_labels(const fs::path& file) {
  read_or_refuse(file, [](const fs::path& path) {
    const LabelFile labels = read_label_map(path, {.limits = fuzz_limits()});
    for (const std::string& warning : labels.warnings) require_one_line(warning);
    require_valid(labels.map);
  });
}

template <const char* kName>
void run_picture(std::string_view bytes) {
  const fs::path file = input_folder().write(kName, bytes);
  read_scan(file);
  read_as_labels(file);
}

/// A slice alone is no volume: another one of the same series lies beside it.
void run_dicom(std::string_view bytes) {
  static const fs::path second = [] {
    SliceBytes slice;
    slice.position = {0, 0, 2};
    return input_folder().write("second.dcm", slice.bytes());
  }();
  const fs::path file = input_folder().write("first.dcm", bytes);
  read_scan(file);
  read_or_refuse(file, [](const fs::path& path) {
    require_scan(read_volume(path, {.resample = true, .limits = fuzz_limits()}));
  });
}

/// The layout as text, a line break, the file.
void run_raw(std::string_view bytes) {
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) return;
  ReadOptions options;
  try {
    options.raw = parse_raw_layout(bytes.substr(0, end));
  } catch (const InputError& refusal) {
    return require_one_line(refusal.what());
  }
  read_scan(input_folder().write("scan.raw", bytes.substr(end + 1)), options);
}

/// Checksums that fit: those that do not end the reading before anything else is tried.
std::string with_png_sums(std::string bytes) {
  const auto number = [&bytes](std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i) {
      value = value << 8 | static_cast<unsigned char>(bytes[i]);
    }
    return value;
  };
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t size = number(at);
    if (size > bytes.size() - at - 12) break;
    const auto* checked = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    bytes.replace(at + 8 + size, 4,
                  bytes_of(static_cast<std::uint32_t>(crc32_z(0, checked, size + 4)), true));
    at += size + 12;
  }
  return bytes;
}

void run_png(std::string_view bytes) {
  const fs::path file = input_folder().write("scan.png", with_png_sums(std::string(bytes)));
  read_scan(file);
  read_as_labels(file);
}

constexpr std::size_t kMostVoxels = 100'000;  // each may be a chunk, and a look at the disk

void require_chunks(const ChunkedScan& scan) {
  require_grid(scan.grid());
  for (const std::string& warning : scan.warnings()) require_one_line(warning);
  if (scan.grid().voxel_count() > kMostVoxels) return;
  const std::size_t slice = scan.grid().offset(0, 0, 1);
  const Index last = scan.grid().size[2] - 1;
  require_law(scan.read(last, 1).size() == slice, "samples are missing");
  require_law(scan.read(0, last + 1).size() == scan.grid().voxel_count(), "samples are missing");
  std::size_t visited = 0;
  scan.visit_samples([&](std::span<const double> samples) { visited += samples.size(); });
  require_law(visited == scan.grid().voxel_count(), "samples are not visited");
}

/// Which metadata these are: 2 .zarray, 3 zarr.json, else .zattrs; behind a zero byte the first
/// chunk. Below lies an array that a group may name.
void run_zarr(std::string_view bytes) {
  if (bytes.empty()) return;
  const fs::path store = input_folder().path() / "store";
  fs::remove_all(store);
  fs::create_directories(store / "0");
  input_folder().write("store/0/.zarray",
                       R"({"zarr_format": 2, "shape": [3, 4, 5], "chunks": [3, 4, 5],
                       "dtype": "|u1", "compressor": null, "fill_value": 1, "order": "C"})");
  const std::size_t end = bytes.find('\0');
  const std::string_view metadata = bytes.substr(1, end == bytes.npos ? end : end - 1);
  const bool array = bytes[0] == '2', third = bytes[0] == '3';
  input_folder().write(array   ? "store/.zarray"
                       : third ? "store/zarr.json"
                               : "store/.zattrs",
                       metadata);
  if (!array && !third) input_folder().write("store/.zgroup", R"({"zarr_format": 2})");
  if (end != bytes.npos) {
    const std::string_view chunk = bytes.substr(end + 1);
    fs::create_directories(store / "c/0/0");
    input_folder().write("store/0.0.0", chunk);
    input_folder().write("store/c/0/0/0", chunk);
  }
  read_or_refuse(store, [](const fs::path& path) {
    const auto scan = open_zarr(path, {.limits = fuzz_limits()});
    require_chunks(*scan);
    if (scan->grid().voxel_count() <= kMostVoxels) read_as_labels(path);
  });
}

/// Slices beside a log; a text beside an image.
void run_text_beside(std::string_view bytes) {
  const fs::path folder = input_folder().path() / "beside";
  fs::create_directories(folder);
  for (const char* name : {"beside/a_1.png", "beside/a_2.png", "beside/a_spr.png"}) {
    input_folder().write(name, png_bytes(2, 2, "abcd"));
  }
  input_folder().write("beside/a.log", bytes);
  input_folder().write("beside/b.json", bytes);
  const fs::path image =
      input_folder().write("beside/b.mha", meta_bytes("") + std::string(120, 'x'));
  const ReadOptions options{.limits = fuzz_limits()};
  for (const fs::path& path : {folder, image}) {
    read_or_refuse(path, [&](const fs::path& read) { require_scan(read_volume(read, options)); });
  }
}

/// The matrix beside an image of Analyze.
void run_spm(std::string_view bytes) {
  static const fs::path image = [] {
    NiftiBytes analyze;
    analyze.magic = std::string(4, '\0');
    analyze.vox_offset = 0;
    input_folder().write("spm.img", bytes_of_all(ramp<std::int16_t>(60)));
    return input_folder().write("spm.hdr", analyze.header());
  }();
  input_folder().write("spm.mat", bytes);
  const ReadOptions options{.resample = true, .limits = fuzz_limits()};
  read_or_refuse(image, [&](const fs::path& path) { require_scan(read_volume(path, options)); });
}

constexpr char kNifti[] = "scan.nii", kNrrd[] = "scan.nrrd", kMeta[] = "scan.mha",
               kTiff[] = "scan.tif", kInv3[] = "scan.inv3", kBmp[] = "scan.bmp",
               kPair[] = "scan.hdr", kMgh[] = "scan.mgz", kIsq[] = "scan.isq", kAim[] = "scan.aim",
               kVgi[] = "scan.vgi", kJpeg[] = "scan.jpg";

constexpr FuzzTarget kTargets[] = {
    {"dicom", run_dicom},      {"nifti", run_scan<kNifti>},  {"nrrd", run_scan<kNrrd>},
    {"meta", run_scan<kMeta>}, {"tiff", run_picture<kTiff>}, {"inv3", run_scan<kInv3>},
    {"png", run_png},          {"bmp", run_picture<kBmp>},   {"raw", run_raw},
    {"zarr", run_zarr},        {"hdr", run_scan<kPair>},     {"mgh", run_scan<kMgh>},
    {"isq", run_scan<kIsq>},   {"aim", run_scan<kAim>},      {"vgi", run_scan<kVgi>},
    {"jpeg", run_scan<kJpeg>}, {"beside", run_text_beside},  {"spm", run_spm},
};

}  // namespace

std::span<const FuzzTarget> scan_targets() { return kTargets; }

}  // namespace mesamis
