// SPDX-License-Identifier: Apache-2.0
#include "mesamis/io/read_volume.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "mesamis/base/error.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/test_data.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::int16_t> kRamp = ramp<std::int16_t>(60);

/// Why a file is refused; empty if it is not. The line itself must be fit to print.
std::string complaint(const fs::path& file) {
  try {
    read_volume(file);
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.rfind(file.string(), 0), 0u) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line.substr(file.string().size());
  }
  return "";
}

std::string complaint(const TempFolder& folder, const std::string& name, const std::string& bytes) {
  write_bytes(folder / name, bytes);
  return complaint(folder / name);
}

VolumeFile read(const TempFolder& folder, const std::string& name, const std::string& bytes) {
  write_bytes(folder / name, bytes);
  return read_volume(folder / name);
}

void expect_ramp(const Volume& volume, double slope = 1, double intercept = 0) {
  EXPECT_EQ(volume.size, (std::array<Index, 3>{4, 3, 5}));
  ASSERT_EQ(volume.samples.size(), kRamp.size());
  for (std::size_t n = 0; n < kRamp.size(); ++n) {
    ASSERT_FLOAT_EQ(volume.samples[n], static_cast<float>(slope * kRamp[n] + intercept));
  }
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-5) {
  EXPECT_LT(norm(a - b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

/// Most memory the process has had, in MB.
double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

// --- NIfTI -----------------------------------------------------------------------------------

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
  expect_ramp(read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).volume, 0.5, 100);
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
  expect_near(volume.direction * Vec3{1, 0, 0}, {0, -1, 0});
  expect_near(volume.direction * Vec3{0, 1, 0}, {1, 0, 0});
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
  expect_near(volume.direction * Vec3{1, 0, 0}, {-std::cos(0.3), -std::sin(0.3), 0});
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

TEST(Nifti, AcceptsAFourthDimensionOfOne) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.dim[0] = 4;
  expect_ramp(read(folder, "a.nii", nifti.header() + bytes_of_all(kRamp)).volume);
}

// --- What every format has in common ---------------------------------------------------------

std::string nrrd(const std::string& fields, const std::string& data) {
  return "NRRD0004\n# made here\ntype: short\ndimension: 3\nsizes: 4 3 5\n"
         "space: left-posterior-superior\n"
         "space directions: (0.5,0,0) (0,1.25,0) (0,0,2)\nspace origin: (1,2,3)\n" +
         fields + "\n" + data;
}

std::string meta(const std::string& fields, const std::string& data_file = "LOCAL") {
  return "ObjectType = Image\nNDims = 3\nDimSize = 4 3 5\nElementType = MET_SHORT\n"
         "ElementSpacing = 0.5 1.25 2\nOffset = 1 2 3\nModality = MET_MOD_CT\n" +
         fields + "ElementDataFile = " + data_file + "\n";
}

TEST(ReadVolume, RefusesAHeaderThatPromisesMoreThanTheFileHolds) {
  const TempFolder folder;
  const double before = peak_mb();
  const std::string few(100, 'x');
  NiftiBytes huge;
  huge.dim = {3, 5000, 5000, 5000, 1, 1, 1, 1};
  EXPECT_THAT(complaint(folder, "a.nii", huge.header() + few), HasSubstr("expected 250000000000"));
  EXPECT_THAT(complaint(folder, "a.nii.gz", packed(huge.header() + few)), HasSubstr("at most"));
  const std::string sizes = "dimension: 3\nsizes: 60000 60000 60000\ntype: double\n";
  EXPECT_THAT(
      complaint(folder, "a.nrrd", "NRRD0004\n" + sizes + "encoding: raw\nendian: little\n\n" + few),
      HasSubstr("60000 x 60000 x 60000"));
  EXPECT_THAT(complaint(folder, "b.nrrd", "NRRD0004\n" + sizes + "encoding: ascii\n\n1 2 3"),
              HasSubstr("60000 x 60000 x 60000"));
  EXPECT_THAT(complaint(folder, "a.mha",
                        "NDims = 3\nDimSize = 60000 60000 60000\nElementType = MET_DOUBLE\n"
                        "ElementDataFile = LOCAL\n" +
                            few),
              HasSubstr("60000 x 60000 x 60000"));
  EXPECT_THAT(complaint(folder, "a.inv3", packed(inv3_bytes(5000, 5000, 5000, few))),
              HasSubstr("found 100"));
  TiffPage page;
  page.width = page.height = 60000;
  page.pixels = few;
  EXPECT_THAT(complaint(folder, "a.tif", tiff_bytes({page, page})), HasSubstr("found a file of"));
  // More voxels than an index can count.
  EXPECT_THAT(complaint(folder, "c.nrrd",
                        "NRRD0004\ntype: short\ndimension: 3\nsizes: 9223372036854775807 9 9\n"
                        "encoding: raw\nendian: little\n\n"),
              HasSubstr("9223372036854775807"));
  EXPECT_THAT(complaint(folder, "d.nrrd",
                        "NRRD0004\ntype: short\ndimension: 3\n"
                        "sizes: 2147483647 2147483647 2147483647\nencoding: raw\n"
                        "endian: little\n\n"),
              HasSubstr("more voxels"));
  EXPECT_LT(peak_mb() - before, 64);
}

// What a gzip'd file can unpack to is not known beforehand: memory may grow only with what is
// there.
TEST(ReadVolume, GrowsWithTheDataAndNotWithTheHeader) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.dim = {3, 1000, 1000, 400, 1, 1, 1, 1};  // 1.6 GB of floats
  std::string noise(4'000'000, '\0');
  std::uint32_t state = 1;
  for (char& c : noise) c = static_cast<char>((state = state * 1664525 + 1013904223) >> 24);
  const std::string bytes = packed(nifti.header() + noise);
  const double before = peak_mb();
  EXPECT_THAT(complaint(folder, "a.nii.gz", bytes), HasSubstr("found 4000000"));
  EXPECT_LT(peak_mb() - before, 400);  // the address sanitizer marks what is reserved: 200
}

TEST(ReadVolume, RefusesTruncatedAndBrokenData) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp);
  const std::string nifti = NiftiBytes{}.header() + data;
  EXPECT_THAT(complaint(folder, "a.nii", nifti.substr(0, nifti.size() - 1)),
              HasSubstr("found 119"));
  const std::string zipped = packed(nifti);
  EXPECT_THAT(complaint(folder, "a.nii.gz", zipped.substr(0, zipped.size() / 2)),
              HasSubstr("cut off"));
  std::string broken = zipped;
  broken[broken.size() - 6] ^= 0x55;  // the checksum
  EXPECT_THAT(complaint(folder, "b.nii.gz", broken + "x"),
              testing::AnyOf(IsEmpty(), HasSubstr("broken")));
  EXPECT_THAT(complaint(folder, "a.nrrd", nrrd("encoding: raw\nendian: little\n", "123")),
              HasSubstr("found 3"));
  EXPECT_THAT(complaint(folder, "b.nrrd", nrrd("encoding: gzip\nendian: little\n", "no gzip here")),
              HasSubstr("broken"));
  EXPECT_THAT(complaint(folder, "c.nrrd", nrrd("encoding: ascii\n", "1 2 3 4")),
              HasSubstr("expected 119 bytes"));
  std::string text;
  for (int n = 0; n < 60; ++n) text += n == 30 ? "many " : "12345 ";
  EXPECT_THAT(complaint(folder, "d.nrrd", nrrd("encoding: ascii\n", text)),
              HasSubstr("sample 30, found \"many\""));
  EXPECT_THAT(complaint(folder, "a.mha", meta("") + "123"), HasSubstr("found 3"));
  EXPECT_THAT(complaint(folder, "a.inv3", inv3_bytes(4, 3, 5, data).substr(0, 600)),
              HasSubstr("main.plist"));
}

TEST(ReadVolume, HandsOnUnknownSamplesAndThinVolumesThatTheGateRefuses) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.datatype = 16;
  std::vector<float> values(60, 1);
  const auto read_values = [&] {
    return read(folder, "a.nii", nifti.header() + bytes_of_all(values)).volume;
  };
  EXPECT_THROW(require_usable(read_values()), InputError);  // constant
  values[7] = 2;
  EXPECT_NO_THROW(require_usable(read_values()));
  values[9] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(read_values().samples[9]));
  EXPECT_THROW(require_usable(read_values()), InputError);
  nifti.dim = {3, 12, 5, 1, 1, 1, 1, 1};
  values[9] = 3;
  EXPECT_EQ(read_values().size[2], 1);
  EXPECT_THROW(require_usable(read_values()), InputError);
}

TEST(ReadVolume, RefusesWhatIsNoScanAtAll) {
  const TempFolder folder;
  EXPECT_THAT(complaint(folder / "nowhere.nii"), HasSubstr("no such file"));
  EXPECT_THAT(complaint(folder.path()), HasSubstr("found none"));
  EXPECT_THAT(complaint(folder, "notes.txt", "a scan of my head"), HasSubstr("found none of them"));
  EXPECT_THAT(complaint(folder, "empty", ""), HasSubstr("found none of them"));
  EXPECT_THAT(complaint(folder, "a.img", std::string(5000, '\0')), HasSubstr("found none of them"));
  for (const char* name :
       {"a.nii", "a.nii.gz", "a.nrrd", "a.nhdr", "a.mha", "a.mhd", "a.tif", "a.tiff", "a.inv3"}) {
    EXPECT_NE(complaint(folder, name, "a scan of my head\nand its second line\n"), "") << name;
    EXPECT_NE(complaint(folder, name, std::string(3'000'000, 'x')), "") << name;
    EXPECT_NE(complaint(folder, name, std::string(10'000, '\0')), "") << name;
    EXPECT_NE(complaint(folder, name, ""), "") << name;
  }
  EXPECT_NE(complaint("/dev/null"), "");
}

// --- NRRD ------------------------------------------------------------------------------------

TEST(Nrrd, ReadsItsEncodingsAndSkips) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp), little = "endian: little\n";
  std::string text;
  for (const int value : kRamp) text += std::to_string(value) + (value % 4 ? " " : "\n");
  expect_ramp(read(folder, "a.nrrd", nrrd("encoding: raw\n" + little, data)).volume);
  expect_ramp(read(folder, "b.nrrd", nrrd("encoding: gzip\n" + little, packed(data))).volume);
  expect_ramp(read(folder, "c.nrrd", nrrd("encoding: ascii\n", text)).volume);
  expect_ramp(
      read(folder, "d.nrrd", nrrd("encoding: raw\nendian: big\n", bytes_of_all(kRamp, true)))
          .volume);
  expect_ramp(read(folder, "e.nrrd",
                   nrrd("encoding: raw\nline skip: 1\nbyte skip: 3\n" + little, "one\nabc" + data))
                  .volume);
  expect_ramp(
      read(folder, "f.nrrd", nrrd("encoding: raw\nbyte skip: -1\n" + little, "anything" + data))
          .volume);
  expect_ramp(
      read(folder, "g.nrrd", nrrd("encoding: gzip\nbyte skip: 4\n" + little, packed("four" + data)))
          .volume);
  write_bytes(folder / "data.raw", data);
  expect_ramp(
      read(folder, "h.nhdr", nrrd("encoding: raw\ndata file: data.raw\n" + little, "")).volume);
  EXPECT_THAT(
      complaint(folder, "i.nhdr", nrrd("encoding: raw\ndata file: missing.raw\n" + little, "")),
      HasSubstr("missing.raw"));
  write_bytes(folder / "long.raw", data + "x");
  EXPECT_THAT(
      complaint(folder, "j.nhdr", nrrd("encoding: raw\ndata file: long.raw\n" + little, "")),
      HasSubstr("go on"));
}

TEST(Nrrd, PutsItsSpacesIntoLps) {
  const TempFolder folder;
  const auto origin = [&](const std::string& space) {
    return read(
               folder, "a.nrrd",
               "NRRD0005\ntype: int16\ndimension: 3\nsizes: 4 3 5\nspace: " + space +
                   "\nspace directions: (0.5, 0, 0) (0,1.25,0) (0,0,2)\nspace origin: (1,2,3)\n"
                   "kinds: domain domain domain\nendian: little\nencoding: raw\nkey:=a: value\n\n" +
                   bytes_of_all(kRamp))
        .volume;
  };
  expect_near(origin("left-posterior-superior").origin, {1, 2, 3});
  expect_near(origin("RAS").origin, {-1, -2, 3});
  expect_near(origin("left-anterior-superior").origin, {1, -2, 3});
  expect_near(origin("RAS").direction * Vec3{1, 0, 0}, {-1, 0, 0});
  expect_near(origin("LAS").direction * Vec3{0, 1, 0}, {0, -1, 0});
}

TEST(Nrrd, RefusesWhatItCannotMean) {
  const TempFolder folder;
  const auto spoilt = [&](const std::string& fields) {
    return complaint(folder, "a.nrrd", "NRRD0004\n" + fields + "\n" + bytes_of_all(kRamp));
  };
  const std::string end = "encoding: raw\nendian: little\n", grid = "dimension: 3\nsizes: 4 3 5\n";
  EXPECT_THAT(spoilt("type: short\ndimension: 4\nsizes: 2 2 3 5\n" + end),
              HasSubstr("4 dimensions"));
  EXPECT_THAT(spoilt("type: block\n" + grid + end), HasSubstr("block"));
  EXPECT_THAT(
      spoilt("type: short\ndimension: 3\nsizes: 3 4 5\nkinds: RGB-color domain domain\n" + end),
      HasSubstr("RGB-color"));
  EXPECT_THAT(spoilt("type: short\n" + grid + "encoding: bzip2\n"), HasSubstr("bzip2"));
  EXPECT_THAT(spoilt("type: short\n" + grid + "encoding: raw\n"), HasSubstr("\"endian\""));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "space: MNI\n"), HasSubstr("mni"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "data file: LIST\n"), HasSubstr("list"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "byte skip: -5\n"), HasSubstr("-5"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "spacings: 1 2\n"), HasSubstr("found 2"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "spacings: 1 2 0\n"), HasSubstr("found 0 mm"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "space directions: (1,0,0) (0,1,0) none\n"),
              HasSubstr("none"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "space directions: (1,0,0) (1,1,0) (0,0,1)\n"),
              HasSubstr("orthogonal"));
  EXPECT_THAT(spoilt("nonsense\n"), HasSubstr("nonsense"));
}

// --- MetaImage -------------------------------------------------------------------------------

TEST(Meta, ReadsLocalPackedTextAndDetachedData) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp);
  std::string text;
  for (const int value : kRamp) text += std::to_string(value) + " ";
  const VolumeFile file = read(folder, "a.mha", meta("BinaryData = True\n") + data);
  expect_ramp(file.volume);
  EXPECT_EQ(file.volume.modality, "CT");
  expect_near(file.volume.origin, {1, 2, 3});
  expect_near(file.volume.spacing, {0.5, 1.25, 2});
  expect_ramp(
      read(folder, "b.mha", meta("BinaryDataByteOrderMSB = True\n") + bytes_of_all(kRamp, true))
          .volume);
  expect_ramp(read(folder, "c.mha", meta("CompressedData = True\n") + packed(data, 15)).volume);
  expect_ramp(read(folder, "d.mha", meta("BinaryData = False\n") + text).volume);
  write_bytes(folder / "my data.raw", "head" + data);
  expect_ramp(read(folder, "e.mhd", meta("HeaderSize = 4\n", "my data.raw")).volume);
  expect_ramp(read(folder, "f.mhd", meta("HeaderSize = -1\n", "my data.raw")).volume);
  EXPECT_THAT(complaint(folder, "g.mhd", meta("", "my data.raw")), HasSubstr("go on"));
  EXPECT_THAT(complaint(folder, "h.mhd", meta("", "slice%03d.raw 1 5 1")), HasSubstr("slice"));
}

TEST(Meta, ListsTheAxesOneAfterAnother) {
  const TempFolder folder;
  const Volume volume =
      read(folder, "a.mha", meta("TransformMatrix = 0 1 0 -1 0 0 0 0 1\n") + bytes_of_all(kRamp))
          .volume;
  expect_near(volume.direction * Vec3{1, 0, 0}, {0, 1, 0});
  expect_near(volume.direction * Vec3{0, 1, 0}, {-1, 0, 0});
}

TEST(Meta, RefusesChannelsOtherDimensionsAndLengths) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp);
  EXPECT_THAT(complaint(folder, "a.mha", meta("ElementNumberOfChannels = 3\n") + data),
              HasSubstr("3 channels"));
  EXPECT_THAT(complaint(folder, "b.mha", "NDims = 4\n" + data), HasSubstr("expected"));
  EXPECT_THAT(complaint(folder, "c.mha", "NDims = 4\nElementDataFile = LOCAL\n"),
              HasSubstr("4 dim"));
  EXPECT_THAT(complaint(folder, "d.mha", meta("TransformMatrix = 2 0 0 0 2 0 0 0 2\n") + data),
              HasSubstr("length 2"));
}

// --- InVesalius ------------------------------------------------------------------------------

TEST(InVesalius, ReadsAPackedAndAPlainProject) {
  const TempFolder folder;
  const std::string tar = inv3_bytes(4, 3, 5, bytes_of_all(kRamp));
  for (const std::string& bytes : {tar, packed(tar)}) {
    const VolumeFile file = read(folder, "a.inv3", bytes);
    expect_ramp(file.volume);
    EXPECT_EQ(file.volume.modality, "CT");
    expect_near(file.volume.spacing, {0.5, 1.25, 2});
    expect_near(file.volume.direction * Vec3{0, 1, 0}, {0, -1, 0});
  }
  EXPECT_THAT(complaint(folder, "b.inv3", inv3_bytes(4, 3, 6, bytes_of_all(kRamp))),
              HasSubstr("expected 144 bytes, found 120"));
  EXPECT_THAT(complaint(folder, "c.inv3", inv3_bytes(4, 3, 5, bytes_of_all(kRamp), "object")),
              HasSubstr("object"));
  EXPECT_THAT(complaint(folder, "d.inv3", tar_entry("x/notes.txt", "hi")), HasSubstr("main.plist"));
}

TEST(InVesalius, ReadsTheDistributionsCranium) {
  const fs::path cranium = "/usr/share/doc/invesalius-examples/examples/Cranium.inv3";
  MESAMIS_REQUIRE_DATA(cranium);
  const VolumeFile file = read_volume(cranium);
  EXPECT_EQ(file.volume.size, (std::array<Index, 3>{256, 256, 108}));
  expect_near(file.volume.spacing, {0.9570312, 0.9570312, 1.5});
  const fs::path same = test_data("data/cranium_inv/ct.nrrd");
  MESAMIS_REQUIRE_DATA(same);
  const Volume other = read_volume(same).volume;
  EXPECT_EQ(file.volume.samples, other.samples);
  EXPECT_EQ(file.volume.direction, other.direction);
}

// --- TIFF ------------------------------------------------------------------------------------

std::vector<TiffPage> five_pages() {
  std::vector<TiffPage> pages(5);
  for (std::size_t k = 0; k < 5; ++k) {
    pages[k].pixels = bytes_of_all(ramp<std::int16_t>(12, -40 + 12 * static_cast<int>(k)));
  }
  return pages;
}

TEST(Tiff, ReadsPagesAsSlices) {
  const TempFolder folder;
  const VolumeFile file = read(folder, "a.tif", tiff_bytes(five_pages()));
  expect_ramp(file.volume);
  expect_near(file.volume.spacing, {0.5, 0.5, 1});
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("between slices")));
}

TEST(Tiff, TakesTheSliceDistanceOfImageJ) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[0].description = "ImageJ=1.53\nimages=5\nslices=5\nunit=mm\nspacing=2.5\n";
  const VolumeFile file = read(folder, "a.tiff", tiff_bytes(pages));
  expect_near(file.volume.spacing, {0.05, 0.05, 2.5});  // 20 pixels per mm
  EXPECT_THAT(file.warnings, IsEmpty());
}

TEST(Tiff, RefusesColourMixedPagesAndCutOffFiles) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[3].width = 3;
  EXPECT_THAT(complaint(folder, "a.tif", tiff_bytes(pages)), HasSubstr("page 3"));
  pages = five_pages();
  for (TiffPage& page : pages) page.photometric = 8;
  EXPECT_THAT(complaint(folder, "b.tif", tiff_bytes(pages)), HasSubstr("photometric 8"));
  TiffPage rgb{2, 2, 8, 3, 1, 2, 0, "", std::string(12, 'x')};
  EXPECT_THAT(complaint(folder, "c.tif", tiff_bytes({rgb, rgb})), HasSubstr("3 channels"));
  const std::string whole = tiff_bytes(five_pages());
  EXPECT_THAT(complaint(folder, "d.tif", whole.substr(0, whole.size() / 2)), HasSubstr("cut off"));
  EXPECT_THAT(complaint(folder, "e.tif", whole.substr(0, 9)), HasSubstr("TIFF"));
}

// --- Listing and checksums -------------------------------------------------------------------

TEST(ListVolumes, NamesEveryVolumeAndWhatIsWrongWithIt) {
  const TempFolder folder;
  write_bytes(folder / "a.nii", NiftiBytes{}.header() + bytes_of_all(kRamp));
  write_bytes(folder / "b.nrrd", "NRRD0004\nnonsense\n");
  write_bytes(folder / "c.txt", "notes");
  const auto all = list_volumes(folder.path());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].format, "NIfTI");
  EXPECT_EQ(all[0].size, (std::array<Index, 3>{4, 3, 5}));
  expect_near(all[0].spacing, {0.5, 1.25, 2});
  EXPECT_EQ(all[0].problem, "");
  EXPECT_EQ(all[1].description, "b.nrrd");
  EXPECT_THAT(all[1].problem, HasSubstr("nonsense"));
  EXPECT_EQ(list_volumes(folder / "a.nii").size(), 1u);
  EXPECT_THROW(list_volumes(folder / "c.txt"), InputError);
  EXPECT_THROW(list_volumes(folder / "nowhere"), InputError);
}

TEST(Sha256, EqualsTheStandardsExamples) {
  const TempFolder folder;
  const auto of = [&](const std::string& bytes) {
    write_bytes(folder / "a", bytes);
    return sha256(folder / "a");
  };
  EXPECT_EQ(of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(of(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, OfADirectoryIsThatOfItsFilesInNameOrder) {
  const TempFolder folder;
  write_bytes(folder / "d/2", "c");
  write_bytes(folder / "d/1", "ab");
  write_bytes(folder / "whole", "abc");
  EXPECT_EQ(sha256(folder / "d"), sha256(folder / "whole"));
  EXPECT_THROW(sha256(folder / "nowhere"), InputError);
}

}  // namespace
}  // namespace mesamis
