// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "support/run_program.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

constexpr const char* kPng = "\x89PNG\r\n\x1a\n";
constexpr const char* kTriangle = "v 0 0 0\nv 10 0 0\nv 0 0 10\nf 1 2 3\n";

/// Draws and returns the PNG's bytes.
std::string draw(const TempFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "picture");
  arguments.insert(arguments.end(), {"-o", folder / "a.png", "--size", "320,240"});
  const ProgramRun run = run_program(folder, arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out + run.err, "");
  const std::string png = read_bytes(folder / "a.png");
  EXPECT_EQ(png.substr(0, 8), kPng);
  // Width and height stand big-endian in the header.
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\1\x40\0\0\0\xf0", 8));
  return png;
}

TEST(PictureCommand, DrawsSurfacesMeshesAndSlices) {
  const TempFolder folder;
  write_bytes(folder / "s.obj", kTriangle);
  const std::string front = draw(folder, {folder / "s.obj", "--view", "front"});
  const std::string side = draw(folder, {folder / "s.obj", "--view", "left"});
  EXPECT_GT(front.size(), side.size()) << "from the side the triangle is a line";

  write_medit_mesh(folder / "m.mesh", box_mesh({{0, 0, 0}, {2, 3, 4}}, {4, 4, 4}));
  const std::string whole = draw(folder, {folder / "m.mesh", "--edges"});
  EXPECT_NE(draw(folder, {folder / "m.mesh", "--edges", "--clip", "z,2"}), whole);

  write_bytes(folder / "v.nrrd",
              "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n"
              "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,2)\n"
              "space origin: (0,0,0)\n\nABCDEFGHIJKLMNOPQRSTUVWX");
  const std::string slice = draw(folder, {folder / "v.nrrd", "--clip", "x,1"});
  write_bytes(folder / "big.obj", "v 0.5 0.5 0\nv 1.5 0.5 4\nv 0.5 1.5 4\nf 1 2 3\n");
  EXPECT_NE(draw(folder, {folder / "v.nrrd", "--clip", "x,1", "--outline", folder / "big.obj"}),
            slice);
  EXPECT_NE(draw(folder, {folder / "v.nrrd", "--clip", "x,1", "--window", "60:70"}), slice);
  EXPECT_EQ(draw(folder, {folder / "v.nrrd", "--clip", "x,1", "--window", "-60,70"}),
            draw(folder, {folder / "v.nrrd", "--clip", "x,1", "--window=-60:70"}));
}

TEST(PictureCommand, ColoursSurfacesAndTurnsThoseInRas) {
  const TempFolder folder;
  const TriMesh surface{{{0, 0, 0}, {10, 0, 0}, {0, 0, 10}}, {{0, 1, 2}}};
  const std::vector<PointArray> arrays{{"distance", {0, 1, 2}}};
  write_surface(folder / "lps.vtp", surface, {.point_arrays = arrays});
  write_surface(folder / "ras.vtp", surface, {.frame = Frame::kRas, .point_arrays = arrays});
  const std::vector<std::string> front{"--view", "front", "--color", "distance"};
  const auto draw_front = [&](const char* name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), folder / name);
    return draw(folder, arguments);
  };
  const std::string colored = draw_front("lps.vtp", front);
  EXPECT_EQ(draw_front("ras.vtp", front), colored);
  EXPECT_NE(draw_front("lps.vtp", {"--view", "front"}), colored);
}

/// The same picture from each format, other than that of one surface.
TEST(PictureCommand, ShowsObjectsInTheirColours) {
  const TempFolder folder;
  std::vector<NamedSurface> objects{{"a", {255, 0, 0}, 1, cube({0, 0, 0}, 8)},
                                    {"b", {0, 0, 255}, 2, cube({16, 0, 0}, 8)}};
  const auto draw_file = [&](const std::string& name) {
    return draw(folder, {folder / name, "--view", "front"});
  };
  write_objects(folder / "a.vtp", objects);
  const std::string colored = draw_file("a.vtp");
  for (const char* name : {"a.3mf", "a.obj", "a.amf"}) {
    write_objects(folder / name, objects, {.frame = Frame::kRas});
    EXPECT_EQ(draw_file(name), colored) << name;
  }
  write_surface(folder / "one.stl", joined(objects[0].surface, objects[1].surface));
  const std::string plain = draw_file("one.stl");
  EXPECT_NE(plain, colored);
  std::filesystem::remove(folder / "a.mtl");
  EXPECT_EQ(draw_file("a.obj"), plain) << "without its colours";
}

TEST(PictureCommand, RefusesPlainly) {
  const TempFolder folder;
  write_bytes(folder / "s.obj", kTriangle);
  const std::string surface = folder / "s.obj", png = folder / "a.png";
  EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", folder / "a.jpg"}), 2, ".png");
  EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", png, "--view", "up"}), 2, "up");
  EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", png, "--clip", "w,1"}), 2, "w,1");
  EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", png, "--clip", "x,1,"}), 2, "--clip");
  EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", png, "--size", "10"}), 2, "--size");
  EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", png, "--size", "10,10"}), 3, "10");
  EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", png, "--color", "u"}), 3, "\"u\"");
  EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", png, "--outline", surface}), 3,
               "--outline");
  for (const char* window : {"9:3", "3:3", "3", "a:b", "1:2:3", ":3"}) {
    EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", png, "--window", window}), 2,
                 "--window");
  }
  EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", png, "--window", "3:9"}), 3,
               "--window is for slices");
  for (const char* option : {"--spacing=1,1,1", "--modality=CT", "--volume=0", "--channel=0",
                             "--series=1", "--resample"}) {
    EXPECT_FAILS(run_program(folder, {"picture", surface, "-o", png, option}), 3, "for volumes");
    EXPECT_FAILS(run_program(folder, {"info", surface, option}), 3, "for volumes");
  }
  write_bytes(folder / "v.nrrd",
              "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\nABCDEFGH");
  for (const char* option : {"--view=front", "--view=oblique", "--zoom=2", "--focus=1,1,1"}) {
    EXPECT_FAILS(run_program(folder, {"picture", folder / "v.nrrd", "-o", png, option}), 3,
                 "are for surfaces and meshes");
  }
  EXPECT_FAILS(run_program(folder, {"picture", folder / "none.vtu", "-o", png}), 3, "none.vtu");
  EXPECT_FALSE(std::filesystem::exists(png));
}

}  // namespace
}  // namespace mesamis
