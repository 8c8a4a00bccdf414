// SPDX-License-Identifier: Apache-2.0
// mesamis info: what is in a file or a directory, one line each.
#include <iostream>
#include <memory>
#include <sstream>

#include "arguments.h"
#include "commands.h"
#include "mesamis/scan_files/read_volume.h"
#include "mesamis/shape_files/file_kind.h"
#include "mesamis/shape_files/surface_files.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

std::string box_text(std::span<const Vec3> points) {
  const Vec3 e = bounding_box(points).extent();
  std::ostringstream text;
  text << e.x << " x " << e.y << " x " << e.z << " mm";
  return text.str();
}

std::string volume_line(const VolumeInfo& info) {
  std::ostringstream line;
  line << (info.description.empty() ? "(no description)" : one_line(info.description)) << "  "
       << info.format;
  if (!info.modality.empty()) line << "  " << one_line(info.modality);
  if (info.size[0] > 0) {
    line << "  " << info.size[0] << " x " << info.size[1] << " x " << info.size[2] << " voxels of "
         << info.spacing.x << " x " << info.spacing.y << " x " << info.spacing.z << " mm";
  }
  if (!info.series.empty()) line << "  series " << one_line(info.series);
  if (!info.problem.empty()) line << "  not usable: " << one_line(info.problem);
  return line.str();
}

std::string surface_line(const fs::path& path) {
  const TriMesh surface = read_surface(path);
  const SurfaceCheck check = check_surface(surface);
  std::ostringstream line;
  line << one_line(path.filename().string()) << "  surface  " << surface.triangles.size()
       << " triangles, " << surface.points.size() << " vertices, " << check.components
       << " components, " << (check.closed() ? "closed" : "open") << ", "
       << (check.manifold() ? "2-manifold" : "not 2-manifold") << ", " << check.volume << " mm^3, "
       << check.area << " mm^2, " << box_text(surface.points);
  return line.str();
}

std::string mesh_line(const fs::path& path) {
  const MeshWithArrays mesh = read_mesh(path);
  std::ostringstream line;
  line << one_line(path.filename().string()) << "  mesh  " << mesh.mesh.cells.size()
       << " tetrahedra, " << mesh.mesh.points.size() << " vertices, " << box_text(mesh.mesh.points);
  const char* separator = ", arrays ";
  for (const auto* arrays : {&mesh.point_arrays, &mesh.cell_arrays}) {
    for (const MeshArray& array : *arrays) {
      line << separator << one_line(array.name);
      separator = " ";
    }
  }
  return line.str();
}

int run_info(const fs::path& input) {
  switch (kind_of(input)) {
    case FileKind::kSurface:
      std::cout << surface_line(input) << "\n";
      break;
    case FileKind::kMesh:
      std::cout << mesh_line(input) << "\n";
      break;
    case FileKind::kVolume:
      for (const VolumeInfo& info : list_volumes(input)) std::cout << volume_line(info) << "\n";
      break;
  }
  return kExitDone;
}

}  // namespace

void add_info_command(CLI::App& app, CommonOptions&, Action& action) {
  auto input = std::make_shared<fs::path>();
  CLI::App* command = app.add_subcommand("info", "List what is in a file or a directory");
  command->add_option("input", *input, "Volume, DICOM directory, surface or mesh")->required();
  command->callback([input, &action] { action = [input] { return run_info(*input); }; });
}

}  // namespace mesamis
