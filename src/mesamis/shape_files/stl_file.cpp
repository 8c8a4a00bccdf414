// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "mesamis/decimate/round_to_single.h"
#include "mesamis/files/bytes.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/shape_files/surface_formats.h"

namespace mesamis::detail::shape_files {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeader = 80, kBegin = kHeader + 4, kRecord = 50;

using Corner = std::array<float, 3>;

/// Adding zero turns -0 into +0, so that equal numbers have equal bits.
Corner corner(double x, double y, double z) {
  return {static_cast<float>(x) + 0.0f, static_cast<float>(y) + 0.0f, static_cast<float>(z) + 0.0f};
}

Corner normal_of(const std::array<Corner, 3>& t) {
  auto at = [&t](std::size_t i) { return Vec3{t[i][0], t[i][1], t[i][2]}; };
  const Vec3 n = cross(at(1) - at(0), at(2) - at(0));
  const double length = norm(n);
  return length > 0 ? corner(n.x / length, n.y / length, n.z / length) : Corner{0, 0, 0};
}

/// Equal corners become one point, numbered in the order of their first use.
TriMesh weld(const fs::path& file, const std::vector<Corner>& corners, MemoryBudget& budget) {
  const ScopedClaim claim(budget, corners.size(), 2 * sizeof(Index), "corners");
  if (corners.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
    refuse(file, message(corners.size() / 3, " triangles exceed 32-bit indices"));
  }
  std::vector<Index> order(corners.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&corners](Index a, Index b) {
    return corners[a] != corners[b] ? corners[a] < corners[b] : a < b;
  });
  std::vector<Index> first(corners.size());  // where the same corner is used first
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && corners[order[i]] == corners[order[i - 1]];
    first[order[i]] = again ? first[order[i - 1]] : order[i];
  }
  TriMesh surface;
  reserve_within(budget, surface.triangles, corners.size() / 3, "triangles");
  surface.triangles.resize(corners.size() / 3);
  std::vector<Index>& point = order;  // no longer needed
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const auto own = static_cast<Index>(c);
    point[c] = first[c] == own ? static_cast<Index>(surface.points.size()) : point[first[c]];
    if (first[c] == own) {
      append_within(budget, surface.points, {corners[c][0], corners[c][1], corners[c][2]},
                    "points");
    }
    surface.triangles[c / 3][c % 3] = point[c];
  }
  return surface;
}

void require_finite(const fs::path& file, const std::vector<Corner>& corners) {
  for (std::size_t c = 0; c < corners.size(); ++c) {
    for (const float x : corners[c]) {
      if (!std::isfinite(x))
        refuse(file, message("triangle ", c / 3, " has a corner that is not finite"));
    }
  }
}

/// Whether a record is that of a triangle: numbers of a usual size, and a normal of length 1 or none.
bool is_triangle(const char* record) {
  std::array<double, 12> n{};
  double most = 0;
  for (std::size_t i = 0; i < n.size(); ++i) {
    n[i] = static_cast<double>(load<float>(record + 4 * i));
    if (!std::isfinite(n[i]) || (n[i] != 0 && std::abs(n[i]) < 1e-12)) return false;
    if (i >= 3) most = std::max(most, std::abs(n[i]));
  }
  const double length = norm(Vec3{n[0], n[1], n[2]});
  return most > 0 && most < 1e9 && (length == 0 || std::abs(length - 1) < 0.01);
}

std::vector<Corner> binary_corners(const fs::path& file, std::string_view bytes,
                                   MemoryBudget& budget) {
  const std::uint64_t count = load<std::uint32_t>(bytes.data() + kHeader);
  const std::uint64_t room = (bytes.size() - kBegin) / kRecord;
  if (count > room) {
    refuse(file, message("the header promises ", count, " triangles, the file ends after ", room));
  }
  if (count < room && is_triangle(bytes.data() + kBegin + count * kRecord)) {
    refuse(file, message("the header promises ", count, " triangles, but more follow"));
  }
  std::vector<Corner> corners;
  reserve_within(budget, corners, 3 * count, "corners");
  corners.resize(3 * count);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    // A record: normal, three corners, two bytes.
    const char* from = bytes.data() + kBegin + c / 3 * kRecord + 12 + c % 3 * 12;
    corners[c] = corner(load<float>(from), load<float>(from + 4), load<float>(from + 8));
  }
  return corners;
}

std::vector<Corner> text_corners(const fs::path& file, std::string_view bytes,
                                 MemoryBudget& budget) {
  std::vector<Corner> corners;
  std::string_view line;
  bool ended = false;
  for (std::size_t number = 1; take_line(bytes, line); ++number) {
    line = trimmed(line);  // of a zero byte, too, that a document in DICOM may end with
    const std::string keyword = lower(take_word(line));
    if (!keyword.empty()) ended = keyword == "endsolid";
    if (keyword == "endloop" && corners.size() % 3 != 0) {
      refuse(file, message("line ", number, ": expected three corners in each loop"));
    }
    if (keyword != "vertex") continue;
    double x = 0, y = 0, z = 0;
    if (!parse_number(take_word(line), x) || !parse_number(take_word(line), y) ||
        !parse_number(take_word(line), z)) {
      refuse(file, message("line ", number, ": expected three numbers after vertex"));
    }
    append_within(budget, corners, corner(x, y, z), "corners");
  }
  if (!ended) refuse(file, "the file does not end with endsolid");
  if (corners.size() % 3 != 0) refuse(file, "the last triangle has not three corners");
  return corners;
}

/// Some editors put the mark of UTF-8 before a text.
std::string_view without_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return bytes.starts_with(kMark) ? bytes.substr(kMark.size()) : bytes;
}

bool begins_like_text(std::string_view bytes) {
  return lower(trimmed(without_mark(bytes.substr(0, kHeader)))).starts_with("solid");
}

/// Whether bytes come early that no text has, as those of small numbers. Zero bytes may end a text.
bool has_control_bytes(std::string_view bytes) {
  constexpr std::size_t kEarly = 512;
  const std::string_view early = trimmed(bytes.substr(0, kEarly));
  return std::any_of(early.begin(), early.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' && (c < '\t' || c > '\r');
  });
}

/// Some binary files, too, begin with "solid": their size tells, and where there are bytes behind
/// the triangles or the end is missing, that they are no text.
bool is_binary(std::string_view bytes) {
  if (bytes.size() < kBegin) return false;
  const std::uint64_t count = load<std::uint32_t>(bytes.data() + kHeader);
  const std::uint64_t size = kBegin + count * kRecord;
  if (bytes.size() == size || !begins_like_text(bytes)) return true;
  return count > 0 && has_control_bytes(bytes);
}

}  // namespace

std::string stl_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  const TriMesh single = round_to_single(surface);
  // The header must not begin with "solid", or readers take the file for text.
  std::string out = frame_note(options.frame) + (options.name.empty() ? "" : ", " + options.name);
  out.resize(kHeader, '\0');
  out.reserve(kBegin + kRecord * single.triangles.size());
  append(out, static_cast<std::uint32_t>(single.triangles.size()));
  for (const Triangle& k : single.triangles) {
    std::array<Corner, 3> t;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = single.points[k[i]];
      t[i] = corner(p.x, p.y, p.z);
    }
    for (const float x : normal_of(t)) append(out, x);
    for (const Corner& c : t) {
      for (const float x : c) append(out, x);
    }
    append(out, std::uint16_t{0});
  }
  return out;
}

std::uint64_t most_stl_bytes(std::string_view first_bytes) {
  if (first_bytes.size() < kBegin || begins_like_text(first_bytes)) return 0;
  // One more tells whether the number holds.
  return kBegin + (std::uint64_t{load<std::uint32_t>(first_bytes.data() + kHeader)} + 1) * kRecord;
}

SurfaceFile parse_stl(const fs::path& file, std::string_view bytes, MemoryBudget& budget) {
  const bool binary = is_binary(bytes);
  if (!binary && !begins_like_text(bytes)) {
    refuse(file, "is not an STL file: neither begins with solid nor holds a binary header");
  }
  const auto corners = binary ? binary_corners(file, bytes, budget)
                              : text_corners(file, without_mark(bytes), budget);
  require_finite(file, corners);
  const std::string_view head = bytes.substr(0, kHeader);
  return {weld(file, corners, budget),
          frame_named_in(binary ? head : head.substr(0, head.find_first_of("\r\n")))};
}

}  // namespace mesamis::detail::shape_files
