// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/spm_matrix.h"

#include <gmock/gmock.h>

#include <cmath>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/matlab_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Turned by a quarter about z: i to the front, j to the left; by columns.
const std::vector<double> kTurned{0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1};

std::vector<double> with(std::vector<double> values, std::size_t at, double value) {
  values[at] = value;
  return values;
}

class SpmMatrixTest : public testing::Test {
 protected:
  std::optional<SpmMatrix> read(const std::string& bytes, std::int64_t volume = 0) {
    write_bytes(file, bytes);
    return read_spm_matrix(file, volume);
  }
  void expect_turned(const std::string& bytes) {
    const auto m = read(bytes);
    ASSERT_TRUE(m);
    expect_near(m->steps[0], {0, 2, 0});
    expect_near(m->steps[1], {-3, 0, 0});
    expect_near(m->steps[2], {0, 0, 4});
    expect_near(m->origin, {7, 22, 34});  // voxels count from 1
    EXPECT_EQ(m->count, 1);
  }

  TempFolder folder;
  std::filesystem::path file = folder / "a.mat";
};

TEST_F(SpmMatrixTest, IsReadFromEveryLevelAndByteOrder) {
  const MatlabVariable other{"other", {1, 2, 3}, 3, 1}, mat{"mat", kTurned};
  for (const bool big : {false, true}) {
    expect_turned(matlab_4_bytes({other, mat}, big));
    expect_turned(matlab_5_bytes({other, mat}, false, big));
    expect_turned(matlab_5_bytes({other, mat}, true, big));
  }
}

TEST_F(SpmMatrixTest, TheOneWithSidesExchangedCountsBeforeTheOther) {
  const MatlabVariable m{"M", with(with(kTurned, 4, 3), 12, -10)}, mat{"mat", kTurned};
  for (const auto& variables : {std::vector{m}, {m, mat}, {mat, m}}) {
    expect_turned(matlab_4_bytes(variables));
    expect_turned(matlab_5_bytes(variables, true));
  }
}

TEST_F(SpmMatrixTest, EachVolumeHasItsOwn) {
  std::vector<double> stack = kTurned;
  const std::vector<double> second = with(kTurned, 12, 11);
  stack.insert(stack.end(), second.begin(), second.end());
  const std::string bytes = matlab_5_bytes({{"mat", stack}}, true);
  expect_near(read(bytes, 0)->origin, {7, 22, 34});
  expect_near(read(bytes, 1)->origin, {8, 22, 34});
  expect_near(read(bytes, 2)->origin, {7, 22, 34});
  EXPECT_EQ(read(bytes)->count, 2);
}

TEST_F(SpmMatrixTest, WithoutAFileThereIsNone) {
  EXPECT_FALSE(read_spm_matrix(folder / "b.mat", 0));
  EXPECT_FALSE(read("")) << "empty";
}

TEST_F(SpmMatrixTest, OtherFilesAreRefused) {
  EXPECT_REFUSED(read("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"), HasSubstr("expected a MATLAB file"));
  EXPECT_REFUSED(read("x"), HasSubstr("expected a MATLAB file"));
  std::string hdf5 = "MATLAB 7.3 MAT-file";
  hdf5.resize(600);
  EXPECT_REFUSED(read(hdf5), HasSubstr("7.3"));
  EXPECT_REFUSED(read(matlab_5_bytes({{"other", kTurned}}, true)), HasSubstr("found neither"));
  EXPECT_REFUSED(read(matlab_5_bytes({}, false)), HasSubstr("found neither"));
  EXPECT_REFUSED(read(matlab_4_bytes({{"M", {1, 2}, 2, 1}})), HasSubstr("4 x 4, found 2 x 1"));
  for (const auto& [at, value] : {std::pair<std::size_t, double>{3, 1}, {15, 0}, {0, NAN}}) {
    EXPECT_REFUSED(read(matlab_4_bytes({{"mat", with(kTurned, at, value)}})), HasSubstr("0 0 0 1"));
  }
}

/// Wherever it is cut, one line; the last bytes of a compressed one may be its sum.
TEST_F(SpmMatrixTest, AFileThatIsCutIsRefused) {
  for (const std::string& whole :
       {matlab_4_bytes({{"mat", kTurned}}), matlab_5_bytes({{"mat", kTurned}}, false),
        matlab_5_bytes({{"mat", kTurned}}, true)}) {
    for (std::size_t n = 1; n + 8 < whole.size(); ++n) {
      EXPECT_REFUSED(read(whole.substr(0, n)), HasSubstr("a.mat"));
    }
  }
}

/// An image of Analyze or NIfTI with a matrix beside it.
class ImageBesideMatrix : public testing::Test {
 protected:
  VolumeFile read(const std::string& magic, const std::string& matrix) {
    nifti.magic = std::string(4, '\0').replace(0, magic.size(), magic);
    nifti.vox_offset = 0;
    write_bytes(folder / "a.hdr", nifti.header().substr(0, 348));
    write_bytes(folder / "a.img", bytes_of_all(ramp<std::int16_t>(60)));
    write_bytes(folder / "a.mat", matrix);
    return read_volume(folder / "a.img");
  }

  TempFolder folder;
  NiftiBytes nifti;
};

TEST_F(ImageBesideMatrix, AnalyzeLiesWhereItSays) {
  nifti.pixdim = {1, 2, 3, 4, 1, 1, 1, 1};
  nifti.qform_code = nifti.sform_code = 0;
  const VolumeFile file = read("", matlab_4_bytes({{"mat", kTurned}}));
  EXPECT_THAT(file.warnings, IsEmpty());
  expect_near(file.volume.spacing, {2, 3, 4});
  expect_near(file.volume.origin, {-7, -22, 34});
  expect_near(file.volume.direction * Vec3{1, 0, 0}, {0, -1, 0});
  expect_near(file.volume.direction * Vec3{0, 1, 0}, {1, 0, 0});
  nifti.pixdim[1] = 1;
  EXPECT_THAT(read("", matlab_4_bytes({{"mat", kTurned}})).warnings,
              ElementsAre(HasSubstr("the matrix of SPM 2")));
}

TEST_F(ImageBesideMatrix, OneThatCannotBeReadGivesAWarningBesideAnalyze) {
  nifti.qform_code = nifti.sform_code = 0;
  EXPECT_THAT(read("", "1 0 0 0").warnings,
              ElementsAre(HasSubstr("a.mat: expected a MATLAB file"), HasSubstr("taken as LAS")));
  EXPECT_THAT(read("ni1", "1 0 0 0").warnings, ElementsAre(HasSubstr("no orientation")))
      << "what is no matrix does not belong to NIfTI";
}

TEST_F(ImageBesideMatrix, TheHeaderOfNiftiCountsWithAWarningWhereTheyDiffer) {
  const std::vector<double> same{0.5, 0, 0, 0, 0, 1.25, 0, 0, 0, 0, 2, 0, 9.5, 18.75, 28, 1};
  EXPECT_THAT(read("ni1", matlab_5_bytes({{"mat", same}}, true)).warnings, IsEmpty());
  const VolumeFile file = read("ni1", matlab_5_bytes({{"mat", with(same, 13, 20.75)}}, true));
  expect_near(file.volume.origin, {-10, -20, 30});
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("\"a.mat\" puts voxels up to 2 mm elsewhere")));
}

}  // namespace
}  // namespace mesamis
