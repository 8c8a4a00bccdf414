// SPDX-License-Identifier: Apache-2.0
#include "mesamis/delivery/body_output.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {
namespace {

constexpr double kVoxelsPerElement = 3;

void require_different_names(std::span<const FaceQuery> sets) {
  std::set<std::string> names;
  for (const FaceQuery& query : sets) {
    if (names.insert(query.name).second) continue;
    throw InputError("set: expected names that differ, found '" + query.name + "' twice");
  }
}

/// Between the world and the grid's own axes. A left-handed grid mirrors what goes through it.
class Frames {
 public:
  explicit Frames(const VoxelGrid& grid) : grid_(grid), box_(grid.box()) {}

  TriMesh to_grid(const TriMesh& surface) const {
    TriMesh turned = surface;
    for (Vec3& p : turned.points) p = snapped(grid_.to_grid(p));
    if (mirrors()) {
      for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
    }
    return turned;
  }

  bool mirrors() const { return determinant(grid_.direction) < 0; }
  Vec3 to_world(const Vec3& p) const { return grid_.to_world(p); }
  const Box& box() const { return box_; }

 private:
  /// A point that rounding has moved off the border of the scan is put back.
  Vec3 snapped(Vec3 p) const {
    constexpr double kRounding = 1e-9;
    const double near = kRounding * norm(box_.extent());
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(p[axis] - box_.lo[axis]) < near) p[axis] = box_.lo[axis];
      if (std::abs(p[axis] - box_.hi[axis]) < near) p[axis] = box_.hi[axis];
    }
    return p;
  }

  const VoxelGrid& grid_;
  Box box_;
};

/// Around all surfaces; where one ends at the border of the scan, that border.
Box box_around(std::span<const TriMesh> surfaces, const Box& scan, double margin) {
  std::vector<Vec3> corners;
  for (const TriMesh& surface : surfaces) {
    const Box box = bounding_box(surface.points);
    corners.insert(corners.end(), {box.lo, box.hi});
  }
  Box around = bounding_box(corners);
  for (int axis = 0; axis < 3; ++axis) {
    if (around.lo[axis] != scan.lo[axis]) around.lo[axis] -= margin;
    if (around.hi[axis] != scan.hi[axis]) around.hi[axis] += margin;
  }
  return around;
}

/// Letters, digits and underscores, as solvers take them.
std::string part_name(const Segment& segment, std::size_t number) {
  std::string name;
  for (const char c : segment.name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += plain ? c : '_';
  }
  return "PART_" + std::to_string(number) + (name.empty() ? "" : "_" + name.substr(0, 40));
}

void set_cells(FiniteElements& elements, const MeshedBody& body, const Frames& frames) {
  elements.points.reserve(body.elements.mesh.points.size() + body.middles.points.size());
  for (const auto* points : {&body.elements.mesh.points, &body.middles.points}) {
    for (const Vec3& p : *points) elements.points.push_back(frames.to_world(p));
  }
  elements.cells = body.elements.mesh.cells;
  elements.mid_nodes = body.middles.of_cell;
  const auto corners = static_cast<Index>(body.elements.mesh.points.size());
  for (auto& nodes : elements.mid_nodes) {
    for (Index& node : nodes) node += corners;
  }
  for (const Material object : body.elements.materials) {
    elements.part_of_cell.push_back(static_cast<Index>(object) - 1);
  }
}

/// Turns the elements of a mirrored mesh right side out: corners 0 and 1 change places, and with
/// them the nodes of their edges to 2 and to 3.
void mirror_cells(FiniteElements& elements) {
  for (Cell& cell : elements.cells) std::swap(cell[0], cell[1]);
  for (auto& nodes : elements.mid_nodes) {
    std::swap(nodes[1], nodes[2]);
    std::swap(nodes[3], nodes[4]);
  }
}

FiniteElements::FaceSet face_set(const FiniteElements& elements, const BodyMesh& body,
                                 const FaceQuery& query) {
  FiniteElements::FaceSet set{query.name, find_faces(body, query), {}};
  for (const auto& [cell, face] : set.faces) {
    for (const Index node : face_nodes(elements, cell, face)) {
      if (node != kNoIndex) set.nodes.push_back(node);
    }
  }
  std::sort(set.nodes.begin(), set.nodes.end());
  set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
  return set;
}

/// The elements without their mid-side nodes, in the world, as far as faces and materials need
/// them.
BodyMesh in_world(const FiniteElements& elements, MeshedBody& body) {
  const std::ptrdiff_t corners = std::ssize(body.elements.mesh.points);
  return {{{elements.points.begin(), elements.points.begin() + corners}, elements.cells},
          std::move(body.elements.materials),
          {}};
}

std::vector<FiniteElements::Part> parts_of(std::span<const FoundObject> objects) {
  std::vector<FiniteElements::Part> parts;
  for (const FoundObject& object : objects) {
    parts.push_back({part_name(object.segment, parts.size() + 1), object.segment.name});
  }
  return parts;
}

MeshedBody body_on_grid(std::span<const FoundObject> objects, const Frames& frames,
                        const BodyOptions& options) {
  std::vector<TriMesh> surfaces;
  surfaces.reserve(objects.size());
  for (const FoundObject& object : objects) surfaces.push_back(frames.to_grid(object.surface));
  return make_body(surfaces, box_around(surfaces, frames.box(), options.element_size), options);
}

}  // namespace

BodyOutput make_body_output(std::span<const FoundObject> objects, const Volume& volume,
                            const BodyRequest& request) {
  require_different_names(request.sets);
  BodyOptions options = request.elements;
  if (options.element_size <= 0) options.element_size = kVoxelsPerElement * volume.voxel_size();
  const Frames frames(volume);
  BodyOutput output;
  output.tolerance = options.tolerance;
  output.facts = body_on_grid(objects, frames, options);
  FiniteElements& elements = output.elements;
  set_cells(elements, output.facts, frames);
  if (frames.mirrors()) mirror_cells(elements);
  elements.parts = parts_of(objects);
  const BodyMesh body = in_world(elements, output.facts);
  output.facts.elements = {};
  output.facts.middles = {{}, {}, output.facts.middles.straight};
  for (const FaceQuery& query : request.sets) {
    elements.sets.push_back(face_set(elements, body, query));
  }
  if (!request.material) return output;
  const Materials materials = assign_materials(body.mesh, volume, *request.material);
  elements.materials = elastic_materials(materials, *request.material);
  elements.material_of_cell = materials.bins.of_cell;
  output.material = materials.report;
  return output;
}

}  // namespace mesamis
