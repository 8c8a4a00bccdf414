// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/contour_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::label_files {
namespace {

/// Half the sum of the cross products of neighbours: the area, along the normal.
Vec3 area_of(const Contour& contour) {
  const Vec3 origin = contour.points.front();
  Vec3 sum;
  for (std::size_t n = 1; n + 1 < contour.points.size(); ++n) {
    sum = sum + cross(contour.points[n] - origin, contour.points[n + 1] - origin);
  }
  return 0.5 * sum;
}

template <class Visit>
void for_each_contour(const StructureSet& set, Visit visit) {
  for (std::size_t n = 0; n < set.regions.size(); ++n) {
    for (const Contour& contour : set.regions[n].contours) visit(n, contour);
  }
}

constexpr double kSameNormal = 2e-3;  // of unit vectors

/// The normal of most contours: that of the largest one, improved by those that nearly share it.
Vec3 main_normal(const StructureSet& set) {
  constexpr double kNear = 0.996;  // cosine of 5 degrees
  Vec3 largest, sum;
  for_each_contour(set, [&](std::size_t, const Contour& contour) {
    const Vec3 area = area_of(contour);
    if (norm(area) > norm(largest)) largest = area;
  });
  const Vec3 first = unit_or_zero(largest);
  for_each_contour(set, [&](std::size_t, const Contour& contour) {
    const Vec3 area = area_of(contour);
    const double along = dot(area, first);
    if (std::abs(along) >= kNear * norm(area)) sum = sum + (along < 0 ? -1.0 : 1.0) * area;
  });
  return unit_or_zero(sum);
}

/// Axes in which contours are flat, and what is known of the pixels.
struct PlaneAxes {
  Vec3 across, down, normal;
  Vec3 origin;
  std::optional<std::array<int, 3>> scan_axes;  // where they are those of the scan
};

Vec3 column_of(const Mat3& m, int column) {
  return transpose(m).rows[static_cast<std::size_t>(column)];
}

PlaneAxes axes_of(const Vec3& normal, const std::optional<VoxelGrid>& scan) {
  for (int a = 0; scan && a < 3; ++a) {
    const Vec3 axis = column_of(scan->direction, a);
    if (norm(cross(axis, normal)) > kSameNormal) continue;
    const std::array<int, 3> axes{(a + 1) % 3, (a + 2) % 3, a};
    return {column_of(scan->direction, axes[0]), column_of(scan->direction, axes[1]), axis,
            scan->origin, axes};
  }
  Vec3 n = normal;
  for (int a = 0; a < 3; ++a) {
    Vec3 axis;
    axis[a] = 1;
    if (norm(cross(axis, normal)) <= kSameNormal) n = axis;  // rounded decimals
  }
  const Vec3 aside = std::abs(n.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = unit_or_zero(aside - dot(aside, n) * n);
  return {across, cross(n, across), n, {}, std::nullopt};
}

/// A contour in the axes, mm.
struct FlatContour {
  std::size_t region = 0;
  double height = 0;
  std::vector<PlanePoint> points;
  bool exclusive = false;
};

struct FlatContours {
  std::vector<FlatContour> all;  // by ascending height
  std::size_t askew = 0;         // left out
};

/// In the axes; none if it does not lie across the normal.
std::optional<FlatContour> flattened(const Contour& contour, const PlaneAxes& axes) {
  FlatContour flat;
  double least = std::numeric_limits<double>::max(), most = -least, extent = 0;
  for (const Vec3& point : contour.points) {
    const Vec3 p = point - axes.origin;
    const double height = dot(p, axes.normal);
    least = std::min(least, height);
    most = std::max(most, height);
    extent = std::max(extent, norm(point - contour.points.front()));
    flat.points.push_back({dot(p, axes.across), dot(p, axes.down)});
  }
  constexpr double kRounding = 0.02, kTurn = 1e-3;  // mm of decimals; of the contour's extent
  if (!(most - least <= kRounding + kTurn * extent)) return std::nullopt;
  flat.height = (least + most) / 2;
  flat.exclusive = contour.exclusive;
  return flat;
}

FlatContours flatten(const StructureSet& set, const PlaneAxes& axes) {
  FlatContours flat;
  for_each_contour(set, [&](std::size_t region, const Contour& contour) {
    auto one = flattened(contour, axes);
    if (!one) {
      ++flat.askew;
      return;
    }
    one->region = region;
    flat.all.push_back(std::move(*one));
  });
  std::stable_sort(flat.all.begin(), flat.all.end(),
                   [](const auto& a, const auto& b) { return a.height < b.height; });
  return flat;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Contours whose heights differ by rounding lie in one plane: they get its height.
/// @return the heights of the planes.
std::vector<double> join_planes(std::vector<FlatContour>& contours) {
  constexpr double kLeastGap = 1e-3, kMostTolerance = 0.1;  // mm
  std::vector<double> gaps;
  for (std::size_t n = 1; n < contours.size(); ++n) {
    const double gap = contours[n].height - contours[n - 1].height;
    if (gap > kLeastGap) gaps.push_back(gap);
  }
  const double tolerance =
      gaps.empty() ? kMostTolerance : std::clamp(0.05 * median_of(gaps), kLeastGap, kMostTolerance);
  std::vector<double> planes;
  for (FlatContour& contour : contours) {
    if (planes.empty() || contour.height - planes.back() > tolerance) {
      planes.push_back(contour.height);
    }
    contour.height = planes.back();
  }
  return planes;
}

/// The distance of the grid's planes.
struct PlaneStep {
  double mm = 0;  // 0: there is only one plane
  bool even = true;
};

/// The least distance, if all others are multiples of it; else as fine as need be.
PlaneStep step_of(const std::vector<double>& planes) {
  if (planes.size() < 2) return {};
  std::vector<double> gaps;
  for (std::size_t n = 1; n < planes.size(); ++n) gaps.push_back(planes[n] - planes[n - 1]);
  const double least = *std::min_element(gaps.begin(), gaps.end());
  double steps = 0;
  for (const double gap : gaps) steps += std::round(gap / least);
  const double step = (planes.back() - planes.front()) / steps;
  constexpr double kTolerance = 0.05;  // of a step, for each gap
  for (const double gap : gaps) {
    if (std::abs(gap / step - std::round(gap / step)) <= kTolerance) continue;
    return {std::max(least, 0.25 * median_of(gaps)), false};
  }
  return {step, true};
}

/// A range of numbers; empty at first.
struct Range {
  double least = std::numeric_limits<double>::max(), most = -std::numeric_limits<double>::max();
  void include(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
};

/// The median length of an edge, but no more than a plane's distance and no less than 1/512 of all.
double pixel_size(const std::vector<FlatContour>& contours, double step) {
  std::vector<double> lengths;
  Range x, y;
  for (const FlatContour& contour : contours) {
    PlanePoint last = contour.points.back();
    for (const PlanePoint& point : contour.points) {
      const double length = std::hypot(point.x - last.x, point.y - last.y);
      if (length > 0) lengths.push_back(length);
      x.include(point.x);
      y.include(point.y);
      last = point;
    }
  }
  if (lengths.empty()) return 1;
  const double extent = std::max(x.most - x.least, y.most - y.least);
  const double most = step > 0 ? step : extent / 16;
  return std::max(std::min(median_of(std::move(lengths)), most), extent / 512);
}

/// The grid while its lengths are found: one axis after another.
class GridBuilder {
 public:
  GridBuilder(const std::filesystem::path& file, const PlaneAxes& axes,
              const std::optional<VoxelGrid>& scan)
      : file_(file), axes_(axes), scan_(scan) {}

  /// The lattice and its part that the contours need.
  VoxelGrid build(const std::vector<FlatContour>& contours, const std::vector<double>& planes,
                  double step) {
    Range x, y;
    for (const FlatContour& contour : contours) {
      for (const PlanePoint& point : contour.points) x.include(point.x), y.include(point.y);
    }
    const double pixel = axes_.scan_axes ? 0 : pixel_size(contours, step);
    add_pixels(0, x, pixel);
    add_pixels(1, y, pixel);
    add_planes(planes, step > 0 ? step : thickness(pixel));
    grid_.direction = transpose(Mat3{{axes_.across, axes_.down, axes_.normal}});
    grid_.origin = axes_.origin + grid_.direction * first_;
    return grid_;
  }

 private:
  int scan_axis(int axis) const { return (*axes_.scan_axes)[static_cast<std::size_t>(axis)]; }
  Index scan_size(int axis) const { return scan_->size[static_cast<std::size_t>(scan_axis(axis))]; }
  /// Of a single plane.
  double thickness(double pixel) const {
    return axes_.scan_axes ? scan_->spacing[scan_axis(2)] : pixel;
  }

  void add_pixels(int axis, const Range& range, double pixel) {
    const double step = axes_.scan_axes ? scan_->spacing[scan_axis(axis)] : pixel;
    double first = std::floor(range.least / step + 0.5) - 1;
    double last = std::floor(range.most / step + 0.5) + 1;
    if (axes_.scan_axes) {
      first = std::max(first, 0.0);
      last = std::min(last, scan_size(axis) - 1.0);
    }
    set(axis, first * step, step, last - first + 1);
  }

  void add_planes(const std::vector<double>& planes, double step) {
    const double least = planes.front() - step, most = planes.back() + step;
    set(2, least, step, std::floor((most - least) / step + 1.5));
  }

  void set(int axis, double first, double step, double count) {
    if (!(count >= 1)) refuse(file_, "expected contours within the scan, found none");
    constexpr double kMost = 1e6;
    if (!(count <= kMost)) {
      refuse(file_, message("expected contours on a grid of at most ", kMost,
                            " voxels along an axis, found ", count));
    }
    first_[axis] = first;
    grid_.spacing[axis] = step;
    grid_.size[static_cast<std::size_t>(axis)] = static_cast<Index>(count);
  }

  const std::filesystem::path& file_;
  const PlaneAxes& axes_;
  const std::optional<VoxelGrid>& scan_;
  VoxelGrid grid_;
  Vec3 first_;
};

/// Whether all planes are slices of the scan.
bool are_slices(const std::vector<double>& planes, const PlaneAxes& axes, const VoxelGrid& scan) {
  if (!axes.scan_axes) return false;
  const int axis = (*axes.scan_axes)[2];
  const double last = scan.size[static_cast<std::size_t>(axis)] - 1;
  return std::all_of(planes.begin(), planes.end(), [&](double height) {
    const double slice = height / scan.spacing[axis];
    return std::abs(slice - std::round(slice)) <= 0.05 && slice > -0.5 && slice < last + 0.5;
  });
}

/// Contours beyond the ends of a scan cannot be shown on it.
void drop_beyond(FlatContours& flat, const PlaneAxes& axes, const std::optional<VoxelGrid>& scan) {
  if (!scan || !axes.scan_axes) return;
  const int axis = (*axes.scan_axes)[2];
  const double step = scan->spacing[axis];
  const double end = step * scan->size[static_cast<std::size_t>(axis)];
  std::erase_if(flat.all, [&](const FlatContour& c) {
    return c.height < -2 * step || c.height > end + 2 * step;
  });
}

void require_size(const std::filesystem::path& file, const VoxelGrid& grid,
                  const std::optional<VoxelGrid>& scan) {
  constexpr double kMostPerByte = 8192;
  double voxels = 1;
  for (const Index n : grid.size) voxels *= n;
  const double allowed = kMostPerByte * static_cast<double>(size_of(file)) +
                         (scan ? static_cast<double>(scan->voxel_count()) : 0.0);
  if (voxels <= allowed) return;
  refuse(file, message("expected contours on at most ", kMostPerByte,
                       " voxels per byte of the file, found ", grid.size[0], " x ", grid.size[1],
                       " x ", grid.size[2], " voxels"));
}

}  // namespace

ContourGrid place_contours(const std::filesystem::path& file, const StructureSet& set,
                           const std::optional<VoxelGrid>& scan) {
  const Vec3 normal = main_normal(set);
  if (!(norm(normal) > 0.5))
    refuse(file, "expected contours with an inside, found lines and points");
  const PlaneAxes axes = axes_of(normal, scan);
  FlatContours flat = flatten(set, axes);
  drop_beyond(flat, axes, scan);
  if (flat.all.empty()) refuse(file, "expected contours within the scan, found none");
  const std::vector<double> planes = join_planes(flat.all);
  const PlaneStep step = step_of(planes);
  ContourGrid out;
  out.grid = GridBuilder(file, axes, scan).build(flat.all, planes, step.mm);
  require_size(file, out.grid, scan);
  out.on_scan = scan && are_slices(planes, axes, *scan);
  out.contours.resize(set.regions.size());
  const VoxelGrid& grid = out.grid;
  const Vec3 first = transpose(grid.direction) * (grid.origin - axes.origin);
  for (FlatContour& contour : flat.all) {
    PlaneContour placed{(contour.height - first.z) / grid.spacing.z, std::move(contour.points),
                        contour.exclusive};
    for (PlanePoint& p : placed.points) {
      p = {(p.x - first.x) / grid.spacing.x, (p.y - first.y) / grid.spacing.y};
    }
    out.contours[contour.region].push_back(std::move(placed));
  }
  if (flat.askew > 0) {
    out.warnings.push_back(message(flat.askew,
                                   " contours left out that do not lie in the planes of the "
                                   "others, across ",
                                   axes.normal.x, " ", axes.normal.y, " ", axes.normal.z));
  }
  if (!step.even) {
    out.warnings.push_back(message("the planes of the contours lie at uneven distances: labels ",
                                   step.mm, " mm apart are taken from the nearest one"));
  }
  if (!axes.scan_axes) {
    out.warnings.push_back(message("contours state no pixels: labels of ", grid.spacing.x, " x ",
                                   grid.spacing.y, " x ", grid.spacing.z, " mm are made"));
  }
  return out;
}

}  // namespace mesamis::detail::label_files
