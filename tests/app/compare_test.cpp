// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "support/run_program.h"

namespace mesamis {
namespace {

/// A square in the plane z = height, as .obj.
std::string square(double height) {
  std::ostringstream text;
  for (const auto* corner : {"0 0 ", "4 0 ", "4 4 ", "0 4 "}) {
    text << "v " << corner << height << "\n";
  }
  text << "f 1 2 3\nf 1 3 4\n";
  return text.str();
}

TEST(CompareCommand, MeasuresParallelSquares) {
  const TempFolder folder;
  write_bytes(folder / "a.obj", square(0));
  write_bytes(folder / "b.obj", square(0.25));
  const ProgramRun run =
      run_program(folder, {"compare", folder / "a.obj", folder / "b.obj", "--report",
                           folder / "r.json", "--histogram", folder / "h.csv"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr("0.2500"));
  const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"));
  for (const auto* direction : {"surface_to_reference", "reference_to_surface"}) {
    const auto& d = report[direction];
    EXPECT_EQ(d["vertices"], 4);
    for (const auto* figure : {"mean", "rms", "p95", "p99", "max"}) {
      EXPECT_NEAR(d[figure].get<double>(), 0.25, 1e-12) << direction << " " << figure;
      EXPECT_NEAR(d["by_area"][figure].get<double>(), 0.25, 1e-12) << direction << " " << figure;
    }
    EXPECT_GT(d["by_area"]["samples"], 1000);
  }
}

TEST(CompareCommand, HistogramCountsEveryPoint) {
  const TempFolder folder;
  write_bytes(folder / "a.obj", square(0));
  write_bytes(folder / "b.obj", "v 0 0 0\nv 4 0 1\nv 0 4 2\nf 1 2 3\n");
  const ProgramRun run = run_program(
      folder, {"compare", folder / "a.obj", folder / "b.obj", "--histogram", folder / "h.csv"});
  EXPECT_EQ(run.status, 0) << run.err;
  std::istringstream csv(read_bytes(folder / "h.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line,
            "from_mm,to_mm,surface_to_reference_vertices,surface_to_reference_area,"
            "reference_to_surface_vertices,reference_to_surface_area");
  std::array<long, 2> vertices{};
  double last = 0;
  while (std::getline(csv, line)) {
    double from = 0, to = 0;
    long a = 0, b = 0, c = 0, d = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%ld,%ld,%ld,%ld", &from, &to, &a, &b, &c, &d), 6);
    EXPECT_NEAR(from, last, 1e-4);
    last = to;
    vertices[0] += a;
    vertices[1] += c;
  }
  EXPECT_EQ(vertices, (std::array<long, 2>{3, 4}));
}

TEST(CompareCommand, RefusesPlainly) {
  const TempFolder folder;
  write_bytes(folder / "a.obj", square(0));
  const std::string a = folder / "a.obj";
  EXPECT_FAILS(run_program(folder, {"compare", a, a, "--colored", "c.vtp"}), 2, "not available");
  EXPECT_FAILS(run_program(folder, {"compare", a, folder / "none.obj"}), 3, "none.obj");
  EXPECT_FAILS(run_program(folder, {"compare", a}), 2, "surface");
}

}  // namespace
}  // namespace mesamis
