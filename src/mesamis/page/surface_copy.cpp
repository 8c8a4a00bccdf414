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

namespace mesamis::detail {
namespace {

using Place = std::array<std::int64_t, 3>;

TriMesh clustered(const TriMesh& surface, double cell) {
  std::vector<std::pair<Place, Index>> places;
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    Place place{};
    for (std::size_t a = 0; a < 3; ++a) {
      place[a] = std::llround(std::floor(surface.points[n][static_cast<int>(a)] / cell));
    }
    places.emplace_back(place, static_cast<Index>(n));
  }
  std::sort(places.begin(), places.end());
  TriMesh coarse;
  std::vector<Index> number(surface.points.size());
  for (std::size_t n = 0; n < places.size();) {
    Vec3 sum;
    std::size_t end = n;
    for (; end < places.size() && places[end].first == places[n].first; ++end) {
      sum += surface.points[static_cast<std::size_t>(places[end].second)];
      number[static_cast<std::size_t>(places[end].second)] =
          static_cast<Index>(coarse.points.size());
    }
    coarse.points.push_back((1 / static_cast<double>(end - n)) * sum);
    n = end;
  }
  for (Triangle t : surface.triangles) {
    for (Index& corner : t) corner = number[static_cast<std::size_t>(corner)];
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) coarse.triangles.push_back(t);
  }
  return coarse;
}

template <class T>
void append(std::string& to, T value) {
  static_assert(std::endian::native == std::endian::little);
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  to.append(bytes.data(), bytes.size());
}

}  // namespace

TriMesh coarse_surface(const TriMesh& surface, std::int64_t most) {
  if (static_cast<std::int64_t>(surface.triangles.size()) <= most) return surface;
  constexpr double kGrowth = 1.25;
  // About two triangles for each cell that the surface passes through.
  double cell = std::sqrt(2 * surface_area(surface) / static_cast<double>(most));
  if (!(cell > 0)) return surface;
  TriMesh coarse = clustered(surface, cell);
  while (static_cast<std::int64_t>(coarse.triangles.size()) > most) {
    cell *= kGrowth;
    coarse = clustered(surface, cell);
  }
  return coarse;
}

std::string mz3_gz(const TriMesh& surface) {
  constexpr std::uint16_t kMagic = 23117, kFacesAndPoints = 3;
  constexpr double kSteps = 16384;
  const Vec3 size = surface.points.empty() ? Vec3{} : bounding_box(surface.points).extent();
  // A power of two, so that rounded points are short numbers in single precision.
  const double step =
      std::exp2(std::floor(std::log2(std::max({size.x, size.y, size.z, 1e-6}) / kSteps)));
  std::string file;
  append(file, kMagic);
  append(file, kFacesAndPoints);
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
  return well_gzipped(file);
}

}  // namespace mesamis::detail
