// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/run_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Result run() {
  Result result;
  result.surface = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  result.expected_error = {0.1, 0.2, 0.3};
  result.parameters.level = 0.1;
  return result;
}

TEST(RunSurface, SaysTheProgramAndTheSettingsUsed) {
  const SurfaceWriteOptions as = surface_options(run(), 1, {.frame = Frame::kRas, .name = "hip"});
  EXPECT_EQ(as.frame, Frame::kRas);
  EXPECT_EQ(as.name, "hip");
  ASSERT_EQ(as.metadata.size(), 2u);
  EXPECT_EQ(as.metadata[0].first, "producer");
  EXPECT_THAT(as.metadata[0].second, HasSubstr("mesamis"));
  EXPECT_EQ(nlohmann::json::parse(as.metadata[1].second)["level"], 0.1);
  EXPECT_TRUE(as.grey.empty());
  EXPECT_TRUE(as.point_arrays.empty());
}

TEST(RunSurface, MarksAPreviewAndAddsTheErrorIfAsked) {
  Result result = run();
  result.parameters.preview = true;
  const SurfaceWriteOptions as = surface_options(result, 1, {.error = true, .grey = true});
  EXPECT_EQ(as.name, "mesamis surface (preview)");
  EXPECT_TRUE(as.grey.empty()) << "there is no mesh to take them from";
  ASSERT_EQ(as.point_arrays.size(), 1u);
  EXPECT_EQ(as.point_arrays[0].name, "expected_error");
  EXPECT_EQ(as.point_arrays[0].values, result.expected_error);
}

TEST(RunSurface, WithoutTrianglesIsRefusedAndSaysWhatToChange) {
  EXPECT_NO_THROW(require_surface(run(), {}));
  Result result;
  result.parameters.level = 0.1;
  Settings asked;
  asked.level = 0.1;
  EXPECT_REFUSED(require_surface(result, asked), HasSubstr("values above --level 0.1, found none"));
  result.parameters.level = 285.18468755167737;
  EXPECT_REFUSED(require_surface(result, {}),
                 AllOf(HasSubstr("above the level of 285.2 that"), Not(HasSubstr("--level"))));
  auto& parts = result.printable.parts.emplace();
  parts.islands_dropped = 3;
  parts.volume_dropped = 0.1 + 0.2;
  asked.min_volume = result.parameters.min_volume = 20;
  EXPECT_REFUSED(require_surface(result, asked),
                 HasSubstr("at least --min-volume 20 mm^3, found 3 of 0.3 mm^3 in all"));
  EXPECT_REFUSED(require_surface(result, {}),
                 HasSubstr("at least 20 mm^3, found 3 of 0.3 mm^3 in all; --min-volume 0 keeps"));
  result.parameters.surface = SurfaceKind::kBand;
  result.parameters.band_threshold = 0.25;
  EXPECT_REFUSED(require_surface(result, {}),
                 HasSubstr("v below --band-threshold 0.25, found none"));
}

}  // namespace
}  // namespace mesamis
