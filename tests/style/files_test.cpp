// SPDX-License-Identifier: Apache-2.0
// What every file of the project has in common.
#include <gtest/gtest.h>

#include <regex>
#include <string>

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

void check_links(const fs::path& page) {
  static const std::regex link(R"re(\]\(([^)\s#]+)|(?:src|href)="([^"#]+)")re");
  const std::string text = file_text(page);
  for (std::sregex_iterator match(text.begin(), text.end(), link), end; match != end; ++match) {
    const std::string target = (*match)[1].matched ? (*match)[1] : (*match)[2];
    if (target.find("://") != std::string::npos || target.rfind("mailto:", 0) == 0) continue;
    EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << " links to " << target;
  }
}

TEST(Files, LinksOfThePagesResolve) {
  const fs::path root(MESAMIS_SOURCE_DIR);
  for (const auto* page : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"}) {
    ASSERT_TRUE(fs::exists(root / page)) << page;
    check_links(root / page);
  }
  for (const auto& page : project_files("docs", {".md"})) check_links(page);
}

}  // namespace
}  // namespace mesamis
