// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "style/project_files.h"

namespace mesamis {

/// What a room's sources.cmake lists.
struct Room {
  std::filesystem::path folder;
  std::set<std::string> doors, sources;
};

/// The words of set(NAME ...) in a CMake file.
inline std::set<std::string> cmake_list(const std::string& text, const std::string& name) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex("set\\(" + name + "\\s([^)]*)\\)"))) return {};
  static const std::regex word("\\S+");
  const std::string words = match[1];
  return {std::sregex_token_iterator(words.begin(), words.end(), word), {}};
}

/// Every room of src/mesamis/ and tools/mesamis/ by its name.
inline std::map<std::string, Room> read_rooms() {
  std::map<std::string, Room> rooms;
  for (const char* root : {"src/mesamis", "tools/mesamis"}) {
    for (const auto& file : project_files(root, {".cmake"})) {
      const std::string text = file_text(file);
      rooms[file.parent_path().filename().string()] = {
          file.parent_path(), cmake_list(text, "ROOM_HEADERS"), cmake_list(text, "ROOM_SOURCES")};
    }
  }
  return rooms;
}

/// For each room the rooms that its arrows point to.
using Edges = std::map<std::string, std::set<std::string>>;

/// What rooms.txt says.
struct RoomList {
  std::vector<std::string> names;  ///< in its order
  Edges arrows;
  Edges libraries;  ///< how headers of other libraries begin that a room may include
};

inline RoomList read_room_list() {
  RoomList list;
  std::istringstream lines(
      file_text(std::filesystem::path(MESAMIS_SOURCE_DIR) / "src/mesamis/rooms.txt"));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string name, kind;
    words >> name >> kind;
    list.names.push_back(name);
    for (std::string word; words >> word;) {
      if (word[0] == '<') {
        list.libraries[name].insert(word.substr(1));
      } else {
        list.arrows[name].insert(word);
      }
    }
  }
  return list;
}

/// What stands in the #include lines of a file.
inline std::vector<std::string> includes_of(const std::filesystem::path& file) {
  static const std::regex include("#include [<\"]([^>\"]+)[>\"]");
  const std::string text = file_text(file);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end; ++match) {
    found.push_back((*match)[1]);
  }
  return found;
}

/// The headers that one leads to, itself included; names below src/ and tools/.
inline std::set<std::string> reached_from(const std::string& door) {
  std::set<std::string> reached;
  std::vector<std::string> open{door};
  while (!open.empty()) {
    const std::string header = open.back();
    open.pop_back();
    if (header.rfind("mesamis/", 0) != 0 || !reached.insert(header).second) continue;
    for (const char* root : {"src", "tools"}) {
      const auto file = std::filesystem::path(MESAMIS_SOURCE_DIR) / root / header;
      for (const auto& to : includes_of(file)) open.push_back(to);
    }
  }
  return reached;
}

}  // namespace mesamis
