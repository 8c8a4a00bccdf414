// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/text_writer.h"
#include "mesamis/shape_files/mesh_files.h"

namespace mesamis {

using namespace detail;

namespace {

std::string as_attribute(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

void write_arrays(TextWriter& out, const char* element, std::span<const MeshArray> arrays) {
  out << "    <" << element << ">\n";
  for (const MeshArray& array : arrays) {
    out << "      <PDataArray type=\"Float64\" Name=\"" << as_attribute(array.name)
        << "\" NumberOfComponents=\"" << array.components << "\"/>\n";
  }
  out << "    </" << element << ">\n";
}

}  // namespace

void write_pvtu(const std::filesystem::path& path, std::span<const std::string> pieces,
                std::span<const MeshArray> point_arrays, std::span<const MeshArray> cell_arrays) {
  TextWriter out(path);
  out << "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n"
         "  <PUnstructuredGrid GhostLevel=\"0\">\n";
  write_arrays(out, "PPointData", point_arrays);
  write_arrays(out, "PCellData", cell_arrays);
  out << "    <PPoints>\n"
         "      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n"
         "    </PPoints>\n";
  for (const std::string& piece : pieces) {
    out << "    <Piece Source=\"" << as_attribute(piece) << "\"/>\n";
  }
  out << "  </PUnstructuredGrid>\n</VTKFile>\n";
  out.commit();
}

}  // namespace mesamis
