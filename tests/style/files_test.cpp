// SPDX-License-Identifier: Apache-2.0
// What every file of the project has in common.
#include <gtest/gtest.h>

#include <cctype>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "style/project_files.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kCodeFolders{"src",   "tools",    "app",   "tests",
                                            "bench", "examples", "python"};

TEST(Files, SourcesNameTheirLicence) {
  auto folders = kCodeFolders;
  folders.insert(folders.end(), {"cmake", "scripts", ".ci"});
  std::size_t seen = 0;
  for (const auto& folder : folders) {
    for (const auto& file :
         project_files(folder, {".h", ".cpp", ".txt", ".cmake", ".in", ".py", ".pyi", ""})) {
      const std::string head = file_text(file).substr(0, 200);
      EXPECT_NE(head.find("SPDX-License-Identifier: Apache-2.0"), std::string::npos) << file;
      ++seen;
    }
  }
  EXPECT_GT(seen, 50u);
}

TEST(Files, NamesAreSnakeCase) {
  static const std::regex snake("[a-z0-9_]+");
  for (const auto& folder : kCodeFolders) {
    for (const auto& file : project_files(folder, {".h", ".cpp"})) {
      EXPECT_TRUE(std::regex_match(file.stem().string(), snake)) << file;
    }
  }
}

TEST(Files, EveryTestIsBuilt) {
  const fs::path root(MESAMIS_SOURCE_DIR);
  const std::string folders =
      file_text(root / "tests/CMakeLists.txt") + file_text(root / "src/mesamis/rooms.txt");
  for (const auto& file : project_files("tests", {".cpp"})) {
    const std::string list = file_text(file.parent_path() / "CMakeLists.txt");
    if (list.find("mesamis_add_test") == std::string::npos) continue;
    const std::string folder = file.parent_path().filename().string();
    EXPECT_TRUE(std::regex_search(folders, std::regex("\\b" + folder + "\\b")))
        << "tests/" << folder << " is in neither list of folders";
    EXPECT_NE(list.find(file.filename().string()), std::string::npos)
        << file << " is not in its CMakeLists.txt";
  }
}

/// The pages that people read.
std::vector<fs::path> pages() {
  std::vector<fs::path> all = project_files("docs", {".md"});
  for (const char* page : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"}) {
    all.push_back(fs::path(MESAMIS_SOURCE_DIR) / page);
  }
  return all;
}

/// The lines of a page that are no code.
std::vector<std::string> prose_of(const fs::path& page) {
  std::vector<std::string> lines;
  std::istringstream text(file_text(page));
  bool code = false;
  for (std::string line; std::getline(text, line);) {
    line.erase(0, line.find_first_not_of(' '));
    if (line.rfind("```", 0) == 0) {
      code = !code;
    } else if (!code) {
      lines.push_back(line);
    }
  }
  return lines;
}

/// What links to a heading end in.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading.substr(heading.find_first_not_of("# "))) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ') anchor += '-';
    if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80) {
      anchor += static_cast<char>(std::tolower(byte));
    }
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  for (const std::string& line : prose_of(page)) {
    if (line.rfind('#', 0) == 0) anchors.insert(anchor_of(line));
  }
  return anchors;
}

void check_links(const fs::path& page) {
  static const std::regex link(R"re(\]\(([^)\s#]*)(#[^)\s]*)?\)|(?:src|href)="([^"#]+)")re");
  const std::string text = file_text(page);
  for (std::sregex_iterator match(text.begin(), text.end(), link), end; match != end; ++match) {
    const std::string target = (*match)[1].str() + (*match)[3].str(), anchor = (*match)[2];
    if (target.find("://") != std::string::npos) continue;
    const fs::path file = target.empty() ? page : page.parent_path() / target;
    EXPECT_TRUE(fs::exists(file)) << page << " links to " << target;
    if (anchor.empty() || file.extension() != ".md") continue;
    EXPECT_EQ(anchors_of(file).count(anchor.substr(1)), 1u)
        << page << " links to " << target << anchor;
  }
}

TEST(Files, LinksOfThePagesResolve) {
  for (const fs::path& page : pages()) check_links(page);
}

/// Cells of a row: a bar behind a backslash, or in code, divides none.
std::size_t cells_of(const std::string& row) {
  std::size_t bars = 0;
  bool code = false;
  for (std::size_t n = 0; n < row.size(); ++n) {
    if (row[n] == '`') code = !code;
    if (row[n] == '|' && !code && (n == 0 || row[n - 1] != '\\')) ++bars;
  }
  return bars - 1;
}

TEST(Files, TablesOfThePagesAreWhole) {
  std::size_t tables = 0;
  for (const fs::path& page : pages()) {
    std::size_t row = 0, cells = 0;
    for (const std::string& line : prose_of(page)) {
      if (line.rfind('|', 0) != 0) {
        EXPECT_EQ(line.find("|---"), std::string::npos) << page << ": " << line;
        row = 0;
        continue;
      }
      if (row++ == 0) cells = cells_of(line);
      if (row == 2) {
        EXPECT_EQ(line.find_first_not_of("|-: "), std::string::npos) << page << ": " << line;
        ++tables;
      }
      EXPECT_EQ(cells_of(line), cells) << page << ": " << line;
    }
  }
  EXPECT_GT(tables, 50u);
}

}  // namespace
}  // namespace mesamis
