// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/charts.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "page/sample_run.h"

namespace mesamis {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Histogram, MarksWindowThresholdAndLevel) {
  const SampleRun run;
  const std::string svg = histogram_svg(run.scan, sample_report());
  EXPECT_THAT(svg, StartsWith("<svg"));
  for (const char* name :
       {"voxels", "window, low", "window, high", "threshold", "level", "value, HU"}) {
    EXPECT_THAT(svg, HasSubstr(name));
  }
  EXPECT_THAT(histogram_svg(run.scan, json::object()), testing::Not(HasSubstr("threshold")));
}

TEST(Histogram, OfAnImageOfTwoValuesIsDrawn) {
  Volume flat = make_ball({.noise = 0, .blur = 1e-3});
  EXPECT_THAT(histogram_svg(flat, {{"surface", {{"level_native", 1e6}}}}), StartsWith("<svg"));
}

TEST(Histogram, LeavesOutWhatNoAxisHolds) {
  const SampleRun run;
  json report = sample_report();
  for (const json& window : {json{-1e308, 1e308}, json{-1e308, 200}, json{100, 1e308}}) {
    report["grey"]["window_native"] = window;
    for (const double threshold : {-1e308, 1e308, 150.0}) {
      report["settings"]["threshold"] = threshold;
      const std::string svg = histogram_svg(run.scan, report);
      for (const char* no : {"nan", "inf", "1e+308", "e+308"}) {
        EXPECT_THAT(svg, testing::Not(HasSubstr(no))) << window << " " << threshold;
      }
      EXPECT_THAT(svg, HasSubstr("level"));
    }
  }
}

TEST(Passes, AreDrawnFromTheSecondOn) {
  const json report = sample_report();
  EXPECT_THAT(energy_svg(report), HasSubstr("fidelity"));
  EXPECT_THAT(cells_svg(report), HasSubstr("tetrahedra"));
  EXPECT_EQ(movement_svg(report), "") << "measured once alone";
  json once = report;
  once["iterations"].erase(1);
  EXPECT_EQ(energy_svg(once), "");
  EXPECT_EQ(cells_svg(json::object()), "");
}

}  // namespace
}  // namespace mesamis
