// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/contour_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "mesamis/files/refuse.h"
#include "mesamis/label_files/layer_stack.h"

namespace mesamis::detail::label_files {
namespace {

/// A contour as shares of the pixels of a window.
struct FilledContour {
  PixelWindow window;
  std::vector<float> shares;
  double area = 0;  // pixels
  bool exclusive = false;
  int depth = 0;       // of how many others it lies inside
  bool again = false;  // the same as another one
};

float share_at(const FilledContour& contour, Index column, Index row) {
  const PixelWindow& w = contour.window;
  return contour
      .shares[static_cast<std::size_t>(row - w.top) * static_cast<std::size_t>(w.columns) +
              static_cast<std::size_t>(column - w.left)];
}

PixelWindow common_part(const PixelWindow& a, const PixelWindow& b) {
  PixelWindow both{std::max(a.left, b.left), std::max(a.top, b.top), 0, 0};
  both.columns = std::max(std::min(a.left + a.columns, b.left + b.columns) - both.left, 0);
  both.rows = std::max(std::min(a.top + a.rows, b.top + b.rows) - both.top, 0);
  return both;
}

/// Fills the contours of one plane and finds which lies inside of which.
class PlaneFiller {
 public:
  PlaneFiller(const std::filesystem::path& file, const PixelWindow& plane)
      : file_(file), plane_(plane) {}

  void add(const PlaneContour& contour) {
    FilledContour filled;
    filled.window = window_of(contour.points, plane_);
    spend(filled.window.pixels() + contour.points.size());
    filled.shares = pixel_shares(contour.points, filled.window);
    for (const float share : filled.shares) filled.area += static_cast<double>(share);
    filled.exclusive = contour.exclusive;
    if (filled.area > 0) contours_.push_back(std::move(filled));
  }

  /// @return whether some overlap partly.
  bool sort_by_depth() {
    bool overlap = false;
    for (std::size_t a = 0; a < contours_.size(); ++a) {
      for (std::size_t b = a + 1; b < contours_.size(); ++b) {
        overlap |= relate(contours_[a], contours_[b]);
      }
    }
    std::erase_if(contours_, [](const FilledContour& c) { return c.again && !c.exclusive; });
    std::stable_sort(contours_.begin(), contours_.end(),
                     [](const auto& a, const auto& b) { return a.depth < b.depth; });
    return overlap;
  }

  std::vector<float> shares() const {
    std::vector<float> plane(plane_.pixels());
    const bool exclusive = std::any_of(contours_.begin(), contours_.end(),
                                       [](const FilledContour& c) { return c.exclusive; });
    for (const FilledContour& contour : contours_) {
      const PixelWindow& w = contour.window;
      for (Index row = w.top; row < w.top + w.rows; ++row) {
        for (Index column = w.left; column < w.left + w.columns; ++column) {
          float& to = plane[static_cast<std::size_t>(row - plane_.top) *
                                static_cast<std::size_t>(plane_.columns) +
                            static_cast<std::size_t>(column - plane_.left)];
          const float share = share_at(contour, column, row);
          to = exclusive                ? std::abs(to - share)
               : contour.depth % 2 == 0 ? std::min(to + share, 1.0f)
                                        : std::max(to - share, 0.0f);
        }
      }
    }
    return plane;
  }

 private:
  /// Notes which of two contours lies inside of the other.
  /// @return whether they overlap partly.
  bool relate(FilledContour& a, FilledContour& b) {
    const PixelWindow both = common_part(a.window, b.window);
    spend(both.pixels() + 1);
    double common = 0;
    for (Index row = both.top; row < both.top + both.rows; ++row) {
      for (Index column = both.left; column < both.left + both.columns; ++column) {
        common += static_cast<double>(std::min(share_at(a, column, row), share_at(b, column, row)));
      }
    }
    constexpr double kWithin = 0.98, kSmaller = 0.999;  // of the area
    FilledContour &inner = a.area < b.area ? a : b, &outer = a.area < b.area ? b : a;
    if (common >= kWithin * inner.area) {
      if (inner.area < kSmaller * outer.area) {
        ++inner.depth;
      } else {
        inner.again = true;
      }
      return false;
    }
    // Neighbours share the pixels of their border.
    return common > 1 + 0.1 * inner.area && !a.exclusive;
  }

  void spend(std::size_t pixels) {
    constexpr std::size_t kMost = std::size_t{1} << 26;
    spent_ += pixels;
    if (spent_ > kMost) {
      refuse(file_, "expected contours of a plane that overlap now and then, found too many");
    }
  }

  const std::filesystem::path& file_;
  PixelWindow plane_;
  std::vector<FilledContour> contours_;
  std::size_t spent_ = 0;
};

/// The planes of one region, each with its contours, and which of them a slice belongs to.
class RegionPlanes {
 public:
  explicit RegionPlanes(const std::vector<PlaneContour>& contours) {
    for (std::size_t n = 0; n < contours.size(); ++n) {
      if (n == 0 || contours[n].slice != contours[n - 1].slice) begins_.push_back(n);
      if (begins_.back() == n) slices_.push_back(contours[n].slice);
    }
    begins_.push_back(contours.size());
    std::vector<double> gaps;
    for (std::size_t n = 1; n < slices_.size(); ++n) gaps.push_back(slices_[n] - slices_[n - 1]);
    if (gaps.empty()) return;
    std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2),
                     gaps.end());
    step_ = gaps[gaps.size() / 2];
  }

  /// The plane that a slice belongs to; none if it is too far away.
  std::optional<std::size_t> plane_of(double slice) const {
    if (slices_.empty()) return std::nullopt;  // all contours of the region were left out
    constexpr double kRounding = 1e-3;
    const auto above = std::lower_bound(slices_.begin(), slices_.end(), slice - kRounding);
    const auto n = static_cast<std::size_t>(above - slices_.begin());
    const bool is_up = n<slices_.size(), is_down = n> 0;
    const double up = is_up ? slices_[n] - slice : 0, down = is_down ? slice - slices_[n - 1] : 0;
    const bool take_up = is_up && (!is_down || up < down - kRounding);
    const bool between = is_up && is_down && up + down <= kGap * step_;
    // At the ends one of two slices at half the distance counts: the volume is that of the planes.
    const double half = step_ / 2 + (take_up ? -kRounding : kRounding);
    if (!between && (take_up ? up : down) > half) return std::nullopt;
    return take_up ? n : n - 1;
  }

  std::pair<std::size_t, std::size_t> contours_of(std::size_t plane) const {
    return {begins_[plane], begins_[plane + 1]};
  }
  bool has_gaps() const {
    for (std::size_t n = 1; n < slices_.size(); ++n) {
      if (slices_[n] - slices_[n - 1] > kGap * step_) return true;
    }
    return false;
  }

 private:
  static constexpr double kGap = 1.5;  // of the region's own distance: larger ones stay open
  std::vector<double> slices_;
  std::vector<std::size_t> begins_;
  double step_ = 1;  // the median distance, in voxels
};

/// A pixel that may belong to a region, and its place in the order in which such pixels are taken:
/// those with the largest share first, of equal ones every second and in no order of place, so that
/// contours through the centres of pixels are not shifted to one side.
struct OpenPixel {
  std::size_t pixel;
  std::array<std::uint32_t, 3> order;

  OpenPixel(std::size_t number, std::size_t columns, float share) : pixel(number) {
    constexpr float kSteps = 1024;                 // shares that differ by rounding are equal
    constexpr std::uint32_t kSpread = 2654435761;  // Knuth's multiplicative hash
    order = {static_cast<std::uint32_t>(std::lround(kSteps * (1 - share))),
             static_cast<std::uint32_t>((number % columns + number / columns) % 2),
             static_cast<std::uint32_t>(number) * kSpread};
  }
};

/// The pixels of a region in a plane: those with the largest shares, so many that their area is
/// that of the contours. Pixels of less than a quarter are none, those of more than three always
/// are.
std::vector<std::size_t> pixels_of(const std::vector<float>& shares, Index columns) {
  constexpr float kNever = 0.25f, kAlways = 0.75f;
  std::vector<std::size_t> pixels;
  std::vector<OpenPixel> open;
  double area = 0;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    area += static_cast<double>(shares[n]);
    if (shares[n] > kAlways) {
      pixels.push_back(n);
    } else if (shares[n] >= kNever) {
      open.emplace_back(n, static_cast<std::size_t>(columns), shares[n]);
    }
  }
  std::sort(open.begin(), open.end(),
            [](const OpenPixel& a, const OpenPixel& b) { return a.order < b.order; });
  const double missing = std::round(area) - static_cast<double>(pixels.size());
  const auto count =
      static_cast<std::size_t>(std::clamp(missing, 0.0, static_cast<double>(open.size())));
  for (std::size_t n = 0; n < count; ++n) pixels.push_back(open[n].pixel);
  return pixels;
}

/// Fills the regions one after another.
class RegionFiller {
 public:
  RegionFiller(const std::filesystem::path& file, const ContourGrid& placed)
      : file_(file), placed_(placed) {}

  /// Calls visit(offset) for each voxel of a region.
  /// @return what is to be said of it.
  struct Notes {
    bool overlaps = false, gaps = false;
  };
  template <class Visit>
  Notes fill(std::size_t region, Visit visit) const {
    const VoxelGrid& grid = placed_.grid;
    const auto& contours = placed_.contours[region];
    const RegionPlanes planes(contours);
    Notes notes{false, planes.has_gaps()};
    std::optional<std::size_t> last;
    std::vector<std::size_t> filled;
    for (Index k = 0; k < grid.size[2]; ++k) {
      const auto plane = planes.plane_of(k);
      if (!plane) continue;
      if (plane != last) {
        const auto [begin, end] = planes.contours_of(*plane);
        filled = pixels_of(filled_plane(file_, std::span(contours).subspan(begin, end - begin),
                                        {0, 0, grid.size[0], grid.size[1]}, notes.overlaps),
                           grid.size[0]);
        last = plane;
      }
      const std::size_t first = grid.offset(0, 0, k);
      for (const std::size_t pixel : filled) visit(first + pixel);
    }
    return notes;
  }

 private:
  const std::filesystem::path& file_;
  const ContourGrid& placed_;
};

/// Names for a warning.
std::string names_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNamed = 5;
  std::string text;
  for (std::size_t n = 0; n < std::min(names.size(), kMostNamed); ++n) {
    text += (n > 0 ? ", " : "") + in_quotes(names[n]);
  }
  return text + (names.size() > kMostNamed ? ", ..." : "");
}

/// The frames of reference of the scan and of a structure set are compared. Where only some regions
/// have another one, these are left out.
void require_frame(const DicomFile& file, StructureSet& set, const std::optional<VoxelGrid>& scan) {
  if (!scan || scan->frame_of_reference.empty()) return;
  const auto differs = [&](const Region& region) {
    return !region.frame.empty() && region.frame != scan->frame_of_reference;
  };
  std::vector<std::string> other;
  for (const Region& region : set.regions) {
    if (differs(region)) other.push_back(region.name);
  }
  if (other.empty()) return;
  if (other.size() < set.regions.size()) {
    std::erase_if(set.regions, differs);
    set.warnings.push_back("regions of another frame of reference than the scan's left out: " +
                           names_of(other));
    return;
  }
  const std::string found = in_quotes(set.regions.front().frame, 64);
  if (!place_contours(file.path, set, scan).on_scan) {
    refuse(file.path, message("expected the scan's frame of reference, ",
                              in_quotes(scan->frame_of_reference, 64), ", found ", found,
                              ", and contours that do not lie on the scan's slices"));
  }
  set.warnings.push_back(message("the frame of reference ", found, " is not the scan's, ",
                                 in_quotes(scan->frame_of_reference, 64),
                                 ": its contours lie on the scan's slices and are taken"));
}

}  // namespace

std::vector<float> filled_plane(const std::filesystem::path& file,
                                std::span<const PlaneContour> contours, const PixelWindow& plane,
                                bool& overlaps) {
  PlaneFiller filler(file, plane);
  for (const PlaneContour& contour : contours) filler.add(contour);
  overlaps |= filler.sort_by_depth();
  return filler.shares();
}

LabelFile read_contour_labels(const DicomFile& file, const std::function<VoxelGrid()>& scan,
                              MemoryBudget& budget) {
  StructureSet set = read_structure_set(file, budget);
  std::optional<VoxelGrid> grid;
  if (scan) grid = scan();
  require_frame(file, set, grid);
  const ContourGrid placed = place_contours(file.path, set, grid);
  LabelFile out{{placed.grid, {}, {}}, "DICOM structure set", set.warnings};
  out.warnings.insert(out.warnings.end(), placed.warnings.begin(), placed.warnings.end());
  LayerStack stack(out.map, budget);
  const RegionFiller filler(file.path, placed);
  std::vector<std::string> overlapping, open, empty;
  for (std::size_t n = 0; n < set.regions.size(); ++n) {
    const Region& region = set.regions[n];
    Segment segment{region.name, region.number, 0, region.colour};
    std::vector<std::size_t> voxels;
    const auto notes = filler.fill(
        n, [&](std::size_t voxel) { append_within(budget, voxels, voxel, "voxels of a region"); });
    if (notes.overlaps) overlapping.push_back(region.name);
    if (notes.gaps) open.push_back(region.name);
    if (voxels.empty()) empty.push_back(region.name);
    stack.add(segment,
              [&](const auto& visit) { std::for_each(voxels.begin(), voxels.end(), visit); });
    free_within(budget, voxels);
    out.map.segments.push_back(std::move(segment));
  }
  if (!overlapping.empty()) {
    out.warnings.push_back("contours of one plane that overlap are united: " +
                           names_of(overlapping));
  }
  if (!open.empty()) {
    out.warnings.push_back("planes without a contour stay open between others: " + names_of(open));
  }
  if (!empty.empty()) {
    out.warnings.push_back("no voxel lies within the contours: " + names_of(empty));
  }
  if (const std::string note = stack.overlap_note(); !note.empty()) out.warnings.push_back(note);
  return out;
}

}  // namespace mesamis::detail::label_files
