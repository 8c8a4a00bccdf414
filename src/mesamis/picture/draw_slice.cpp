// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/picture/annotation.h"
#include "mesamis/picture/color_scale.h"
#include "mesamis/picture/picture.h"
#include "mesamis/picture/scene.h"
#include "mesamis/picture/slice.h"

namespace mesamis {

namespace {

constexpr Colour kOutline{255, 107, 13};

/// A slice of a volume as it lies on the page: grey values, the first row is the lowest.
class SliceImage {
 public:
  SliceImage(const Volume& volume, const SlicePlane& plane, const ValueRange& window) {
    const auto [right, up, deep] = plane.axis;
    size_ = {volume.size[static_cast<std::size_t>(right)],
             volume.size[static_cast<std::size_t>(up)]};
    spacing_ = {volume.spacing[right], volume.spacing[up]};
    for (std::size_t n = 0; n < 2; ++n) {
      corner_[n] = plane.sign[n] < 0 ? -(size_[n] - 1) * spacing_[n] : 0;
    }
    std::array<Index, 3> voxel{};
    voxel[static_cast<std::size_t>(deep)] = plane.index;
    for (Index y = 0; y < size_[1]; ++y) {
      voxel[static_cast<std::size_t>(up)] = plane.sign[1] < 0 ? size_[1] - 1 - y : y;
      for (Index x = 0; x < size_[0]; ++x) {
        voxel[static_cast<std::size_t>(right)] = plane.sign[0] < 0 ? size_[0] - 1 - x : x;
        const double value = volume.at(voxel[0], voxel[1], voxel[2]);
        const double share = (value - window.lo) / (window.hi - window.lo);
        greys_.push_back(std::isfinite(value) ? grey(share)[0] : grey(0)[0]);
      }
    }
  }

  /// The corners of the slice, through the middles of its outer voxels, mm on the page.
  std::array<Vec3, 2> corners() const {
    return {Vec3{corner_[0], corner_[1], 0}, Vec3{corner_[0] + (size_[0] - 1) * spacing_[0],
                                                  corner_[1] + (size_[1] - 1) * spacing_[1], 0}};
  }

  /// The grey value at a place on the page, between the voxels; those outside are at the border.
  double at(const std::array<double, 2>& page) const {
    std::array<Index, 2> voxel{};
    std::array<double, 2> share{};
    for (std::size_t n = 0; n < 2; ++n) {
      const double place =
          std::clamp((page[n] - corner_[n]) / spacing_[n], 0.0, double{1} * (size_[n] - 1));
      voxel[n] = std::min(static_cast<Index>(place), size_[n] - 2);
      share[n] = place - voxel[n];
    }
    const auto row = [&](Index y) {
      const std::size_t first =
          static_cast<std::size_t>(voxel[1] + y) * static_cast<std::size_t>(size_[0]) +
          static_cast<std::size_t>(voxel[0]);
      return (1 - share[0]) * greys_[first] + share[0] * greys_[first + 1];
    };
    return (1 - share[1]) * row(0) + share[1] * row(1);
  }

 private:
  std::array<Index, 2> size_{};
  std::array<double, 2> spacing_{}, corner_{};
  std::vector<std::uint8_t> greys_;
};

/// The share of a pixel that lies between two places.
double share_between(int pixel, double lo, double hi) {
  return std::clamp(std::min(hi, pixel + 1.0) - std::max(lo, double{1} * pixel), 0.0, 1.0);
}

/// Draws the slice, each pixel as the mean of 3 x 3 places in it.
void add_image(Scene& scene, const SliceImage& image) {
  constexpr int kSamples = 3;
  const auto corners = image.corners();
  const Vec3& lo = corners[0];
  const Vec3& hi = corners[1];
  const Place first = scene.on_canvas(scene.to_pixel(lo)),
              last = scene.on_canvas(scene.to_pixel(hi));
  const double mm = scene.mm_per_pixel();
  const auto mean_of = [&](int x, int y) {
    double sum = 0;
    for (int s = 0; s < kSamples * kSamples; ++s) {
      const int row = s / kSamples;
      const double px = x + (s % kSamples + 0.5) / kSamples - first[0];
      const double py = first[1] - y - (row + 0.5) / kSamples;
      sum += image.at({lo.x + mm * px, lo.y + mm * py});
    }
    return static_cast<std::uint8_t>(std::lround(sum / (kSamples * kSamples)));
  };
  parallel_for_each(static_cast<std::size_t>(scene.size()[1]), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const double height = share_between(y, last[1], first[1]);
    if (height == 0) return;
    for (int x = 0; x < scene.size()[0]; ++x) {
      const double share = height * share_between(x, first[0], last[0]);
      if (share == 0) continue;
      const std::uint8_t value = mean_of(x, y);
      mix(scene.canvas(), {x, y}, {value, value, value}, share);
    }
  });
}

void add_outline(Scene& scene, const std::vector<std::array<Vec3, 2>>& segments) {
  std::vector<std::array<Place, 2>> lines;
  lines.reserve(segments.size());
  for (const auto& ends : segments) {
    lines.push_back({scene.on_canvas(scene.to_pixel({ends[0].x, ends[0].y, 0})),
                     scene.on_canvas(scene.to_pixel({ends[1].x, ends[1].y, 0}))});
  }
  draw_lines(scene.canvas(), lines, 1.6 * scene.unit(), kOutline);
}

void add_side_ticks(Scene& scene, const std::array<std::vector<SideTick>, 2>& ticks,
                    const Vec3& corner) {
  for (const SideTick& tick : ticks[0]) {
    add_tick(scene, scene.to_pixel({tick.at, corner.y, 0}), true, tick.text);
  }
  for (const SideTick& tick : ticks[1]) {
    add_tick(scene, scene.to_pixel({corner.x, tick.at, 0}), false, tick.text);
  }
}

ValueRange window_of(const Volume& volume, const PictureOptions& options) {
  if (!options.window) return slice_window(volume);
  const auto [low, high] = *options.window;
  if (low < high && std::isfinite(low) && std::isfinite(high)) return {low, high};
  throw InputError("picture: expected a window from low to high, found " + short_number(low) +
                   " to " + short_number(high));
}

/// Adds the letters of the body's sides around the slice, beyond its ticks.
void add_side_letters(Scene& scene, const SlicePlane& plane, const std::array<Vec3, 2>& corners) {
  const auto lo = scene.to_pixel(corners[0]), hi = scene.to_pixel(corners[1]);
  const double gap = 18 * scene.unit(), left = 62 * scene.unit(), below = 36 * scene.unit();
  const double x = (lo[0] + hi[0]) / 2, y = (lo[1] + hi[1]) / 2;
  const std::array<std::array<double, 2>, 4> places{
      {{lo[0] - left, y}, {hi[0] + gap, y}, {x, lo[1] - below}, {x, hi[1] + gap}}};
  for (std::size_t i = 0; i < 4; ++i) {
    add_label(scene, {std::string(1, plane.letters[i]), places[i], Align::kCenter, 20, true});
  }
}

std::string slice_label(const Volume& volume, const SlicePlane& plane, int axis) {
  constexpr std::array<const char*, 3> kNames{"sagittal  x = ", "coronal  y = ", "axial  z = "};
  return kNames[static_cast<std::size_t>(axis)] + short_number(plane.position) + " mm   slice " +
         std::to_string(plane.index + 1) + " of " +
         std::to_string(volume.size[static_cast<std::size_t>(plane.axis[2])]);
}

}  // namespace

void draw_slice(const std::filesystem::path& png, const Volume& volume, const TriMesh* surface,
                const PictureOptions& options) {
  require_usable(volume);
  const int axis = options.clip ? options.clip->axis : 2;
  const SlicePlane plane =
      slice_plane(volume, axis, options.clip ? &options.clip->position : nullptr);
  const ColorBar bar{volume.modality == "CT" ? "HU" : "value", window_of(volume, options), grey};
  Scene scene(options.pixels);
  const SliceImage image(volume, plane, bar.range);
  const std::array<Vec3, 2> corners = image.corners();
  scene.fit({{0, 0, -1}, {0, 1, 0}}, corners, {0.09, kColorBarMargin, 0.14, 0.06});
  add_image(scene, image);
  if (surface != nullptr) add_outline(scene, outline(volume, plane, *surface));
  add_side_ticks(scene, side_ticks(volume, plane), corners[0]);
  add_side_letters(scene, plane, corners);
  add_color_bar(scene, bar);
  add_scale_bar(scene);
  add_corner_label(scene, slice_label(volume, plane, axis));
  scene.save(png);
}

}  // namespace mesamis
