// SPDX-License-Identifier: Apache-2.0
// The readers of surfaces and meshes: indices are within the points, arrays fit, what must be
// finite is.
#include <algorithm>
#include <cmath>

#include "mesamis/shape_files/file_kind.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "reader_targets.h"
#include "support/zip_bytes.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

template <class Cells>
void require_indices(const Cells& cells, std::size_t points) {
  for (const auto& cell : cells) {
    for (const Index i : cell) {
      require_law(i >= 0 && static_cast<std::size_t>(i) < points, "an index beyond the points");
    }
  }
}

void require_surface(const TriMesh& surface) {
  require_law(!surface.triangles.empty(), "no triangle");
  require_indices(surface.triangles, surface.points.size());
  for (const Vec3& p : surface.points) {
    require_law(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                "a point that is nowhere");
  }
}

void require_objects(const ObjectFile& file) {
  require_law(!file.objects.empty(), "no object");
  std::vector<Index> labels;
  for (const NamedSurface& object : file.objects) {
    require_surface(object.surface);
    require_law(object.label >= 0 && !object.name.empty(), "an object without label or name");
    labels.push_back(object.label);
  }
  std::sort(labels.begin(), labels.end());
  require_law(std::adjacent_find(labels.begin(), labels.end()) == labels.end(), "equal labels");
}

void read_surface_in_all_ways(const fs::path& file) {
  std::size_t points = 0;
  read_or_refuse(file, [&points](const fs::path& path) {
    const SurfaceFile surface = read_surface_file(path, fuzz_limits());
    require_surface(surface.surface);
    points = surface.surface.points.size();
  });
  read_or_refuse(
      file, [](const fs::path& path) { require_objects(read_object_file(path, fuzz_limits())); });
  if (!carries_arrays(file)) return;
  read_or_refuse(file, [points](const fs::path& path) {
    const auto values = read_point_array(path, "distance", fuzz_limits());
    require_law(points == 0 || values.size() == points, "an array of another size");
  });
}

template <const char* kName>
void run_surface(std::string_view bytes) {
  read_surface_in_all_ways(input_folder().write(kName, bytes));
}

/// The surface, and behind a zero byte the materials that it names.
void run_obj(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\0'), bytes.size());
  input_folder().write("shape.mtl", bytes.substr(std::min(end + 1, bytes.size())));
  read_surface_in_all_ways(input_folder().write("shape.obj", bytes.substr(0, end)));
}

void run_mtl(std::string_view bytes) {
  static const fs::path surface = input_folder().write(
      "shape.obj", "mtllib shape.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\no a\nusemtl a\nf 1 2 3\n");
  input_folder().write("shape.mtl", bytes);
  read_or_refuse(surface, [](const fs::path& path) {
    require_objects(read_object_file(path, fuzz_limits()));
  });
}

/// The model alone, in an archive whose sums fit.
void run_threemf_model(std::string_view bytes) {
  read_surface_in_all_ways(input_folder().write(
      "shape.3mf",
      zip_bytes({{"[Content_Types].xml", "<Types/>"},
                 {"_rels/.rels",
                  "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/"
                  "relationships\"><Relationship Id=\"r\" Target=\"/3D/3dmodel.model\" "
                  "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
                  "</Relationships>"},
                 {"3D/3dmodel.model", std::string(bytes)}},
                false)));
}

/// A model and, behind a zero byte, another one that it may name, in an archive whose sums fit.
void run_threemf_parts(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\0'), bytes.size());
  read_surface_in_all_ways(input_folder().write(
      "shape.3mf",
      zip_bytes({{"_rels/.rels",
                  "<Relationships><Relationship Id=\"r\" Target=\"/3D/3dmodel.model\" "
                  "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
                  "</Relationships>"},
                 {"3D/3dmodel.model", std::string(bytes.substr(0, end))},
                 {"3D/a.model", std::string(bytes.substr(std::min(end + 1, bytes.size())))}},
                false)));
}

void require_arrays(const std::vector<MeshArray>& arrays, std::size_t count) {
  for (const MeshArray& array : arrays) {
    require_law(array.components >= 1 &&
                    array.values.size() == count * static_cast<std::size_t>(array.components),
                "an array of another size");
  }
}

template <const char* kName>
void run_mesh(std::string_view bytes) {
  read_or_refuse(input_folder().write(kName, bytes), [](const fs::path& path) {
    const MeshWithArrays mesh = read_mesh(path, fuzz_limits());
    require_indices(mesh.mesh.cells, mesh.mesh.points.size());
    require_arrays(mesh.point_arrays, mesh.mesh.points.size());
    require_arrays(mesh.cell_arrays, mesh.mesh.cells.size());
  });
}

void run_sol(std::string_view bytes) {
  read_or_refuse(input_folder().write("metric.sol", bytes),
                 [](const fs::path& path) { read_medit_metric(path, fuzz_limits()); });
}

constexpr char kStl[] = "shape.stl", kPly[] = "shape.ply", kVtp[] = "shape.vtp",
               kVtk[] = "shape.vtk", kThreemf[] = "shape.3mf", kAmf[] = "shape.amf",
               kVtu[] = "shape.vtu", kMesh[] = "shape.mesh", kDcm[] = "shape.dcm";

constexpr FuzzTarget kTargets[] = {
    {"stl", run_surface<kStl>},
    {"ply", run_surface<kPly>},
    {"obj", run_obj},
    {"mtl", run_mtl},
    {"vtp", run_surface<kVtp>},
    {"vtk", run_surface<kVtk>},
    {"amf", run_surface<kAmf>},
    {"threemf", run_surface<kThreemf>},
    {"vtu", run_mesh<kVtu>},
    {"threemf_model", run_threemf_model},
    {"mesh", run_mesh<kMesh>},
    {"sol", run_sol},
    {"threemf_parts", run_threemf_parts},
    {"encapsulated", run_surface<kDcm>},
};

}  // namespace

std::span<const FuzzTarget> shape_targets() { return kTargets; }

}  // namespace mesamis
