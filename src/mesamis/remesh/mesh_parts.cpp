// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/mesh_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/stopwatch.h"

namespace mesamis::detail::remesh {
namespace {

constexpr Index kShared = -2;

/// Recursive bisection of the vertices along the longest of three axes.
class Bisection {
 public:
  Bisection(const WorkingMesh& mesh, int round)
      : mesh_(mesh), axes_(turned_axes(round)), keys_(mesh.vertices.size()) {}

  std::vector<Index> parts_of_vertices(Index parts) {
    std::vector<Index> order(mesh_.vertices.size());
    std::iota(order.begin(), order.end(), 0);
    part_.assign(order.size(), 0);
    bisect(order, 0, parts);
    return std::move(part_);
  }

 private:
  static std::array<Vec3, 3> turned_axes(int round) {
    const double longitude = 0.35 + 1.1 * round, latitude = 0.2 + 0.7 * round;
    const double c = std::cos(latitude);
    const Vec3 e0{std::cos(longitude) * c, std::sin(longitude) * c, std::sin(latitude)};
    const Vec3 e1{-std::sin(longitude), std::cos(longitude), 0};
    return {e0, e1, cross(e0, e1)};
  }

  const Vec3& longest_axis(std::span<const Index> ids) const {
    constexpr std::size_t kSampleStride = 7;
    std::size_t best = 0;
    double longest = -1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double lo = INFINITY, hi = -INFINITY;
      for (std::size_t i = 0; i < ids.size(); i += kSampleStride) {
        const double key = dot(axes_[axis], mesh_.vertices[ids[i]].position);
        lo = std::min(lo, key);
        hi = std::max(hi, key);
      }
      if (hi - lo > longest) {
        longest = hi - lo;
        best = axis;
      }
    }
    return axes_[best];
  }

  void bisect(std::span<Index> ids, Index first_part, Index parts) {
    if (parts == 1) {
      for (const Index v : ids) part_[v] = first_part;
      return;
    }
    const Vec3& axis = longest_axis(ids);
    for (const Index v : ids) {
      keys_[v] = static_cast<float>(dot(axis, mesh_.vertices[v].position));
    }
    const Index lower = parts / 2;
    const std::size_t middle =
        ids.size() * static_cast<std::size_t>(lower) / static_cast<std::size_t>(parts);
    std::nth_element(
        ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(middle), ids.end(),
        [this](Index a, Index b) { return std::tie(keys_[a], a) < std::tie(keys_[b], b); });
    parallel_for_each(2, [&](std::size_t half) {
      half == 0 ? bisect(ids.first(middle), first_part, lower)
                : bisect(ids.subspan(middle), first_part + lower, parts - lower);
    });
  }

  const WorkingMesh& mesh_;
  std::array<Vec3, 3> axes_;
  std::vector<float> keys_;
  std::vector<Index> part_;
};

/// Items grouped by part, those of part p being items[start[p]] ... items[start[p + 1] - 1].
struct Groups {
  std::vector<Index> start, items, slot;  ///< slot: an item's position within its part
  std::span<const Index> of(Index part) const {
    return {items.data() + start[part], items.data() + start[part + 1]};
  }
};

/// @param part_of  the part of each item; items with a negative one belong to no group.
Groups group(std::span<const Index> part_of, Index parts) {
  Groups groups{std::vector<Index>(parts + 1, 0), {}, std::vector<Index>(part_of.size(), 0)};
  for (std::size_t i = 0; i < part_of.size(); ++i) {
    if (part_of[i] >= 0) groups.slot[i] = groups.start[part_of[i] + 1]++;
  }
  std::partial_sum(groups.start.begin(), groups.start.end(), groups.start.begin());
  groups.items.resize(groups.start.back());
  for (std::size_t i = 0; i < part_of.size(); ++i) {
    if (part_of[i] < 0) continue;
    groups.items[groups.start[part_of[i]] + groups.slot[i]] = static_cast<Index>(i);
  }
  return groups;
}

/// Who works on what. A cell goes to the lowest part among its vertices; a vertex whose cells go
/// to different parts is shared by them.
struct PartCut {
  std::vector<Index> part_of_cell, owner;  ///< owner of a vertex: a part or kShared
  Groups cells, vertices;
  std::vector<Index> shared;         ///< the shared vertices
  std::vector<Index> shared_number;  ///< position in `shared`, by vertex
};

PartCut make_cut(const WorkingMesh& mesh, int round, Index parts) {
  const std::vector<Index> part_of_vertex = Bisection(mesh, round).parts_of_vertices(parts);
  PartCut cut;
  cut.part_of_cell.resize(mesh.cells.size());
  cut.owner.assign(mesh.vertices.size(), kNoIndex);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell& k = mesh.cells[c].points;
    const Index part = std::min(
        {part_of_vertex[k[0]], part_of_vertex[k[1]], part_of_vertex[k[2]], part_of_vertex[k[3]]});
    cut.part_of_cell[c] = part;
    for (const Index v : k) {
      Index& owner = cut.owner[v];
      owner = owner == kNoIndex || owner == part ? part : kShared;
    }
  }
  cut.cells = group(cut.part_of_cell, parts);
  cut.vertices = group(cut.owner, parts);
  cut.shared_number.assign(mesh.vertices.size(), kNoIndex);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (cut.owner[v] != kShared) continue;
    cut.shared_number[v] = static_cast<Index>(cut.shared.size());
    cut.shared.push_back(static_cast<Index>(v));
  }
  return cut;
}

/// A part as a mesh of its own. Its shared vertices come first and stay first.
struct Part {
  WorkingMesh mesh;
  std::vector<Index> shared;  ///< their positions in PartCut::shared, increasing
  Counters counters;
  Index first_cell = 0, first_vertex = 0;  ///< in the joined mesh
};

/// Local numbers of the shared vertices of a part, by position in PartCut::shared; kNoIndex for
/// those of other parts.
std::vector<Index> number_shared(const WorkingMesh& mesh, const PartCut& cut, Index part) {
  std::vector<Index> number(cut.shared.size(), kNoIndex);
  for (const Index c : cut.cells.of(part)) {
    for (const Index v : mesh.cells[c].points) {
      if (cut.owner[v] == kShared) number[cut.shared_number[v]] = 0;
    }
  }
  Index next = 0;
  for (Index& n : number) {
    if (n != kNoIndex) n = next++;
  }
  return number;
}

Part extract(const WorkingMesh& mesh, const PartCut& cut, Index p) {
  Part part;
  const std::vector<Index> number = number_shared(mesh, cut, p);
  for (std::size_t s = 0; s < number.size(); ++s) {
    if (number[s] != kNoIndex) part.shared.push_back(static_cast<Index>(s));
  }
  const auto shared_count = static_cast<Index>(part.shared.size());
  part.mesh.box = mesh.box;
  part.mesh.is_part = true;
  part.mesh.shape = mesh.shape;
  part.mesh.vertices.reserve(part.shared.size() + cut.vertices.of(p).size());
  for (const Index s : part.shared) {
    part.mesh.vertices.push_back(mesh.vertices[cut.shared[s]]);
    part.mesh.vertices.back().mask |= kFrozen;
  }
  for (const Index v : cut.vertices.of(p)) part.mesh.vertices.push_back(mesh.vertices[v]);
  auto local_vertex = [&](Index v) {
    return cut.owner[v] == kShared ? number[cut.shared_number[v]]
                                   : shared_count + cut.vertices.slot[v];
  };
  part.mesh.cells.reserve(cut.cells.of(p).size());
  for (const Index c : cut.cells.of(p)) {
    WorkCell cell = mesh.cells[c];
    for (Index& v : cell.points) {
      v = local_vertex(v);
      part.mesh.vertices[v].cell = static_cast<Index>(part.mesh.cells.size());
    }
    for (FaceRef& n : cell.neighbors) {
      if (n == kNoIndex) continue;
      const bool inside = cut.part_of_cell[cell_of(n)] == p;
      n = inside ? face_ref(cut.cells.slot[cell_of(n)], face_of(n)) : kNoIndex;
    }
    part.mesh.cells.push_back(cell);
  }
  return part;
}

/// A face on the border between parts, to be matched with its other side.
struct BorderFace {
  std::array<Index, 3> points;  // sorted
  FaceRef face;
};

bool is_on_box(const WorkingMesh& mesh, const std::array<Index, 3>& points) {
  return mesh.vertices[points[0]].mask & mesh.vertices[points[1]].mask &
         mesh.vertices[points[2]].mask & kPlanes;
}

std::vector<BorderFace> border_faces(const WorkingMesh& mesh, Index first, Index count) {
  std::vector<BorderFace> faces;
  for (Index c = first; c < first + count; ++c) {
    const WorkCell& cell = mesh.cells[c];
    for (int f = 0; f < 4; ++f) {
      if (cell.neighbors[f] != kNoIndex) continue;
      const std::array<Index, 3> points = sorted_face(cell.points, f);
      if (!is_on_box(mesh, points)) faces.push_back({points, face_ref(c, f)});
    }
  }
  return faces;
}

/// Writes a part to its place in the joined mesh; shared vertices are there already.
void insert(WorkingMesh& joined, const Part& part) {
  const auto shared_count = static_cast<Index>(part.shared.size());
  auto joined_vertex = [&](Index v) {
    return v < shared_count ? part.shared[v] : part.first_vertex + v - shared_count;
  };
  for (Index v = shared_count; v < std::ssize(part.mesh.vertices); ++v) {
    Vertex& vertex = joined.vertices[joined_vertex(v)];
    vertex = part.mesh.vertices[v];
    vertex.cell += part.first_cell;
  }
  for (std::size_t c = 0; c < part.mesh.cells.size(); ++c) {
    WorkCell cell = part.mesh.cells[c];
    for (Index& v : cell.points) v = joined_vertex(v);
    for (FaceRef& n : cell.neighbors) {
      if (n != kNoIndex) n += face_ref(part.first_cell, 0);
    }
    joined.cells[part.first_cell + static_cast<Index>(c)] = cell;
  }
}

void match_border(WorkingMesh& mesh, const std::vector<Part>& parts) {
  auto faces =
      parallel_collect<BorderFace>(parts.size(), 1, [&](std::size_t p, std::size_t, auto& found) {
        found =
            border_faces(mesh, parts[p].first_cell, static_cast<Index>(parts[p].mesh.cells.size()));
      });
  std::sort(faces.begin(), faces.end(), [](const BorderFace& a, const BorderFace& b) {
    return std::tie(a.points, a.face) < std::tie(b.points, b.face);
  });
  for (std::size_t i = 0; i < faces.size(); i += 2) {
    if (i + 1 == faces.size() || faces[i].points != faces[i + 1].points) {
      if (mesh.shape == nullptr && !mesh.is_part) {
        throw NumericalError("remesh: the parts of the mesh do not fit together");
      }
      --i;  // the skin of a body and the border of a piece have one side only
      continue;
    }
    const FaceRef a = faces[i].face, b = faces[i + 1].face;
    mesh.cells[cell_of(a)].neighbors[face_of(a)] = b;
    mesh.cells[cell_of(b)].neighbors[face_of(b)] = a;
  }
}

/// Makes room for `count` items, whatever they are.
template <class Item>
void make_room(std::vector<Item>& items, std::size_t count) {
  if (count > items.capacity()) items = {};  // else all would be copied
  items.resize(count);
}

/// Writes the parts over the mesh that they were cut from.
void join(WorkingMesh& mesh, const PartCut& cut, std::vector<Part>& parts) {
  std::size_t cells = 0, vertices = cut.shared.size();
  for (Part& part : parts) {
    part.first_cell = static_cast<Index>(cells);
    part.first_vertex = static_cast<Index>(vertices);
    cells += part.mesh.cells.size();
    vertices += part.mesh.vertices.size() - part.shared.size();
  }
  std::vector<Vertex> shared;
  shared.reserve(cut.shared.size());
  for (const Index v : cut.shared) shared.push_back(mesh.vertices[v]);
  make_room(mesh.cells, cells);
  make_room(mesh.vertices, vertices);
  std::copy(shared.begin(), shared.end(), mesh.vertices.begin());
  for (const Part& part : parts) {
    for (std::size_t s = 0; s < part.shared.size(); ++s) {
      mesh.vertices[part.shared[s]].cell = part.first_cell + part.mesh.vertices[s].cell;
    }
  }
  parallel_for_each(parts.size(), [&](std::size_t p) { insert(mesh, parts[p]); });
  match_border(mesh, parts);
}

}  // namespace

PartsReport work_on_parts(WorkingMesh& mesh, const PartSchedule& schedule,
                          const std::function<Counters(WorkingMesh&)>& work) {
  const PartCut cut = make_cut(mesh, schedule.round, schedule.parts);
  std::vector<Part> parts(static_cast<std::size_t>(schedule.parts));
  PartsReport report{{}, std::vector<double>(parts.size())};
  parallel_for_each(parts.size(), [&](std::size_t p) {
    Stopwatch watch;
    parts[p] = extract(mesh, cut, static_cast<Index>(p));
    parts[p].counters = work(parts[p].mesh);
    compact(parts[p].mesh);
    report.seconds[p] = watch.lap();
  });
  join(mesh, cut, parts);
  for (const Part& part : parts) report.counters += part.counters;
  return report;
}

}  // namespace mesamis::detail::remesh
