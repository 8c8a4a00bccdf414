// SPDX-License-Identifier: Apache-2.0
// A room is entered by its doors: the headers its sources.cmake names. Those that mesamis.h leads to are installed.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <string>

#include "style/project_files.h"
#include "style/rooms.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

bool is_door(const std::map<std::string, Room>& rooms, const std::string& room,
             const std::string& header) {
  const auto found = rooms.find(room);
  return found != rooms.end() && found->second.doors.count(header);
}

/// The room a file lives in; for the program and the like the name of their folder.
std::string room_of(const fs::path& file) {
  for (const char* root : {"src/mesamis", "tools/mesamis"}) {
    const fs::path relative = fs::relative(file, fs::path(MESAMIS_SOURCE_DIR) / root);
    if (*relative.begin() != "..") return *relative.begin();
  }
  return file.parent_path().filename();
}

/// Calls visit(room, header) for each #include "mesamis/room/header" of a file.
template <class Visit>
void for_each_include(const fs::path& file, Visit visit) {
  static const std::regex include("#include \"mesamis/(\\w+)/([^\"]+)\"");
  const std::string text = file_text(file);
  for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end; ++match) {
    visit((*match)[1].str(), (*match)[2].str());
  }
}

TEST(Doors, EverySourceAndDoorOfARoomIsThereAndListed) {
  const auto rooms = read_rooms();
  ASSERT_EQ(rooms.count("base"), 1u);
  for (const auto& [name, room] : rooms) {
    EXPECT_FALSE(room.doors.empty()) << name << " has no door";
    for (const auto& door : room.doors) EXPECT_TRUE(fs::exists(room.folder / door)) << door;
    for (const auto& file : project_files(room.folder, {".cpp"})) {
      const std::string relative = fs::relative(file, room.folder).string();
      EXPECT_TRUE(room.sources.count(relative)) << file << " is not in sources.cmake";
    }
  }
}

/// Two types of one name are undefined behaviour where a program has both, though each compiles.
TEST(Doors, NoTwoTypesHaveOneName) {
  static const std::regex space("(?:^|\n)namespace ([\\w:]+) \\{");
  static const std::regex type(
      "(?:^|\n)(?:struct|class|enum class|union) (\\w+)(?: final)?(?: :[^;{]*)? ?\\{");
  std::map<std::string, fs::path> definitions;
  for (const char* root : {"src/mesamis", "tools/mesamis"}) {
    for (const auto& file : project_files(root, {".h"})) {
      const std::string text = file_text(file);
      std::smatch inside;
      const std::string of = std::regex_search(text, inside, space) ? inside[1].str() : "";
      for (std::sregex_iterator match(text.begin(), text.end(), type), end; match != end; ++match) {
        const auto [other, is_new] = definitions.try_emplace(of + "::" + (*match)[1].str(), file);
        EXPECT_TRUE(is_new) << other->first << " in " << other->second << " and " << file;
      }
    }
  }
  EXPECT_GT(definitions.size(), 200u);
}

/// Who includes the library reads few headers, and needs no other library for them.
TEST(Doors, TheFrontDoorLeadsToFewHeadersAndNoOtherLibrary) {
  const auto reached = reached_from("mesamis/mesamis.h");
  EXPECT_GT(reached.size(), 15u);
  EXPECT_LE(reached.size(), 30u);
  for (const std::string& header : reached) {
    for (const std::string& to : includes_of(fs::path(MESAMIS_SOURCE_DIR) / "src" / header)) {
      const bool is_standard = to.find_first_of("./") == std::string::npos;
      EXPECT_TRUE(is_standard || to.rfind("mesamis/", 0) == 0) << header << " includes " << to;
    }
  }
}

TEST(Doors, TheFrontDoorLeadsToDoorsOnly) {
  const auto rooms = read_rooms();
  for (const std::string& header : reached_from("mesamis/mesamis.h")) {
    if (header == "mesamis/mesamis.h") continue;
    const fs::path path(header);
    EXPECT_TRUE(is_door(rooms, path.parent_path().filename(), path.filename())) << header;
  }
}

TEST(Doors, AreTheOnlyWayIntoAnotherRoom) {
  const auto rooms = read_rooms();
  for (const std::string folder : {"src", "tools", "app", "bench", "examples"}) {
    for (const auto& file : project_files(folder, {".h", ".cpp"})) {
      const std::string from = room_of(file);
      for_each_include(file, [&](const std::string& to, const std::string& header) {
        if (to == from) return;
        EXPECT_TRUE(is_door(rooms, to, header)) << file << ": " << to << "/" << header;
      });
    }
  }
}

}  // namespace
}  // namespace mesamis
