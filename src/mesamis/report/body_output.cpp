// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/body_output.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/body/rim.h"
#include "mesamis/files/refuse.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/report/filled_objects.h"
#include "mesamis/report/solver_name.h"

namespace mesamis::detail::report {
namespace {

/// PART_1, MAT_001_..., as this program and its parts call them.
bool is_numbered(const std::string& name, const std::string& prefix) {
  return name.starts_with(prefix) && name.size() > prefix.size() &&
         std::isdigit(static_cast<unsigned char>(name[prefix.size()])) != 0;
}

std::string part_name(const Segment& segment, std::size_t number) {
  constexpr std::size_t kMost = 40;
  const std::string of_segment = segment.name.empty() ? "" : "_" + segment.name.substr(0, kMost);
  return solver_name("PART_" + std::to_string(number) + of_segment);
}

void set_cells(FiniteElements& elements, const MeshedBody& body, const VoxelGrid& grid) {
  elements.points.reserve(body.elements.mesh.points.size() + body.middles.points.size());
  for (const auto* points : {&body.elements.mesh.points, &body.middles.points}) {
    for (const Vec3& p : *points) elements.points.push_back(grid.to_world(p));
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
  sort_once(set.nodes);
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

/// What may keep skin and surface apart.
std::string reasons_of_distance(const MeshedBody& facts) {
  const std::int64_t dropped = facts.parts_dropped;
  const std::string parts = dropped == 0 ? ""
                                         : std::to_string(dropped) +
                                               (dropped == 1 ? " part of the objects that was"
                                                             : " parts of the objects that were") +
                                               " dropped and ";
  return ", with " + parts + "elements down to " + rounded_text(facts.least_size) + " mm";
}

/// Objects without an element, sets without a face.
std::string missing_in(const BodyOutput& body, bool first) {
  std::string missing;
  const auto add = [&](const std::string& text) {
    missing += (first && missing.empty() ? "" : "; ") + text;
  };
  for (std::size_t part = 0; part < body.elements.parts.size(); ++part) {
    if (std::ranges::count(body.elements.part_of_cell, static_cast<Index>(part)) == 0) {
      add("'" + body.elements.parts[part].note + "' has no element");
    }
  }
  for (const std::string& set : body.empty_sets)
    add("set '" + set + "' has no face, it is left out");
  return missing;
}

std::vector<TriMesh> surfaces_of(std::span<const FoundObject> objects) {
  std::vector<TriMesh> surfaces;
  for (const FoundObject& object : objects) surfaces.push_back(object.surface);
  return surfaces;
}

}  // namespace

std::string unmet(const BodyOutput& body) {
  const ElementQuality& q = body.facts.quality;
  const BodyFit& fit = body.facts.fit;
  std::string missed;
  const auto expect = [&](bool kept, const std::string& what, double expected, double found) {
    if (kept) return;
    int digits = 4;  // as many as tell both apart
    while (digits < 17 && rounded_text(found, digits) == rounded_text(expected, digits)) ++digits;
    missed += (missed.empty() ? "" : "; ") + what + " " + rounded_text(expected, digits) +
              ", found " + rounded_text(found, digits);
  };
  expect(q.least_angle >= 10.7, "expected dihedral angles of at least", 10.7, q.least_angle);
  expect(q.greatest_angle <= 165, "expected dihedral angles of at most", 165, q.greatest_angle);
  expect(q.share_above_15_deg >= 0.999, "expected a share of elements above 15 degrees of", 0.999,
         q.share_above_15_deg);
  expect(q.scaled_jacobian_min >= 0.1, "expected scaled Jacobians of at least", 0.1,
         q.scaled_jacobian_min);
  const double distance = std::max(fit.skin_to_surface, fit.surface_to_skin);
  expect(distance <= body.tolerance, "expected a distance to the surface, mm, of at most",
         body.tolerance, distance);
  if (distance > body.tolerance) missed += reasons_of_distance(body.facts);
  // The ratio is that of straight sides: what mid-side nodes add is not in it.
  const bool straight = body.elements.mid_nodes.empty();
  expect(!straight || std::abs(fit.volume_ratio - 1) <= 0.005,
         "expected the volume within 0.005 of a share of", 1, fit.volume_ratio);
  return missed + missing_in(body, missed.empty());
}

void require_set_names(std::span<const FaceQuery> sets) {
  std::map<std::string, std::string> names;
  for (const FaceQuery& query : sets) {
    const std::string name = upper(query.name);
    if (name == "ALL" || is_numbered(name, "PART_") || is_numbered(name, "MAT_")) {
      throw InputError(
          "set: expected a name other than ALL and those of parts and materials, found '" +
          query.name + "'");
    }
    const auto [earlier, is_new] = names.emplace(name, query.name);
    if (is_new) continue;
    throw InputError(
        "set: expected names that differ in more than case, found '" + query.name +
        (earlier->second == query.name ? "' twice" : "' beside '" + earlier->second + "'"));
  }
}

BodyOutput make_body_output(std::span<const FoundObject> objects, const VolumeView& volume,
                            const BodyRequest& request) {
  require_set_names(request.sets);
  return make_body_output(fill_objects(objects, volume, request.elements).body, objects, volume,
                          request);
}

BodyOutput make_body_output(MeshedBody&& filled, std::span<const FoundObject> objects,
                            const VolumeView& volume, const BodyRequest& request) {
  require_set_names(request.sets);
  BodyOutput output;
  output.tolerance = request.elements.tolerance;
  output.facts = std::move(filled);
  FiniteElements& elements = output.elements;
  set_cells(elements, output.facts, volume);
  if (determinant(volume.direction) < 0) mirror_cells(elements);
  elements.parts = parts_of(objects);
  const BodyMesh body = in_world(elements, output.facts);
  output.facts.elements = {};
  output.facts.middles = {{}, {}, output.facts.middles.straight};
  for (const FaceQuery& query : request.sets) {
    FiniteElements::FaceSet set = face_set(elements, body, query);
    if (set.faces.empty()) {
      output.empty_sets.push_back(query.name);
    } else {
      elements.sets.push_back(std::move(set));
    }
  }
  if (!request.material) return output;
  output.rim = request.rim;
  const Materials materials = assign_materials(
      body.mesh, with_full_rim(volume, surfaces_of(objects), request.rim), *request.material);
  elements.materials = elastic_materials(materials, *request.material);
  elements.material_of_cell = materials.bins.of_cell;
  output.material = materials.report;
  return output;
}

}  // namespace mesamis::detail::report
