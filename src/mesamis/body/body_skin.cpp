// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/body_skin.h"

#include <utility>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::body {
namespace {

/// Calls visit(material, material beyond, triangle) for the faces of cells on whose other side is
/// another material, or nothing.
template <class Visit>
void for_each_border_face(const BodyMesh& body, Visit&& visit) {
  const auto neighbors = cell_neighbors(body.mesh);
  for (std::size_t c = 0; c < neighbors.size(); ++c) {
    const Cell& cell = body.mesh.cells[c];
    for (std::size_t f = 0; f < 4; ++f) {
      const Index n = neighbors[c][f];
      const Material beyond = n == kNoIndex ? kOutside : body.materials[n];
      if (beyond == body.materials[c]) continue;
      const auto& k = kCellFaces[f];
      visit(body.materials[c], beyond, Triangle{cell[k[0]], cell[k[1]], cell[k[2]]});
    }
  }
}

TriMesh with_used_points(const BodyMesh& body, std::vector<Triangle> triangles) {
  return without_unused_points({body.mesh.points, std::move(triangles)});
}

}  // namespace

TriMesh body_skin(const BodyMesh& body, Material object) {
  std::vector<Triangle> skin;
  for_each_border_face(body, [&](Material inside, Material beyond, const Triangle& triangle) {
    const bool is_wanted = object == kOutside ? beyond == kOutside : inside == object;
    if (is_wanted) skin.push_back(triangle);
  });
  return with_used_points(body, std::move(skin));
}

std::vector<TriMesh> body_skins(const BodyMesh& body, std::size_t count) {
  std::vector<std::vector<Triangle>> triangles(count);
  for_each_border_face(body, [&](Material inside, Material, const Triangle& triangle) {
    triangles[inside - 1U].push_back(triangle);
  });
  std::vector<TriMesh> skins;
  skins.reserve(count);
  for (auto& of_object : triangles) skins.push_back(with_used_points(body, std::move(of_object)));
  return skins;
}

}  // namespace mesamis::detail::body
