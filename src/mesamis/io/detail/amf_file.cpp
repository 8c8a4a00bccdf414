// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "mesamis/io/detail/surface_formats.h"

namespace mesamis::detail {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

void append_number(std::string& out, const char* tag, double value) {
  ((out += '<') += tag) += '>';
  append_shortest(out, value);
  ((out += "</") += tag) += '>';
}

void append_metadata(std::string& out, const std::string& type, const std::string& text) {
  out += "<metadata type=\"" + escaped(type) + "\">" + escaped(text) + "</metadata>\n";
}

/// A grey value of 0 to 255 as an AMF colour, from 0 to 1 per channel.
void append_color(std::string& out, double grey) {
  const double share = std::clamp(grey / 255, 0.0, 1.0);
  out += "<color>";
  for (const char* channel : {"r", "g", "b"}) append_number(out, channel, share);
  out += "</color>";
}

}  // namespace

std::string amf_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<amf unit=\"millimeter\" version=\"1.1\">\n";
  append_metadata(out, "producer", "mesamis");
  append_metadata(out, "description", frame_note(options.frame));
  for (const auto& [type, text] : options.metadata) append_metadata(out, type, text);
  out += "<object id=\"0\">\n";
  if (!options.name.empty()) append_metadata(out, "name", options.name);
  out += "<mesh>\n<vertices>\n";
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    out += "<vertex><coordinates>";
    append_number(out, "x", surface.points[n].x);
    append_number(out, "y", surface.points[n].y);
    append_number(out, "z", surface.points[n].z);
    out += "</coordinates>";
    if (!options.grey.empty()) append_color(out, options.grey[n]);
    out += "</vertex>\n";
  }
  out += "</vertices>\n<volume>\n";
  for (const Triangle& t : surface.triangles) {
    out += "<triangle><v1>" + std::to_string(t[0]) + "</v1><v2>" + std::to_string(t[1]) +
           "</v2><v3>" + std::to_string(t[2]) + "</v3></triangle>\n";
  }
  return out += "</volume>\n</mesh>\n</object>\n</amf>\n";
}

}  // namespace mesamis::detail
