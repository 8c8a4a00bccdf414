// SPDX-License-Identifier: Apache-2.0
// A wall stays a wall: files include only what src/mesamis/rooms.txt allows their room, and
// CONTRIBUTING.md describes the rooms of that list.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "style/rooms.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

std::string contributing() { return file_text(fs::path(MESAMIS_SOURCE_DIR) / "CONTRIBUTING.md"); }

/// The text between two marks, without them; empty if either is missing.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const auto first = text.find(begin);
  if (first == std::string::npos) return {};
  const auto start = first + begin.size();
  const auto last = text.find(end, start);
  return last == std::string::npos ? std::string() : text.substr(start, last - start);
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
Edges picture_arrows(const std::string& page) {
  Edges edges;
  static const std::regex arrow("(\\w+) --> (\\w+)");
  const std::string picture = between(page, "```mermaid\n", "```");
  for (std::sregex_iterator match(picture.begin(), picture.end(), arrow), end; match != end;
       ++match) {
    edges[(*match)[1]].insert((*match)[2]);
  }
  return edges;
}

/// The other rooms that a room's files include.
std::set<std::string> included_rooms(const std::string& room) {
  std::set<std::string> rooms;
  for (const auto& file : project_files(read_rooms().at(room).folder, {".h", ".cpp"})) {
    for (const std::string& header : includes_of(file)) {
      const std::string to = between(header, "mesamis/", "/");
      if (!to.empty() && to != room) rooms.insert(to);
    }
  }
  return rooms;
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

TEST(RoomList, NamesEveryRoomOnce) {
  const RoomList list = read_room_list();
  const std::multiset<std::string> names(list.names.begin(), list.names.end());
  std::multiset<std::string> folders;
  for (const auto& [name, room] : read_rooms()) folders.insert(name);
  EXPECT_EQ(names, folders);
  EXPECT_EQ(rooms_of_the_table(contributing()), names);
}

/// The namespaces that a header opens.
std::set<std::string> namespaces_of(const fs::path& file) {
  static const std::regex open("(?:^|\n)namespace ([\\w:]+) \\{");
  const std::string text = file_text(file);
  const std::sregex_iterator begin(text.begin(), text.end(), open), end;
  std::set<std::string> names;
  std::transform(begin, end, std::inserter(names, names.end()),
                 [](const std::smatch& match) { return match[1].str(); });
  return names;
}

TEST(RoomList, NamesTheNamespacesOfRoomsH) {
  const std::string text = file_text(fs::path(MESAMIS_SOURCE_DIR) / "src/mesamis/rooms.h");
  std::string lines;
  for (const std::string& room : read_room_list().names) {
    lines += "namespace detail::" + room + " {}\nusing namespace detail::" + room + ";\n";
  }
  EXPECT_EQ(between(text, "namespace mesamis {\n", "}  // namespace mesamis"), lines);
}

/// Public are the headers that a front door leads to. Any other one opens the namespace of its room and leads to rooms.h.
TEST(RoomList, NamesTheNamespaceOfWhatIsPrivate) {
  auto open = reached_from("mesamis/mesamis.h");
  open.merge(reached_from("mesamis/baseline/baseline_surface.h"));
  for (const auto& [name, room] : read_rooms()) {
    for (const auto& file : project_files(room.folder, {".h"})) {
      const std::string header = "mesamis/" + name + "/" + file.filename().string();
      if (open.count(header)) {
        EXPECT_TRUE(namespaces_of(file).count("mesamis")) << file;
        EXPECT_FALSE(reached_from(header).count("mesamis/rooms.h")) << file;
        continue;
      }
      for (const std::string& inside : namespaces_of(file)) {
        EXPECT_FALSE(inside.rfind("mesamis", 0) == 0 && inside != "mesamis::detail::" + name)
            << file << " opens " << inside;
      }
      EXPECT_TRUE(reached_from(header).count("mesamis/rooms.h")) << file;
    }
  }
}

TEST(RoomList, IsThePictureInContributing) {
  EXPECT_EQ(picture_arrows(contributing()), read_room_list().arrows);
}

/// Then there is no circle.
TEST(RoomList, NamesARoomBehindThoseThatItIncludes) {
  const RoomList list = read_room_list();
  std::set<std::string> before;
  for (const std::string& room : list.names) {
    const auto found = list.arrows.find(room);
    if (found != list.arrows.end()) {
      for (const auto& to : found->second) EXPECT_TRUE(before.count(to)) << room << " " << to;
    }
    before.insert(room);
  }
}

TEST(RoomList, LeadsToEveryIncludedRoomByNoMoreArrowsThanThatNeeds) {
  const RoomList list = read_room_list();
  for (const std::string& from : list.names) {
    const auto included = included_rooms(from), allowed = reachable(list.arrows, from);
    for (const auto& to : included) {
      EXPECT_TRUE(allowed.count(to)) << from << " includes " << to << ", no path leads there";
    }
    const auto found = list.arrows.find(from);
    if (found == list.arrows.end()) continue;
    for (const auto& to : found->second) {
      EXPECT_TRUE(included.count(to)) << from << " --> " << to << ": no file includes that";
      EXPECT_FALSE(reachable(list.arrows, from, {from, to}).count(to))
          << from << " --> " << to << ": other arrows lead there";
    }
  }
}

TEST(RoomList, NamesTheOtherLibrariesThatARoomIncludes) {
  const RoomList list = read_room_list();
  std::set<std::string> known;
  for (const auto& [room, prefixes] : list.libraries)
    known.insert(prefixes.begin(), prefixes.end());
  for (const std::string& room : list.names) {
    const auto found = list.libraries.find(room);
    const auto allowed = found == list.libraries.end() ? std::set<std::string>() : found->second;
    for (const auto& file : project_files(read_rooms().at(room).folder, {".h", ".cpp"})) {
      for (const std::string& header : includes_of(file)) {
        for (const std::string& prefix : known) {
          EXPECT_TRUE(header.rfind(prefix, 0) != 0 || allowed.count(prefix))
              << file << " includes " << header;
        }
      }
    }
  }
}

/// ITK brings an older Eigen along.
TEST(RoomList, NoFileIncludesBothItkAndEigen) {
  for (const auto& file : project_files(read_rooms().at("baseline").folder, {".h", ".cpp"})) {
    bool itk = false, eigen = false;
    for (const std::string& header : includes_of(file)) {
      itk |= header.rfind("itk", 0) == 0;
      eigen |= header.rfind("Eigen", 0) == 0;
    }
    EXPECT_FALSE(itk && eigen) << file;
  }
}

}  // namespace
}  // namespace mesamis
