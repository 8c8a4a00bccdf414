// SPDX-License-Identifier: Apache-2.0
// Broken and odd files: each is read rightly or refused in one line, and nothing is printed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <set>

#include "mesamis/base/error.h"
#include "mesamis/volume_files/read_volume.h"
#include "support/dicom_bytes.h"
#include "support/read_scan.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/test_data.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A refusal is checked, see complaint().
bool is_read(const fs::path& path) { return complaint(path).empty(); }

/// Checks that nothing is printed while it lives.
class ExpectSilence {
 public:
  ExpectSilence() {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
  }
  ~ExpectSilence() {
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  }
};

// --- Flipped bytes and cut ends ---------------------------------------------------------------

void spoil(std::string& bytes, std::mt19937& random) {
  const auto below = [&random](std::size_t n) { return random() % n; };
  if (below(4) == 0) bytes.resize(below(bytes.size()));
  if (bytes.empty()) return;
  // Headers decide most: half of the flips go to the first bytes.
  const std::size_t flips = below(6);
  for (std::size_t n = 0; n < flips; ++n) {
    const std::size_t reach = below(2) ? bytes.size() : std::min<std::size_t>(bytes.size(), 600);
    bytes[below(reach)] = static_cast<char>(random());
  }
}

/// Reads `rounds` spoilt versions of a file that is well.
void fuzz(const std::string& name, const std::string& well, int rounds,
          const std::function<void(const fs::path&)>& add_others = {}) {
  const TempFolder folder;
  if (add_others) add_others(folder.path());
  write_bytes(folder / name, well);
  ASSERT_TRUE(is_read(folder / name)) << name;
  const double before = peak_mb();
  const ExpectSilence silence;
  std::mt19937 random(7);
  for (int round = 0; round < rounds; ++round) {
    std::string bytes = well;
    spoil(bytes, random);
    write_bytes(folder / name, bytes);
    is_read(folder / name);
  }
  EXPECT_LT(peak_mb() - before, 300);
}

const std::string kData = bytes_of_all(ramp<std::int16_t>(60));

TEST(Fuzz, Nifti) {
  const std::string nifti = NiftiBytes{}.header() + kData;
  fuzz("a.nii", nifti, 500);
  fuzz("a.nii.gz", packed(nifti), 500);
}

TEST(Fuzz, Nrrd) {
  const std::string head =
      "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 3 5\nspace: left-posterior-superior\n"
      "space directions: (0.5,0,0) (0,1.25,0) (0,0,2)\nspace origin: (1,2,3)\nendian: little\n";
  fuzz("a.nrrd", head + "encoding: raw\n\n" + kData, 500);
  fuzz("b.nrrd", head + "encoding: gzip\n\n" + packed(kData), 500);
}

TEST(Fuzz, Meta) {
  const std::string head =
      "ObjectType = Image\nNDims = 3\nDimSize = 4 3 5\nElementType = MET_SHORT\n"
      "ElementSpacing = 0.5 1.25 2\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n";
  fuzz("a.mha", head + "ElementDataFile = LOCAL\n" + kData, 500);
  fuzz("b.mha", head + "CompressedData = True\nElementDataFile = LOCAL\n" + packed(kData, 15),
       1500);
}

TEST(Fuzz, InVesalius) {
  fuzz("a.inv3", inv3_bytes(4, 3, 5, kData), 500);
  fuzz("b.inv3", packed(inv3_bytes(4, 3, 5, kData)), 500);
}

TEST(Fuzz, Tiff) {
  TiffPage page;
  page.pixels = bytes_of_all(ramp<std::int16_t>(12));
  fuzz("a.tif", tiff_bytes({page, page, page}), 500);
}

TEST(Fuzz, Dicom) {
  for (const DicomCoding coding :
       {DicomCoding::kExplicit, DicomCoding::kImplicit, DicomCoding::kDeflated}) {
    SliceBytes first, second;
    first.coding = second.coding = coding;
    second.position = {0, 0, 2};
    fuzz("a.dcm", first.bytes(), 400,
         [&second](const fs::path& folder) { write_bytes(folder / "b.dcm", second.bytes()); });
  }
}

TEST(Fuzz, CompressedDicom) {
  for (const char* coding : {"j2k", "jpeg", "jpegls", "rle"}) {
    const fs::path source = test_data(std::string("data/bad/dicom2nifti_compressed_") + coding);
    MESAMIS_REQUIRE_DATA(source);
    fuzz("a.dcm", read_bytes(source / "IM-0001-0001-0001.dcm"), 60, [&](const fs::path& folder) {
      write_bytes(folder / "b.dcm", read_bytes(source / "IM-0001-0002-0001.dcm"));
    });
  }
}

// --- The collection of odd files --------------------------------------------------------------

/// What can be read; everything else in the collection must be refused.
const std::set<std::string> kReadable{
    "ct_transfer_syntaxes/CT0012.fragmented_no_bot_jpeg_baseline.51.dcm",
    "dicom2nifti_compressed_j2k",
    "dicom2nifti_compressed_j2k/IM-0001-0001-0001.dcm",
    "dicom2nifti_compressed_j2k/IM-0001-0002-0001.dcm",
    "dicom2nifti_compressed_j2k/IM-0001-0003-0001.dcm",
    "dicom2nifti_compressed_j2k/IM-0001-0004-0001.dcm",
    "dicom2nifti_compressed_jpeg",
    "dicom2nifti_compressed_jpeg/IM-0001-0001-0001.dcm",
    "dicom2nifti_compressed_jpeg/IM-0001-0002-0001.dcm",
    "dicom2nifti_compressed_jpeg/IM-0001-0003-0001.dcm",
    "dicom2nifti_compressed_jpeg/IM-0001-0004-0001.dcm",
    "dicom2nifti_compressed_jpegls",
    "dicom2nifti_compressed_jpegls/IM-0001-0001-0001.dcm",
    "dicom2nifti_compressed_jpegls/IM-0001-0002-0001.dcm",
    "dicom2nifti_compressed_jpegls/IM-0001-0003-0001.dcm",
    "dicom2nifti_compressed_jpegls/IM-0001-0004-0001.dcm",
    "dicom2nifti_compressed_rle",
    "dicom2nifti_compressed_rle/IM-0001-0001-0001.dcm",
    "dicom2nifti_compressed_rle/IM-0001-0002-0001.dcm",
    "dicom2nifti_compressed_rle/IM-0001-0003-0001.dcm",
    "dicom2nifti_compressed_rle/IM-0001-0004-0001.dcm",
    "dicom2nifti_nonisotropic",
    "dicom2nifti_nonisotropic/001.dcm",
    "dicom2nifti_nonisotropic/002.dcm",
    "dicom2nifti_nonisotropic/003.dcm",
    "dicom2nifti_nonisotropic/004.dcm",
    // Two slices one step apart: thin, but a volume.
    "dicom2nifti_slicecount",
    "dicom2nifti_slicecount/001",
    "dicom2nifti_slicecount/001/IM-0001-0001-0001.dcm",
    "dicom2nifti_slicecount/001/IM-0001-0002-0001.dcm",
    "nibabel/anatomical.nii",
    "nibabel/reoriented_anat_moved.nii",
    "nibabel/standard.nii.gz",
    // The enhanced CT is the only volume in its folder.
    "pydicom_data",
    "pydicom_data/eCT_Supplemental.dcm",
    "pynrrd/BallBinary30x30x30.nhdr",
    "pynrrd/BallBinary30x30x30.nii.gz",
    "pynrrd/BallBinary30x30x30.nrrd",
    "pynrrd/BallBinary30x30x30_byteskip_minus_one.nhdr",
    "pynrrd/BallBinary30x30x30_byteskip_minus_one_nifti.nhdr",
    "pynrrd/BallBinary30x30x30_gz.nrrd",
    "pynrrd/BallBinary30x30x30_gz_byteskip_minus_one.nrrd",
    "pynrrd/BallBinary30x30x30_gz_lineskip.nrrd",
    // One volume of one voxel, which every method refuses.
    "pynrrd/test_simple4d_raw.nrrd",
};

TEST(OddFiles, AreReadOrRefusedInOneLineAndInSilence) {
  const fs::path bad = test_data("data/bad");
  MESAMIS_REQUIRE_DATA(bad);
  const double before = peak_mb();
  const ExpectSilence silence;
  std::set<std::string> read;
  is_read(bad);
  for (const auto& entry : fs::recursive_directory_iterator(bad)) {
    if (is_read(entry.path())) read.insert(fs::relative(entry.path(), bad).string());
    EXPECT_NO_THROW(try { list_volumes(entry.path()); } catch (const InputError&){});
  }
  EXPECT_EQ(read, kReadable);
  EXPECT_LT(peak_mb() - before, 300);
}

TEST(OddFiles, SayWhatIsWrong) {
  const fs::path bad = test_data("data/bad");
  MESAMIS_REQUIRE_DATA(bad);
  const auto why = [&bad](const std::string& name) { return complaint(bad / name); };
  EXPECT_THAT(why("made_truncated.nii.gz"), HasSubstr("cut off"));
  EXPECT_THAT(why("made_short_data.nii.gz"), HasSubstr("expected 739320 bytes"));
  EXPECT_THAT(why("nifti_rgb24.nii.gz"), HasSubstr("RGB"));
  EXPECT_THAT(why("nibabel/example4d.nii.gz"), HasSubstr("4-D"));
  EXPECT_THAT(why("nibabel/example_nifti2.nii.gz"), HasSubstr("4-D"));
  EXPECT_THAT(why("dicom2nifti_gantrytilting"), HasSubstr("tilt of 14 degrees"));
  EXPECT_THAT(why("dicom2nifti_sliceincrement_001"), HasSubstr("expected 5 mm, found 10 mm"));
  EXPECT_THAT(why("dicom2nifti_sliceorientation/001"), HasSubstr("another orientation"));
  EXPECT_THAT(why("dicom2nifti_rgb"), HasSubstr("RGB"));
  EXPECT_THAT(why("dcm_12bit"), HasSubstr("mosaic"));
  EXPECT_THAT(why("pydicom/MR_truncated.dcm"), HasSubstr("claims 8192 bytes"));
  EXPECT_THAT(why("pydicom/rtstruct.dcm"), HasSubstr("RTSTRUCT"));
  EXPECT_THAT(why("pydicom/liver_1frame.dcm"), HasSubstr("1 bits allocated"));
  EXPECT_THAT(why("pydicom_data/parametric_map_float.dcm"), HasSubstr("Float Pixel Data"));
  EXPECT_THAT(why("pynrrd/BallBinary30x30x30_bz2.nrrd"), HasSubstr("bzip2"));
  EXPECT_THAT(why("pynrrd/BallBinary30x30x30_nifti.nhdr"), HasSubstr("go on"));
}

TEST(OddFiles, TheBallIsTheSameInEveryEncoding) {
  const fs::path folder = test_data("data/bad/pynrrd");
  MESAMIS_REQUIRE_DATA(folder);
  const auto plain = read_volume(folder / "BallBinary30x30x30.nrrd").volume.samples;
  for (const std::string& name : kReadable) {
    if (!name.starts_with("pynrrd/Ball")) continue;
    EXPECT_EQ(read_volume(folder.parent_path() / name).volume.samples, plain) << name;
  }
}

// Three decoders of GDCM's and the run lengths of our own.
TEST(OddFiles, OneSeriesIsTheSameInFourCompressions) {
  const fs::path bad = test_data("data/bad");
  MESAMIS_REQUIRE_DATA(bad);
  const auto samples = [&bad](const std::string& coding) {
    return read_volume(bad / ("dicom2nifti_compressed_" + coding)).volume.samples;
  };
  const auto plain = samples("rle");
  for (const char* coding : {"j2k", "jpeg", "jpegls"}) EXPECT_EQ(samples(coding), plain) << coding;
}

TEST(OddFiles, ACompressedPictureWithoutItsEndIsRefused) {
  for (const char* coding : {"j2k", "jpeg", "jpegls"}) {
    const fs::path source = test_data(std::string("data/bad/dicom2nifti_compressed_") + coding);
    MESAMIS_REQUIRE_DATA(source);
    const TempFolder folder;
    std::string bytes = read_bytes(source / "IM-0001-0001-0001.dcm");
    const auto end = bytes.rfind("\xff\xd9");
    ASSERT_NE(end, std::string::npos);
    bytes.replace(end - 100, 102, std::string(102, '\0'));
    write_bytes(folder / "a.dcm", bytes);
    write_bytes(folder / "b.dcm", read_bytes(source / "IM-0001-0002-0001.dcm"));
    try {
      read_volume(folder.path());
      ADD_FAILURE() << coding;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("cut off"));
    }
  }
}

// --- One slice in many codings ----------------------------------------------------------------

void replace_once(std::string& bytes, const std::string& from, const std::string& to) {
  const auto at = bytes.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  bytes.replace(at, from.size(), to);
}

std::string inflated(const std::string& bytes) {
  std::string out(4'000'000, '\0');
  z_stream stream{};
  inflateInit2(&stream, -15);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  inflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  inflateEnd(&stream);
  return out;
}

/// The file with another position; both texts of one length, so that nothing else moves.
std::string moved(const fs::path& file, const std::string& from, const std::string& to) {
  std::string bytes = read_bytes(file);
  if (file.string().find("Deflated") == std::string::npos) {
    replace_once(bytes, from, to);
    return bytes;
  }
  const std::size_t meta = 144 + static_cast<unsigned char>(bytes[140]);  // group length below 256
  std::string set = inflated(bytes.substr(meta));
  replace_once(set, from, to);
  return bytes.substr(0, meta) + packed(set, -15);
}

/// Makes a volume of one slice by putting it at two positions.
Volume doubled(const fs::path& file, const std::string& from, const std::string& to) {
  const TempFolder folder;
  write_bytes(folder / "0.dcm", read_bytes(file));
  write_bytes(folder / "1.dcm", moved(file, from, to));
  return read_volume(folder.path()).volume;
}

/// Codings that lose something, and the mean difference they may have: 8 bits over some 8000 grey
/// values make steps of 32, 12 bits steps of 2.
const std::vector<std::pair<std::string, double>> kLossy{
    {"JPEGProcess1Transfer", 32}, {"JPEGProcess2_4", 8},   {"JPEGProcess6_8", 8},
    {"JPEGProcess10_12", 8},      {"JPEG2000Transfer", 8}, {"JPEGLSLossy", 8}};

TEST(OddFiles, OneSliceIsTheSameInEveryTransferSyntax) {
  const fs::path folder = test_data("data/bad/ct_transfer_syntaxes");
  MESAMIS_REQUIRE_DATA(folder);
  const ExpectSilence silence;
  const auto read = [](const fs::path& file) { return doubled(file, "\\4.700000", "\\5.700000"); };
  const Volume plain = read(folder / "CTImage.dcm");
  EXPECT_NEAR(plain.spacing.z, 1, 1e-6);
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("CTImage.dcm_")) continue;
    const Volume volume = read(entry.path());
    ASSERT_EQ(volume.samples.size(), plain.samples.size()) << name;
    double sum = 0;
    for (std::size_t n = 0; n < plain.samples.size(); ++n) {
      sum +=
          std::abs(static_cast<double>(volume.samples[n]) - static_cast<double>(plain.samples[n]));
    }
    const double mean = sum / static_cast<double>(plain.samples.size());
    const auto lossy = std::find_if(kLossy.begin(), kLossy.end(), [&name](const auto& coding) {
      return name.find(coding.first) != std::string::npos;
    });
    EXPECT_LE(mean, lossy == kLossy.end() ? 0 : lossy->second) << name;
  }
}

TEST(OddFiles, ByteOrderAndPaddingChangeNoPixel) {
  const fs::path folder = test_data("data/bad/pydicom");
  MESAMIS_REQUIRE_DATA(folder);
  const auto read = [&](const char* name) {
    return doubled(folder / name, "\\6.6406", "\\7.6406").samples;
  };
  const auto plain = read("MR_small.dcm");
  EXPECT_EQ(read("MR_small_bigendian.dcm"), plain);
  EXPECT_EQ(read("MR_small_padded.dcm"), plain);
}

// The JPEG 2000 stream says unsigned, the header signed: the header means the bits.
TEST(OddFiles, SignOfTheHeaderHoldsAgainstTheStreams) {
  const fs::path file = test_data("data/bad/pydicom/J2K_pixelrep_mismatch.dcm");
  MESAMIS_REQUIRE_DATA(file);
  const Volume volume = doubled(file, "\\-98.1898\\72.1446", "\\-94.4438\\81.4166");
  const auto [lo, hi] = std::minmax_element(volume.samples.begin(), volume.samples.end());
  EXPECT_GE(*lo, -4096);
  EXPECT_LE(*hi, 4095);
  EXPECT_LT(*lo, -900);  // air
}

}  // namespace
}  // namespace mesamis
