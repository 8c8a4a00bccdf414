// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/text_writer.h"
#include "mesamis/files/xml_text.h"
#include "mesamis/shape_files/mesh_files.h"

namespace mesamis {

namespace {

void write_arrays(TextWriter& out, const char* element, std::span<const MeshArray> arrays) {
  out << "    <" << element << ">\n";
  for (const MeshArray& array : arrays) {
    out << "      <PDataArray type=\"Float64\" Name=\"" << xml_escaped(array.name)
        << "\" NumberOfComponents=\"" << array.components << "\"/>\n";
  }
  out << "    </" << element << ">\n";
}

}  // namespace

void write_pvtu(const OutputPath& path, std::span<const std::string> pieces,
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
    out << "    <Piece Source=\"" << xml_escaped(piece) << "\"/>\n";
  }
  out << "  </PUnstructuredGrid>\n</VTKFile>\n";
  out.commit();
}

}  // namespace mesamis
