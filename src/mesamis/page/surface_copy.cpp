// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/surface_copy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/page/scan_copy.h"

namespace mesamis::detail::page {
namespace {

using Place = std::array<std::int64_t, 3>;

SurfaceCopy clustered(const SurfaceCopy& copy, double cell) {
  const TriMesh& surface = copy.surface;
  std::vector<std::pair<Place, Index>> places;
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    Place place{};
    for (std::size_t a = 0; a < 3; ++a) {
      place[a] = std::llround(std::floor(surface.points[n][static_cast<int>(a)] / cell));
    }
    places.emplace_back(place, static_cast<Index>(n));
  }
  std::sort(places.begin(), places.end());
  SurfaceCopy made;
  TriMesh& coarse = made.surface;
  std::vector<Index> number(surface.points.size());
  for (std::size_t n = 0; n < places.size();) {
    Vec3 sum;
    double values = 0;
    std::size_t end = n;
    for (; end < places.size() && places[end].first == places[n].first; ++end) {
      sum += surface.points[static_cast<std::size_t>(places[end].second)];
      number[static_cast<std::size_t>(places[end].second)] =
          static_cast<Index>(coarse.points.size());
      if (!copy.values.empty()) values += copy.values[static_cast<std::size_t>(places[end].second)];
    }
    const double share = 1 / static_cast<double>(end - n);
    coarse.points.push_back(share * sum);
    if (!copy.values.empty()) made.values.push_back(share * values);
    n = end;
  }
  for (Triangle t : surface.triangles) {
    for (Index& corner : t) corner = number[static_cast<std::size_t>(corner)];
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) coarse.triangles.push_back(t);
  }
  return made;
}

template <class T>
void append(std::string& to, T value) {
  static_assert(std::endian::native == std::endian::little);
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  to.append(bytes.data(), bytes.size());
}

/// A power of two, so that rounded numbers are short in single precision.
double step_of(double most, double steps) {
  return std::exp2(std::floor(std::log2(std::max(most, 1e-6) / steps)));
}

void append_values(std::string& file, const std::vector<double>& values) {
  constexpr double kSteps = 256;
  if (values.empty()) return;
  const double step = step_of(*std::max_element(values.begin(), values.end()), kSteps);
  for (const double value : values) {
    append(file, static_cast<float>(step * std::round(static_cast<float>(value) / step)));
  }
}

}  // namespace

SurfaceCopy coarse_surface(const SurfaceCopy& copy, std::int64_t most) {
  if (std::ssize(copy.surface.triangles) <= most) return copy;
  constexpr double kGrowth = 1.25;
  // About two triangles for each cell that the surface passes through.
  double cell = std::sqrt(2 * surface_area(copy.surface) / static_cast<double>(most));
  if (!(cell > 0)) return copy;
  SurfaceCopy coarse = clustered(copy, cell);
  while (std::ssize(coarse.surface.triangles) > most) {
    cell *= kGrowth;
    coarse = clustered(copy, cell);
  }
  return coarse;
}

std::string mz3_gz(const SurfaceCopy& copy) {
  constexpr std::uint16_t kMagic = 23117, kFacesAndPoints = 3, kValues = 8;
  constexpr double kSteps = 16384;
  const TriMesh& surface = copy.surface;
  const Vec3 size = surface.points.empty() ? Vec3{} : bounding_box(surface.points).extent();
  const double step = step_of(std::max({size.x, size.y, size.z}), kSteps);
  std::string file;
  append(file, kMagic);
  append(file, copy.values.empty() ? kFacesAndPoints
                                   : static_cast<std::uint16_t>(kFacesAndPoints | kValues));
  append(file, static_cast<std::uint32_t>(surface.triangles.size()));
  append(file, static_cast<std::uint32_t>(surface.points.size()));
  append(file, std::uint32_t{0});
  for (const Triangle& t : surface.triangles) {
    for (const Index corner : t) append(file, static_cast<std::int32_t>(corner));
  }
  const auto rounded = [&](double mm) { return static_cast<float>(step * std::round(mm / step)); };
  for (const Vec3& p : surface.points) {
    for (const double mm : {-p.x, -p.y, p.z}) append(file, rounded(mm));
  }
  append_values(file, copy.values);
  return well_gzipped(file);
}

}  // namespace mesamis::detail::page
