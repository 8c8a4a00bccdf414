// SPDX-License-Identifier: Apache-2.0
// `mesamis segment --surface-quality meshing`: surfaces that other meshers fill.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "mesamis/label_files/write_labels.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/triangle_shapes.h"
#include "support/external_program.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

constexpr double kTolerance = 0.3;

/// A scan of a femur in a folder of its own, and runs on it.
class Femur {
 public:
  Femur() {
    run_program(folder, {"phantom", "femur", "--size", "40,40,56", "-o", folder / "femur.nrrd",
                         "--noise", "10", "--quiet"});
  }
  ProgramRun segment(std::vector<std::string> more) const {
    std::vector<std::string> arguments{
        "segment",  folder / "femur.nrrd", "--tolerance", "0.3", "--preview",
        "--report", folder / "r.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(folder, arguments);
  }
  nlohmann::json report() const { return nlohmann::json::parse(read_bytes(folder / "r.json")); }

  TempFolder folder;
};

/// With its surface for meshing, as a.ply and a.stl.
struct MeshedFemur : Femur {
  ProgramRun run = segment({"-o", folder / "a.ply", "-o", folder / "a.stl", "--surface-quality",
                            "meshing", "--element-size", "3"});
};

/// Made once for all tests.
const MeshedFemur& meshed_femur() {
  static const MeshedFemur femur;
  return femur;
}

class SegmentMeshing : public testing::Test, protected Femur {};

double volume_of(const TetMesh& mesh) {
  double volume = 0;
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) volume += std::abs(cell_volume(mesh, c));
  return volume;
}

TEST_F(SegmentMeshing, KeepsItsPromisesAndReportsThem) {
  const ProgramRun plain = segment({"-o", folder / "plain.ply"});
  ASSERT_EQ(plain.status, 0) << plain.err;
  EXPECT_FALSE(report()["surface"].contains("meshing"));
  const MeshedFemur& meshed = meshed_femur();
  ASSERT_EQ(meshed.run.status, 0) << meshed.run.err;
  EXPECT_THAT(meshed.run.err, testing::Not(testing::HasSubstr("warning")));
  const TriMesh surface = read_surface(meshed.folder / "a.ply"),
                given = read_surface(folder / "plain.ply");
  EXPECT_EQ(solid_flaws_of(check_surface(surface)), "");
  EXPECT_TRUE(find_self_intersections(surface).empty());
  const TriangleShapes shapes = triangle_shapes(surface);
  EXPECT_GE(shapes.least_angle, 20);
  EXPECT_GE(shapes.share_above_30_deg, 0.99);
  EXPECT_LT(triangle_shapes(given).least_angle, 20) << "else there was nothing to do";
  const double to = max_distance(surface, given, 0.003), from = max_distance(given, surface, 0.003);
  EXPECT_LE(std::max(to, from), kTolerance);
  const auto told = meshed.report()["surface"];
  EXPECT_EQ(told["triangles"], surface.triangles.size());
  EXPECT_EQ(told["meshing"]["kept"], true);
  EXPECT_NEAR(told["meshing"]["least_angle_deg"], shapes.least_angle, 0.01);
  EXPECT_NEAR(told["meshing"]["share_above_30_deg"], shapes.share_above_30_deg, 1e-3);
  EXPECT_NEAR(told["meshing"]["distance_meshing_to_printing_max"], to, 0.005);
  EXPECT_NEAR(told["meshing"]["distance_printing_to_meshing_max"], from, 0.005);
}

/// The body is made once: its skin is the surface.
TEST_F(SegmentMeshing, ABodyBesideItHasTheSameSkin) {
  const ProgramRun run = segment({"-o", folder / "a.ply", "--surface-quality", "meshing",
                                  "--element-size", "3", "--body", folder / "a.vtu"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read_bytes(meshed_femur().folder / "a.ply"), read_bytes(folder / "a.ply"));
  const double volume = check_surface(read_surface(folder / "a.ply")).volume;
  EXPECT_NEAR(volume_of(read_vtu(folder / "a.vtu").mesh), volume, 1e-5 * volume);
}

TEST_F(SegmentMeshing, TheErrorExpectedComesAlong) {
  ASSERT_EQ(segment({"-o", folder / "a.ply", "--error"}).status, 0);
  const double before = report()["quality"]["expected_error_mm"]["mean"];
  ASSERT_EQ(segment({"-o", folder / "a.ply", "--error", "--surface-quality", "meshing",
                     "--element-size", "3"})
                .status,
            0);
  const double after = report()["quality"]["expected_error_mm"]["mean"];
  EXPECT_GT(after, 0.8 * before);
  EXPECT_LT(after, before + 0.5 * kTolerance);
}

TEST_F(SegmentMeshing, GmshFillsIt) {
  MESAMIS_REQUIRE_PROGRAM("gmsh");
  std::filesystem::copy(meshed_femur().folder / "a.stl", folder / "a.stl");
  write_bytes(folder / "a.geo", "Merge \"a.stl\";\nSurface Loop(1) = {1};\nVolume(1) = {1};\n");
  ASSERT_EQ(run_in(folder.path(), "gmsh -3 a.geo -format mesh -o a.mesh -nopopup"), 0)
      << read_bytes(folder / "log");
  const double volume = check_surface(read_surface(folder / "a.stl")).volume;
  EXPECT_NEAR(volume_of(read_medit_mesh(folder / "a.mesh")), volume, 1e-5 * volume);
}

/// Writes the file that TetGen reads a surface from.
void write_off(const std::filesystem::path& path, const TriMesh& surface) {
  std::ofstream out(path);
  out.precision(17);
  out << "OFF\n" << surface.points.size() << " " << surface.triangles.size() << " 0\n";
  for (const Vec3& p : surface.points) out << p.x << " " << p.y << " " << p.z << "\n";
  for (const Triangle& t : surface.triangles) {
    out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  }
}

TetMesh read_tetgen(const std::filesystem::path& nodes, const std::filesystem::path& cells) {
  TetMesh mesh;
  std::ifstream node(nodes), cell(cells);
  std::size_t count = 0, skip = 0;
  node >> count >> skip >> skip >> skip;
  for (Vec3 p; node >> skip >> p.x >> p.y >> p.z;) mesh.points.push_back(p);
  EXPECT_EQ(mesh.points.size(), count);
  cell >> count >> skip >> skip;
  for (Cell c; cell >> skip >> c[0] >> c[1] >> c[2] >> c[3];) mesh.cells.push_back(c);
  EXPECT_EQ(mesh.cells.size(), count);
  return mesh;
}

TEST_F(SegmentMeshing, TetGenFillsIt) {
  MESAMIS_REQUIRE_PROGRAM("tetgen");
  const TriMesh surface = read_surface(meshed_femur().folder / "a.ply");
  write_off(folder / "a.off", surface);
  ASSERT_EQ(run_in(folder.path(), "tetgen -pYQz a.off"), 0) << read_bytes(folder / "log");
  const double volume = check_surface(surface).volume;
  const TetMesh mesh = read_tetgen(folder / "a.1.node", folder / "a.1.ele");
  EXPECT_GT(mesh.cells.size(), surface.triangles.size() / 2);
  EXPECT_NEAR(volume_of(mesh), volume, 1e-9 * volume);
}

TEST_F(SegmentMeshing, RefusesInOneLineBeforeItReads) {
  write_bytes(folder / "femur.nrrd", "no scan");
  const std::vector<std::string> meshing{"--surface-quality", "meshing"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), meshing.begin(), meshing.end());
    return segment(more);
  };
  EXPECT_FAILS(with({}), 2, "--surface-quality: expected --output for meshing, found none");
  const std::string out = folder / "a.stl";
  EXPECT_FAILS(run_program(folder, {"segment", folder / "femur.nrrd", "-o", out, "--surface",
                                    "band", "--surface-quality", "meshing"}),
               2, "--surface-quality: surface: expected solid, found band");
  EXPECT_FAILS(run_program(folder, {"segment", folder / "femur.nrrd", "-o", out, "--tolerance", "0",
                                    "--surface-quality", "meshing"}),
               2, "--surface-quality: tolerance: expected one above 0 for the skin, found 0");
  EXPECT_FAILS(run_program(folder, {"segment", folder / "femur.nrrd", "-o", out, "--triangles",
                                    "1000", "--surface-quality", "meshing"}),
               2, "--surface-quality: tolerance: expected one beside triangles");
  EXPECT_FAILS(segment({"-o", out, "--surface-quality", "nice"}), 2, "--surface-quality");
}

/// Two blocks of a label map that share a side.
LabelMap two_blocks() {
  LabelMap map;
  map.size = {24, 16, 16};
  map.segments = {{"left", 1, 0, {255, 0, 0}}, {"right", 2, 0, {0, 0, 255}}};
  map.layers.resize(1);
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    const auto [i, j, k] = map.voxel(n);
    const bool inside = i >= 4 && i < 20 && j >= 4 && j < 12 && k >= 4 && k < 12;
    map.layers[0].push_back(static_cast<std::uint16_t>(!inside ? 0 : i < 12 ? 1 : 2));
  }
  return map;
}

/// What two objects share is the same triangles in both: together they have the volume of all.
TEST_F(SegmentMeshing, ObjectsShareTheirBoundaryWithoutAScan) {
  write_label_map(folder / "labels.nrrd", two_blocks());
  const ProgramRun run =
      run_program(folder, {"segment", "--labels", folder / "labels.nrrd", "-o",
                           folder / "{label}.ply", "--surface-quality", "meshing", "--element-size",
                           "2", "--tolerance", "0.2", "--report", folder / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  std::size_t shared = 0;
  const TriMesh left = read_surface(folder / "left.ply"),
                right = read_surface(folder / "right.ply");
  for (const Vec3& p : left.points) {
    shared += static_cast<std::size_t>(std::count(right.points.begin(), right.points.end(), p));
  }
  EXPECT_GT(shared, 20U) << "8 x 8 mm in triangles of 2 mm";
  for (const auto& told : report()["object"]["surfaces"]) {
    EXPECT_GE(told["meshing"]["least_angle_deg"], 15);
    EXPECT_EQ(told["meshing"]["self_intersections"], 0);
  }
}

}  // namespace
}  // namespace mesamis
