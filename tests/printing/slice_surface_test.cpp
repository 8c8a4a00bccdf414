// SPDX-License-Identifier: Apache-2.0
// With stand-ins for the slicers; tests/app/slice_test.cpp runs the real ones where installed.
#include "mesamis/printing/slice_surface.h"

#include <gmock/gmock.h>
#include <signal.h>

#include <numbers>

#include "mesamis/base/error.h"
#include "mesamis/shape_files/surface_files.h"
#include "support/script.h"
#include "support/shapes.h"
#include "support/variable.h"

namespace mesamis {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;

/// Two slicers made of shell lines: sound by --info, else they do as told.
class SliceSurface : public testing::Test {
 protected:
  SliceSurface() {
    std::filesystem::create_directories(folder_ / "temporary");
    options_.settings.bed = {100, 80, 60};
    options_.gcode = folder_ / "a.gcode";
    prusa(kTwoLayers);
  }
  ~SliceSurface() override {
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "temporary")) << "nothing is left behind";
  }

  void prusa(const std::string& lines, const std::string& info = "manifold = yes") {
    write_script(folder_ / "bin/prusa-slicer",
                 "case \"$*\" in *--info*) echo '" + info + "'; exit 0;; esac\n" + lines);
  }

  void cura(const std::string& lines) {
    options_.slicer = Slicer::kCuraEngine;
    write_script(folder_ / "bin/CuraEngine", lines);
    write_bytes(folder_ / "definitions/fdmprinter.def.json", "{}");
  }

  SliceResult slice(const TriMesh& surface = cube({-7, 30, 5}, 0.6)) {
    const Variable path("PATH", (folder_ / "bin").string() + ":/usr/bin:/bin");
    const Variable temporary("TMPDIR", folder_ / "temporary");
    const Variable definitions("CURA_ENGINE_SEARCH_PATH", folder_ / "definitions");
    return slice_surface(surface, options_);
  }

  /// Why slicing failed; nothing may be written then.
  template <class Error>
  std::string failure() {
    std::filesystem::remove(options_.gcode);
    try {
      slice();
    } catch (const Error& error) {
      EXPECT_FALSE(std::filesystem::exists(options_.gcode));
      return error.what();
    }
    return "";
  }

  static constexpr const char* kTwoLayers =
      "printf ';LAYER_CHANGE\\n;LAYER_CHANGE\\n; filament used [mm] = 1000\\n"
      "; threads = 7\\n' > print.gcode";

  TempFolder folder_;
  SliceOptions options_;
};

TEST_F(SliceSurface, GivesTheGcodeAndItsFacts) {
  const SliceResult result = slice();
  EXPECT_EQ(result.outcome, SliceOutcome::kSliced);
  EXPECT_EQ(result.triangles, 12u);
  EXPECT_NEAR(result.size.z, 0.6, 1e-12);
  EXPECT_TRUE(result.check.prusa && result.check.prusa->sound());
  EXPECT_EQ(result.run.program, folder_ / "bin/prusa-slicer");
  EXPECT_FALSE(result.run.arguments.empty());
  EXPECT_GT(result.run.seconds, 0);
  EXPECT_EQ(result.gcode.layers, 2);
  EXPECT_THAT(result.warnings, IsEmpty());
  EXPECT_THAT(read_bytes(options_.gcode), testing::Not(HasSubstr("threads")));
  EXPECT_EQ(result.gcode.bytes, std::ssize(read_bytes(options_.gcode)));
}

TEST_F(SliceSurface, VolumeAndMassFollowFromTheLengthOfTheFilament) {
  const GcodeFacts facts = slice().gcode;
  const double volume = std::numbers::pi / 4 * 1.75 * 1.75;  // of a metre, cm^3
  EXPECT_THAT(facts.filament_cm3, Optional(DoubleNear(volume, 1e-12)));
  EXPECT_THAT(facts.filament_g, Optional(DoubleNear(1.24 * volume, 1e-12)));
}

TEST_F(SliceSurface, WithoutAPathTheGcodeIsReadAndNotKept) {
  options_.gcode.clear();
  EXPECT_EQ(slice().gcode.layers, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.gcode"));
}

/// What the slicer is given: the surface where it is printed.
TEST_F(SliceSurface, HandsOverThePlacedSurface) {
  prusa("cp surface.stl " + (folder_ / "seen.stl").string() + "\n" + kTwoLayers);
  slice();
  const TriMesh seen = read_surface(folder_ / "seen.stl");
  for (const Vec3& p : seen.points) {
    EXPECT_NEAR(std::abs(p.x - 50), 0.3, 1e-5);
    EXPECT_NEAR(std::abs(p.y - 40), 0.3, 1e-5);
    EXPECT_NEAR(std::abs(p.z - 0.3), 0.3, 1e-5);
  }
}

TEST_F(SliceSurface, AnOpenSurfaceIsAnOutcomeAndNoSlicerRuns) {
  prusa("touch " + (folder_ / "ran").string());
  TriMesh open = cube();
  open.triangles.pop_back();
  const SliceResult result = slice(open);
  EXPECT_EQ(result.outcome, SliceOutcome::kNotPrintable);
  EXPECT_EQ(print_flaws_of(result.check), "3 open edges");
  EXPECT_FALSE(result.check.prusa.has_value());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "ran"));
  EXPECT_FALSE(std::filesystem::exists(options_.gcode));
}

TEST_F(SliceSurface, WhatPrusaSlicerWouldRepairIsNotSlicedByEither) {
  cura("touch " + (folder_ / "ran").string());
  prusa("", "facets_reversed = 2");
  EXPECT_EQ(slice().outcome, SliceOutcome::kNotPrintable);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "ran"));
}

TEST_F(SliceSurface, ASurfaceLargerThanTheBedIsAnOutcome) {
  EXPECT_EQ(slice(cube({0, 0, 0}, 60)).outcome, SliceOutcome::kSliced);
  const SliceResult result = slice(cube({0, 0, 0}, 60.5));
  EXPECT_EQ(result.outcome, SliceOutcome::kDoesNotFit);
  EXPECT_NEAR(result.size.z, 60.5, 1e-12);
}

TEST_F(SliceSurface, CuraEnginesHeaderComesFromItsLog) {
  cura(
      "printf ';TIME:6666\\n;Generated with Cura_SteamEngine 4.13.0\\n;LAYER:0\\n;LAYER:1\\n' "
      "> print.gcode\n"
      "printf 'Gcode header after slicing:\\n;TIME:60\\n;Filament used: 0.5m\\n"
      "End of gcode header.\\n'");
  const SliceResult result = slice();
  EXPECT_THAT(result.gcode.print_seconds, Optional(60.0));
  EXPECT_THAT(result.gcode.filament_mm, Optional(500.0));
  EXPECT_EQ(result.gcode.version, "4.13.0");
  EXPECT_THAT(result.warnings, IsEmpty());
}

TEST_F(SliceSurface, WhatIsNotKnownIsAWarning) {
  cura("printf ';TIME:6666\\n;Filament used: 0m\\n;LAYER:0\\n' > print.gcode");
  const SliceResult result = slice(cube({0, 0, 0}, 6));
  EXPECT_EQ(result.gcode.print_seconds, std::nullopt);
  EXPECT_EQ(result.gcode.filament_g, std::nullopt);
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("logged no header"),
                                           HasSubstr("has 1 layers, expected about 20")));
}

TEST_F(SliceSurface, SurfacesThatMeetAreSlicedWithAWarning) {
  const SliceResult result = slice(joined(cube({0, 0, 0}, 0.6), cube({0.3, 0.3, 0}, 0.6)));
  EXPECT_EQ(result.outcome, SliceOutcome::kSliced);
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("pairs of triangles meet")));
}

TEST_F(SliceSurface, AFailureIsOneLineWithItsReason) {
  prusa("echo '10 => slicing'; echo 'error: no luck'; exit 3");
  EXPECT_EQ(failure<NumericalError>(),
            "PrusaSlicer: expected G-code, found exit status 3: error: no luck");
  prusa("kill -11 $$");
  EXPECT_EQ(failure<NumericalError>(), "PrusaSlicer: expected G-code, found signal 11");
  prusa("true");
  EXPECT_EQ(failure<NumericalError>(), "PrusaSlicer: expected G-code, found none");
  prusa("echo G1 > print.gcode");
  EXPECT_EQ(failure<NumericalError>(), "PrusaSlicer: expected layers in its G-code, found none");
  write_script(folder_ / "bin/prusa-slicer", "echo 'error: no display'; exit 1");
  EXPECT_EQ(failure<NumericalError>(),
            "prusa-slicer --info: expected exit status 0, found exit status 1: error: no display");
}

TEST_F(SliceSurface, ASlicerThatTakesTooLongIsKilled) {
  prusa("exec sleep 60");
  options_.timeout_seconds = 0.3;
  EXPECT_EQ(failure<NumericalError>(),
            "PrusaSlicer: expected G-code, found none before the timeout");
}

TEST_F(SliceSurface, StopsWhenTheProgressFunctionSaysSo) {
  const std::string number = folder_ / "number";
  prusa("echo $$ > " + number + "; exec sleep 60");
  std::vector<std::string> stages;
  options_.progress = [&](std::string_view stage, double) {
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    return read_bytes(number).empty();
  };
  EXPECT_THROW(slice(), Cancelled);
  EXPECT_THAT(stages, ElementsAre("check", "slice"));
  EXPECT_NE(kill(std::stoi(read_bytes(number)), 0), 0) << "the slicer is gone";
  EXPECT_FALSE(std::filesystem::exists(options_.gcode));
}

TEST_F(SliceSurface, RefusesSettingsAndPlacesThatCannotBe) {
  options_.settings.layer = 1;
  EXPECT_THAT(failure<InputError>(), HasSubstr("layer: expected"));
  options_.settings.layer = 0.3;
  options_.gcode = folder_ / "none/a.gcode";
  EXPECT_THAT(failure<InputError>(), HasSubstr("none"));
}

}  // namespace
}  // namespace mesamis
