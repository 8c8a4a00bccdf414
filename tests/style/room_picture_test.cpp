// SPDX-License-Identifier: Apache-2.0
// CONTRIBUTING.md describes the rooms as they are: its table names every room, and its picture has
// exactly the edges that the includes need.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <string>

#include "style/project_files.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

/// For each room the rooms it includes, or the rooms its arrows in the picture point to.
using Edges = std::map<std::string, std::set<std::string>>;

std::string contributing() { return file_text(fs::path(MESAMIS_SOURCE_DIR) / "CONTRIBUTING.md"); }

/// The text between two marks, without them; empty if either is missing.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const auto first = text.find(begin);
  if (first == std::string::npos) return {};
  const auto start = first + begin.size();
  const auto last = text.find(end, start);
  return last == std::string::npos ? std::string() : text.substr(start, last - start);
}

std::set<std::string> room_folders() {
  std::set<std::string> rooms;
  for (const auto& entry : fs::directory_iterator(fs::path(MESAMIS_SOURCE_DIR) / "src/mesamis")) {
    if (!fs::exists(entry.path() / "sources.cmake")) continue;
    rooms.insert(entry.path().filename().string());
  }
  return rooms;
}

/// The first cells of the table whose header begins with "room".
std::multiset<std::string> rooms_of_the_table(const std::string& page) {
  std::multiset<std::string> rooms;
  static const std::regex row("\\| `(\\w+)` \\|");
  const std::string table = between(page, "\n| room ", "\n\n");
  for (std::sregex_iterator match(table.begin(), table.end(), row), end; match != end; ++match) {
    rooms.insert((*match)[1]);
  }
  return rooms;
}

/// The arrows "from --> to" of the first mermaid block.
Edges picture_edges(const std::string& page) {
  Edges edges;
  static const std::regex arrow("(\\w+) --> (\\w+)");
  const std::string picture = between(page, "```mermaid\n", "```");
  for (std::sregex_iterator match(picture.begin(), picture.end(), arrow), end; match != end;
       ++match) {
    edges[(*match)[1]].insert((*match)[2]);
  }
  return edges;
}

Edges include_edges() {
  Edges edges;
  static const std::regex include("#include \"mesamis/(\\w+)/");
  for (const auto& room : room_folders()) {
    for (const auto& file : project_files("src/mesamis/" + room, {".h", ".cpp"})) {
      const std::string text = file_text(file);
      for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end;
           ++match) {
        if ((*match)[1] != room) edges[room].insert((*match)[1]);
      }
    }
  }
  return edges;
}

/// All rooms that arrows lead to from a room. Without the arrow skip, if one is given.
std::set<std::string> reachable(const Edges& edges, const std::string& from,
                                const std::pair<std::string, std::string>& skip = {}) {
  std::set<std::string> seen;
  std::vector<std::string> open{from};
  while (!open.empty()) {
    const std::string room = open.back();
    open.pop_back();
    const auto found = edges.find(room);
    if (found == edges.end()) continue;
    for (const auto& to : found->second) {
      if (std::pair(room, to) != skip && seen.insert(to).second) open.push_back(to);
    }
  }
  return seen;
}

TEST(RoomPicture, TableNamesEveryRoomOnce) {
  const auto folders = room_folders();
  EXPECT_EQ(rooms_of_the_table(contributing()),
            std::multiset<std::string>(folders.begin(), folders.end()));
}

TEST(RoomPicture, ReachesEveryIncludedRoom) {
  const Edges drawn = picture_edges(contributing());
  ASSERT_FALSE(drawn.empty());
  for (const auto& [from, rooms] : include_edges()) {
    const auto allowed = reachable(drawn, from);
    for (const auto& to : rooms) {
      EXPECT_TRUE(allowed.count(to)) << from << " includes " << to << ", no path leads there";
    }
  }
}

TEST(RoomPicture, DrawsOnlyArrowsThatIncludesNeed) {
  const Edges drawn = picture_edges(contributing()), included = include_edges();
  for (const auto& [from, rooms] : drawn) {
    EXPECT_FALSE(reachable(drawn, from).count(from)) << from << " lies on a cycle";
    for (const auto& to : rooms) {
      const auto found = included.find(from);
      EXPECT_TRUE(found != included.end() && found->second.count(to))
          << from << " --> " << to << ": no file includes that";
      EXPECT_FALSE(reachable(drawn, from, {from, to}).count(to))
          << from << " --> " << to << ": other arrows lead there";
    }
  }
}

}  // namespace
}  // namespace mesamis
