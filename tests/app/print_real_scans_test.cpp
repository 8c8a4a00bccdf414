// SPDX-License-Identifier: Apache-2.0
// What comes of real scans can be printed: for us, and for programs that are not ours.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "support/external_program.h"
#include "support/run_program.h"
#include "support/test_data.h"

namespace mesamis {
namespace {

struct Scan {
  const char* name;
  const char* path;
  const char* crop;
  const char* stride = "3,3,3";
};

class EachScan : public testing::TestWithParam<Scan> {
 protected:
  /// Fewer cells and passes than by default, and parts of scans: what is promised does not depend
  /// on them.
  ProgramRun segment(const std::filesystem::path& scan) const {
    return run_program(folder_, {"segment", scan, "-o", folder_ / "a.stl", "-o", folder_ / "a.3mf",
                                 "-o", folder_ / "a.amf", "--report", folder_ / "r.json",
                                 "--stride", GetParam().stride, "--crop", GetParam().crop,
                                 "--max-tets", "5000", "--adaptations", "2", "--quiet"});
  }

  TempFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(
    Real, EachScan,
    testing::Values(Scan{"cranium", "cranium_inv/ct.nrrd", "128:188,60:120,60:84"},
                    Scan{"pelvis", "pelvis_ts/ct.nii.gz", "20:60,30:70,40:70"},
                    Scan{"skull", "skull_phantom/ct_soft_1mm.nrrd", "130:190,160:220,35:65",
                         "4,4,2"},
                    Scan{"mouse", "mouse_skull/ct_A_J.nii.gz", "50:90,50:90,40:70"},
                    Scan{"mouse_template", "mouse_skull/ct_template.nii.gz", "40:80,70:110,40:70"},
                    Scan{"spine", "thoracic_spine_ts/ct.nii.gz", "40:80,40:80,70:100"},
                    Scan{"trabecular", "trabecular_microct/ct.nrrd", "0:36,0:36,0:36"},
                    Scan{"head_aniso", "head_aniso/ct.nii.gz", "84:144,84:144,6:20"},
                    Scan{"mr", "head_aniso/mr_t1.nii.gz", "84:144,84:144,6:20"},
                    Scan{"j2k", "dicom_ct_j2k", "180:300,180:300,0:-1"},
                    Scan{"three_slices", "dicom_ct_3slice", "150:350,150:350,0:-1"}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(EachScan, GivesASurfaceThatPrints) {
  const std::filesystem::path scan = test_data(std::filesystem::path("data") / GetParam().path);
  MESAMIS_REQUIRE_DATA(scan);
  const ProgramRun run = segment(scan);
  ASSERT_THAT(run.status, testing::AnyOf(0, 4)) << run.err;  // few passes may leave it unsettled
  const auto report = nlohmann::json::parse(read_bytes(folder_ / "r.json"));
  const auto& surface = report["surface"];
  EXPECT_EQ(surface["closed"], true);
  EXPECT_EQ(surface["manifold"], true);
  EXPECT_GT(surface["volume_mm3"], 0);
  EXPECT_EQ(surface["self_intersections"], 0);
  const double tolerance = report["settings"]["tolerance"];
  EXPECT_GT(tolerance, 0);
  EXPECT_LE(surface["distance_extracted_to_result_max"], tolerance);
  EXPECT_LE(surface["distance_result_to_extracted_max"], tolerance);
  EXPECT_LT(surface["triangles"], surface["triangles_extracted"]);

  if (is_installed("admesh")) {
    const ProgramRun admesh = run_command(folder_, {"admesh", "--exact", folder_ / "a.stl"});
    EXPECT_EQ(admesh.status, 0);
    EXPECT_THAT(admesh.out, testing::ContainsRegex("Total disconnected facets *: +0 +0\n"));
    EXPECT_THAT(admesh.out, testing::ContainsRegex("Degenerate facets *: +0"));
  }
  MESAMIS_REQUIRE_PROGRAM("prusa-slicer");
  for (const char* file : {"a.stl", "a.3mf", "a.amf"}) {
    const ProgramRun prusa = run_command(folder_, {"prusa-slicer", "--info", folder_ / file});
    EXPECT_EQ(prusa.status, 0) << file;
    EXPECT_THAT(prusa.out, testing::HasSubstr("manifold = yes")) << file;
    EXPECT_THAT(prusa.out, testing::Not(testing::ContainsRegex("open_edges|facets_|edges_fixed")));
    EXPECT_THAT(prusa.out,
                testing::HasSubstr("number_of_facets = " + to_string(surface["triangles"])));
  }
}

}  // namespace
}  // namespace mesamis
