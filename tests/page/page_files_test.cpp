// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/page_files.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesamis/files/output_set.h"
#include "page/sample_run.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

TEST(PageFiles, WritesNoFileThatWasNotNamed) {
  const TempFolder folder;
  const SampleRun run;
  const PageFiles files{folder / "a.html", folder / "pictures"};
  OutputSet set;
  write_page(files, run.page(), set);
  set.commit();
  const std::vector<fs::path> named = page_outputs(files);
  std::size_t found = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
    if (!entry.is_regular_file()) continue;
    ++found;
    EXPECT_EQ(std::count(named.begin(), named.end(), entry.path()), 1) << entry.path();
  }
  EXPECT_EQ(found, named.size());
}

TEST(PageFiles, AreWrittenWhereAskedFor) {
  const TempFolder folder;
  EXPECT_TRUE(page_outputs({}).empty());
  OutputSet set;
  write_page({folder / "a.html"}, SampleRun().page(), set);
  EXPECT_FALSE(fs::exists(folder / "a.html"));
  set.commit();
  EXPECT_TRUE(fs::exists(folder / "a.html"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace mesamis
