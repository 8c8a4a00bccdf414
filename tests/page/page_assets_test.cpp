// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/page_assets.h"

#include <gmock/gmock.h>

#include "mesamis/page/run_page.h"
#include "support/temp_folder.h"

namespace mesamis::detail {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(PageAssets, AreTheFilesAndEndNoScript) {
  const std::filesystem::path room = std::filesystem::path(MESAMIS_SOURCE_DIR) / "src/mesamis/page";
  EXPECT_EQ(page_style(), read_bytes(room / "assets/page.css"));
  EXPECT_EQ(page_script(), read_bytes(room / "assets/page.js"));
  for (const std::string& text : {std::string(page_script()), std::string(viewer_script())}) {
    EXPECT_THAT(text, Not(HasSubstr("</script")));
    EXPECT_THAT(text, Not(HasSubstr("<!--")));
  }
  EXPECT_THAT(std::string(page_style()), Not(HasSubstr("</style")));
  EXPECT_THAT(std::string(page_style()), Not(HasSubstr("url(")));
}

TEST(PageAssets, TheViewerComesWithItsLicence) {
  EXPECT_THAT(std::string(viewer_licence()), HasSubstr("Redistributions in binary form"));
  if (!has_viewer()) GTEST_SKIP() << "the viewer is not part of this build: npm was not at hand";
  EXPECT_THAT(std::string(viewer_script()), HasSubstr("niivue"));
}

}  // namespace
}  // namespace mesamis::detail
