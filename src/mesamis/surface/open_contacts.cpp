// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/open_contacts.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "mesamis/base/each_once.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/half_edges.h"
#include "mesamis/surface/self_intersections.h"

namespace mesamis::detail::surface {
namespace {

/// Of each material its number if it is chosen, else that of the background, as of what lies outside.
class Objects {
 public:
  explicit Objects(std::span<const char> chosen) : chosen_(chosen) {}
  Index of(Index side) const {
    const bool is_object =
        side > 0 && side < std::ssize(chosen_) && chosen_[static_cast<std::size_t>(side)] != 0;
    return is_object ? side : 0;
  }
  bool is_contact(const std::array<Index, 2>& sides) const {
    return of(sides[0]) != 0 && of(sides[1]) != 0;
  }
  bool bounds_background(const std::array<Index, 2>& sides) const {
    return (of(sides[0]) == 0) != (of(sides[1]) == 0);
  }

 private:
  std::span<const char> chosen_;
};

constexpr int kUnreached = 1 << 20;

/// Lets distances grow along the edges of contacts, as many of them.
void spread(const PartitionSurface& partition, const std::vector<std::size_t>& contacts, int edges,
            std::vector<int>& distance) {
  for (int edge = 0; edge < edges; ++edge) {
    const std::vector<int> before = distance;
    for (const std::size_t t : contacts) {
      const Triangle& k = partition.triangles[t];
      const int least = std::min({before[k[0]], before[k[1]], before[k[2]]});
      for (const Index p : k) distance[p] = std::min(distance[p], least + 1);
    }
  }
}

/// Of each triangle 1 if it is of a contact that is narrow.
std::vector<char> narrow_contacts(const PartitionSurface& partition, const Objects& objects,
                                  int depth) {
  std::vector<std::size_t> contacts;
  std::vector<int> at_background(partition.points.size(), kUnreached);
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    const auto& sides = partition.sides[t];
    if (objects.is_contact(sides)) {
      contacts.push_back(t);
    } else if (sides[1] != kNoIndex) {
      for (const Index p : partition.triangles[t]) at_background[p] = 0;
    }
  }
  std::vector<char> narrow(partition.triangles.size(), 0);
  if (contacts.empty()) return narrow;
  spread(partition, contacts, depth, at_background);
  std::vector<int> deep(partition.points.size(), kUnreached);
  for (std::size_t p = 0; p < deep.size(); ++p) {
    if (at_background[p] >= depth) deep[p] = 0;
  }
  spread(partition, contacts, depth, deep);
  for (const std::size_t t : contacts) {
    const Triangle& k = partition.triangles[t];
    narrow[t] = std::ranges::any_of(k, [&](Index p) { return deep[p] > depth; }) ? 1 : 0;
  }
  return narrow;
}

/// A point of one or several objects, once contacts are open.
struct Copy {
  std::vector<Index> objects;  ///< that hang together there, increasing
  Index point = 0;
};

/// Marks the points of open contacts.
std::vector<char> points_of(const PartitionSurface& partition, const std::vector<char>& open) {
  std::vector<char> points(partition.points.size(), 0);
  for (std::size_t t = 0; t < open.size(); ++t) {
    if (open[t] == 0) continue;
    for (const Index p : partition.triangles[t]) points[p] = 1;
  }
  return points;
}

/// Closes contacts at points.
/// @return whether there was any.
bool close_at(const PartitionSurface& partition, const std::vector<char>& points,
              std::vector<char>& open) {
  bool any = false;
  for (std::size_t t = 0; t < open.size(); ++t) {
    const auto& [a, b, c] = partition.triangles[t];
    if (open[t] == 0 || points[a] + points[b] + points[c] == 0) continue;
    open[t] = 0;
    any = true;
  }
  return any;
}

/// A partition whose open contacts are two boundaries, and which points of objects come from one.
class OpenedPartition {
 public:
  /// @param open  of each triangle; contacts that cannot be opened are closed.
  OpenedPartition(const PartitionSurface& from, const Objects& objects, std::vector<char>& open)
      : from_(from), objects_(objects), open_(open) {
    do find_copies();
    while (close_pinched());
    build();
  }

  PartitionSurface surface;
  std::vector<Index> origin;                ///< of each point the one that it was
  std::vector<char> is_copy;                ///< of each point 1 if another has its origin
  std::vector<std::array<Index, 2>> twins;  ///< points of one origin

 private:
  /// Divides points of open contacts among the objects that still hang together there.
  void find_copies() {
    copies_.assign(from_.points.size(), {});
    std::vector<char> touched = points_of(from_, open_);
    for (std::size_t t = 0; t < open_.size(); ++t) {
      if (from_.sides[t][1] != kNoIndex) continue;
      for (const Index p : from_.triangles[t]) touched[p] = 0;
    }
    for (std::size_t t = 0; t < open_.size(); ++t) {
      const Index a = objects_.of(from_.sides[t][0]), b = objects_.of(from_.sides[t][1]);
      for (const Index p : from_.triangles[t]) {
        if (touched[p] == 0) continue;
        if (open_[t] == 0 && a != 0 && b != 0) {
          join(p, {a, b});
        } else {
          if (a != 0) join(p, {a});
          if (b != 0) join(p, {b});
        }
      }
    }
    origin.resize(from_.points.size());
    std::iota(origin.begin(), origin.end(), 0);
    for (Index p = 0; p < std::ssize(copies_); ++p) {
      auto& copies = copies_[p];
      if (copies.size() < 2) copies.clear();
      std::ranges::sort(copies, {}, &Copy::objects);
      for (std::size_t c = 0; c < copies.size(); ++c) {
        copies[c].point = c == 0 ? p : static_cast<Index>(origin.size());
        if (c > 0) origin.push_back(p);
      }
    }
  }

  /// Joins the copies of some objects at a point.
  void join(Index p, std::vector<Index> objects) {
    auto& copies = copies_[p];
    std::erase_if(copies, [&](const Copy& copy) {
      const bool meets = std::ranges::any_of(
          objects, [&](Index o) { return std::ranges::count(copy.objects, o) > 0; });
      if (meets) objects.insert(objects.end(), copy.objects.begin(), copy.objects.end());
      return meets;
    });
    sort_once(objects);
    copies.push_back({std::move(objects)});
  }

  /// The point of an object where a point was.
  Index point_of(Index p, Index object) const {
    for (const Copy& copy : copies_[p]) {
      if (std::ranges::count(copy.objects, object) > 0) return copy.point;
    }
    return p;
  }

  /// A triangle with the points of an object.
  Triangle triangle_of(std::size_t t, Index object) const {
    const auto& [a, b, c] = from_.triangles[t];
    return {point_of(a, object), point_of(b, object), point_of(c, object)};
  }

  /// Closes contacts at points around which the background would not be one closed fan of triangles,
  /// or where the two sides of one would have the same points.
  /// @return whether there was any.
  bool close_pinched() {
    const std::vector<char> near = points_of(from_, open_);
    std::vector<char> pinched(origin.size(), 0);
    std::vector<Triangle> background;  // its boundary at those points
    for (const Index i : triangles_at(from_.triangles, near)) {
      const auto t = static_cast<std::size_t>(i);
      const auto& [a, b] = from_.sides[t];
      if (open_[t] != 0) {
        const Triangle one = triangle_of(t, a), other = triangle_of(t, b);
        background.insert(background.end(), {one, other});
        if (one != other) continue;
        for (const Index p : one) pinched[p] = 1;
      } else if (objects_.bounds_background({a, b})) {
        background.push_back(triangle_of(t, std::max(objects_.of(a), objects_.of(b))));
      }
    }
    const auto half_edges = sorted_half_edges(background, origin.size());
    for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
      if (edge.size() != 2) pinched[edge[0].lo] = pinched[edge[0].hi] = 1;
    });
    const auto several = points_of_several_fans(background, half_edges, origin.size());
    std::vector<char> origins(near.size(), 0);
    for (std::size_t p = 0; p < origin.size(); ++p) {
      if (near[origin[p]] != 0 && pinched[p] + several[p] > 0) origins[origin[p]] = 1;
    }
    return close_at(from_, origins, open_);
  }

  void add(std::size_t t, Index object, const std::array<Index, 2>& sides, bool flips) {
    Triangle k = triangle_of(t, object);
    if (flips) std::swap(k[1], k[2]);
    surface.triangles.push_back(k);
    surface.sides.push_back(sides);
  }

  void build() {
    for (std::size_t t = 0; t < open_.size(); ++t) {
      const auto& [a, b] = from_.sides[t];
      if (open_[t] != 0) {
        add(t, a, {0, a}, true);
      } else {
        add(t, std::max(objects_.of(a), objects_.of(b)), {a, b}, false);
      }
    }
    for (std::size_t t = 0; t < open_.size(); ++t) {
      const Index b = from_.sides[t][1];
      if (open_[t] != 0) add(t, b, {0, b}, false);
    }
    is_copy.assign(origin.size(), 0);
    for (const Index p : origin) surface.points.push_back(from_.points[p]);
    for (const std::vector<Copy>& copies : copies_) {
      for (const Copy& copy : copies) {
        is_copy[copy.point] = 1;
        for (const Copy& other : copies) {
          if (other.point < copy.point) twins.push_back({other.point, copy.point});
        }
      }
    }
  }

  const PartitionSurface& from_;
  const Objects& objects_;
  std::vector<char>& open_;
  std::vector<std::vector<Copy>> copies_;  // of each point; none where it stays one
};

/// The directions into the objects of each copy that lead away from all their boundaries there; 0
/// for other points.
std::vector<Vec3> ways_inwards(const OpenedPartition& opened, const Objects& objects) {
  constexpr int kSteps = 30;
  const PartitionSurface& s = opened.surface;
  std::vector<std::vector<Vec3>> outwards(s.points.size());  // normals around each copy
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    if (objects.is_contact(s.sides[t])) continue;
    const Triangle& k = s.triangles[t];
    const Vec3& a = s.points[k[0]];
    const Vec3 normal = unit_or_zero(cross(s.points[k[1]] - a, s.points[k[2]] - a));
    const double sign = objects.of(s.sides[t][0]) != 0 ? 1 : -1;
    for (const Index p : k) {
      if (opened.is_copy[p] != 0) outwards[p].push_back(sign * normal);
    }
  }
  std::vector<Vec3> ways(s.points.size());
  parallel_for(ways.size(), [&](std::size_t p) {
    const auto& normals = outwards[p];
    if (normals.empty()) return;
    Vec3 way;
    for (const Vec3& n : normals) way += -1.0 * n;
    for (int step = 1; step <= kSteps; ++step) {  // away from the one that is left the least
      way = unit_or_zero(way);
      const Vec3 worst =
          *std::ranges::max_element(normals, {}, [&](const Vec3& n) { return dot(n, way); });
      way += (-1.0 / (1 + step)) * worst;
    }
    ways[p] = unit_or_zero(way);
  });
  return ways;
}

/// The ways of copies, averaged with those beside them: the nearer these are, the more they count,
/// so that points that lie close together go together.
std::vector<Vec3> averaged(const OpenedPartition& opened, std::vector<Vec3> ways) {
  constexpr int kSweeps = 32;
  constexpr double kNearest = 1e-6;  // mm
  const PartitionSurface& s = opened.surface;
  std::vector<std::size_t> at_copies;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const auto& [a, b, c] = s.triangles[t];
    if (opened.is_copy[a] + opened.is_copy[b] + opened.is_copy[c] > 1) at_copies.push_back(t);
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    std::vector<Vec3> sum(s.points.size());
    for (const std::size_t t : at_copies) {
      const Triangle& k = s.triangles[t];
      for (std::size_t i = 0; i < 3; ++i) {
        const Index p = k[i], q = k[(i + 1) % 3];
        const double nearness = 1 / (norm(s.points[p] - s.points[q]) + kNearest);
        sum[p] += nearness * ways[q];
        sum[q] += nearness * ways[p];
      }
    }
    parallel_for(ways.size(), [&](std::size_t p) {
      if (opened.is_copy[p] != 0) ways[p] = unit_or_zero(unit_or_zero(sum[p]) + ways[p]);
    });
  }
  return ways;
}

/// Moves the two sides of open contacts apart: less far where they would meet something.
class Parting {
 public:
  Parting(const OpenedPartition& opened, const Objects& objects, const ContactOptions& options)
      : opened_(opened),
        options_(options),
        own_(ways_inwards(opened, objects)),
        averaged_(averaged(opened, own_)),
        trial_(opened.origin.size(), 0) {}

  /// @return of each origin 1 if that is not possible there.
  std::vector<char> part() {
    const std::vector<Vec3>& start = opened_.surface.points;
    TriMesh filed{std::vector<Vec3>(start.size()), opened_.surface.triangles};
    const auto file = [&](std::size_t p) { filed.points[p] = options_.in_file(place_of(p)); };
    parallel_for(start.size(), file);
    SelfIntersections search(filed);
    std::vector<Index> moved = triangles_at(filed.triangles, opened_.is_copy);
    while (true) {
      std::vector<char> meet = origins_of(search.after_move_of(moved));
      add_close_twins(meet);
      bool goes_on = false;
      for (std::size_t o = 0; o < meet.size(); ++o) {
        if (meet[o] == 0 || trial_[o] == kScale.size() - 1) continue;
        ++trial_[o];
        goes_on = true;
      }
      if (!goes_on) return meet;
      std::vector<char> changed(start.size(), 0);
      parallel_for(start.size(), [&](std::size_t p) {
        if (opened_.is_copy[p] == 0 || meet[opened_.origin[p]] == 0) return;
        file(p);
        changed[p] = 1;
      });
      moved = triangles_at(filed.triangles, changed);
    }
  }

  /// Where a point of the opened partition goes.
  Vec3 place_of(std::size_t p) const {
    const std::size_t trial = trial_[opened_.origin[p]];
    const Vec3 way = (trial == 0 ? averaged_ : own_)[p];
    return opened_.surface.points[p] + (options_.gap * kScale[trial]) * way;
  }

 private:
  static constexpr std::array<double, 3> kScale{1, 1.0 / 16, 1.0 / 256};

  std::vector<char> origins_of(const std::vector<TrianglePair>& pairs) const {
    std::vector<char> origins(opened_.origin.size(), 0);
    for (const auto& pair : pairs) {
      for (const Index t : pair) {
        for (const Index p : opened_.surface.triangles[t]) origins[opened_.origin[p]] = 1;
      }
    }
    return origins;
  }

  /// Adds the origins of points that do not part.
  void add_close_twins(std::vector<char>& origins) const {
    constexpr double kLeast = 0.05;  // of what each moves
    for (const auto& [one, other] : opened_.twins) {
      const Index origin = opened_.origin[one];
      const auto& ways = trial_[origin] == 0 ? averaged_ : own_;
      if (norm(ways[one] - ways[other]) < kLeast) origins[origin] = 1;
    }
  }

  const OpenedPartition& opened_;
  const ContactOptions& options_;
  std::vector<Vec3> own_, averaged_;
  std::vector<std::size_t> trial_;  // of each origin
};

/// The points of open contacts that have one of some points.
std::vector<char> around(const PartitionSurface& partition, const std::vector<char>& open,
                         const std::vector<char>& points) {
  std::vector<char> found = points;
  for (std::size_t t = 0; t < open.size(); ++t) {
    const Triangle& k = partition.triangles[t];
    if (open[t] == 0 || points[k[0]] + points[k[1]] + points[k[2]] == 0) continue;
    for (const Index p : k) found[p] = 1;
  }
  return found;
}

}  // namespace

PartitionSurface open_narrow_contacts(PartitionSurface partition, std::span<const char> chosen,
                                      const ContactOptions& options) {
  const Objects objects(chosen);
  std::vector<char> open = narrow_contacts(partition, objects, options.depth);
  while (std::ranges::count(open, 1) > 0) {
    OpenedPartition opened(partition, objects, open);
    Parting parting(opened, objects, options);
    const std::vector<char> failed = parting.part();
    if (std::ranges::count(failed, 1) == 0) {
      std::vector<Vec3> apart(opened.surface.points.size());
      parallel_for(apart.size(), [&](std::size_t p) { apart[p] = parting.place_of(p); });
      opened.surface.points = std::move(apart);
      return std::move(opened.surface);
    }
    close_at(partition, around(partition, open, failed), open);
  }
  return partition;
}

}  // namespace mesamis::detail::surface
