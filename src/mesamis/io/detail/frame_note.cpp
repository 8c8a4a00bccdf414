// SPDX-License-Identifier: Apache-2.0
// How files say in which frame their coordinates are.
#include <cctype>

#include "mesamis/io/detail/surface_formats.h"

namespace mesamis {

const char* frame_name(Frame frame) { return frame == Frame::kRas ? "RAS" : "LPS"; }

namespace detail {
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
  std::size_t end = 0;
  while (end < note.size() && std::isalnum(static_cast<unsigned char>(note[end])) != 0) ++end;
  return frame_named(note.substr(0, end));
}

}  // namespace detail
}  // namespace mesamis
