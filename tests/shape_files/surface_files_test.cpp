// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/surface_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/extract.h"
#include "support/level_set.h"
#include "support/scan_bytes.h"
#include "support/shapes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// A sphere in two pieces: single precision holds its coordinates only roughly.
TriMesh sample() {
  const TetMesh mesh = box_mesh({{-101.3, 40.7, -3}, {-99.1, 43.3, 0}}, {7, 8, 9});
  std::vector<double> u;
  for (const Vec3& p : mesh.points) u.push_back(-norm(p - Vec3{-100, 42, -1.3}));
  return joined(extract_solid(mesh, u, -0.9), cube({0.1, 0.2, 0.3}, 0.7));
}

double largest_difference(const TriMesh& a, const TriMesh& b) {
  if (a.triangles.size() != b.triangles.size()) return 1e300;
  double largest = 0;
  for (std::size_t t = 0; t < a.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 d = a.points[a.triangles[t][i]] - b.points[b.triangles[t][i]];
      largest = std::max(largest, norm(d));
    }
  }
  return largest;
}

class EachFormat : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path file() const { return folder_ / (std::string("a") + GetParam()); }
  std::filesystem::path file(const std::string& name) const {
    return folder_ / (name + GetParam());
  }
  bool is(const char* extension) const { return std::strcmp(GetParam(), extension) == 0; }
  /// Single precision at 100 mm, in 3MF with the decimals' rounding on top; or nothing at all.
  double tolerance() const { return is(".stl") ? 1e-5 : is(".3mf") ? 2e-5 : 0; }
  TempFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Surface, EachFormat,
                         testing::Values(".stl", ".ply", ".obj", ".vtp", ".3mf", ".amf"),
                         [](const auto& tested) { return std::string(tested.param + 1); });

TEST_P(EachFormat, GivesBackWhatWasWritten) {
  const TriMesh surface = sample();
  write_surface(file(), surface);
  const TriMesh read = read_surface(file());
  EXPECT_LE(largest_difference(read, surface), tolerance());
  EXPECT_EQ(read.points.size(), surface.points.size());
  const SurfaceCheck check = check_surface(read);
  EXPECT_TRUE(check.closed() && check.manifold());
  EXPECT_EQ(check.components, 2);
  EXPECT_NEAR(check.volume, check_surface(surface).volume, 1e-4);
  EXPECT_EQ(folder_.file_count(), 1u);
}

TEST_P(EachFormat, NegatesXAndYForRasAndKeepsFacingOutward) {
  TriMesh surface = sample();
  write_surface(file(), surface, {.frame = Frame::kRas});
  const TriMesh read = read_surface(file());
  for (Vec3& p : surface.points) p = {-p.x, -p.y, p.z};
  EXPECT_LE(largest_difference(read, surface), tolerance());
  EXPECT_GT(check_surface(read).volume, 0);
}

TEST_P(EachFormat, SaysItsFrameAndItsName) {
  write_surface(file("lps"), cube(), {.frame = Frame::kLps, .name = "left hip"});
  write_surface(file("ras"), cube(), {.frame = Frame::kRas, .name = "two\nlines"});
  const std::string lps = read_bytes(file("lps")), ras = read_bytes(file("ras"));
  if (is(".vtp") || is(".3mf")) {  // packed
    EXPECT_NE(lps, ras);
  } else {
    EXPECT_THAT(lps, HasSubstr("SPACE=LPS"));
    EXPECT_THAT(lps, HasSubstr("left hip"));
    EXPECT_THAT(ras, HasSubstr("SPACE=RAS"));
    EXPECT_THAT(ras, HasSubstr("two lines"));
  }
  EXPECT_EQ(read_surface(file("ras")).triangles.size(), 12u);
}

TEST_P(EachFormat, TellsTheFrameItsFileStates) {
  for (const std::optional<Frame> frame :
       {std::optional(Frame::kLps), std::optional(Frame::kRas), std::optional<Frame>()}) {
    write_surface(file(), cube(), {.frame = frame, .name = "SPACED out"});
    EXPECT_EQ(read_surface_file(file()).frame, frame);
  }
  EXPECT_LT(largest_difference(read_surface(file()), cube()), 1e-6) << "as given, no frame";
}

TEST(StatedFrame, IsReadAs3DSlicerWritesIt) {
  const TempFolder folder;
  const auto frame_of = [&](const char* name, const std::string& bytes) {
    write_bytes(folder / name, bytes);
    return read_surface_file(folder / name).frame;
  };
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_EQ(frame_of("a.obj", "# 3D Slicer output. SPACE=RAS\n" + obj), Frame::kRas);
  EXPECT_EQ(frame_of("b.obj", "#SPACE=LPS\n" + obj), Frame::kLps);
  EXPECT_EQ(frame_of("c.obj", "# SPACE=LPSX\n" + obj), std::nullopt);
  EXPECT_EQ(frame_of("d.obj", "# SPACE=\n" + obj), std::nullopt);
  EXPECT_EQ(frame_of("a.stl",
                     "solid 3D Slicer output. SPACE=LPS\nfacet\nouter loop\nvertex 0 0 0\n"
                     "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"),
            Frame::kLps);
  const std::string head = "\nASCII\nDATASET POLYDATA\n",
                    rest = "POINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";
  const std::string vtk = "# vtk DataFile Version 4.2\n";
  EXPECT_EQ(frame_of("a.vtk", vtk + "3D Slicer output. SPACE=RAS" + head + rest), Frame::kRas);
  EXPECT_EQ(frame_of("b.vtk", vtk + "vtk output" + head +
                                  "FIELD FieldData 1\nSPACE 1 1 string\nLPS\n" + rest),
            Frame::kLps);
  EXPECT_EQ(frame_of("c.vtk", vtk + "vtk output" + head + rest), std::nullopt);
}

TEST_P(EachFormat, IsReadFromGzip) {
  const TriMesh surface = sample();
  write_surface(file(), surface);
  const std::string bytes = read_bytes(file());
  const auto packed = folder_ / (std::string("b") + GetParam() + ".gz");
  write_bytes(packed, mesamis::packed(bytes));
  EXPECT_LE(largest_difference(read_surface(packed), surface), tolerance());
  const std::string whole = read_bytes(packed);
  write_bytes(packed, whole.substr(0, whole.size() / 2));
  EXPECT_REFUSED(read_surface(packed), HasSubstr("cut off"));
}

TEST_P(EachFormat, ReadsUpperCaseExtensions) {
  write_surface(file(), cube());
  std::string name = GetParam();
  for (char& c : name) c = static_cast<char>(std::toupper(c));
  std::filesystem::rename(file(), folder_ / ("A" + name));
  EXPECT_EQ(read_surface(folder_ / ("A" + name)).triangles.size(), 12u);
  write_surface(folder_ / ("B" + name), cube());
}

TEST_P(EachFormat, WritesTheSameBytesAgain) {
  write_surface(file("one"), sample());
  write_surface(file("two"), sample());
  EXPECT_EQ(read_bytes(file("one")), read_bytes(file("two")));
}

TEST_P(EachFormat, RefusesAnEmptyOrUnsoundSurface) {
  EXPECT_REFUSED(write_surface(file(), {}), HasSubstr("empty surface"));
  TriMesh broken = cube();
  broken.triangles[3][1] = 99;
  EXPECT_REFUSED(write_surface(file(), broken), HasSubstr("triangle 3 names point 99"));
  broken = cube();
  broken.points[2].x = std::nan("");
  EXPECT_REFUSED(write_surface(file(), broken), HasSubstr("point 2 is not finite"));
  EXPECT_EQ(folder_.file_count(), 0u);
}

TEST_P(EachFormat, CutOffAnywhereIsRefusedOrStillASurface) {
  write_surface(file(), cube());
  const std::string whole = read_bytes(file());
  int refused = 0;
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 150) {
    write_bytes(file("cut"), whole.substr(0, length));
    try {
      check_surface(read_surface(file("cut")));
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

TEST_P(EachFormat, DamagedBytesAreRefusedOrStillASurface) {
  write_surface(file(), cube());
  const std::string whole = read_bytes(file());
  std::mt19937 generator(1);
  for (int round = 0; round < 500; ++round) {
    std::string bytes = whole;
    for (unsigned i = 0; i <= generator() % 4; ++i) {
      bytes[generator() % bytes.size()] = static_cast<char>(generator());
    }
    write_bytes(file("bad"), bytes);
    try {
      check_surface(read_surface(file("bad")));
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
    }
  }
}

TEST_P(EachFormat, GarbageIsRefused) {
  std::mt19937 generator(2);
  for (const std::size_t size : {0, 1, 10, 83, 84, 1000, 50'000}) {
    std::string bytes(size, '\0');
    for (char& c : bytes) c = static_cast<char>(generator());
    write_bytes(file(), bytes);
    EXPECT_REFUSED(read_surface(file()), HasSubstr(file().string())) << size;
  }
}

TEST_P(EachFormat, AMissingFileOrADirectoryIsRefused) {
  EXPECT_REFUSED(read_surface(file("missing")), HasSubstr("missing"));
  std::filesystem::create_directory(file());
  EXPECT_REFUSED(read_surface(file()), HasSubstr(file().string()));
  EXPECT_REFUSED(write_surface(file(), cube()), HasSubstr("cannot be written"));
  EXPECT_REFUSED(write_surface(folder_ / "no/folder.stl", cube()), HasSubstr("cannot be written"));
}

TEST(SurfaceFiles, OtherExtensionsAreRefusedByName) {
  const TempFolder folder;
  const std::string written = ".stl .ply .obj .vtp .3mf .amf";
  EXPECT_REFUSED(write_surface(folder / "a.off", cube()),
                 testing::AllOf(HasSubstr("off"), HasSubstr(written)));
  EXPECT_REFUSED(write_surface(folder / "a.vtk", cube()), HasSubstr(written));
  EXPECT_REFUSED(write_surface(folder / "a.stl.gz", cube()), HasSubstr(written));
  EXPECT_REFUSED(write_surface(folder / "a", cube()), HasSubstr("no extension"));
  EXPECT_REFUSED(read_surface(folder / "a.off"), HasSubstr(written + " .vtk"));
  EXPECT_REFUSED(read_surface(folder / "a.gz"), HasSubstr(written + " .vtk"));
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace mesamis
