// SPDX-License-Identifier: Apache-2.0
// A wall stays a wall: each room includes only the rooms it may see.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> kSees{
    {"base", {}},
    {"image", {"base"}},
    {"restore", {"base", "image"}},
    {"object", {"base", "image", "restore"}},
    {"mesh", {"base"}},
    {"fem", {"base", "mesh", "image"}},
    {"segment", {"base", "mesh", "image", "fem"}},
    {"adapt", {"base", "mesh", "image", "fem", "segment"}},
    {"remesh", {"base", "mesh"}},
    {"surface", {"base", "mesh"}},
    {"body", {"base", "mesh", "surface", "remesh"}},
    {"decimate", {"base", "mesh", "surface"}},
    {"phantom", {"base", "image", "mesh", "surface"}},
    {"labels", {"base", "image", "mesh", "fem", "surface"}},
    {"material", {"base", "image", "mesh", "surface"}},
    {"fit", {"base", "image", "surface"}},
    {"method",
     {"base", "image", "restore", "object", "mesh", "fem", "segment", "adapt", "remesh", "surface",
      "decimate", "labels", "fit"}},
    {"slabs",
     {"base", "image", "restore", "object", "mesh", "fem", "segment", "adapt", "remesh", "surface",
      "decimate", "fit", "method"}},
    {"parallel", {"base", "slabs"}},
    {"files", {"base"}},
    {"scan_files", {"base", "image", "files"}},
    {"chunk_files", {"base", "image", "files"}},
    {"label_files", {"base", "image", "files", "scan_files", "chunk_files"}},
    {"shape_files", {"base", "mesh", "surface", "decimate", "files"}},
    {"plot", {"base", "files"}},
    {"picture", {"base", "image", "mesh", "surface", "files", "shape_files", "plot"}},
    {"baseline", {"base", "image", "restore", "mesh", "surface"}},
    {"printing", {"base", "mesh", "surface", "files", "shape_files"}},
    {"comparison", {"base", "mesh", "surface", "shape_files"}},
    {"delivery",
     {"base", "image", "mesh", "fem", "adapt", "remesh", "surface", "body", "material", "method",
      "files", "shape_files"}},
    {"record",
     {"base", "image", "object", "body", "material", "mesh", "remesh", "surface", "method", "files",
      "shape_files", "comparison", "delivery"}},
    {"study",
     {"base", "image", "surface", "method", "files", "shape_files", "plot", "comparison",
      "delivery", "record"}},
    {"run",
     {"base", "files", "image", "mesh", "surface", "object", "method", "label_files", "shape_files",
      "delivery", "record", "page", "slabs"}},
    {"page", {"base", "image", "mesh", "surface", "method", "files", "plot"}},
};

const std::map<std::string, std::set<std::string>> kOnlyIn{
    {"itk", {"baseline"}},
    {"vtk", {"picture", "baseline"}},
    {"lib3mf", {"shape_files"}},
    {"gdcm", {"scan_files"}},
    {"tiff", {"scan_files"}},
    {"hdf5", {"chunk_files"}},
    {"blosc", {"chunk_files"}},
    {"zstd", {"chunk_files"}},
    {"X11", {"picture"}},
    {"nlohmann", {"record", "run", "study", "page", "files", "chunk_files", "shape_files"}},
    {"oneapi/tbb", {"base"}},
    {"tbb", {"base"}},
    {"OpenMesh", {"decimate"}},
    {"expat", {"files"}},
    {"openssl", {"files"}},
    {"mpi.h", {"parallel"}},
};

void check_file(const fs::path& file, const std::string& room) {
  static const std::regex own("#include \"mesamis/(\\w+)/.*\"");
  static const std::regex any("#include [<\"]([^>\"]+)[>\"]");
  std::ifstream in(file);
  bool itk = false, eigen = false;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_match(line, match, own) && match[1] != room) {
      EXPECT_TRUE(kSees.at(room).count(match[1])) << file << ": " << line;
    }
    if (!std::regex_match(line, match, any)) continue;
    const std::string header = match[1];
    for (const auto& [prefix, rooms] : kOnlyIn) {
      if (header.rfind(prefix, 0) == 0) {
        EXPECT_TRUE(rooms.count(room)) << file << ": " << line;
      }
    }
    itk |= header.rfind("itk", 0) == 0;
    eigen |= header.rfind("Eigen", 0) == 0;
  }
  EXPECT_FALSE(itk && eigen) << file << " includes both ITK and Eigen";
}

TEST(Walls, RoomsIncludeOnlyWhatTheyMaySee) {
  const fs::path source = fs::path(MESAMIS_SOURCE_DIR) / "src/mesamis";
  int files = 0;
  for (const auto& [room, sees] : kSees) {
    for (const auto& entry : fs::recursive_directory_iterator(source / room)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      check_file(entry.path(), room);
      ++files;
    }
  }
  EXPECT_GT(files, 10);
}

}  // namespace
