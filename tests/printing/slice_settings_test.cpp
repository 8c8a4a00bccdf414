// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/slice_settings.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "mesamis/base/error.h"

namespace mesamis {
namespace {

std::string refusal(const std::function<void(SliceSettings&)>& change) {
  SliceSettings settings;
  change(settings);
  try {
    require_valid(settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SliceSettings, TheDefaultsAndTheEndsOfTheRangesAreValid) {
  EXPECT_EQ(refusal([](SliceSettings&) {}), "");
  EXPECT_EQ(refusal([](SliceSettings& s) { s.layer = kLayerMin, s.infill = 0, s.perimeters = 0; }),
            "");
  EXPECT_EQ(refusal([](SliceSettings& s) {
              s.layer = kNozzle, s.infill = 100, s.perimeters = kPerimetersMax;
            }),
            "");
}

TEST(SliceSettings, WhatIsOutOfRangeIsNamed) {
  EXPECT_EQ(refusal([](SliceSettings& s) { s.layer = 0.5; }),
            "layer: expected 0.02 to 0.4 mm, found 0.5");
  EXPECT_EQ(refusal([](SliceSettings& s) { s.infill = -1; }),
            "infill: expected 0 to 100 percent, found -1");
  EXPECT_EQ(refusal([](SliceSettings& s) { s.perimeters = 101; }),
            "perimeters: expected 0 to 100, found 101");
  EXPECT_THAT(refusal([](SliceSettings& s) { s.layer = std::nan(""); }),
              testing::HasSubstr("layer: expected"));
  EXPECT_THAT(refusal([](SliceSettings& s) { s.bed.depth = 0; }), testing::HasSubstr("bed"));
}

}  // namespace
}  // namespace mesamis
