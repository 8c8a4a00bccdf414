// SPDX-License-Identifier: Apache-2.0
// What is said to slicers and understood of their answers; needs none of them.
#include "slicers.h"

#include <gmock/gmock.h>

#include "print_gate.h"
#include "support/shapes.h"
#include "support/temp_folder.h"
#include "support/variable.h"

namespace mesamis {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Pair;

/// The value after an option.
std::string value_of(const std::vector<std::string>& arguments, const std::string& option) {
  const auto at = std::find(arguments.begin(), arguments.end(), option);
  return at == arguments.end() || at + 1 == arguments.end() ? "none" : *(at + 1);
}

TEST(Slicers, PrusaSlicerIsToldTheSettings) {
  SliceSettings settings;
  settings.layer = 0.1;
  settings.infill = 12.5;
  settings.perimeters = 3;
  settings.bed = {300, 200.5, 400};
  const auto arguments = slicer_called("prusa").arguments(settings);
  EXPECT_EQ(value_of(arguments, "--layer-height"), "0.1");
  EXPECT_EQ(value_of(arguments, "--first-layer-height"), "0.1");
  EXPECT_EQ(value_of(arguments, "--fill-density"), "12.5%");
  EXPECT_EQ(value_of(arguments, "--perimeters"), "3");
  EXPECT_EQ(value_of(arguments, "--bed-shape"), "0x0,300x0,300x200.5,0x200.5");
  EXPECT_EQ(value_of(arguments, "--max-print-height"), "400");
  EXPECT_EQ(value_of(arguments, "--top-solid-layers"), "8") << "0.8 mm";
  EXPECT_THAT(arguments, testing::Not(Contains("--support-material")));
  settings.support = true;
  EXPECT_THAT(slicer_called("prusa").arguments(settings), Contains("--support-material"));
}

TEST(Slicers, CuraEngineIsToldWhatCuraComputes) {
  const TempFolder folder;
  write_bytes(folder / "fdmprinter.def.json", "{}");
  const Variable place("CURA_ENGINE_SEARCH_PATH", "/none:" + folder.path().string());
  SliceSettings settings;
  settings.infill = 20;
  const auto arguments = slicer_called("cura").arguments(settings);
  EXPECT_EQ(value_of(arguments, "-j"), folder / "fdmprinter.def.json");
  EXPECT_THAT(arguments, Contains("layer_height=0.3"));
  EXPECT_THAT(arguments, Contains("layer_height_0=0.3"));
  EXPECT_THAT(arguments, Contains("wall_line_count=2"));
  EXPECT_THAT(arguments, Contains("infill_line_distance=4")) << "a grid has two directions";
  EXPECT_THAT(arguments, Contains("top_layers=3"));
  EXPECT_THAT(arguments, Contains("mesh_position_x=-125"));
  settings.infill = 50;
  EXPECT_THAT(slicer_called("cura").arguments(settings), Contains("infill_line_distance=0.8"));
  settings.infill = 0;
  EXPECT_THAT(slicer_called("cura").arguments(settings), Contains("infill_line_distance=0"));
}

TEST(Slicers, InfoOfASoundSurface) {
  const PrusaInfo info = parse_prusa_info(
      "[2026-01-01 00:00:00.1] [0x00] [trace]   Initializing StaticPrintConfigs\n"
      "[cube.stl]\nsize_x = 20.000000\nmin_x = -110.000000\nmax_x = -90.000000\n"
      "number_of_facets = 12\nmanifold = yes\nnumber_of_parts =  2\nvolume = 8000.000488\n");
  EXPECT_TRUE(info.sound());
  EXPECT_EQ(info.parts, 2);
  EXPECT_NEAR(info.volume, 8000, 1e-3);
}

TEST(Slicers, InfoOfAnUnsoundSurface) {
  const PrusaInfo open = parse_prusa_info(
      "number_of_facets = 11\nmanifold = no\nopen_edges = 3\nnumber_of_parts =  1\n");
  EXPECT_FALSE(open.sound());
  EXPECT_EQ(open.open_edges, 3);
  const PrusaInfo flipped = parse_prusa_info("manifold = yes\nfacets_reversed = 1\n");
  EXPECT_FALSE(flipped.sound()) << "what was repaired was not sound";
  EXPECT_THAT(flipped.repairs, testing::ElementsAre(Pair("facets_reversed", 1)));
  for (const auto* text : {"", "manifold", "manifold = no\n", "volume = 3\n"}) {
    EXPECT_FALSE(parse_prusa_info(text).sound()) << text;
  }
}

TEST(Slicers, FailuresAreNamedByTheirOwnLine) {
  EXPECT_EQ(failure_line("[x] [trace]   Initializing StaticPrintConfigs\n"
                         "10 => Processing triangulated mesh\n"
                         "No layers were detected. Repair it.\n\n"),
            "No layers were detected. Repair it.");
  EXPECT_EQ(failure_line("terminate called after throwing an instance of 'E'\n"
                         "  what():  Objects could not fit on the bed\nlast\n"),
            "what():  Objects could not fit on the bed");
  EXPECT_EQ(failure_line("88 => Generating skirt and brim\n"
                         "There is an object with no extrusions in the first layer.\n"
                         "Object name: surface.stl\n"),
            "There is an object with no extrusions in the first layer. Object name: surface.stl");
  EXPECT_EQ(failure_line("[ERROR] Failed to load model: a.stl.\nUsage\n"),
            "[ERROR] Failed to load model: a.stl.");
  EXPECT_EQ(failure_line("error: " + std::string(500, 'x')).size(), 200u);
  EXPECT_EQ(failure_line("error: \x1b[31mred\n"), "error:  [31mred");
  EXPECT_EQ(failure_line(""), "");
}

TEST(PrintGate, NamesWhatIsWrong) {
  const TriMesh sound = cube();
  EXPECT_EQ(print_flaw(check_for_print(sound)), "");
  TriMesh open = sound;
  open.triangles.pop_back();
  EXPECT_EQ(print_flaw(check_for_print(open)), "3 open edges");
  TriMesh turned = sound;
  std::swap(turned.triangles[4][0], turned.triangles[4][1]);
  EXPECT_THAT(print_flaw(check_for_print(turned)), HasSubstr("3 edges between triangles"));
  TriMesh doubled = sound;
  doubled.triangles.push_back(doubled.triangles[0]);
  EXPECT_THAT(print_flaw(check_for_print(doubled)), HasSubstr("3 edges with more than two"));
  TriMesh inward = sound;
  for (Triangle& triangle : inward.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_THAT(print_flaw(check_for_print(inward)), HasSubstr("inward"));
}

TEST(PrintGate, AHollowIsNoFlawAndOverlapsAreCounted) {
  TriMesh hollow = cube({2, 2, 2}, 1);
  for (Triangle& triangle : hollow.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(print_flaw(check_for_print(joined(cube({0, 0, 0}, 5), hollow))), "");
  const PrintGate overlap = check_for_print(joined(cube(), cube({0.5, 0.5, 0.5})));
  EXPECT_EQ(print_flaw(overlap), "");
  EXPECT_GT(overlap.self_intersections, 0u);
}

TEST(PrintGate, PrusaSlicerHasASay) {
  PrintGate gate = check_for_print(cube());
  gate.prusa = parse_prusa_info("manifold = yes\nedges_fixed = 2\n");
  EXPECT_EQ(print_flaw(gate), "prusa-slicer --info: edges_fixed = 2");
  EXPECT_EQ(gate_json(gate)["passed"], false);
  EXPECT_EQ(gate_json(gate)["by"].size(), 2u);
  EXPECT_EQ(gate_json(check_for_print(cube()))["by"].size(), 1u);
}

}  // namespace
}  // namespace mesamis
