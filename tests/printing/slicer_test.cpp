// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/slicer.h"

#include <gmock/gmock.h>

#include "mesamis/base/error.h"
#include "support/script.h"
#include "support/variable.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

std::string refusal(Slicer slicer) {
  try {
    require_slicer(slicer);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Slicer, IsFoundInPath) {
  const TempFolder folder;
  write_script(folder / "prusa-slicer", "");
  const Variable path("PATH", folder.path());
  const InstalledSlicer slicer = require_slicer(Slicer::kPrusaSlicer);
  EXPECT_EQ(slicer.program, folder / "prusa-slicer");
  EXPECT_EQ(slicer.definition, "");
  EXPECT_EQ(slicer.slicer, Slicer::kPrusaSlicer);
  EXPECT_EQ(find_slicer(Slicer::kCuraEngine), "");
}

TEST(Slicer, CuraEnginesDefinitionsAreSearchedInItsOwnPath) {
  const TempFolder folder;
  write_script(folder / "CuraEngine", "");
  write_bytes(folder / "settings/fdmprinter.def.json", "{}");
  const Variable path("PATH", folder.path());
  const Variable place("CURA_ENGINE_SEARCH_PATH", "/none:" + (folder / "settings").string());
  EXPECT_EQ(require_slicer(Slicer::kCuraEngine).definition,
            folder / "settings/fdmprinter.def.json");
}

TEST(Slicer, AMissingOneIsNamedWithItsPackage) {
  const TempFolder folder;
  const Variable path("PATH", folder.path());
  EXPECT_EQ(refusal(Slicer::kPrusaSlicer),
            "prusa-slicer: expected this program in PATH, found none; on Debian: apt install "
            "prusa-slicer");
  EXPECT_THAT(refusal(Slicer::kCuraEngine), HasSubstr("apt install cura-engine"));
}

TEST(Slicer, NamesAreThoseOfTheProducts) {
  EXPECT_STREQ(slicer_name(Slicer::kPrusaSlicer), "PrusaSlicer");
  EXPECT_STREQ(slicer_name(Slicer::kCuraEngine), "CuraEngine");
}

}  // namespace
}  // namespace mesamis
