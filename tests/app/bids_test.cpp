// SPDX-License-Identifier: Apache-2.0
// mesamis bids on small trees of phantoms.
#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "mesamis/label_files/read_labels.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/volume_files/read_volume.h"
#include "support/run_program.h"
#include "support/scan_bytes.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr const char* kCt = "sub-01/ct/sub-01_acq-thin_ct.nii.gz";
constexpr const char* kMr = "sub-02/ses-a/anat/sub-02_ses-a_T1w.nii";

/// A phantom of the program as a NIfTI file: RAS, so that x and y of LPS run backwards.
std::string nifti_of(const Volume& volume) {
  NiftiBytes nifti;
  nifti.datatype = 16;
  nifti.bitpix = 32;
  for (std::size_t a = 0; a < 3; ++a) nifti.dim[a + 1] = static_cast<std::int16_t>(volume.size[a]);
  const auto& s = volume.spacing;
  const auto& o = volume.origin;
  nifti.pixdim = {1, static_cast<float>(s.x), static_cast<float>(s.y), static_cast<float>(s.z)};
  nifti.srow = {static_cast<float>(-s.x),
                0,
                0,
                static_cast<float>(-o.x),
                0,
                static_cast<float>(-s.y),
                0,
                static_cast<float>(-o.y),
                0,
                0,
                static_cast<float>(s.z),
                static_cast<float>(o.z)};
  std::string bytes = nifti.header();
  for (const float sample : volume.samples) bytes += bytes_of(sample);
  return bytes;
}

class Bids : public testing::Test {
 protected:
  void SetUp() override {
    const ProgramRun run = run_program(
        folder_, {"phantom", "sphere", "--size", "20,20,20", "-o", folder_ / "ball.nrrd"});
    ASSERT_EQ(run.status, 0) << run.err;
    ball_ = nifti_of(read_volume(folder_ / "ball.nrrd", {}).volume);
    write_bytes(dataset() / "dataset_description.json",
                R"({"Name": "Balls", "BIDSVersion": "1.9.0"})");
    write_bytes(dataset() / kCt, packed(ball_));
    write_bytes(dataset() / kMr, ball_);
    write_bytes(dataset() / "sub-01/ct/sub-01_acq-thin_ct.json", "{}");
    write_bytes(dataset() / "sub-01/ct/sub-01_acq-thin_mask.nii", "no scan");
    write_bytes(dataset() / "sub-01/func/sub-01_task-rest_bold.nii", "no scan");
  }
  fs::path dataset() const { return folder_ / "dataset"; }
  fs::path out() const { return dataset() / "derivatives/mesamis"; }
  ProgramRun run(Words more = {}) const {
    const Words words{"bids", dataset(), out(), "participant", "--max-tets", "2000"};
    more.insert(more.begin(), words.begin(), words.end());
    return run_program(folder_, more);
  }
  nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(read_bytes(out() / name));
  }
  /// Files of the derivatives, in order.
  Words made() const {
    Words names;
    for (const auto& file : fs::recursive_directory_iterator(out())) {
      if (file.is_regular_file()) names.push_back(fs::relative(file.path(), out()).string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  TempFolder folder_;
  std::string ball_;
};

TEST_F(Bids, MakesDerivativesOfEachImage) {
  const auto begin = std::chrono::steady_clock::now();
  const ProgramRun all = run({"--quiet"});
  ASSERT_EQ(all.status, 0) << all.err;
  EXPECT_EQ(all.out + all.err, "");
  EXPECT_EQ(made(), (Words{".bidsignore", "README", "dataset_description.json",
                           "sub-01/ct/sub-01_acq-thin_desc-ct_mesh.json",
                           "sub-01/ct/sub-01_acq-thin_desc-ct_mesh.stl",
                           "sub-02/ses-a/anat/sub-02_ses-a_desc-T1w_mesh.json",
                           "sub-02/ses-a/anat/sub-02_ses-a_desc-T1w_mesh.stl"}));

  const auto description = json("dataset_description.json");
  EXPECT_EQ(description["DatasetType"], "derivative");
  EXPECT_EQ(description["GeneratedBy"][0]["Name"], "mesamis");
  EXPECT_TRUE(
      fs::equivalent(out() / description["DatasetLinks"]["raw"].get<std::string>(), dataset()));

  const auto report = json("sub-01/ct/sub-01_acq-thin_desc-ct_mesh.json");
  EXPECT_EQ(report["Sources"][0], std::string("bids:raw:") + kCt);
  EXPECT_EQ(report["settings"]["max_tets"], 2000);
  EXPECT_EQ(report["surface"]["closed"], true);
  const TriMesh surface = read_surface(out() / "sub-01/ct/sub-01_acq-thin_desc-ct_mesh.stl");
  EXPECT_EQ(report["surface"]["triangles"], surface.triangles.size());
  // Each tells the seconds of its own run: together they are no more than those of all.
  const double both =
      json("sub-02/ses-a/anat/sub-02_ses-a_desc-T1w_mesh.json")["seconds"].get<double>() +
      report["seconds"].get<double>();
  const auto passed = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(both, std::chrono::duration<double>(passed).count());
}

TEST_F(Bids, MakesWhatSegmentMakes) {
  ASSERT_EQ(run({"--participant-label", "sub-01", "--format", "vtp", "ply", "--tetrahedra",
                 "--dseg", "--error", "--frame", "ras", "--desc", "bone", "--quiet"})
                .status,
            0);
  const std::string stem = "sub-01/ct/sub-01_acq-thin_desc-bone_";
  EXPECT_EQ(made(), (Words{".bidsignore", "README", "dataset_description.json", "dseg.tsv",
                           stem + "dseg.nii.gz", stem + "mesh.json", stem + "mesh.ply",
                           stem + "mesh.vtp", stem + "mesh.vtu"}));
  ASSERT_EQ(run_program(folder_,
                        {"segment", dataset() / kCt, "-o", folder_ / "s.ply", "--error", "--frame",
                         "ras", "--max-tets", "2000", "--name", "sub-01_acq-thin_desc-bone_mesh",
                         "--labelmap", folder_ / "l.nii.gz", "--quiet"})
                .status,
            0);
  EXPECT_TRUE(read_bytes(out() / (stem + "mesh.ply")) == read_bytes(folder_ / "s.ply"));
  EXPECT_TRUE(read_bytes(out() / (stem + "dseg.nii.gz")) == read_bytes(folder_ / "l.nii.gz"));
}

TEST_F(Bids, GoesOnAfterABrokenImage) {
  write_bytes(dataset() / kCt, "no image");
  const ProgramRun all = run({"--preview", "--quiet"});
  EXPECT_EQ(all.status, 3);
  EXPECT_EQ(all.error_lines(), 1u) << all.err;
  EXPECT_THAT(all.err, HasSubstr(kCt));
  EXPECT_FALSE(fs::exists(out() / "sub-01")) << "nothing, and no folder for it";
  EXPECT_TRUE(fs::exists(out() / "sub-02/ses-a/anat/sub-02_ses-a_desc-T1w_mesh.stl"));

  // A failure of the method names the image, too.
  const ProgramRun none = run({"--level", "5000", "--quiet"});
  EXPECT_EQ(none.status, 3);
  EXPECT_EQ(none.error_lines(), 2u) << none.err;
  EXPECT_THAT(none.err, HasSubstr(std::string(kMr) + ": level"));
}

TEST_F(Bids, KeepsWhatIsMade) {
  ASSERT_EQ(run({"--preview"}).status, 0);
  const Words names = made();
  const ProgramRun again = run({"--preview", "--skip-existing"});
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, HasSubstr("2 images: 0 segmented, 2 kept, 0 failed"));
  EXPECT_EQ(made(), names);

  fs::remove(out() / "sub-02/ses-a/anat/sub-02_ses-a_desc-T1w_mesh.stl");
  EXPECT_THAT(run({"--preview", "--skip-existing"}).err, HasSubstr("1 segmented, 1 kept"));
  write_bytes(dataset() / kCt, packed(ball_ + "more"));
  EXPECT_THAT(run({"--preview", "--skip-existing"}).err, HasSubstr("1 segmented, 1 kept"));
  EXPECT_THAT(run({"--preview", "--skip-existing", "--keep-largest", "1"}).err,
              HasSubstr("2 segmented"));
  write_bytes(out() / "sub-01/ct/sub-01_acq-thin_desc-ct_mesh.json", "{broken");
  EXPECT_THAT(run({"--preview", "--skip-existing", "--keep-largest", "1"}).err,
              HasSubstr("1 segmented, 1 kept"));
}

TEST_F(Bids, ChoosesImages) {
  const auto said = [&](Words more) {
    more.insert(more.end(), {"--preview"});
    const ProgramRun one = run(more);
    EXPECT_EQ(one.status, 0) << one.err;
    return one.err;
  };
  EXPECT_THAT(said({"--participant_label", "02"}), HasSubstr("1 images: 1 segmented"));
  EXPECT_THAT(said({"--session-label", "ses-a"}), HasSubstr("sub-02_ses-a_T1w"));
  EXPECT_THAT(said({"--datatype", "ct"}), testing::Not(HasSubstr("T1w")));
  EXPECT_THAT(said({"--suffix", "T1w"}), HasSubstr("1 images"));
  write_bytes(dataset() / "sub-01/ct/scan.nii", ball_);
  EXPECT_THAT(said({"--datatype", "ct"}), HasSubstr("sub-01/ct/scan.nii: expected a name sub-01_"));
}

TEST_F(Bids, RefusesInOneLine) {
  EXPECT_FAILS(run({"--participant-label", "03"}), 3, "expected a folder sub-03, found none");
  EXPECT_FAILS(run({"--datatype", "pet"}), 3, "expected NIfTI images in folders pet");
  EXPECT_FAILS(run({"--desc", "a_b"}), 2, "--desc: expected letters and digits, found 'a_b'");
  EXPECT_FAILS(run({"--datatype", "../../extra"}), 2, "--datatype: expected letters and digits");
  EXPECT_FAILS(run({"--level", "5x"}), 2, "--level: expected X|auto");
  EXPECT_FAILS(run({"--tissue", "wood"}), 2, "--tissue");
  EXPECT_FAILS(run({"--error"}), 2, "--error: expected vtp or ply");
  EXPECT_FAILS(run({"--format", "doc"}), 2, "doc");
  EXPECT_FAILS(run_program(folder_, {"bids", dataset(), dataset(), "participant"}), 2,
               "expected a folder other than the dataset");
  EXPECT_FAILS(run_program(folder_, {"bids", dataset(), out(), "subject"}), 2, "subject");
  EXPECT_FAILS(run_program(folder_, {"bids", folder_ / "none", out(), "participant"}), 3, "none");
  write_bytes(dataset() / "sub-01/ct/sub-01_acq-thin_T1w.nii", ball_);
  EXPECT_FAILS(run({"--desc", "bone"}), 3, "choose one image with --suffix");
  write_bytes(dataset() / "dataset_description.json", R"({"Name": "Balls"})");
  EXPECT_FAILS(run(), 3, "expected an entry BIDSVersion, found none");
}

TEST_F(Bids, LeavesDerivativesOfOthersAlone) {
  const std::string theirs = R"({"Name": "x", "GeneratedBy": [{"Name": "fMRIPrep"}]})";
  write_bytes(out() / "dataset_description.json", theirs);
  EXPECT_FAILS(run(), 3, "expected derivatives of mesamis, found those of others");
  EXPECT_EQ(read_bytes(out() / "dataset_description.json"), theirs);
  for (const char* odd : {"[1, 2]", R"({"GeneratedBy": [{"Name": 3}]})", R"({"GeneratedBy": 7})"}) {
    write_bytes(out() / "dataset_description.json", odd);
    EXPECT_FAILS(run(), 3, "expected derivatives of mesamis, found those of others");
  }
}

/// A run that did not converge is not made again, and still counts.
TEST_F(Bids, RemembersWhatDidNotConverge) {
  ASSERT_EQ(run({"--adaptations", "1"}).status, 4);
  const ProgramRun again = run({"--adaptations", "1", "--skip-existing"});
  EXPECT_THAT(again.err, HasSubstr("0 segmented, 2 kept, 0 failed"));
  EXPECT_EQ(again.status, 4);
}

TEST_F(Bids, HasNothingToDoForAGroup) {
  const ProgramRun group = run_program(folder_, {"bids", dataset(), out(), "group"});
  EXPECT_EQ(group.status, 0);
  EXPECT_EQ(group.error_lines(), 1u);
  EXPECT_THAT(group.err, HasSubstr("group: no results across participants"));
  EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
}  // namespace mesamis
