// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "page/sample_run.h"
#include "support/throws.h"

namespace mesamis {
namespace {

std::vector<std::string> names_of(const std::vector<RunPicture>& pictures) {
  std::vector<std::string> names;
  for (const RunPicture& picture : pictures) names.push_back(picture.name);
  return names;
}

TEST(RunPictures, AreOfWhatIsThere) {
  const SampleRun run;
  RunPage page = run.page();
  const auto all = run_pictures(page, 120);
  EXPECT_THAT(names_of(all),
              testing::ElementsAre("surface-front.png", "surface-left.png", "surface-top.png",
                                   "surface-oblique.png", "slice-axial.png", "slice-coronal.png",
                                   "slice-sagittal.png", "mesh-cut.png"));
  for (const RunPicture& picture : all) EXPECT_EQ(picture.png.substr(1, 3), "PNG") << picture.name;
  EXPECT_EQ(run_pictures(page, 120)[7].png, all[7].png);
  page.mesh = nullptr;
  page.surfaces.clear();
  EXPECT_THAT(names_of(run_pictures(page, 64)),
              testing::ElementsAre("slice-axial.png", "slice-coronal.png", "slice-sagittal.png"));
}

TEST(RunPictures, HaveASizeWithinBounds) {
  const SampleRun run;
  for (const int pixels : {0, 63, 4097}) {
    EXPECT_REFUSED(run_pictures(run.page(), pixels), testing::HasSubstr("64 to 4096"));
  }
}

}  // namespace
}  // namespace mesamis
