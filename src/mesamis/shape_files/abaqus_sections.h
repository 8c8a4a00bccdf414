// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "mesamis/base/types.h"
#include "mesamis/files/text_writer.h"

/// What the writers of Abaqus .inp share.
namespace mesamis::detail::shape_files {

// CalculiX refuses a number of more than 20 characters.
inline constexpr int kAbaqusDigits = 13;  // with sign, point and a three-digit exponent, 20
inline constexpr std::size_t kAbaqusEntriesPerLine = 16;

inline void write_abaqus_head(TextWriter& out, Frame frame) {
  out << "*HEADING\nTetrahedral mesh of a scan\n"
      << "** Lengths in mm; frame " << frame_name(frame)
      << (frame == Frame::kRas ? ": x right, y front, z head\n" : ": x left, y back, z head\n");
}

inline void write_abaqus_nodes(TextWriter& out, std::span<const Vec3> points, Frame frame) {
  out << "*NODE, NSET=ALL\n";
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec3 p = in_frame(points[n], frame);
    out << n + 1;
    for (int axis = 0; axis < 3; ++axis) {
      out << ", ";
      out.number(p[axis], kAbaqusDigits);
    }
    out << "\n";
  }
}

/// Nodes or elements under a keyword such as "*ELSET, ELSET="; nothing where there are none: an
/// empty set is an error for some programs.
inline void write_abaqus_set(TextWriter& out, std::string_view keyword, std::string_view name,
                             std::span<const Index> items) {
  if (items.empty()) return;
  out << keyword << name << "\n";
  for (std::size_t i = 0; i < items.size(); ++i) {
    const bool line_ends = (i + 1) % kAbaqusEntriesPerLine == 0 || i + 1 == items.size();
    out << std::int64_t{items[i]} + 1 << (line_ends ? "\n" : ", ");
  }
}

}  // namespace mesamis::detail::shape_files
