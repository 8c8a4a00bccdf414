// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kFloat = 1e-7;  // of directions the header gives in single precision

TEST(Nifti, TurnsRasIntoLpsAndStreamsSamples) {
  const TempFolder folder;
  const std::string bytes = NiftiBytes{}.header() + bytes_of_all(kRamp);
  for (const std::string name : {"a.nii", "a.nii.gz", "B.NII"}) {
    const bool gz = name.ends_with(".gz");
    const VolumeFile file = read(folder, name, gz ? packed(bytes) : bytes);
    expect_ramp(file.volume);
    EXPECT_EQ(file.format, "NIfTI");
    EXPECT_THAT(file.warnings, IsEmpty());
    expect_near(file.volume.spacing, {0.5, 1.25, 2});
    expect_near(file.volume.origin, {-10, -20, 30});
    expect_near(file.volume.to_world({1, 0, 0}), {-11, -20, 30});
    expect_near(file.volume.to_world({0, 0, 1}), {-10, -20, 31});
  }
}

TEST(Nifti, ReadsEveryTypeOfOneNumberInBothByteOrders) {
  const TempFolder folder;
  const auto check = [&](auto number, std::int16_t code) {
    using Number = decltype(number);
    const int first = std::is_signed_v<Number> ? -40 : 0;
    for (const bool big_endian : {false, true}) {
      NiftiBytes nifti;
      nifti.datatype = code;
      nifti.big_endian = big_endian;
      const auto values = ramp<Number>(60, first);
      const VolumeFile file =
          read(folder, "a.nii", nifti.header() + bytes_of_all(values, big_endian));
      for (std::size_t n = 0; n < 60; ++n) {
        ASSERT_EQ(file.volume.samples[n], static_cast<float>(values[n])) << code;
      }
    }
  };
  check(std::uint8_t{}, 2), check(std::int16_t{}, 4), check(std::int32_t{}, 8);
  check(float{}, 16), check(double{}, 64), check(std::int8_t{}, 256);
  check(std::uint16_t{}, 512), check(std::uint32_t{}, 768);
  check(std::int64_t{}, 1024), check(std::uint64_t{}, 1280);
}

TEST(Nifti, AppliesTheScale) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.slope = 0.5f, nifti.intercept = 100;
  expect_ramp(read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).volume, 5, 0.5, 100);
  nifti.slope = std::numeric_limits<float>::quiet_NaN();
  expect_ramp(read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).volume);
}

TEST(Nifti, TakesTheSformBeforeTheQformBeforeNeither) {
  const TempFolder folder;
  NiftiBytes nifti;
  // A quarter turn about z: the first axis points to A, the second to L.
  const float half = std::sqrt(0.5f);
  nifti.quatern = {0, 0, half, 1, 2, 3};
  nifti.qform_code = 1;
  const std::string data = bytes_of_all(kRamp);
  expect_near(read(folder, "a.nii", nifti.header() + data).volume.origin, {-10, -20, 30});
  nifti.sform_code = 0;
  Volume volume = read(folder, "a.nii", nifti.header() + data).volume;
  expect_near(volume.origin, {-1, -2, 3});
  expect_near(volume.direction * Vec3{1, 0, 0}, {0, -1, 0}, kFloat);
  expect_near(volume.direction * Vec3{0, 1, 0}, {1, 0, 0}, kFloat);
  nifti.pixdim[0] = -1;  // qfac: the third axis is turned over
  volume = read(folder, "a.nii", nifti.header() + data).volume;
  expect_near(volume.direction * Vec3{0, 0, 1}, {0, 0, -1});
  nifti.qform_code = 0;
  const VolumeFile file = read(folder, "a.nii", nifti.header() + data);
  expect_near(file.volume.direction * Vec3{1, 0, 0}, {-1, 0, 0});
  EXPECT_THAT(file.warnings, testing::Contains(HasSubstr("no orientation")));
}

TEST(Nifti, MakesASlightlySkewedSformOrthonormalAndRefusesASkewedOne) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp);
  NiftiBytes nifti;
  nifti.srow[1] = 1.25f * 5e-4f;  // the second axis leans by a cosine of 5e-4
  const VolumeFile file = read(folder, "a.nii", nifti.header() + data);
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("cosine 0.0005")));
  EXPECT_NO_THROW(require_usable(file.volume));
  expect_near(file.volume.direction * Vec3{0, 1, 0}, {0, -1, 0}, 1e-3);
  nifti.srow[1] = 1.25f * 0.02f;
  EXPECT_THAT(complaint(folder, "a.nii", nifti.header() + data), HasSubstr("a cosine of 0.0199"));
}

TEST(Nifti, HonoursObliqueDirectionsAndUnits) {
  const TempFolder folder;
  const float c = std::cos(0.3f), s = std::sin(0.3f);
  NiftiBytes nifti;
  nifti.srow = {0.5f * c, -1.25f * s, 0, 0, 0.5f * s, 1.25f * c, 0, 0, 0, 0, 2, 0};
  nifti.units = 3;  // micrometres
  const Volume volume = read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).volume;
  expect_near(volume.spacing, {0.0005, 0.00125, 0.002}, 1e-9);
  expect_near(volume.direction * Vec3{1, 0, 0}, {-std::cos(0.3), -std::sin(0.3), 0}, kFloat);
  EXPECT_NO_THROW(require_usable(volume));
}

TEST(Nifti, RefusesWhatIsNoVolume) {
  const TempFolder folder;
  const auto spoilt = [&](auto&& change) {
    NiftiBytes nifti;
    change(nifti);
    return complaint(folder, "a.nii", nifti.header() + bytes_of_all(kRamp));
  };
  EXPECT_THAT(spoilt([](auto& n) { n.dim = {4, 2, 3, 5, 2, 1, 1, 1}; }), HasSubstr("4-D"));
  EXPECT_THAT(spoilt([](auto& n) { n.dim[0] = 2; }), HasSubstr("2 dimensions"));
  EXPECT_THAT(spoilt([](auto& n) { n.dim[0] = -1; }), HasSubstr("-1 dimensions"));
  EXPECT_THAT(spoilt([](auto& n) { n.dim[2] = 0; }), HasSubstr("found 0"));
  EXPECT_THAT(spoilt([](auto& n) { n.dim[2] = -7; }), HasSubstr("found -7"));
  EXPECT_THAT(spoilt([](auto& n) { n.datatype = 128; }), HasSubstr("RGB"));
  EXPECT_THAT(spoilt([](auto& n) { n.datatype = 32; }), HasSubstr("complex"));
  EXPECT_THAT(spoilt([](auto& n) { n.datatype = 9999; }), HasSubstr("9999"));
  EXPECT_THAT(spoilt([](auto& n) { n.vox_offset = 1; }), HasSubstr("vox_offset 1"));
  EXPECT_THAT(spoilt([](auto& n) { n.vox_offset = NAN; }), HasSubstr("vox_offset nan"));
  EXPECT_THAT(spoilt([](auto& n) { n.srow[0] = NAN; }), HasSubstr("axis 0, found nan"));
  EXPECT_THAT(spoilt([](auto& n) { n.srow.fill(0); }), HasSubstr("found 0 mm"));
  EXPECT_THAT(spoilt([](auto& n) { n.srow[3] = INFINITY; }), HasSubstr("origin"));
  EXPECT_THAT(spoilt([](auto& n) { n.magic = "ni1"; }), HasSubstr("magic"));
  EXPECT_THAT(complaint(folder, "a.nii", "hello"), HasSubstr("found 5"));
  EXPECT_THAT(complaint(folder, "a.nii", ""), HasSubstr("found 0"));
  EXPECT_THAT(complaint(folder, "a.nii", std::string(600, 'x')), HasSubstr("found neither"));
}

TEST(Nifti, WarnsWhereTheHeaderContradictsTheFile) {
  const TempFolder folder;
  const auto warnings = [&](const NiftiBytes& nifti, std::size_t more = 0) {
    return read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp) + std::string(more, 'x'))
        .warnings;
  };
  NiftiBytes nifti;
  EXPECT_THAT(warnings(nifti, 16), IsEmpty()) << "less than a slice";
  EXPECT_THAT(warnings(nifti, 24), ElementsAre(HasSubstr("goes on for 24 bytes")));
  nifti.bitpix = 32;
  EXPECT_THAT(warnings(nifti), ElementsAre(HasSubstr("bitpix states 32 bits")));
  nifti = {};
  nifti.vox_offset = 348;
  EXPECT_THAT(warnings(nifti), ElementsAre(HasSubstr("vox_offset 348 lies before")));
}

TEST(Nifti, AcceptsALaterDimensionOfZero) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.dim = {5, 4, 3, 5, 0, 0, 0, 0};
  expect_ramp(read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).volume);
}

TEST(Nifti, AcceptsAFourthDimensionOfOne) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.dim[0] = 4;
  expect_ramp(read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).volume);
}

TEST(Nifti, HasManyVolumesForThoseWhoAsk) {
  const TempFolder folder;
  NiftiBytes nifti;
  for (const std::size_t axis : {4, 5}) {
    nifti.dim = {static_cast<std::int16_t>(axis), 4, 3, 1, 1, 1, 1, 1};
    nifti.dim[axis] = 5;
    write_bytes(folder / "a.nii", nifti.header() + bytes_of_all(kRamp));
    EXPECT_THAT(complaint(folder / "a.nii"), HasSubstr("expected a 3-D image"));
    WideBudget budget;
    const ScanFile scan = open_nifti(folder / "a.nii", {budget, false, Values::kMany});
    EXPECT_EQ(scan.outer, 5);
    EXPECT_EQ(scan.inner, 1);
    const auto samples = read_samples(scan, budget);
    EXPECT_THAT(samples, testing::ElementsAreArray(kRamp));
  }
  nifti.dim = {5, 2, 3, 1, 2, 5, 1, 1};
  write_bytes(folder / "a.nii", nifti.header() + bytes_of_all(kRamp));
  WideBudget budget;
  EXPECT_REFUSED(open_nifti(folder / "a.nii", {budget, false, Values::kMany}),
                 HasSubstr("2 volumes of 5 channels"));
}

TEST(Nifti, ExtensionsAreRead) {
  const TempFolder folder;
  const auto of = [&folder](const std::string& extensions, float offset, char flag = 1) {
    NiftiBytes nifti;
    nifti.vox_offset = offset;
    std::string bytes = nifti.header();
    bytes[348] = flag;
    write_bytes(folder / "a.nii", packed(bytes + extensions + bytes_of_all(kRamp)));
    WideBudget budget;
    return nifti_extensions(folder / "a.nii", budget);
  };
  const auto extension = [](int size, const std::string& content) {
    return bytes_of(size) + bytes_of(6) + content;
  };
  const std::string two = extension(16, "eight789") + extension(12, "four");
  EXPECT_THAT(of(two, 380), ElementsAre("eight789", "four"));
  EXPECT_THAT(of(two, 380, 0), IsEmpty());
  EXPECT_THAT(of("", 352), IsEmpty());
  EXPECT_REFUSED(of(extension(7, "x"), 361), HasSubstr("expected a header extension"));
  EXPECT_REFUSED(of(extension(-1, "x"), 361), HasSubstr("found -1"));
  EXPECT_REFUSED(of(extension(64, "x"), 361), HasSubstr("found 64"));
  EXPECT_REFUSED(of(extension(1 << 30, "x"), 2e9f), HasSubstr("found 1073741824"));
}

/// The qform where the sform is marked valid but has no axes, as some converters leave it.
TEST(Nifti, AnSformWithoutAxesLeavesTheQform) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.qform_code = 1;
  nifti.quatern = {0, 0, 0, 5, 6, 7};
  for (const float bad : {0.F, NAN}) {
    nifti.srow.fill(bad);
    const VolumeFile file = read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp));
    expect_near(file.volume.spacing, {0.5, 1.25, 2});
    expect_near(file.volume.origin, {-5, -6, 7});
    EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("the qform is used")));
  }
}

TEST(Nifti, WarnsWhereQformAndSformTurnTheAxesDifferently) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.qform_code = 1;
  nifti.quatern = {0, 0, 0, 10, 20, 30};
  EXPECT_THAT(read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).warnings, IsEmpty());
  const float half = std::sqrt(0.5F);
  nifti.quatern = {0, 0, half, 0, 0, 0};  // a quarter turn about z
  const VolumeFile file = read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp));
  ASSERT_THAT(file.warnings, ElementsAre(HasSubstr("differently, by 90")));
  expect_near(file.volume.direction * Vec3{1, 0, 0}, {-1, 0, 0});
  nifti.quatern = {0, 0, 0, 0, 0, 0};
  nifti.pixdim[0] = -1;  // the third axis the other way round
  EXPECT_THAT(read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).warnings,
              ElementsAre(HasSubstr("differently, by 180")));
}

TEST(Nifti, WarnsWhereQformAndSformShiftVoxels) {
  const TempFolder folder;
  const auto warnings = [&](const NiftiBytes& nifti) {
    return read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).warnings;
  };
  NiftiBytes nifti;
  nifti.qform_code = 1;
  nifti.quatern = {0, 0, 0, 13, 20, 34};
  EXPECT_THAT(warnings(nifti),
              ElementsAre(HasSubstr("the qform puts voxels up to 5 mm elsewhere")));
  nifti.quatern = {0, 0, 0, 10, 20, 30.001F};
  EXPECT_THAT(warnings(nifti), IsEmpty()) << "less than a hundredth of a voxel";
  nifti.quatern = {0, 0, 0, 10, 20, 30};
  nifti.pixdim[3] = 2.015625F;  // 5 slices
  EXPECT_THAT(warnings(nifti), ElementsAre(HasSubstr("voxels up to 0.0625 mm elsewhere")));
}

TEST(Nifti, AGivenSpacingTakesThePlaceOfWhatCannotBeUsed) {
  const TempFolder folder;
  const auto with = [&](const NiftiBytes& nifti) {
    write_bytes(folder / "a.nii", nifti.header() + bytes_of_all(kRamp));
    EXPECT_NE(complaint(folder / "a.nii"), "");
    return read_volume(folder / "a.nii", {.spacing = Vec3{1, 1.2, 2}});
  };
  NiftiBytes form;  // a sform without axes, and no qform
  form.srow.fill(0);
  const VolumeFile as_ras = with(form);
  EXPECT_EQ(as_ras.volume.spacing, (Vec3{1, 1.2, 2}));
  expect_near(as_ras.volume.direction * Vec3{1, 0, 0}, {-1, 0, 0});
  EXPECT_THAT(as_ras.warnings, testing::Contains(HasSubstr("axes taken as RAS")));
  NiftiBytes turned;  // a qform keeps its directions
  turned.sform_code = 0;
  turned.qform_code = 1;
  turned.quatern = {0, 0, std::sqrt(0.5F), 0, 0, 0};
  turned.pixdim = {1, 0, 0, NAN, 1, 1, 1, 1};
  const VolumeFile file = with(turned);
  EXPECT_EQ(file.volume.spacing, (Vec3{1, 1.2, 2}));
  expect_near(file.volume.direction * Vec3{1, 0, 0}, {0, -1, 0}, 1e-6);
}

TEST(Nifti, WarnsOfUnitsAndScalesThatItCannotUse) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.units = 5;
  EXPECT_THAT(read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).warnings,
              ElementsAre(HasSubstr("unit of length 5")));
  nifti.units = 2;
  for (const auto& [slope, intercept] : {std::pair{NAN, 0.F}, {2.F, NAN}, {INFINITY, 0.F}}) {
    nifti.slope = slope;
    nifti.intercept = intercept;
    const VolumeFile file = read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp));
    expect_ramp(file.volume);
    EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("kept as stored")));
  }
}

TEST(Nifti, TakesOneOfSeveralVolumesAndComponents) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.dim = {5, 2, 3, 1, 2, 5, 1, 1};
  write_bytes(folder / "a.nii.gz", packed(nifti.header() + bytes_of_all(kRamp)));
  const auto first = [&](Index volume, Index channel) {
    return read_volume(folder / "a.nii.gz", {.volume = volume, .channel = channel})
        .volume.samples[0];
  };
  EXPECT_EQ(first(0, 0), -40);
  EXPECT_EQ(first(1, 0), -40 + 6);
  EXPECT_EQ(first(0, 4), -40 + 48);
  EXPECT_THAT(complaint(folder / "a.nii.gz"),
              HasSubstr("2 volumes (--volume 0 to 1) of 5 channels"));
}

TEST(Nifti, PairsOfHeaderAndSamplesAreRead) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.magic = std::string("ni1\0", 4);
  nifti.vox_offset = 0;
  write_bytes(folder / "a.hdr", nifti.header().substr(0, 348));
  EXPECT_THAT(complaint(folder / "a.hdr"), HasSubstr("a.img"));
  write_bytes(folder / "a.img", bytes_of_all(kRamp));
  write_bytes(folder / "b.hdr.gz", packed(nifti.header()));
  write_bytes(folder / "b.img.gz", packed(bytes_of_all(kRamp)));
  for (const char* name : {"a.hdr", "a.img", "b.hdr.gz", "b.img.gz"}) {
    const VolumeFile file = read_volume(folder / name);
    expect_ramp(file.volume);
    expect_near(file.volume.origin, {-10, -20, 30});
    EXPECT_THAT(file.warnings, IsEmpty()) << name;
  }
  EXPECT_EQ(list_volumes(folder / "").size(), 2u) << "each pair once";
}

TEST(Nifti, AnalyzeHasNoOrientation) {
  const TempFolder folder;
  NiftiBytes analyze;
  analyze.magic = std::string(4, '\0');
  analyze.vox_offset = 0;
  analyze.sform_code = 77;  // no form: other fields lie there
  write_bytes(folder / "a.hdr", analyze.header().substr(0, 348));
  write_bytes(folder / "a.img", bytes_of_all(kRamp));
  const VolumeFile file = read_volume(folder / "a.img");
  expect_ramp(file.volume);
  EXPECT_EQ(file.format, "Analyze");
  expect_near(file.volume.spacing, {0.5, 1.25, 2});
  expect_near(file.volume.direction * Vec3{1, 0, 0}, {1, 0, 0});
  expect_near(file.volume.direction * Vec3{0, 1, 0}, {0, -1, 0});
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("no orientation")));
}

/// The fields that Analyze 7.5 has where NIfTI has others.
class Analyze : public testing::Test {
 protected:
  Analyze() {
    analyze.magic = std::string(4, '\0');
    analyze.vox_offset = 0;
    analyze.sform_code = 0;
    analyze.units = 0;
    header = analyze.header().substr(0, 348);
  }
  template <class Number>
  void put(std::size_t at, Number value) {
    header.replace(at, sizeof(value), bytes_of(value));
  }
  VolumeFile read() const {
    write_bytes(folder / "a.hdr", header);
    write_bytes(folder / "a.img", bytes_of_all(kRamp));
    return read_volume(folder / "a.hdr");
  }

  TempFolder folder;
  NiftiBytes analyze;
  std::string header;
};

TEST_F(Analyze, ZeroLiesInTheMiddleOrAtTheVoxelThatSpmHasNoted) {
  expect_near(read().volume.origin, {-0.75, 1.25, -4});
  put(253, std::int16_t{2}), put(255, std::int16_t{3}), put(257, std::int16_t{1});
  expect_near(read().volume.origin, {-0.5, 2.5, 0});
  put(253, std::int16_t{80});  // far outside: some other field
  expect_near(read().volume.origin, {-0.75, 1.25, -4});
}

TEST_F(Analyze, ItsUnitIsAWord) {
  header[123] = 1;  // metres in NIfTI; here a part of an unused number
  expect_near(read().volume.spacing, {0.5, 1.25, 2});
  header.replace(56, 2, "um");
  expect_near(read().volume.spacing, {0.0005, 0.00125, 0.002});
  header.replace(56, 3, "sec");
  EXPECT_THAT(read().warnings, testing::Contains(HasSubstr("\"sec\" is no unit of length")));
}

TEST_F(Analyze, OtherOrientationsAndRangesGiveAWarning) {
  EXPECT_EQ(read().warnings.size(), 1U);
  header[252] = 2;
  EXPECT_THAT(read().warnings, testing::Contains(HasSubstr("orientation 2")));
  header[252] = 0;
  put(124, 100.F), put(128, 0.F), put(140, std::int32_t{50}), put(144, std::int32_t{0});
  EXPECT_THAT(read().warnings, testing::Contains(HasSubstr("a slope of 2")));
  put(112, 3.F);  // SPM's scale
  const VolumeFile scaled = read();
  EXPECT_EQ(scaled.volume.samples[0], -120);
  EXPECT_EQ(scaled.warnings.size(), 1U);
}

/// The volume of a sheared grid is that of its voxels, and each keeps its place.
TEST(Nifti, AShearedSformIsResampledWhereItIsAskedFor) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.srow = {0.5F, 0,  1, 10, 0, 1.25F,
                0,    20, 0, 0,  2, 30};  // slices shifted by two columns each
  EXPECT_THAT(complaint(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)),
              HasSubstr("--resample"));
  const VolumeFile file = read_volume(folder / "a.nii", {.resample = true});
  EXPECT_EQ(file.volume.size, (std::array<Index, 3>{4 + 2 * 4, 3, 5}));
  expect_near(file.volume.spacing, {0.5, 1.25, 2});
  EXPECT_NO_THROW(require_usable(file.volume));
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("sheared")));
  for (Index k = 0; k < 5; ++k) {
    for (Index i = 0; i < 4; ++i) {
      EXPECT_EQ(file.volume.at(i + 2 * k, 1, k), static_cast<float>(-40 + i + 4 + 12 * k));
    }
  }
  EXPECT_EQ(file.volume.at(0, 0, 4), -40) << "what no voxel covers has the least value";
  EXPECT_EQ(read_grid(folder / "a.nii", {.resample = true}).size, file.volume.size);
}

}  // namespace
}  // namespace mesamis
