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
    {"mesh", {"base"}},
    {"fem", {"base", "mesh", "image"}},
    {"segment", {"base", "mesh", "image", "fem"}},
    {"adapt", {"base", "mesh", "image", "fem", "segment"}},
    {"remesh", {"base", "mesh"}},
    {"surface", {"base", "mesh"}},
    {"io", {"base", "image", "mesh", "surface"}},
};

const std::map<std::string, std::set<std::string>> kOnlyIn{
    {"itk", {"io"}},          {"vtk", {"io"}},   {"lib3mf", {"io"}},        {"gdcm", {"io"}},
    {"oneapi/tbb", {"base"}}, {"tbb", {"base"}}, {"OpenMesh", {"surface"}},
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
    if (!fs::exists(source / room)) continue;
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
