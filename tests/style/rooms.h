// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <regex>
#include <set>
#include <string>

#include "style/project_files.h"

namespace mesamis {

/// What a room's sources.cmake lists.
struct Room {
  std::filesystem::path folder;
  std::set<std::string> doors, inner_doors, sources;
};

/// The words of set(NAME ...) in a CMake file.
inline std::set<std::string> cmake_list(const std::string& text, const std::string& name) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex("set\\(" + name + "\\s([^)]*)\\)"))) return {};
  static const std::regex word("\\S+");
  const std::string words = match[1];
  return {std::sregex_token_iterator(words.begin(), words.end(), word), {}};
}

/// Every room of src/mesamis/ by its name.
inline std::map<std::string, Room> read_rooms() {
  std::map<std::string, Room> rooms;
  for (const auto& file : project_files("src/mesamis", {".cmake"})) {
    const std::string text = file_text(file);
    const std::string name = file.parent_path().filename().string();
    rooms[name] = {file.parent_path(), cmake_list(text, "ROOM_HEADERS"),
                   cmake_list(text, "ROOM_INNER_HEADERS"), cmake_list(text, "ROOM_SOURCES")};
  }
  return rooms;
}

}  // namespace mesamis
