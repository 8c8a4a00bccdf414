// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/axis_flip.h"

#include <algorithm>
#include <numeric>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/sampling.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::surface {
namespace {

// Shares of the longer diagonal: boxes nearer than the first fit, boxes farther than the second
// have hardly anything in common.
constexpr double kFits = 0.02;
constexpr double kPlain = 0.2;
constexpr double kBetterBox = 0.5;
constexpr double kNearer = 0.25;
constexpr double kOnIt = 0.05;     // of the diagonal
constexpr double kMoreNear = 0.5;  // than after LPS to RAS
constexpr std::size_t kSamples = 1000;

Box flipped(const Box& box, const AxisFlip& flip) {
  const Vec3 a = flip(box.lo), b = flip(box.hi);
  Box result;
  for (int i = 0; i < 3; ++i) {
    result.lo[i] = std::min(a[i], b[i]);
    result.hi[i] = std::max(a[i], b[i]);
  }
  return result;
}

AxisFlip inverse(const AxisFlip& flip) {
  AxisFlip result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto from = static_cast<std::size_t>(flip.axis[i]);
    result.axis[from] = static_cast<int>(i);
    result.sign[from] = flip.sign[i];
  }
  return result;
}

/// All but the one that changes nothing, those that exchange no axes first.
std::vector<AxisFlip> all_flips() {
  std::vector<AxisFlip> flips;
  std::array<int, 3> axis{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      const AxisFlip flip{axis, {signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1}};
      if (flip != AxisFlip{}) flips.push_back(flip);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return flips;
}

double diagonal(const Box& a, const Box& b) { return std::max(norm(a.extent()), norm(b.extent())); }

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Mean distances as given and flipped.
struct Nearness {
  double given, flipped;
};

/// From samples of `from`, as they are and flipped, to the other surface.
Nearness nearness(const TriMesh& from, const TriMesh& to, const AxisFlip& flip) {
  std::vector<Vec3> points = sample_by_area(from, kSamples);
  for (std::size_t i = 0; i < kSamples; ++i) points.push_back(flip(points[i]));
  const std::vector<double> distances = distances_to_surface(points, to);
  const std::span<const double> all(distances);
  return {mean(all.first(kSamples)), mean(all.subspan(kSamples))};
}

/// The flip with its distances, if it makes boxes and surfaces fit.
std::optional<FlipFound> try_flip(const TriMesh& reference, const TriMesh& surface,
                                  FlipFound found) {
  found.flipped_misfit = box_misfit(found.reference, flipped(found.surface, found.flip));
  if (found.flipped_misfit > kBetterBox * found.misfit) return std::nullopt;
  const Nearness there = nearness(surface, reference, found.flip);
  const Nearness back = nearness(reference, surface, inverse(found.flip));
  found.distance_mm = std::min(there.given, back.given);
  found.flipped_distance_mm = std::min(there.flipped, back.flipped);
  const double near =
      std::min(kNearer * found.distance_mm, kOnIt * diagonal(found.reference, found.surface));
  return found.flipped_distance_mm <= near ? std::optional(found) : std::nullopt;
}

AxisFlip best_flip_of_boxes(const FlipFound& found) {
  const auto misfit = [&found](const AxisFlip& flip) {
    return box_misfit(found.reference, flipped(found.surface, flip));
  };
  const std::vector<AxisFlip> flips = all_flips();
  return *std::min_element(
      flips.begin(), flips.end(),
      [&misfit](const AxisFlip& a, const AxisFlip& b) { return misfit(a) < misfit(b); });
}

}  // namespace

Vec3 AxisFlip::operator()(const Vec3& p) const noexcept {
  return {sign[0] * p[axis[0]], sign[1] * p[axis[1]], sign[2] * p[axis[2]]};
}

std::string to_string(const AxisFlip& flip) {
  std::string text = "(";
  for (std::size_t i = 0; i < 3; ++i) {
    text += i == 0 ? "" : ", ";
    text += flip.sign[i] < 0 ? "-" : "";
    text += "xyz"[flip.axis[i]];
  }
  return text + ")";
}

double box_misfit(const Box& a, const Box& b) {
  const double apart = std::max(norm(a.lo - b.lo), norm(a.hi - b.hi));
  return apart > 0 ? apart / diagonal(a, b) : 0;
}

std::optional<FlipFound> find_axis_flip(const TriMesh& reference, const TriMesh& surface) {
  require_sound(reference);
  require_sound(surface);
  FlipFound found;
  found.reference = bounding_box(without_unused_points(reference).points);
  found.surface = bounding_box(without_unused_points(surface).points);
  found.misfit = box_misfit(found.reference, found.surface);
  found.plain = found.misfit > kPlain;
  if (found.misfit <= kFits) return std::nullopt;
  found.flip = kLpsRas;
  const auto lps_ras = try_flip(reference, surface, found);
  found.flip = best_flip_of_boxes(found);
  if (found.flip == kLpsRas) return lps_ras;
  const auto best = try_flip(reference, surface, found);
  if (!lps_ras || !best) return lps_ras ? lps_ras : best;
  return best->flipped_distance_mm <= kMoreNear * lps_ras->flipped_distance_mm ? best : lps_ras;
}

}  // namespace mesamis::detail::surface
