// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/slicer_arguments.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace mesamis {
namespace {

using testing::Contains;

const InstalledSlicer kPrusa{Slicer::kPrusaSlicer, "/bin/prusa-slicer", {}};
const InstalledSlicer kCura{Slicer::kCuraEngine, "/bin/CuraEngine",
                            "/definitions/fdmprinter.def.json"};

/// The value after an option.
std::string value_of(const std::vector<std::string>& arguments, const std::string& option) {
  const auto at = std::find(arguments.begin(), arguments.end(), option);
  return at == arguments.end() || at + 1 == arguments.end() ? "none" : *(at + 1);
}

TEST(SlicerArguments, PrusaSlicerIsToldTheSettings) {
  SliceSettings settings;
  settings.layer = 0.1;
  settings.infill = 12.5;
  settings.perimeters = 3;
  settings.bed = {300, 200.5, 400};
  const auto arguments = slicer_arguments(kPrusa, settings);
  EXPECT_EQ(value_of(arguments, "--layer-height"), "0.1");
  EXPECT_EQ(value_of(arguments, "--first-layer-height"), "0.1");
  EXPECT_EQ(value_of(arguments, "--fill-density"), "12.5%");
  EXPECT_EQ(value_of(arguments, "--perimeters"), "3");
  EXPECT_EQ(value_of(arguments, "--bed-shape"), "0x0,300x0,300x200.5,0x200.5");
  EXPECT_EQ(value_of(arguments, "--max-print-height"), "400");
  EXPECT_EQ(value_of(arguments, "--top-solid-layers"), "8") << "0.8 mm";
  EXPECT_THAT(arguments, testing::Not(Contains("--support-material")));
  settings.support = true;
  EXPECT_THAT(slicer_arguments(kPrusa, settings), Contains("--support-material"));
}

TEST(SlicerArguments, CuraEngineIsToldWhatCuraComputes) {
  SliceSettings settings;
  settings.infill = 20;
  const auto arguments = slicer_arguments(kCura, settings);
  EXPECT_EQ(value_of(arguments, "-j"), "/definitions/fdmprinter.def.json");
  EXPECT_THAT(arguments, Contains("layer_height=0.3"));
  EXPECT_THAT(arguments, Contains("layer_height_0=0.3"));
  EXPECT_THAT(arguments, Contains("wall_line_count=2"));
  EXPECT_THAT(arguments, Contains("infill_line_distance=4")) << "a grid has two directions";
  EXPECT_THAT(arguments, Contains("top_layers=3"));
  EXPECT_THAT(arguments, Contains("mesh_position_x=-125"));
  settings.infill = 50;
  EXPECT_THAT(slicer_arguments(kCura, settings), Contains("infill_line_distance=0.8"));
  settings.infill = 0;
  EXPECT_THAT(slicer_arguments(kCura, settings), Contains("infill_line_distance=0"));
}

TEST(SlicerArguments, BothReadTheSurfaceAndWriteTheGcodeOfTheirFolder) {
  for (const InstalledSlicer& slicer : {kPrusa, kCura}) {
    const auto arguments = slicer_arguments(slicer, {});
    EXPECT_EQ(arguments.back(), kSurfaceFile);
    EXPECT_THAT(arguments, Contains(kGcodeFile));
  }
}

/// The shell is at least kShell thick, whatever the layer.
TEST(SlicerArguments, SolidLayersAreAsThickAsTheShell) {
  SliceSettings settings;
  for (const double layer : {0.02, 0.1, 0.25, 0.3, 0.4}) {
    settings.layer = layer;
    const int count = std::stoi(value_of(slicer_arguments(kPrusa, settings), "--top-solid-layers"));
    EXPECT_GE(count * layer, kShell - 1e-9) << layer;
    EXPECT_LT((count - 1) * layer, kShell - 1e-9) << layer;
  }
}

}  // namespace
}  // namespace mesamis
