// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/slice_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/page/base64.h"
#include "mesamis/page/html.h"
#include "mesamis/page/mesh_cut.h"

namespace mesamis::detail::page {
namespace {

constexpr std::array<const char*, 3> kNames{"sagittal", "coronal", "axial"};
constexpr Index kMostPixels = 720;  // along a side of the slice

std::uint8_t shade(double value, const Window& window) {
  const double share = (value - window.low) / (window.high - window.low);
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

/// Voxels per pixel along a grid axis.
Index step_along(const VoxelGrid& grid, int axis) {
  return (grid.size[static_cast<std::size_t>(axis)] + kMostPixels - 1) / kMostPixels;
}

Raster voxels_of(const VolumeView& scan, const SlicePlane& plane, const Window& window) {
  const auto [right, up, deep] = plane.axis;
  const Index step_x = step_along(scan, right), step_y = step_along(scan, up);
  const Index nx = scan.size[static_cast<std::size_t>(right)],
              ny = scan.size[static_cast<std::size_t>(up)];
  Raster picture{(nx + step_x - 1) / step_x, (ny + step_y - 1) / step_y, true, {}};
  picture.bytes.resize(picture.offset(0, picture.height));
  std::array<Index, 3> voxel{};
  voxel[static_cast<std::size_t>(deep)] = plane.index;
  for (int y = 0; y < picture.height; ++y) {
    // The page's first row is its upper one.
    const Index row = std::min(y * step_y, ny - 1);
    voxel[static_cast<std::size_t>(up)] = plane.sign[1] > 0 ? ny - 1 - row : row;
    for (int x = 0; x < picture.width; ++x) {
      const Index column = std::min(x * step_x, nx - 1);
      voxel[static_cast<std::size_t>(right)] = plane.sign[0] > 0 ? column : nx - 1 - column;
      picture.bytes[picture.offset(x, y)] = shade(scan.at(voxel[0], voxel[1], voxel[2]), window);
    }
  }
  return picture;
}

std::string hex(const Colour& c) { return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]); }

/// mm from the upper left corner of the box.
std::array<double, 2> in_box(const PageBox& box, const std::array<double, 2>& p) {
  return {p[0] - box.left, box.top - p[1]};
}

std::string path_of(const std::vector<PageLine>& lines, const PageBox& box) {
  std::string d;
  for (const PageLine& line : lines) {
    for (std::size_t n = 0; n < line.size(); ++n) {
      const auto [x, y] = in_box(box, line[n]);
      d += fmt::format("{}{:.2f} {:.2f}", n == 0 ? "M" : "L", x, y);
    }
  }
  return d;
}

std::size_t points_of(const std::vector<std::vector<PageLine>>& outlines) {
  std::size_t points = 0;
  for (const auto& lines : outlines) {
    for (const PageLine& line : lines) points += line.size();
  }
  return points;
}

std::vector<std::vector<PageLine>> thinned(const std::vector<std::vector<PageLine>>& outlines,
                                           double step) {
  std::vector<std::vector<PageLine>> few;
  for (const auto& lines : outlines) {
    few.emplace_back();
    for (const PageLine& line : lines) {
      PageLine kept = thin_line(line, step);
      if (!kept.empty()) few.back().push_back(std::move(kept));
    }
  }
  return few;
}

/// Outlines as an SVG takes them: within half a pixel of a picture of 1000 pixels, or of as few as
/// the bound on points asks for.
std::vector<std::vector<PageLine>> drawn_outlines(const SliceView& view) {
  constexpr double kPixels = 1000;
  constexpr std::size_t kMostPoints = 60'000;  // about 0.8 MB
  constexpr int kMostDoublings = 12;
  double step = std::max(view.box.width(), view.box.height()) / kPixels / 2;
  auto few = thinned(view.outlines, step);
  for (int n = 0; n < kMostDoublings && points_of(few) > kMostPoints; ++n) {
    step *= 2;
    few = thinned(view.outlines, step);
  }
  return few;
}

Html letter(char c, double x, double y) {
  return of_class("text", "side")
      .set("x", fmt::format("{:.2f}", x))
      .set("y", fmt::format("{:.2f}", y))
      .text(std::string(1, c));
}

/// The sides of the body; sizes follow the slice.
std::string letters_svg(const SliceView& view, const PageBox& shown, double size) {
  const double w = shown.width(), h = shown.height(), edge = 0.9 * size;
  const auto& l = view.plane.letters;
  return letter(l[0], edge, h / 2).str() + letter(l[1], w - edge, h / 2).str() +
         letter(l[2], w / 2, h - edge).str() + letter(l[3], w / 2, edge).str();
}

std::string scale_bar_svg(const PageBox& shown, double size) {
  const double length = bar_length(shown.width()), y = shown.height() - size;
  Html bar = of_class("path", "bar");
  bar.set("d", fmt::format("M{0:.2f} {1:.2f}H{2:.2f}", size, y, size + length));
  Html label = of_class("text", "bar-label");
  label.set("x", fmt::format("{:.2f}", size + length / 2));
  label.set("y", fmt::format("{:.2f}", y - 0.7 * size)).text(fmt::format("{:g} mm", length));
  return bar.str() + label.str();
}

}  // namespace

SlicePlane plane_through(const VoxelGrid& grid, std::span<const ShownSurface> surfaces, int axis) {
  std::vector<const TriMesh*> meshes;
  for (const ShownSurface& s : surfaces) meshes.push_back(s.surface);
  const double position = middle_of(meshes, axis);
  try {
    return slice_plane(grid, axis, meshes.empty() ? nullptr : &position);
  } catch (const InputError&) {
    return slice_plane(grid, axis, nullptr);
  }
}

PageBox box_of(const VoxelGrid& grid, const SlicePlane& plane) {
  std::array<std::array<double, 2>, 2> ends{};  // along the page's right and up
  for (std::size_t side = 0; side < 2; ++side) {
    const int axis = plane.axis[side];
    const double half = grid.spacing[axis] / 2, length = grid.box().hi[axis];
    ends[side] =
        plane.sign[side] > 0 ? std::array{-half, length + half} : std::array{-length - half, half};
  }
  return {ends[0][0], ends[0][1], ends[1][0], ends[1][1]};
}

SliceView slice_view(const VolumeView& scan, std::span<const ShownSurface> surfaces, int axis,
                     const Window& window) {
  SliceView view;
  view.name = kNames[static_cast<std::size_t>(axis)];
  view.plane = plane_through(scan, surfaces, axis);
  view.box = box_of(scan, view.plane);
  view.voxels = voxels_of(scan, view.plane, window);
  for (const ShownSurface& s : surfaces) {
    view.outlines.push_back(cross_section(*s.surface, scan, view.plane));
  }
  return view;
}

double bar_length(double width) {
  const double about = width / 4, power = std::pow(10, std::floor(std::log10(about)));
  const double digits = about / power;
  return power * (digits >= 5 ? 5 : digits >= 2 ? 2 : 1);
}

PageLine thin_line(const PageLine& line, double step) {
  if (line.size() < 2) return {};
  PageLine kept{line.front()};
  for (std::size_t n = 1; n + 1 < line.size(); ++n) {
    const auto& [x, y] = line[n];
    if (std::hypot(x - kept.back()[0], y - kept.back()[1]) > step) kept.push_back(line[n]);
  }
  if (kept.size() == 1 && line.front() == line.back()) return {};
  kept.push_back(line.back());
  return kept;
}

std::string slice_svg(const SliceView& view, std::span<const ShownSurface> surfaces) {
  const PageBox shown = region_around(view.outlines, view.box);
  const double w = shown.width(), h = shown.height(), size = std::max(w, h) / 32;
  Html svg = of_class("svg", "slice");
  svg.set("xmlns", "http://www.w3.org/2000/svg").set("role", "img");
  svg.set("viewBox", fmt::format("0 0 {:.3f} {:.3f}", w, h));
  svg.set("aria-label", fmt::format("{} slice at {:.1f} mm with the outline of the surface",
                                    view.name, view.plane.position));
  svg.set("style", fmt::format("--size:{:.3f}px", size));
  const auto corner = in_box(shown, {view.box.left, view.box.top});
  svg.add(Html("image")
              .set("x", fmt::format("{:.3f}", corner[0]))
              .set("y", fmt::format("{:.3f}", corner[1]))
              .set("width", fmt::format("{:.3f}", view.box.width()))
              .set("height", fmt::format("{:.3f}", view.box.height()))
              .set("preserveAspectRatio", "none")
              .set("href", "data:image/png;base64," + base64(png_bytes(view.voxels))));
  const auto outlines = drawn_outlines(view);
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    if (outlines[n].empty()) continue;
    svg.add(of_class("path", "outline")
                .set("stroke", hex(surfaces[n].outline))
                .set("d", path_of(outlines[n], shown)));
  }
  svg.raw(letters_svg(view, shown, size)).raw(scale_bar_svg(shown, size));
  return svg.str();
}

Raster slice_picture(const SliceView& view, std::span<const ShownSurface> surfaces, int pixels) {
  const double per_mm = pixels / std::max(view.box.width(), view.box.height());
  const auto repeated = [&](double mm, int count) {
    return std::max(1, static_cast<int>(std::lround(mm * per_mm / count)));
  };
  const int columns = repeated(view.box.width(), view.voxels.width);
  const int rows = repeated(view.box.height(), view.voxels.height);
  Raster picture = enlarged(view.voxels, columns, rows);
  const double scale_x = picture.width / view.box.width();
  const double scale_y = picture.height / view.box.height();
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    for (const PageLine& line : view.outlines[n]) {
      for (std::size_t p = 1; p < line.size(); ++p) {
        const auto a = in_box(view.box, line[p - 1]), b = in_box(view.box, line[p]);
        draw_line(picture, {{{a[0] * scale_x, a[1] * scale_y}, {b[0] * scale_x, b[1] * scale_y}}},
                  1.8, surfaces[n].outline);
      }
    }
  }
  return picture;
}

}  // namespace mesamis::detail::page
