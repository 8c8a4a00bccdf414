// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/read_volume.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/given_spacing.h"
#include "mesamis/files/in_one_line.h"
#include "mesamis/files/read_record.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/dicom_store.h"
#include "mesamis/volume_files/foreign_format.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/rounding_record.h"
#include "mesamis/volume_files/sheared_grid.h"
#include "mesamis/volume_files/sidecar.h"
#include "mesamis/volume_files/slice_stack.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

/// A format of plain arrays and the ends of its files' names.
struct ArrayFormat {
  std::string_view extension;
  ScanFile (*open)(const fs::path&, const Opening&);
};

constexpr std::array kArrayFormats{
    ArrayFormat{".nii", open_nifti}, ArrayFormat{".nii.gz", open_nifti},
    ArrayFormat{".hdr", open_nifti}, ArrayFormat{".hdr.gz", open_nifti},
    ArrayFormat{".img", open_nifti}, ArrayFormat{".img.gz", open_nifti},
    ArrayFormat{".nrrd", open_nrrd}, ArrayFormat{".nhdr", open_nrrd},
    ArrayFormat{".mha", open_meta},  ArrayFormat{".mhd", open_meta},
    ArrayFormat{".inv3", open_inv3}, ArrayFormat{".mgh", open_mgh},
    ArrayFormat{".mgz", open_mgh},   ArrayFormat{".isq", open_isq},
    ArrayFormat{".aim", open_aim},   ArrayFormat{".vgi", open_vgi},
    ArrayFormat{".vol", open_vgi},
};

/// The name in lower case, without the version that VMS puts behind it: "a.aim;1".
std::string plain_name(const fs::path& file) {
  const std::string name = lower(file.filename().string());
  const auto mark = name.find(';');
  const bool version = mark != std::string::npos &&
                       name.find_first_not_of("0123456789", mark + 1) == std::string::npos;
  return version ? name.substr(0, mark) : name;
}

/// Some programs call DICOM files .img, and much else .vol.
bool needs_header_beside(std::string_view extension) {
  return extension == ".img" || extension == ".img.gz" || extension == ".vol";
}

bool has_header_beside(fs::path file) {
  if (lower_extension(file) == ".gz") file.replace_extension();
  const bool vol = lower_extension(file) == ".vol";
  std::error_code ignored;
  for (const char* extension : {vol ? ".vgi" : ".hdr", vol ? ".VGI" : ".hdr.gz"}) {
    if (fs::is_regular_file(fs::path(file).replace_extension(extension), ignored)) return true;
  }
  return false;
}

const ArrayFormat* array_format_of(const fs::path& file) {
  const std::string name = plain_name(file);
  for (const ArrayFormat& format : kArrayFormats) {
    if (!name.ends_with(format.extension)) continue;
    if (needs_header_beside(format.extension) && !has_header_beside(file)) continue;
    return &format;
  }
  return nullptr;
}

/// Data files whose header is listed itself.
bool is_data_of_header(const fs::path& file) {
  const ArrayFormat* format = array_format_of(file);
  return format != nullptr && needs_header_beside(format->extension);
}

/// A format of pictures.
struct PictureFormat {
  std::string_view extension;
  ScanFile (*open)(const fs::path&, const Opening&);
  VolumeFile (*read)(const fs::path&, const Opening&);
  OpenSlices (*slices)(const fs::path&, const Opening&);
};

/// A picture that holds one slice.
OpenSlices open_one_slice(const fs::path& file, const Opening& opening) {
  return {open_picture(file, opening), read_pictures({file}, opening.choice)};
}

constexpr std::array<PictureFormat, 7> kPictureFormats{
    {{".jpg", open_jpeg, read_jpeg, open_one_slice},
     {".jpeg", open_jpeg, read_jpeg, open_one_slice},
     {".tif", open_tiff_header, read_tiff, open_tiff_slices},
     {".tiff", open_tiff_header, read_tiff, open_tiff_slices},
     {".lsm", open_tiff_header, read_tiff, open_tiff_slices},
     {".png", open_png, read_png, open_one_slice},
     {".bmp", open_bmp, read_bmp, open_one_slice}}};

const PictureFormat* picture_format_of(const fs::path& file) {
  const std::string extension = lower_extension(file);
  for (const PictureFormat& format : kPictureFormats) {
    if (extension == format.extension) return &format;
  }
  return nullptr;
}

bool has_known_extension(const fs::path& file) { return array_format_of(file) || is_picture(file); }

/// Whether a file of a directory is listed: not what a header lists, nor what is hidden.
bool is_listed(const fs::path& file) {
  return has_known_extension(file) && !is_data_of_header(file) &&
         !file.filename().native().starts_with('.');
}

/// A path, and what it is read with.
struct Request {
  const fs::path& path;
  const ReadOptions& options;
  MemoryBudget& budget;

  Opening opening() const { return opening_of(options, budget); }
};

VolumeFile read_sheared(const Request& request, const ScanFile& scan) {
  const auto plan = plan_unsheared(scan.file, scan.grid, *scan.sheared);
  announce(plan.grid, request.options);
  VolumeFile out{{plan.grid, {}}, scan.format, scan.warnings};
  out.warnings.push_back(plan.note);
  const std::vector<float> samples = read_samples(scan, request.budget);
  request.budget.claim(plan.grid.voxel_count(), sizeof(float), "samples between voxels");
  out.volume.samples = unsheared(plan, samples);
  return out;
}

VolumeFile read_array(const Request& request, const ScanFile& scan) {
  if (scan.sheared) return read_sheared(request, scan);
  announce(scan.grid, request.options);
  VolumeFile out{scan.grid, scan.format, scan.warnings};
  out.volume.samples = read_samples(scan, request.budget);
  return out;
}

VolumeFile read_one_picture(const Request& request) {
  const auto& [path, options, budget] = request;
  const ScanFile scan = open_picture(path, request.opening());
  if (scan.grid.size[2] == 1 && (options.volume || options.channel)) {
    refuse(path, "expected a volume, found one slice of each channel: one slice is none");
  }
  announce(scan.grid, options);
  return read_picture(request.path, request.opening());
}

/// A directory without DICOM may hold volumes that are files of their own.
void require_dicom(const fs::path& directory) {
  if (holds_dicom(directory)) return;
  const std::vector<fs::path> here = files_in(directory);
  const auto volume = std::find_if(here.begin(), here.end(), is_listed);
  const std::string contents = contents_of(directory);
  refuse(
      directory,
      message("expected DICOM images, found none", contents == "nothing" ? "" : " but " + contents,
              volume == here.end() ? "" : "; name the file itself, as " + volume->string()));
}

VolumeFile read_directory(const Request& request) {
  const auto& [path, options, budget] = request;
  const std::vector<fs::path> slices = slices_without_dicom(path, budget);
  if (!slices.empty()) return read_slices(path, slices, options, budget);
  require_dicom(path);
  return read_dicom(path, options, budget);
}

VolumeFile read_file(const Request& request) {
  const auto& [path, options, budget] = request;
  if (options.raw) return read_array(request, open_raw(path, *options.raw));
  if (fs::is_directory(path)) return read_directory(request);
  if (const auto scan = open_array(path, request.opening())) {
    return read_array(request, *scan);
  }
  if (is_picture(path)) return read_one_picture(request);
  if (is_zip(path) || looks_like_dicom(path)) {
    return read_dicom(path, options, budget);
  }
  refuse_unknown(path);
}

/// The header of a file with a known name, or of a raw one.
ScanFile open_header(const Request& request) {
  const fs::path& file = request.path;
  if (request.options.raw) return open_raw(file, *request.options.raw);
  return is_picture(file) ? open_picture(file, request.opening())
                          : *open_array(file, request.opening());
}

VolumeInfo describe(const Request& request) {
  const ScopedFile scope(request.budget, request.path);
  VolumeInfo info;
  info.description = request.path.filename().string();
  try {
    const ScanFile scan = open_header(request);
    info.format = scan.format;
    info.modality = scan.grid.modality;
    info.warnings = scan.warnings;
    set_grid(info, scan.sheared ? plan_unsheared(scan.file, scan.grid, *scan.sheared).grid
                                : static_cast<const VoxelGrid&>(scan.grid));
  } catch (const InputError& error) {
    info.problem = error.what();
  }
  return info;
}

/// DICOM series, or slices, then the other volumes.
std::vector<VolumeInfo> list_directory(const Request& request) {
  const auto& [path, options, budget] = request;
  const std::vector<fs::path> slices = slices_without_dicom(path, budget);
  std::vector<VolumeInfo> all = slices.empty()
                                    ? list_dicom(path, options, budget)
                                    : std::vector{describe_slices(path, slices, request.opening())};
  for (const fs::path& file : files_in(path)) {
    const bool slice = std::find(slices.begin(), slices.end(), file) != slices.end();
    if (is_listed(file) && !slice) all.push_back(describe({file, options, budget}));
  }
  if (all.empty())
    refuse(path, "expected DICOM series, slices or volume files, found " + contents_of(path));
  return all;
}

std::vector<VolumeInfo> list(const Request& request) {
  const auto& [path, options, budget] = request;
  if (fs::is_directory(path) && !options.raw) return list_directory(request);
  if (options.raw || has_known_extension(path)) return {describe(request)};
  if (is_zip(path) || looks_like_dicom(path)) {
    std::vector<VolumeInfo> all = list_dicom(path, options, budget);
    if (all.empty()) refuse(path, "expected DICOM images, found none");
    return all;
  }
  refuse_unknown(path);
}

/// Thrown through a reader that has told the grid: the samples are not wanted.
struct GridFound {
  VoxelGrid grid;
};

}  // namespace

namespace detail::volume_files {

std::optional<ScanFile> open_array(const fs::path& file, const Opening& opening) {
  const ArrayFormat* format = array_format_of(file);
  if (format == nullptr) return std::nullopt;
  ScanFile scan = format->open(file, opening);
  if (scan.grid.modality.empty()) {
    scan.grid.modality = modality_in_sidecar(file, opening.budget, scan.warnings);
  }
  return scan;
}

Opening opening_of(const ReadOptions& options, MemoryBudget& budget) {
  return {budget,           options.limits.allow_outside,     Values::kOne, options.spacing,
          options.resample, {options.volume, options.channel}};
}

bool is_array_file(const fs::path& file) { return array_format_of(file) != nullptr; }

void announce(VoxelGrid grid, const ReadOptions& options) {
  grid.spacing = options.spacing.value_or(grid.spacing);
  if (!options.modality.empty()) grid.modality = options.modality;
  if (options.on_grid) options.on_grid(grid);
}

void refuse_unknown(const fs::path& file) {
  const std::string foreign = foreign_format(file);
  refuse(file,
         "expected .nii .nii.gz .hdr .mgz .nrrd .nhdr .mha .mhd .tif .png .bmp .jpg .inv3 .isq "
         ".aim .vgi, "
         "DICOM, or --raw with the layout of a raw file, found " +
             (foreign.empty() ? "none of them" : foreign));
}

void require_options(const fs::path& path, const ReadOptions& options) {
  if (options.spacing) require_positive_spacing(path, *options.spacing);
  const std::string& modality = options.modality;
  if (modality.empty() || modality == "CT" || modality == "MR" || modality == "other") return;
  refuse(path, "expected the modality CT, MR or other, found " + in_quotes(modality));
}

std::size_t drop_spacing_warnings(std::vector<std::string>& warnings) {
  std::erase_if(warnings, [](const std::string& warning) {
    return warning.find(" is typical of ") != std::string::npos;
  });
  return std::erase_if(warnings, [](const std::string& warning) {
    return warning.find(": 1 mm assumed") != std::string::npos;
  });
}

void apply_spacing(const std::optional<Vec3>& spacing, VoxelGrid& grid,
                   std::vector<std::string>& warnings) {
  if (!spacing) return;
  const std::size_t assumed = drop_spacing_warnings(warnings);
  const Vec3 stated = std::exchange(grid.spacing, *spacing);
  if (assumed == 0 && stated != *spacing) warnings.push_back(spacing_is_replaced(stated));
}

void apply_options(const ReadOptions& options, VolumeFile& file) {
  if (!options.modality.empty()) file.volume.modality = options.modality;
  apply_spacing(options.spacing, file.volume, file.warnings);
}

bool is_picture(const fs::path& file) { return picture_format_of(file) != nullptr; }

VolumeFile read_picture(const fs::path& file, const Opening& opening) {
  return picture_format_of(file)->read(file, opening);
}

void visit_picture(const fs::path& file, const Opening& opening, const VisitSamples& visit) {
  const ScopedFile scope(opening.budget, file);
  const PictureFormat* format = picture_format_of(file);
  if (format->read == read_tiff) return visit_tiff(file, opening, visit);
  const std::vector<float> samples = format->read(file, opening).volume.samples;
  visit(std::vector<double>(samples.begin(), samples.end()));
}

ScanFile open_picture(const fs::path& file, const Opening& opening) {
  const ScopedFile scope(opening.budget, file);
  return picture_format_of(file)->open(file, opening);
}

OpenSlices open_picture_slices(const fs::path& file, const Opening& opening) {
  const ScopedFile scope(opening.budget, file);
  return picture_format_of(file)->slices(file, opening);
}

void set_grid(VolumeInfo& info, const VoxelGrid& grid) {
  info.size = grid.size;
  info.spacing = grid.spacing;
  info.origin = grid.origin;
  info.direction = grid.direction;
}

}  // namespace detail::volume_files

VolumeFile read_volume(const fs::path& path, const ReadOptions& options) {
  MemoryBudget budget(path, options.limits);
  const ReadRecord record;
  const RoundingRecord rounded;
  return in_one_line(path, [&] {
    require_options(path, options);
    VolumeFile file = read_file({path, options, budget});
    rounded.warn(path, file.warnings);
    apply_options(options, file);
    file.files = record.files();
    return file;
  });
}

VoxelGrid read_grid(const fs::path& path, const ReadOptions& options) {
  ReadOptions headers = options;
  headers.on_grid = [](const VoxelGrid& grid) { throw GridFound{grid}; };
  try {
    return read_volume(path, headers).volume;
  } catch (const GridFound& found) {
    return found.grid;
  }
}

std::vector<VolumeInfo> list_volumes(const fs::path& path, const ReadOptions& options) {
  MemoryBudget budget(path, options.limits);
  std::vector<VolumeInfo> all = in_one_line(path, [&] { return list({path, options, budget}); });
  for (VolumeInfo& info : all) {
    info.spacing = options.spacing.value_or(info.spacing);
    if (options.spacing) drop_spacing_warnings(info.warnings);
    if (!options.modality.empty()) info.modality = options.modality;
  }
  return all;
}

}  // namespace mesamis
