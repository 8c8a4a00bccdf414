// SPDX-License-Identifier: Apache-2.0
// mesamis info: what is in a file or a directory, one line each.
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>

#include "arguments.h"
#include "commands.h"
#include "label_lines.h"
#include "label_options.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/label_map.h"
#include "mesamis/image/not_numbers.h"
#include "mesamis/image/orientation.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/shape_files/file_kind.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/volume_files/chunked_scan.h"
#include "mesamis/volume_files/read_volume.h"
#include "scan.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct InfoCommand {
  fs::path input;
  ReadOptions read;
};

std::string box_text(std::span<const Vec3> points) {
  const Vec3 e = bounding_box(points).extent();
  std::ostringstream text;
  text << e.x << " x " << e.y << " x " << e.z << " mm";
  return text.str();
}

/// "  axes LPS, oblique by 3.1 degrees, origin 1 2 3 mm, directions 1 0 0, 0 1 0, 0 0 1 (LPS)"
std::string place_text(const VolumeInfo& info) {
  const GridOrientation grid = orientation_of(info.direction);
  std::ostringstream text;
  text << "  axes " << grid.letters[0] << grid.letters[1] << grid.letters[2];
  constexpr double kAlignedDeg = 0.005;  // rounding of cosines in a file
  if (grid.oblique_deg > kAlignedDeg) text << ", oblique by " << grid.oblique_deg << " degrees";
  const auto vector = [&text](const Vec3& v) { text << v.x << " " << v.y << " " << v.z; };
  text << ", origin ";
  vector(info.origin);
  text << " mm, directions ";
  const Mat3 axes = transpose(info.direction);
  for (std::size_t a = 0; a < 3; ++a) {
    vector(axes.rows[a]);
    text << (a < 2 ? ", " : " (LPS)");
  }
  return text.str();
}

/// What the values of a volume tell where the file does not.
struct ValuesInfo {
  std::string text;     ///< behind the line of the volume
  bool labels = false;  ///< whether they look like labels
};

/// This is the only reason to read them.
/// @throws InputError  also where a value is infinite, or all are NaN.
ValuesInfo values_of(const InfoCommand& command) {
  VolumeFile scan = read_any_volume(command.input, command.read);
  fill_not_numbers(scan.volume.samples);
  const auto [least, most] = sample_range(scan.volume.samples);
  std::ostringstream text;
  if (!std::isfinite(least) || !std::isfinite(most)) {
    text << command.input.string() << ": expected finite samples, found values from " << least
         << " to " << most;
    throw InputError(text.str());
  }
  text << "  values " << least << " to " << most;
  const bool known = least < most;
  const bool labels = known && look_like_labels(scan.volume, scan.volume.samples);
  if (labels) {
    text << ": labels likely (--labels)";
  } else if (known && is_hounsfield(scan.volume)) {
    text << ": CT likely (HU)";
  }
  return {text.str(), labels};
}

std::string volume_line(const VolumeInfo& info) {
  std::ostringstream line;
  line << (info.description.empty() ? "(no description)" : one_line(info.description)) << "  "
       << info.format;
  if (!info.modality.empty()) line << "  " << one_line(info.modality);
  if (info.size[0] > 0) {
    line << "  " << info.size[0] << " x " << info.size[1] << " x " << info.size[2] << " voxels of "
         << info.spacing.x << " x " << info.spacing.y << " x " << info.spacing.z << " mm"
         << place_text(info);
  }
  if (!info.series.empty()) line << "  series " << one_line(info.series);
  if (!info.problem.empty()) line << "  not usable: " << one_line(info.problem);
  return line.str();
}

std::string surface_line(const fs::path& path, const TriMesh& surface) {
  const SurfaceCheck check = check_surface(surface);
  std::ostringstream line;
  line << one_line(path.filename().string()) << "  surface  " << surface.triangles.size()
       << " triangles, " << surface.points.size() << " vertices, " << components_text(check) << ", "
       << (check.closed() ? "closed" : "open") << ", "
       << (check.manifold() ? "2-manifold" : "not 2-manifold") << ", " << check.volume << " mm^3, "
       << check.area << " mm^2, " << box_text(surface.points);
  return line.str();
}

/// A line for a surface, and one for each of its objects if there are several.
void print_surface(const fs::path& path, const ReadLimits& limits) {
  const std::vector<NamedSurface> objects = read_objects(path, limits);
  if (objects.size() == 1) {
    std::cout << surface_line(path, objects[0].surface) << "\n";
    return;
  }
  std::cout << surface_line(path, read_surface(path, limits)) << "\n";
  for (const NamedSurface& object : objects) {
    const SurfaceCheck check = check_surface(object.surface);
    const std::string flaws = flaws_of(check);
    std::cout << "  " << one_line(object.name) << "  label " << object.label << ", "
              << object.surface.triangles.size() << " triangles, " << check.volume << " mm^3, "
              << (flaws.empty() ? "closed" : flaws) << "\n";
  }
}

std::string mesh_line(const fs::path& path, const ReadLimits& limits) {
  const MeshWithArrays mesh = read_mesh(path, limits);
  std::ostringstream line;
  line << one_line(path.filename().string()) << "  mesh  " << mesh.mesh.cells.size()
       << (mesh.quadratic ? " quadratic" : "") << " tetrahedra, " << mesh.mesh.points.size()
       << " vertices, " << box_text(mesh.mesh.points);
  const char* separator = ", arrays ";
  for (const auto* arrays : {&mesh.point_arrays, &mesh.cell_arrays}) {
    for (const MeshArray& array : *arrays) {
      line << separator << one_line(array.name);
      separator = " ";
    }
  }
  return line.str();
}

LabelFile read_labels(const InfoCommand& command) {
  LabelFile file = read_label_map(command.input, read_like(command.read, false));
  for (const std::string& warning : file.warnings) log_warning(warning);
  return file;
}

/// A line for the grid, and one per label.
void print_label_file(const InfoCommand& command) {
  VolumeInfo info;
  info.description = (command.input / "").parent_path().filename().string();
  LabelFile file;
  try {
    file = read_labels(command);
  } catch (const InputError& error) {
    info.format = "labels";
    info.problem = error.what();
    std::cout << volume_line(info) << "\n";
    return;
  }
  info.format = file.format + " labels";
  info.size = file.map.size;
  info.spacing = file.map.spacing;
  info.origin = file.map.origin;
  info.direction = file.map.direction;
  std::cout << volume_line(info) << "\n";
  print_labels(file.map);
}

/// Whether the only file of a folder is a scan: whole grey values would be labels too.
bool is_scan_alone(const InfoCommand& command, const std::vector<VolumeInfo>& all) {
  if (all.size() != 1 || is_zarr(command.input)) return false;
  if (!all[0].modality.empty()) return true;
  try {
    return !values_of({command.input / all[0].description, command.read}).labels;
  } catch (const InputError&) {
    return true;
  }
}

/// The objects of a folder of masks; of any other folder nothing.
void print_masks(const InfoCommand& command, const std::vector<VolumeInfo>& all) {
  if (!is_mask_folder(command.input, command.read.limits) || is_scan_alone(command, all)) return;
  LabelMap map;
  try {
    map = read_labels(command).map;
  } catch (const InputError&) {
    return;  // its files are listed as volumes
  }
  std::cout << "as --labels:\n";
  print_labels(map);
}

/// Whether the values of a volume are read: of one that does not state its modality, in a file,
/// slices or not too many chunks.
bool reads_values(const InfoCommand& command, const VolumeInfo& info) {
  constexpr double kMostVoxels = 1 << 28;  // of chunks, which may be many
  if (!info.modality.empty() || !info.problem.empty()) return false;
  const double voxels = 1.0 * static_cast<double>(info.size[0]) *
                        static_cast<double>(info.size[1]) * static_cast<double>(info.size[2]);
  if (is_zarr(command.input)) return voxels <= kMostVoxels;
  return !fs::is_directory(command.input) || info.format.ends_with(" slices");
}

/// One line per volume, and one per label of a label map; of a volume on its own also the warnings
/// of its headers. One that cannot be read is not usable.
void print_volumes(const InfoCommand& command) {
  std::vector<VolumeInfo> all = list_any_volumes(command.input, command.read);
  const bool masks = fs::is_directory(command.input);
  ValuesInfo values;
  if (all.size() == 1 && reads_values(command, all[0])) {
    try {
      values = values_of(command);
    } catch (const InputError& error) {
      all[0].problem = error.what();
    }
  }
  const bool labels = values.labels && !command.read.raw &&
                      !(masks && is_mask_folder(command.input, command.read.limits));
  if (all.size() == 1 && !labels) {
    for (const std::string& warning : all[0].warnings) log_warning(warning);
  }
  for (const VolumeInfo& info : all) std::cout << volume_line(info) << values.text << "\n";
  if (labels) print_labels(read_labels(command).map);
  if (masks) print_masks(command, all);
}

int run_info(const InfoCommand& command) {
  const fs::path& input = command.input;
  const FileKind kind = command.read.raw ? FileKind::kVolume : kind_of(input);
  if (kind != FileKind::kVolume) require_no_read_options(input, command.read);
  switch (kind) {
    case FileKind::kSurface:
      print_surface(input, command.read.limits);
      break;
    case FileKind::kMesh:
      std::cout << mesh_line(input, command.read.limits) << "\n";
      break;
    case FileKind::kVolume:
      if (!command.read.raw && is_label_file(input, command.read.limits)) {
        print_label_file(command);
      } else {
        print_volumes(command);
      }
      break;
  }
  return kExitDone;
}

}  // namespace

void add_info_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<InfoCommand>();
  CLI::App* command = app.add_subcommand("info", "List what is in a file or a directory");
  command
      ->add_option("input", options->input, "Volume, DICOM directory, label map, surface or mesh")
      ->required();
  add_read_options(*command, options->read);
  command->callback([options, &common, &action] {
    action = [options, &common] {
      options->read.limits = common.limits;
      return run_info(*options);
    };
  });
}

}  // namespace mesamis
