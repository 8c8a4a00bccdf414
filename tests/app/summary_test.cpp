// SPDX-License-Identifier: Apache-2.0
// The lines at the end of a run.
#include "summary.h"

#include <gmock/gmock.h>

#include "mesamis/volume_files/write_volume.h"
#include "support/ball_volume.h"
#include "support/run_program.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

SurfaceCheck closed_check(double mm3) {
  SurfaceCheck check;
  check.volume = mm3;
  check.components = 1;
  check.islands = 1;
  return check;
}

RunFigures one_object() {
  RunFigures run;
  run.objects = {{"bone", 105158, closed_check(802713), {320.1, 218.7, 98.44}, 0.3004}};
  run.level = 198.81;
  run.unit = "HU";
  run.size = {320.1, 218.7, 98.44};
  run.expected_error = 0.3004;
  run.largest_error = 0.7149;
  run.files = {"out/bone.stl", "out/bone.json"};
  return run;
}

TEST(Summary, SaysInFiveLinesWhatPeopleAskFor) {
  EXPECT_THAT(summary_lines(one_object()),
              ElementsAre("object   bone, 1 part, closed", "size     320 x 219 x 98.4 mm, 803 cm³",
                          "surface  105 158 triangles, level 198.8 HU",
                          "error    0.30 mm expected in the mean, 95 % below 0.71 mm",
                          "files    out: bone.stl bone.json"));
}

/// Parts are what the report calls islands; skins around holes are told beside them.
TEST(Summary, TellsPartsFromCavities) {
  RunFigures run = one_object();
  SurfaceCheck& check = run.objects[0].check;
  check.components = 14;
  check.cavities = 13;
  EXPECT_EQ(summary_lines(run)[0], "object   bone, 1 part, 13 cavities, closed");
  check.islands = 2;
  check.cavities = 1;
  EXPECT_EQ(summary_lines(run)[0], "object   bone, 2 parts, 1 cavity, closed");
  check.islands = check.cavities = 0;
  check.open_edges = 3;
  EXPECT_EQ(summary_lines(run)[0], "object   bone, 14 parts, not closed");
}

TEST(Summary, HasALineForEachOfSeveralObjects) {
  RunFigures run = one_object();
  run.objects.push_back({"hip", 12000, closed_check(5000), {10, 20, 30}, {}});
  run.objects[1].check.open_edges = 3;
  const auto lines = summary_lines(run);
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(
      lines[0],
      "object   bone: 105 158 triangles, 320 x 219 x 98.4 mm, 803 cm³, error 0.30 mm, closed");
  EXPECT_EQ(lines[1],
            "object   hip: 12 000 triangles, 10.0 x 20.0 x 30.0 mm, 5.00 cm³, not closed");
  EXPECT_EQ(lines[2], "size     320 x 219 x 98.4 mm, 808 cm³");
  EXPECT_THAT(lines[3], StartsWith("surface  117 158 triangles, level"));
  run.shared = 1200;
  EXPECT_THAT(
      summary_lines(run)[3],
      StartsWith("surface  117 158 triangles (1 200 that two objects share count twice), "));
}

TEST(Summary, OfManyObjectsShowsThoseThatAreNotClosedAndCountsTheRest) {
  RunFigures run = one_object();
  run.objects.assign(104, run.objects[0]);
  run.objects.back().name = "last";
  run.objects.back().check.open_edges = 1;
  const auto lines = summary_lines(run);
  ASSERT_EQ(lines.size(), 12u + 1 + 4);
  EXPECT_THAT(lines[0], StartsWith("object   last: "));
  EXPECT_EQ(lines[12], "object   and 92 more");
}

TEST(Summary, OfNothingSaysSo) {
  EXPECT_THAT(summary_lines({}),
              ElementsAre("object   none", "size     none", "surface  0 triangles",
                          "error    not known", "files    none"));
}

TEST(Summary, OfOneObjectWithoutASurfaceSaysSo) {
  RunFigures run;
  run.objects = {{"hip", 0, {}, {}, {}}};
  EXPECT_EQ(summary_lines(run).front(), "object   hip: no surface");
}

TEST(Summary, FollowsEachRunThatIsNotQuiet) {
  const TempFolder folder;
  const std::string scan = folder / "scan.nrrd", labels = folder / "labels.nrrd";
  ASSERT_EQ(run_program(folder, {"phantom", "sphere", "--size", "16,16,16", "-o", scan}).status, 0);
  const std::vector<std::string> words{"segment",   scan,         "-o",  folder / "a.stl",
                                       "--preview", "--labelmap", labels};
  const ProgramRun one = run_program(folder, words);
  EXPECT_EQ(one.out, "");
  EXPECT_THAT(one.err, HasSubstr("mesamis: object   all that is bright, 1 part, closed\n"));
  EXPECT_THAT(one.err, HasSubstr(" mm expected in the mean, 95 % below "));
  EXPECT_THAT(one.err, HasSubstr(": a.stl labels.nrrd\n"));
  auto quiet = words;
  quiet.emplace_back("--quiet");
  EXPECT_EQ(run_program(folder, quiet).err, "");
  const ProgramRun labelled =
      run_program(folder, {"segment", "--labels", labels, "-o", folder / "{label}.stl"});
  EXPECT_EQ(labelled.status, 0) << labelled.err;
  EXPECT_THAT(labelled.err,
              testing::ContainsRegex("mesamis: object   [a-z0-9_ ]+, 1 part, closed\n"));
  EXPECT_THAT(labelled.err, HasSubstr("mesamis: error    not known\n"));
}

TEST(Summary, SaysHounsfieldUnitsWhereOnlyTheValuesTellThem) {
  const TempFolder folder;
  for (const double air : {-1000, 4000}) {
    write_nrrd(folder / "scan.nrrd", sampled_volume({20, 20, 20}, {1, 1, 1}, [&](const Vec3& p) {
                 return air + 1400 * blurred_ball(norm(p - Vec3{9.5, 9.5, 9.5}), 6, 0.7);
               }));
    const ProgramRun run =
        run_program(folder, {"segment", folder / "scan.nrrd", "-o", folder / "a.stl", "--preview"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, testing::ContainsRegex(air < 0 ? "level -?[0-9.]+ HU" : "native units"));
  }
}

/// The level of a dark tissue of CT is in HU; a range of values has two ends, and no level.
TEST(Summary, SaysTheLevelOfATissueWhereThereIsOne) {
  const TempFolder folder;
  write_nrrd(folder / "scan.nrrd", sampled_volume({20, 20, 20}, {1, 1, 1}, [&](const Vec3& p) {
               return -1000 + 1400 * blurred_ball(norm(p - Vec3{9.5, 9.5, 9.5}), 6, 0.7);
             }));
  const auto summary = [&](const std::string& tissue) {
    return run_program(folder, {"segment", folder / "scan.nrrd", "-o", folder / "a.stl",
                                "--preview", "--tissue", tissue, "--report", folder / "r.json",
                                "--html", folder / "r.html"})
        .err;
  };
  for (const char* tissue : {"bone", "dark", "-300:", ":-300"}) {
    EXPECT_THAT(summary(tissue), testing::ContainsRegex("level -?[0-9.]+ HU")) << tissue;
    EXPECT_THAT(read_bytes(folder / "r.json"), testing::ContainsRegex("\"level_native\": -?[0-9]"));
  }
  EXPECT_THAT(summary("-300:100"),
              AllOf(HasSubstr("object   -300:100, "), Not(HasSubstr(" level "))));
  EXPECT_THAT(read_bytes(folder / "r.json"), HasSubstr("\"level_native\": null"));
  EXPECT_THAT(read_bytes(folder / "r.html"), HasSubstr("encloses the values"));
}

}  // namespace
}  // namespace mesamis
