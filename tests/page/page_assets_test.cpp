// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/page_assets.h"

#include <gmock/gmock.h>

#include "mesamis/page/run_page.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(PageAssets, AreTheFilesAndEndNoScript) {
  const std::filesystem::path room = std::filesystem::path(MESAMIS_SOURCE_DIR) / "src/mesamis/page";
  EXPECT_EQ(page_style(), read_bytes(room / "assets/page.css"));
  EXPECT_EQ(page_script(), read_bytes(room / "assets/page.js"));
  const std::string script(page_script());
  EXPECT_THAT(script, Not(HasSubstr("</script")));
  EXPECT_THAT(script, Not(HasSubstr("<!--")));
  EXPECT_THAT(std::string(page_style()), Not(HasSubstr("</style")));
  EXPECT_THAT(std::string(page_style()), Not(HasSubstr("url(")));
}

TEST(PageAssets, TheScriptAsksForNothing) {
  const std::string script(page_script());
  for (const char* word : {"fetch(", "XMLHttpRequest", "WebSocket", "http", "import(", "eval("}) {
    EXPECT_THAT(script, Not(HasSubstr(word)));
  }
}

}  // namespace
}  // namespace mesamis
