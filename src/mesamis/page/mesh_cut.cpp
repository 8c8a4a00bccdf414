// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/mesh_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

namespace mesamis::detail::page {
namespace {

/// A corner of a cell on the plane: pixels, and its grey value.
struct Corner {
  double x = 0, y = 0, grey = 0;
};

/// Which cell each pixel shows, and its grey value there.
class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width),
        height_(height),
        cell_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kNoIndex),
        grey_(cell_.size(), 0) {}

  void fill(const Corner& a, const Corner& b, const Corner& c, Index cell) {
    visit_pixels({{{a.x, a.y}, {b.x, b.y}, {c.x, c.y}}}, {width_, height_},
                 [&](int x, int y, double in_b, double in_c) {
                   const std::size_t at = place(x, y);
                   cell_[at] = cell;
                   grey_[at] = static_cast<float>(a.grey + in_b * (b.grey - a.grey) +
                                                  in_c * (c.grey - a.grey));
                 });
  }

  /// Cells in their colours; where two meet, darker.
  Raster picture() const {
    Raster drawn = blank(width_, height_, {255, 255, 255});
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t at = place(x, y);
        if (cell_[at] == kNoIndex) continue;
        Colour colour = map_colour(grey_[at]);
        if (is_edge(x, y)) {
          for (std::uint8_t& c : colour) c = static_cast<std::uint8_t>(c * 2 / 5);
        }
        std::copy(colour.begin(), colour.end(), drawn.bytes.data() + drawn.offset(x, y));
      }
    }
    return drawn;
  }

 private:
  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  bool is_edge(int x, int y) const {
    const Index cell = cell_[place(x, y)];
    return (x + 1 < width_ && cell_[place(x + 1, y)] != cell) ||
           (y + 1 < height_ && cell_[place(x, y + 1)] != cell);
  }

  int width_, height_;
  std::vector<Index> cell_;
  std::vector<float> grey_;
};

/// Where the plane meets the edge between two nodes.
Corner between(const std::array<Vec3, 4>& nodes, const std::array<double, 4>& grey, std::size_t a,
               std::size_t b) {
  const double t = nodes[a].z / (nodes[a].z - nodes[b].z);
  return {nodes[a].x + t * (nodes[b].x - nodes[a].x), nodes[a].y + t * (nodes[b].y - nodes[a].y),
          grey[a] + t * (grey[b] - grey[a])};
}

void draw_cell(Canvas& canvas, const std::array<Vec3, 4>& nodes, const std::array<double, 4>& grey,
               Index cell) {
  std::vector<std::size_t> below, above;
  for (std::size_t n = 0; n < 4; ++n) (nodes[n].z < 0 ? below : above).push_back(n);
  if (below.empty() || above.empty()) return;
  const auto at = [&](std::size_t a, std::size_t b) { return between(nodes, grey, a, b); };
  if (below.size() == 2) {
    const Corner p = at(below[0], above[0]), r = at(below[1], above[1]);
    canvas.fill(p, at(below[0], above[1]), r, cell);
    canvas.fill(p, r, at(below[1], above[0]), cell);
    return;
  }
  const auto& [one, three] = below.size() == 1 ? std::tie(below, above) : std::tie(above, below);
  canvas.fill(at(one[0], three[0]), at(one[0], three[1]), at(one[0], three[2]), cell);
}

}  // namespace

Colour map_colour(double grey) {
  constexpr std::array<std::array<double, 3>, 5> kStops{
      {{24, 34, 74}, {38, 84, 124}, {62, 137, 137}, {142, 190, 128}, {250, 240, 190}}};
  const double at = std::clamp(grey / 255, 0.0, 1.0) * (kStops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double share = at - static_cast<double>(stop);
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    colour[c] = static_cast<std::uint8_t>(
        std::lround((1 - share) * kStops[stop][c] + share * kStops[stop + 1][c]));
  }
  return colour;
}

PageBox region_around(const std::vector<std::vector<PageLine>>& outlines, const PageBox& box) {
  PageBox found{box.right, box.left, box.top, box.bottom};
  for (const auto& lines : outlines) {
    for (const PageLine& line : lines) {
      for (const auto& [x, y] : line) {
        found = {std::min(found.left, x), std::max(found.right, x), std::min(found.bottom, y),
                 std::max(found.top, y)};
      }
    }
  }
  if (!(found.width() > 0 && found.height() > 0)) return box;
  const double margin = 0.1 * std::max(found.width(), found.height());
  return {std::max(box.left, found.left - margin), std::min(box.right, found.right + margin),
          std::max(box.bottom, found.bottom - margin), std::min(box.top, found.top + margin)};
}

Raster mesh_cut(const ShownMesh& mesh, const VoxelGrid& grid, const SlicePlane& plane,
                const CutRegion& region) {
  // Drawn twice as large, for smooth edges.
  const PageBox& box = region.box;
  const double scale = 2 * region.pixels / std::max(box.width(), box.height());
  const auto even = [](double length) { return 2 * std::max(1, static_cast<int>(length / 2)); };
  Canvas canvas(even(scale * box.width()), even(scale * box.height()));
  std::vector<Vec3> points;
  points.reserve(mesh.mesh->points.size());
  for (const Vec3& p : mesh.mesh->points) {
    const Vec3 page = to_page(grid, plane, p);
    points.push_back({scale * (page.x - box.left), scale * (box.top - page.y), page.z});
  }
  for (std::size_t c = 0; c < mesh.mesh->cells.size(); ++c) {
    std::array<Vec3, 4> nodes;
    std::array<double, 4> grey{};
    for (std::size_t n = 0; n < 4; ++n) {
      const auto point = static_cast<std::size_t>(mesh.mesh->cells[c][n]);
      nodes[n] = points[point];
      grey[n] = mesh.grey[point];
    }
    draw_cell(canvas, nodes, grey, static_cast<Index>(c));
  }
  return halved(canvas.picture());
}

}  // namespace mesamis::detail::page
