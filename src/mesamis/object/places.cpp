// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/places.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"

namespace mesamis::detail::object {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-6;  // voxels

/// A text as part of a message: short, and in one line.
std::string quoted(std::string_view text) {
  return "\"" + quotable(text) + (text.size() > kMostQuoted ? "...\"" : "\"");
}

std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(mark, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::optional<double> number(std::string_view text) { return written_number(trimmed(text)); }

/// One end of a box; open if nothing is written.
std::optional<double> end_of_box(std::string_view text, double open) {
  return trimmed(text).empty() ? std::optional(open) : number(text);
}

/// One part of a box, low and high end.
std::optional<std::array<double, 2>> part_of_box(std::string_view text) {
  if (trimmed(text).empty()) return std::array{-kInfinity, kInfinity};
  const auto ends = split(text, ':');
  if (ends.size() != 2) return std::nullopt;
  const auto low = end_of_box(ends[0], -kInfinity), high = end_of_box(ends[1], kInfinity);
  if (!low || !high || !(*low < *high)) return std::nullopt;
  return std::array{*low, *high};
}

/// "X0,Y0,Z0,X1,Y1,Z1", split; nothing for anything else.
std::optional<Box> box_of_corners(const std::vector<std::string_view>& parts) {
  if (parts.size() != 6) return std::nullopt;
  Box box;
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const auto low = number(parts[n]), high = number(parts[n + 3]);
    if (!low || !high || !(*low < *high)) return std::nullopt;
    box.lo[a] = *low;
    box.hi[a] = *high;
  }
  return box;
}

/// The box of two corners that may have changed places.
Box sorted(const Vec3& a, const Vec3& b) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::min(a[axis], b[axis]);
    box.hi[axis] = std::max(a[axis], b[axis]);
  }
  return box;
}

Vec3 corner(const Box& box, int n) {
  return {(n & 1) != 0 ? box.hi.x : box.lo.x, (n & 2) != 0 ? box.hi.y : box.lo.y,
          (n & 4) != 0 ? box.hi.z : box.lo.z};
}

/// The smallest box around the images of a box's corners.
template <class Map>
Box box_around(const Box& box, Map&& map) {
  Box around{map(corner(box, 0)), map(corner(box, 0))};
  for (int n = 1; n < 8; ++n) {
    const Vec3 p = map(corner(box, n));
    const Box both_lo = sorted(around.lo, p), both_hi = sorted(around.hi, p);
    around = {both_lo.lo, both_hi.hi};
  }
  return around;
}

/// Where a scan is, for messages.
std::string extent_text(const VoxelGrid& grid, Frame frame) {
  const Box box = world_box(grid, frame);
  std::array<char, 200> text;
  std::snprintf(text.data(), text.size(), "%.6g:%.6g,%.6g:%.6g,%.6g:%.6g mm (%s)", box.lo.x,
                box.hi.x, box.lo.y, box.hi.y, box.lo.z, box.hi.z, frame_name(frame));
  return text.data();
}

/// The voxels of an axis whose centres lie between two places on it.
std::array<Index, 2> voxels_between(double low, double high, double spacing, Index size) {
  const double first = std::ceil(low / spacing - kRounding);
  const double last = std::floor(high / spacing + kRounding);
  return {static_cast<Index>(std::clamp<double>(first, 0, size)),
          static_cast<Index>(std::clamp<double>(last + 1, 0, size))};
}

}  // namespace

Vec3 parse_point(std::string_view text, Frame frame) {
  const auto parts = split(text, ',');
  Vec3 point;
  bool fits = parts.size() == 3;
  for (int a = 0; fits && a < 3; ++a) {
    const auto value = number(parts[static_cast<std::size_t>(a)]);
    fits = value.has_value();
    if (fits) point[a] = *value;
  }
  if (!fits) throw InputError("point: expected X,Y,Z in mm, found " + quoted(text));
  return in_frame(point, frame);
}

std::array<Index, 3> voxel_at(const VoxelGrid& grid, const Vec3& world) {
  const Vec3 p = grid.to_grid(world);
  std::array<Index, 3> voxel{};
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const double at = p[a] / grid.spacing[a];
    if (!(at >= -0.5 - kRounding && at <= grid.size[n] - 0.5 + kRounding)) {
      std::array<char, 100> text;
      std::snprintf(text.data(), text.size(), "%.6g,%.6g,%.6g (LPS)", world.x, world.y, world.z);
      throw InputError("point: expected one within the scan, " + extent_text(grid, Frame::kLps) +
                       ", found " + text.data());
    }
    voxel[n] = std::clamp(static_cast<Index>(std::lround(at)), 0, grid.size[n] - 1);
  }
  return voxel;
}

Box parse_box(std::string_view text) {
  const auto parts = split(text, ',');
  if (const auto corners = box_of_corners(parts)) return *corners;
  Box box;
  bool fits = parts.size() == 3;
  for (int a = 0; fits && a < 3; ++a) {
    const auto part = part_of_box(parts[static_cast<std::size_t>(a)]);
    fits = part.has_value();
    if (!fits) break;
    box.lo[a] = (*part)[0];
    box.hi[a] = (*part)[1];
  }
  if (fits) return box;
  throw InputError(
      "box: expected X0:X1,Y0:Y1,Z0:Z1 in mm, each end below the other or left out, "
      "or X0,Y0,Z0,X1,Y1,Z1, found " +
      quoted(text));
}

CropRange box_to_range(const VoxelGrid& grid, std::string_view text, Frame frame) {
  const Box asked = parse_box(text);
  const Box of_scan = world_box(grid, Frame::kLps);
  const double room = norm(grid.spacing);
  Box box = sorted(in_frame(asked.lo, frame), in_frame(asked.hi, frame));
  for (int a = 0; a < 3; ++a) {
    box.lo[a] = std::clamp(box.lo[a], of_scan.lo[a] - room, of_scan.hi[a] + room);
    box.hi[a] = std::clamp(box.hi[a], of_scan.lo[a] - room, of_scan.hi[a] + room);
  }
  const Box in_grid = box_around(box, [&grid](const Vec3& p) { return grid.to_grid(p); });
  CropRange range;
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const auto [begin, end] =
        voxels_between(in_grid.lo[a], in_grid.hi[a], grid.spacing[a], grid.size[n]);
    if (end - begin < 2) {
      throw InputError("box: expected at least 2 voxels of the scan along each axis, which is at " +
                       extent_text(grid, frame) + ", found " + quoted(text));
    }
    range.begin[n] = begin;
    range.end[n] = end;
  }
  return range;
}

Box world_box(const VoxelGrid& grid, Frame frame) {
  return box_around(grid.box(), [&](const Vec3& p) { return in_frame(grid.to_world(p), frame); });
}

}  // namespace mesamis::detail::object
