// SPDX-License-Identifier: Apache-2.0
// mesamis segment --plan: what a run needs, before it runs.
#include "run_plan.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "mesamis/method/memory.h"
#include "support/run_program.h"
#include "support/scan_bytes.h"

namespace mesamis {
namespace {

using nlohmann::json;

std::string sphere(const TempFolder& folder, const std::string& name, const std::string& size) {
  const std::string scan = folder / name;
  EXPECT_EQ(run_program(folder, {"phantom", "sphere", "--size", size, "-o", scan}).status, 0);
  return scan;
}

json plan_of(const TempFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"segment", "--plan"});
  const ProgramRun run = run_program(folder, arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return json::parse(run.out, nullptr, false);
}

double method_share(const json& plan) { return plan["memory"]["method"].get<double>(); }

TEST(RunPlan, SaysWhatTheLibraryExpectsBesideTheSamples) {
  const TempFolder folder;
  const json plan = plan_of(folder, {sphere(folder, "a.nrrd", "20,24,28"), "--max-tets", "50000"});
  VoxelGrid grid;
  grid.size = {20, 24, 28};
  Settings settings;
  settings.max_tets = 50000;
  EXPECT_EQ(plan["input"]["size"], json({20, 24, 28}));
  EXPECT_EQ(plan["voxels"], 20 * 24 * 28);
  EXPECT_EQ(method_share(plan), std::ceil(memory_needed(grid, settings)));
  EXPECT_EQ(plan["memory"]["samples"], 4 * 20 * 24 * 28);
  EXPECT_EQ(plan["memory_bytes"].get<double>(), method_share(plan) + 4 * 20 * 24 * 28);
}

TEST(RunPlan, CountsWhatSettingsAndBoxLeaveOfTheScan) {
  const TempFolder folder;
  const std::string scan = sphere(folder, "a.nrrd", "40,40,40");
  const double all = method_share(plan_of(folder, {scan}));
  EXPECT_LT(method_share(plan_of(folder, {scan, "--preview"})), all);
  EXPECT_LT(method_share(plan_of(folder, {scan, "--crop", "0:20,:,:"})), all);
  EXPECT_LT(method_share(plan_of(folder, {scan, "--box", ":,:,0:20"})), all);
  EXPECT_GT(method_share(plan_of(folder, {scan, "--max-tets", "2000000"})), all);
}

TEST(RunPlan, ReadsNoSampleAndWritesNothing) {
  const TempFolder folder;
  std::string bytes =
      "NRRD0004\ntype: short\ndimension: 3\nsizes: 20 20 20\nencoding: raw\nendian: little\n\n";
  write_bytes(folder / "flat.nrrd", bytes.append(2 * 20 * 20 * 20, '\0'));
  EXPECT_EQ(plan_of(folder, {folder / "flat.nrrd", "-o", folder / "a.stl"})["voxels"], 8000);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.stl"));
  EXPECT_FAILS(
      run_program(folder, {"segment", "--quiet", folder / "flat.nrrd", "-o", folder / "a.stl"}), 3,
      "flat.nrrd");
}

TEST(RunPlan, CountsTheLabelsToo) {
  const TempFolder folder;
  const std::string scan = sphere(folder, "a.nrrd", "20,20,20"), labels = folder / "l.nrrd";
  ASSERT_EQ(run_program(folder, {"segment", scan, "--preview", "--labelmap", labels}).status, 0);
  const json grid_alone = plan_of(folder, {scan, "--preview"});
  const json with = plan_of(folder, {scan, "--labels", labels});
  EXPECT_EQ(with["memory"]["labels"], 2 * 8000);
  EXPECT_GT(method_share(with), method_share(grid_alone));
  EXPECT_LT(method_share(with),
            method_share(plan_of(folder, {scan, "--labels", labels, "--mesh", folder / "m.vtu"})));
  const json alone = plan_of(folder, {"--labels", labels});
  EXPECT_TRUE(alone["input"]["path"].is_null());
  EXPECT_EQ(alone["voxels"], 8000);
  EXPECT_LT(alone["memory_bytes"], with["memory_bytes"]);
}

TEST(RunPlan, RefusesWhatARunWouldRefuseBeforeItReads) {
  const TempFolder folder;
  const std::string scan = sphere(folder, "a.nrrd", "20,20,20");
  EXPECT_FAILS(run_program(folder, {"segment", "--plan"}), 2, "expected a scan");
  EXPECT_FAILS(run_program(folder, {"segment", "--plan", folder / "none.nrrd"}), 3, "none.nrrd");
  EXPECT_FAILS(run_program(folder, {"segment", "--plan", scan, "--tau", "-1"}), 2, "--tau");
  EXPECT_FAILS(run_program(folder, {"segment", "--plan", scan, "--labels", folder / "none.nrrd"}),
               3, "none.nrrd");
  write_bytes(folder / "cut.nrrd", read_bytes(scan).substr(0, 60));
  EXPECT_FAILS(run_program(folder, {"segment", "--plan", folder / "cut.nrrd"}), 3, "cut.nrrd");
}

}  // namespace
}  // namespace mesamis
