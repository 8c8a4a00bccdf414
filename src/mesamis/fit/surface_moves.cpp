// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/surface_moves.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/single_precision.h"
#include "mesamis/surface/normals.h"

namespace mesamis::detail::fit {
namespace {

/// Voxels of noise beyond which the image tells nothing that the mesh does not.
constexpr double kMostNoise = 0.3;
/// Of the noise at the voxels, what the spline passes on between them, and a margin.
constexpr double kNoiseMargin = 1.1;
constexpr double kNoiseOfMean = 0.2;                // variance left in a local mean
constexpr double kLeastSlope = 8, kFullSlope = 20;  // grey values per voxel
constexpr int kSweepsOfMean = 10;
/// Of the shortest side of a voxel: slices this thick, and a half more, begin to show and show fully.
constexpr double kThickSlice = 1.05, kVeryThickSlice = 1.5;

/// Means over the neighbourhood: each sweep halves the way to the neighbours' weighted mean.
template <class Value>
std::vector<Value> smoothed_along(const Neighbors& neighbors, const std::vector<double>& weights,
                                  std::vector<Value> values, int sweeps) {
  std::vector<Value> next(values.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    parallel_for(values.size(), [&](std::size_t p) {
      const auto count = static_cast<double>(neighbors.start[p + 1] - neighbors.start[p]);
      double weight = weights[p] * count;
      Value sum = weight * values[p];
      for (std::size_t n = neighbors.start[p]; n < neighbors.start[p + 1]; ++n) {
        const Index other = neighbors.points[n];
        weight += weights[other];
        sum = sum + weights[other] * values[other];
      }
      next[p] = weight > 0 ? (1 / weight) * sum : values[p];
    });
    std::swap(values, next);
  }
  return values;
}

std::vector<Vec3> weighted_normals(const TriMesh& surface, const Neighbors& neighbors,
                                   const std::vector<double>& weights, int sweeps) {
  std::vector<Vec3> normals = smoothed_along(neighbors, weights, vertex_normals(surface), sweeps);
  for (Vec3& normal : normals) normal = unit_or_zero(normal);
  return normals;
}

/// Of a value at each point and at its neighbours the one that is chosen of any two.
template <class Choose>
std::vector<double> chosen_around(const Neighbors& neighbors, const std::vector<double>& values,
                                  Choose&& choose) {
  std::vector<double> chosen = values;
  parallel_for(values.size(), [&](std::size_t p) {
    for (std::size_t n = neighbors.start[p]; n < neighbors.start[p + 1]; ++n) {
      chosen[p] = choose(chosen[p], values[neighbors.points[n]]);
    }
  });
  return chosen;
}

void append(const std::vector<TrianglePair>& some, std::vector<TrianglePair>& all) {
  all.insert(all.end(), some.begin(), some.end());
}

}  // namespace

SurfaceSpace::SurfaceSpace(const VoxelGrid& grid, double point_scale)
    : grid_(grid),
      point_scale_(point_scale),
      voxel_(grid.voxel_size() / point_scale),
      box_{{0, 0, 0}, (1 / point_scale) * grid.box().extent()} {}

bool SurfaceSpace::has_thick_slices() const noexcept {
  return longest_side() > kThickSlice * shortest_side();
}

double SurfaceSpace::between_slices(const Vec3& p, const Vec3& normal) const {
  double sum = 0;
  for (int a = 0; a < 3; ++a) {
    const double side = grid_.spacing[a] / grid_.shortest_side();
    const double shows = (side - kThickSlice) / (kVeryThickSlice - kThickSlice);
    const double wave = std::sin(std::numbers::pi * point_scale_ * p[a] / grid_.spacing[a]);
    sum += side * std::clamp(shows, 0.0, 1.0) * normal[a] * normal[a] * wave * wave;
  }
  return sum;
}

double SurfaceSpace::in_steps(const Vec3& way) const {
  const Vec3 d = point_scale_ * way, &s = grid_.spacing;
  return norm({d.x / s.x, d.y / s.y, d.z / s.z});
}

bool SurfaceSpace::on_box(const Vec3& p) const {
  const double slack = 1e-6 * voxel_;
  for (int a = 0; a < 3; ++a) {
    if (p[a] <= box_.lo[a] + slack || p[a] >= box_.hi[a] - slack) return true;
  }
  return false;
}

Vec3 SurfaceSpace::within_box(const Vec3& p, const Vec3& move) const {
  double part = 1;
  for (int a = 0; a < 3; ++a) {
    const double room = std::max(0.0, move[a] < 0 ? p[a] - box_.lo[a] : box_.hi[a] - p[a]);
    if (std::abs(move[a]) > room) part = std::min(part, room / (2 * std::abs(move[a])));
  }
  return part * move;
}

Vec3 SurfaceSpace::step_to(const Vec3& goal, const Vec3& p, double most_voxels) const {
  const Vec3 move = goal - p;
  const double length = norm(move), most = most_voxels * voxel_;
  return within_box(p, (length > most ? most / length : 1) * move);
}

Vec3 SurfaceSpace::as_in_a_file(const Vec3& point) const {
  return rounded(grid_.to_world(point_scale_ * point));
}

Neighbors::Neighbors(const TriMesh& surface) : start(surface.points.size() + 1, 0) {
  std::vector<std::size_t> room(start.size(), 0);
  for (const Triangle& t : surface.triangles) {
    for (const Index p : t) ++room[static_cast<std::size_t>(p) + 1];
  }
  for (std::size_t p = 1; p < room.size(); ++p) room[p] += room[p - 1];
  std::vector<Index> listed(room.back());
  std::vector<std::size_t> end(room.begin(), room.end() - 1);
  for (const Triangle& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto p = static_cast<std::size_t>(t[i]);
      const Index other = t[(i + 1) % 3];
      // An edge of more than two triangles comes more than once.
      const auto first = listed.begin() + static_cast<std::ptrdiff_t>(room[p]);
      const auto last = listed.begin() + static_cast<std::ptrdiff_t>(end[p]);
      if (std::find(first, last, other) == last) listed[end[p]++] = other;
    }
  }
  points.reserve(listed.size());
  for (std::size_t p = 0; p < end.size(); ++p) {
    for (std::size_t n = room[p]; n < end[p]; ++n) points.push_back(listed[n]);
    start[p + 1] = points.size();
  }
  add_way_back();
}

std::size_t Neighbors::place_of(Index neighbor, Index point) const {
  std::size_t place = start[point];
  while (place < start[point + 1] && points[place] != neighbor) ++place;
  return place;
}

bool Neighbors::has(Index point, Index neighbor) const {
  return place_of(neighbor, point) < start[point + 1];
}

void Neighbors::add_way_back() {
  std::vector<char> is_one_way(points.size(), 0);
  parallel_for(start.size() - 1, [&](std::size_t p) {
    for (std::size_t n = start[p]; n < start[p + 1]; ++n) {
      is_one_way[n] = has(points[n], static_cast<Index>(p)) ? 0 : 1;
    }
  });
  std::vector<std::pair<Index, Index>> missing;
  for (std::size_t p = 0; p + 1 < start.size(); ++p) {
    for (std::size_t n = start[p]; n < start[p + 1]; ++n) {
      if (is_one_way[n] != 0) missing.emplace_back(points[n], static_cast<Index>(p));
    }
  }
  if (missing.empty()) return;
  std::sort(missing.begin(), missing.end());
  std::vector<Index> all;
  all.reserve(points.size() + missing.size());
  auto next = missing.begin();
  for (std::size_t p = 0; p + 1 < start.size(); ++p) {
    const std::size_t first = all.size();
    for (std::size_t n = start[p]; n < start[p + 1]; ++n) all.push_back(points[n]);
    for (; next != missing.end() && next->first == static_cast<Index>(p); ++next) {
      all.push_back(next->second);
    }
    start[p] = first;
  }
  start.back() = all.size();
  points = std::move(all);
}

std::optional<ImageOffset> image_offset(double above, double slope, double noise) {
  if (!(slope >= kLeastSlope)) return std::nullopt;
  return ImageOffset{std::clamp(above / slope, -kMostMove, kMostMove),
                     kNoiseMargin * noise / slope};
}

void Offsets::set(std::size_t point, const ImageOffset& offset, double slope) {
  distance[point] = offset.distance;
  noise[point] = offset.noise;
  weight[point] = std::min(1.0, slope * slope / (kFullSlope * kFullSlope));
}

FollowCounts count_told(const Offsets& offsets) {
  FollowCounts counts;
  for (std::size_t p = 0; p < offsets.noise.size(); ++p) {
    if (!(offsets.weight[p] > 0)) continue;
    ++counts.told;
    if (offsets.noise[p] < kMostNoise) ++counts.clear;
  }
  return counts;
}

std::vector<Vec3> smoothed_normals(const TriMesh& surface, const Neighbors& neighbors, int sweeps) {
  return weighted_normals(surface, neighbors, std::vector<double>(surface.points.size(), 1),
                          sweeps);
}

std::vector<Vec3> smoothed_normals(const TriMesh& surface, const Neighbors& neighbors,
                                   const std::vector<char>& on_curve) {
  std::vector<double> weights;
  weights.reserve(on_curve.size());
  for (const char on : on_curve) weights.push_back(on == 0 ? 1 : 0);
  return weighted_normals(surface, neighbors, weights, kSweepsOfNormals);
}

std::vector<double> least_around(const Neighbors& neighbors, const std::vector<double>& values) {
  return chosen_around(neighbors, values, [](double a, double b) { return std::min(a, b); });
}

std::vector<double> greatest_around(const Neighbors& neighbors, const std::vector<double>& values) {
  return chosen_around(neighbors, values, [](double a, double b) { return std::max(a, b); });
}

std::vector<double> filtered_moves(const FollowSpace& space, const Offsets& offsets,
                                   const Neighbors& neighbors) {
  const std::vector<double>& d = offsets.distance;
  std::vector<double> squares(d.size());
  for (std::size_t p = 0; p < d.size(); ++p) squares[p] = d[p] * d[p];
  const auto mean = smoothed_along(neighbors, offsets.weight, d, kSweepsOfMean);
  const auto mean_square =
      smoothed_along(neighbors, offsets.weight, std::move(squares), kSweepsOfMean);
  std::vector<double> moves(d.size());
  for (std::size_t p = 0; p < d.size(); ++p) {
    if (offsets.weight[p] == 0) continue;
    const double m = mean[p], noise = offsets.noise[p] * offsets.noise[p];
    const double variance = mean_square[p] - m * m;
    const double k = variance > noise ? 1 - noise / variance : 0;
    const double a = m * m > kNoiseOfMean * noise ? 1 - kNoiseOfMean * noise / (m * m) : 0;
    moves[p] = std::clamp(a * m + k * (d[p] - m), -kMostMove, kMostMove) * space.voxel();
  }
  return moves;
}

SurfaceMover::SurfaceMover(const SurfaceSpace& space, TriMesh surface, Unfolded where)
    : space_(space), moved_(std::move(surface)), filed_(moved_) {
  file_points();
  if (where == Unfolded::kHereAndInFile) here_.emplace(moved_);
  in_file_.emplace(filed_);
}

bool SurfaceMover::move(std::vector<Vec3> start, std::vector<Vec3> shifts) {
  left_.clear();
  const bool whole = move_and_take_back(std::move(start), std::move(shifts));
  sort_once(left_);
  return whole;
}

bool SurfaceMover::move_and_take_back(std::vector<Vec3> start, std::vector<Vec3> shifts) {
  constexpr int kHalvings = 2, kMostTrials = 40;
  std::vector<int> taken_back(shifts.size(), 0);
  parallel_for(shifts.size(), [&](std::size_t p) { moved_.points[p] = start[p] + shifts[p]; });
  file_points();
  std::vector<TrianglePair> pairs = in_file_->after_move();
  if (here_) append(here_->after_move(), pairs);
  bool whole = true;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    const std::vector<char> corners = moved_corners(shifts, pairs);
    const std::vector<Index> concerned = triangles_at(moved_.triangles, corners);
    if (concerned.empty()) return whole;
    whole = false;
    for (std::size_t p = 0; p < shifts.size(); ++p) {
      if (corners[p] == 0) continue;
      shifts[p] = (taken_back[p]++ < kHalvings ? 0.5 : 0.0) * shifts[p];
      moved_.points[p] = start[p] + shifts[p];
      filed_.points[p] = space_.as_in_a_file(moved_.points[p]);
    }
    pairs = in_file_->after_move_of(concerned);
    if (here_) append(here_->after_move_of(concerned), pairs);
  }
  if (triangles_at(moved_.triangles, moved_corners(shifts, pairs)).empty()) return false;
  moved_.points = std::move(start);
  file_points();
  left_ = in_file_->after_move();
  return false;
}

/// Of each point 1 if it is a corner of a pair of which any corner is still moved. Others are left:
/// they met before.
std::vector<char> SurfaceMover::moved_corners(const std::vector<Vec3>& shifts,
                                              const std::vector<TrianglePair>& pairs) {
  std::vector<char> corners(moved_.points.size(), 0);
  const auto is_moved = [&](Index t) {
    const Triangle& k = moved_.triangles[t];
    return std::any_of(k.begin(), k.end(), [&](Index p) { return norm(shifts[p]) > 0; });
  };
  for (const auto& [a, b] : pairs) {
    if (!is_moved(a) && !is_moved(b)) {
      left_.push_back({a, b});
      continue;
    }
    for (const Index p : moved_.triangles[a]) corners[p] = 1;
    for (const Index p : moved_.triangles[b]) corners[p] = 1;
  }
  return corners;
}

void SurfaceMover::file_points() {
  parallel_for(moved_.points.size(),
               [&](std::size_t p) { filed_.points[p] = space_.as_in_a_file(moved_.points[p]); });
}

TriMesh moved_without_folds(const SurfaceSpace& space, const TriMesh& surface,
                            std::vector<Vec3> shifts, Unfolded where) {
  SurfaceMover mover(space, surface, where);
  mover.move(surface.points, std::move(shifts));
  return mover.take_surface();
}

}  // namespace mesamis::detail::fit
