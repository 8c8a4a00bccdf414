// SPDX-License-Identifier: Apache-2.0
// A room is entered by its doors: the headers its sources.cmake names, which are installed.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <string>

#include "style/project_files.h"
#include "style/rooms.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

bool is_inner_door(const std::map<std::string, Room>& rooms, const std::string& room,
                   const std::string& header) {
  const auto found = rooms.find(room);
  return found != rooms.end() && found->second.inner_doors.count(header);
}

bool is_door(const std::map<std::string, Room>& rooms, const std::string& room,
             const std::string& header) {
  const auto found = rooms.find(room);
  return found != rooms.end() && found->second.doors.count(header);
}

/// The room a file lives in; for the program and the like the name of their folder.
std::string room_of(const fs::path& file) {
  const fs::path source = fs::path(MESAMIS_SOURCE_DIR) / "src/mesamis";
  const fs::path relative = fs::relative(file, source);
  return *relative.begin() == ".." ? file.parent_path().filename() : *relative.begin();
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
    for (const auto& file : project_files("src/mesamis/" + name, {".cpp"})) {
      const std::string relative = fs::relative(file, room.folder).string();
      EXPECT_TRUE(room.sources.count(relative)) << file << " is not in sources.cmake";
    }
  }
}

TEST(Doors, LeadToDoorsOnly) {
  const auto rooms = read_rooms();
  for (const auto& [name, room] : rooms) {
    for (const auto& door : room.doors) {
      for_each_include(room.folder / door, [&](const std::string& to, const std::string& header) {
        EXPECT_TRUE(is_door(rooms, to, header))
            << name << "/" << door << " is installed, " << to << "/" << header << " is not";
      });
    }
  }
}

TEST(Doors, AreTheOnlyWayIntoAnotherRoom) {
  const auto rooms = read_rooms();
  for (const std::string folder : {"src", "app", "bench", "examples"}) {
    for (const auto& file : project_files(folder, {".h", ".cpp"})) {
      const std::string from = room_of(file);
      for_each_include(file, [&](const std::string& to, const std::string& header) {
        if (to == from || (folder == "src" && is_inner_door(rooms, to, header))) return;
        EXPECT_TRUE(is_door(rooms, to, header)) << file << ": " << to << "/" << header;
      });
    }
  }
}

}  // namespace
}  // namespace mesamis
