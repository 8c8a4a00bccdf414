// SPDX-License-Identifier: Apache-2.0
// The text by which files state the frame of their coordinates.
#include "mesamis/shape_files/surface_formats.h"

namespace mesamis::detail::shape_files {
namespace {

constexpr std::string_view kMark = "SPACE=";

}  // namespace

std::optional<Frame> frame_named(std::string_view name) {
  for (const Frame frame : {Frame::kLps, Frame::kRas}) {
    if (name == frame_name(frame)) return frame;
  }
  return std::nullopt;
}

std::string frame_note(std::optional<Frame> frame) {
  std::string note = "mesamis, millimetre";
  if (frame) ((note += ", ") += kMark) += frame_name(*frame);
  return note;
}

std::optional<Frame> frame_named_in(std::string_view note) {
  const std::size_t at = note.find(kMark);
  if (at == note.npos) return std::nullopt;
  note.remove_prefix(at + kMark.size());
  constexpr std::string_view kNameCharacters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
  return frame_named(note.substr(0, note.find_first_not_of(kNameCharacters)));
}

}  // namespace mesamis::detail::shape_files
