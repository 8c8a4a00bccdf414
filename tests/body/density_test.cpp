// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <limits>
#include <string>

#include "mesamis/body/material_law.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Density, CalibrationPassesThroughItsPoints) {
  const Calibration line = calibration_through({-1000, -0.7}, {2345, 1.6});
  EXPECT_NEAR(line.at(-1000), -0.7, 1e-14);
  EXPECT_NEAR(line.at(2345), 1.6, 1e-14);
  EXPECT_NEAR(line.at(672.5), 0.45, 1e-14);
}

TEST(Density, CalibrationsAreReadInBothForms) {
  EXPECT_EQ(parse_calibration("-0.0039,0.00079"), (Calibration{-0.0039, 0.00079}));
  EXPECT_EQ(parse_calibration("+1e-2,5e-4"), (Calibration{0.01, 0.0005}));
  const Calibration line = parse_calibration("0:0.1,1000:0.6");
  EXPECT_DOUBLE_EQ(line.offset, 0.1);
  EXPECT_DOUBLE_EQ(line.slope, 0.0005);
  EXPECT_EQ(parse_calibration("1000:0.6,0:0.1").slope, line.slope);
}

TEST(Density, CalibrationsOfAnotherFormAreRefused) {
  for (const char* text : {"", "1", "1,", "a,b", "1;2", "1,2,3", "1:2", "1:2,3", "1:2,3:4,5",
                           "1, 2", "inf,1", "+-1,2", "1e999,2", "nan,1", "1,2 ", "1:2,3:"}) {
    EXPECT_REFUSED(parse_calibration(text), AllOf(HasSubstr("expected a,b or HU1:rho1,HU2:rho2"),
                                                  HasSubstr("'" + std::string(text) + "'")));
  }
  EXPECT_REFUSED(parse_calibration("1\n,2"), HasSubstr("'1?,2'"));
}

TEST(Density, FallingCalibrationsAreRefused) {
  EXPECT_REFUSED(parse_calibration("0,-1"), HasSubstr("positive slope"));
  EXPECT_REFUSED(parse_calibration("0,0"), HasSubstr("positive slope"));
  EXPECT_REFUSED(parse_calibration("0:1,100:0.5"), HasSubstr("rises with the native value"));
  EXPECT_REFUSED(parse_calibration("5:1,5:2"), HasSubstr("rises"));
  EXPECT_REFUSED(parse_calibration("5:1,6:1"), HasSubstr("found 5:1,6:1"));
}

TEST(Density, KindsFollowFromOneAnother) {
  const DensityModel model{{-0.01, 0.0008}, kSchileoAsh2008, 0.6};
  for (const double native : {-200.0, 0.0, 333.0, 1500.0}) {
    const double qct = -0.01 + 0.0008 * native, ash = 0.877 * qct + 0.079;
    EXPECT_NEAR(calibration_to(DensityKind::kQct, model).at(native), qct, 1e-14);
    EXPECT_NEAR(calibration_to(DensityKind::kAsh, model).at(native), ash, 1e-14);
    EXPECT_NEAR(calibration_to(DensityKind::kApparent, model).at(native), ash / 0.6, 1e-14);
  }
  const DensityModel plain{{-0.01, 0.0008}, kAshEqualsQct};
  EXPECT_EQ(calibration_to(DensityKind::kAsh, plain), plain.qct);
}

TEST(Density, RulesAreFoundByName) {
  EXPECT_EQ(find_ash_rule("equal"), kAshEqualsQct);
  EXPECT_EQ(find_ash_rule("schileo-2008"), kSchileoAsh2008);
  EXPECT_REFUSED(find_ash_rule("schileo"),
                 HasSubstr("expected equal or schileo-2008, found 'schileo'"));
}

TEST(Density, KindsHaveTheirNames) {
  EXPECT_STREQ(density_name(DensityKind::kQct), "QCT");
  EXPECT_STREQ(density_name(DensityKind::kAsh), "ash");
  EXPECT_STREQ(density_name(DensityKind::kApparent), "apparent");
}

TEST(Density, ModelsWithoutRiseAreRefused) {
  const Calibration good{0, 0.001};
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(calibration_to(DensityKind::kQct, {}), HasSubstr("slope of the calibration"));
  EXPECT_REFUSED(calibration_to(DensityKind::kQct, {{none, 1}}), HasSubstr("found nan"));
  EXPECT_REFUSED(calibration_to(DensityKind::kAsh, {good, {0, -1}}),
                 HasSubstr("slope of the ash density"));
  EXPECT_REFUSED(calibration_to(DensityKind::kApparent, {good, kAshEqualsQct, 0}),
                 HasSubstr("ratio of ash to apparent density, found 0"));
}

}  // namespace
}  // namespace mesamis
