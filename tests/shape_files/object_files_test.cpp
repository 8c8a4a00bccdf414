// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/object_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <set>

#include "mesamis/files/refuse.h"
#include "mesamis/shape_files/object_formats.h"
#include "shape_files/object_example.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

double largest_difference(const TriMesh& a, const TriMesh& b) {
  if (a.triangles != b.triangles || a.points.size() != b.points.size()) return 1e300;
  double largest = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    largest = std::max(largest, norm(a.points[i] - b.points[i]));
  }
  return largest;
}

class EachObjectFormat : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path file(const std::string& name = "a") const {
    return folder_ / (name + GetParam());
  }
  bool is(const char* extension) const { return std::strcmp(GetParam(), extension) == 0; }
  double tolerance() const { return is(".3mf") ? 2e-5 : 0; }  // single precision at 100 mm
  int files_written() const { return is(".obj") ? 2 : 1; }
  TempFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Objects, EachObjectFormat, testing::Values(".3mf", ".vtp", ".obj", ".amf"),
                         [](const auto& tested) { return std::string(tested.param + 1); });

TEST_P(EachObjectFormat, GivesBackNamesColoursLabelsAndGeometry) {
  const std::vector<NamedSurface> objects = three_objects();
  write_objects(file(), objects);
  EXPECT_EQ(folder_.file_count(), files_written());
  const ObjectFile read = read_object_file(file());
  EXPECT_EQ(read.frame, Frame::kLps);
  EXPECT_TRUE(read.coloured);
  ASSERT_EQ(read.objects.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.objects[i].name, objects[i].name);
    EXPECT_EQ(read.objects[i].colour, objects[i].colour);
    EXPECT_EQ(read.objects[i].label, objects[i].label);
    EXPECT_LE(largest_difference(read.objects[i].surface, objects[i].surface), tolerance());
  }
}

TEST_P(EachObjectFormat, IsOneSurfaceForReadSurface) {
  const std::vector<NamedSurface> objects = three_objects();
  write_objects(file(), objects);
  TriMesh expected;
  for (const NamedSurface& object : objects) expected = joined(expected, object.surface);
  const TriMesh read = read_surface(file());
  EXPECT_LE(largest_difference(read, expected), tolerance());
  EXPECT_EQ(check_surface(read).components, 3);
}

/// The file's coordinates are rounded, but those of both cubes alike.
TEST_P(EachObjectFormat, NeighboursShareTheirBoundary) {
  std::vector<NamedSurface> objects = three_objects();
  objects[1].surface.points[0] = objects[0].surface.points[1];
  objects[1].surface.points[2] = objects[0].surface.points[3];
  objects[1].surface.points[4] = objects[0].surface.points[5];
  objects[1].surface.points[6] = objects[0].surface.points[7];
  for (const Frame frame : {Frame::kLps, Frame::kRas}) {
    write_objects(file(), objects, {.frame = frame});
    const std::vector<NamedSurface> read = read_objects(file());
    for (const std::size_t p : {0u, 2u, 4u, 6u}) {
      EXPECT_EQ(read[1].surface.points[p], read[0].surface.points[p + 1]);
    }
    for (const NamedSurface& object : read) {
      const SurfaceCheck check = check_surface(object.surface);
      EXPECT_TRUE(check.closed() && check.manifold() && check.volume > 0);
    }
  }
}

TEST_P(EachObjectFormat, StatesItsFrameAndTurns) {
  const std::vector<NamedSurface> objects = three_objects();
  for (const std::optional<Frame> frame :
       {std::optional(Frame::kLps), std::optional(Frame::kRas), std::optional<Frame>()}) {
    write_objects(file(), objects, {.frame = frame});
    ObjectFile read = read_object_file(file());
    EXPECT_EQ(read.frame, frame);
    const Vec3 first = read.objects[2].surface.points[7];
    EXPECT_GT(frame == Frame::kRas ? -first.x : first.x, 0);
    const std::vector<NamedSurface> lps = in_lps(std::move(read));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(largest_difference(lps[i].surface, objects[i].surface), tolerance());
    }
  }
}

TEST_P(EachObjectFormat, NamesAreOneLineAndNeverEmpty) {
  std::vector<NamedSurface> objects = three_objects();
  objects[0].name = "two\nlines";
  objects[1].name = " ";
  objects[2].name = "two\nlines";  // names need not differ
  write_objects(file(), objects, {.name = "all\nof them"});
  const std::vector<NamedSurface> read = read_objects(file());
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(read[0].name, "two lines");
  EXPECT_EQ(read[1].name, "object 2");
  EXPECT_EQ(read[2].name, "two lines");
  EXPECT_EQ(read[2].colour, objects[2].colour);
}

TEST_P(EachObjectFormat, OfOneObjectGivesOne) {
  const TriMesh surface = cube({1, 2, 3}, 4);
  write_objects(file(), std::vector<NamedSurface>{{"one", {9, 8, 7}, 5, surface}});
  std::vector<NamedSurface> read = read_objects(file());
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, "one");
  EXPECT_EQ(read[0].label, 5);
  EXPECT_EQ(read[0].colour, (std::array<std::uint8_t, 3>{9, 8, 7}));
  EXPECT_LE(largest_difference(read[0].surface, surface), 1e-6);

  write_surface(file("b"), surface, {.name = "plain"});
  read = read_objects(file("b"));
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, "plain");
  EXPECT_EQ(read[0].colour, NamedSurface().colour);
  EXPECT_LE(largest_difference(read[0].surface, surface), 1e-6);
  EXPECT_FALSE(read_object_file(file("b")).coloured);
}

TEST_P(EachObjectFormat, WritesTheSameBytesAgainAndReadsGzipAndUpperCase) {
  write_objects(file("one"), three_objects());
  const std::string bytes = read_bytes(file("one"));
  write_objects(file("one"), three_objects());
  EXPECT_EQ(read_bytes(file("one")), bytes);
  write_bytes(folder_ / (std::string("b") + GetParam() + ".gz"), packed(bytes));
  EXPECT_EQ(read_objects(folder_ / (std::string("b") + GetParam() + ".gz")).size(), 3u);
  std::string upper = GetParam();
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  write_objects(folder_ / ("C" + upper), three_objects());
  EXPECT_EQ(read_objects(folder_ / ("C" + upper)).size(), 3u);
}

TEST_P(EachObjectFormat, RefusesWhatItCannotWriteAndLeavesNothing) {
  EXPECT_REFUSED(write_objects(file(), {}), HasSubstr("at least one object"));
  std::vector<NamedSurface> objects = three_objects();
  objects[1].label = 7;
  EXPECT_REFUSED(write_objects(file(), objects), HasSubstr("two have the label 7"));
  objects[1].label = -1;
  EXPECT_REFUSED(write_objects(file(), objects), HasSubstr("-1 is negative"));
  objects = three_objects();
  objects[2].surface.triangles.clear();
  EXPECT_REFUSED(write_objects(file(), objects), HasSubstr("\"sacrum\""));
  objects = three_objects();
  objects[2].surface.points[3].y = std::nan("");
  EXPECT_REFUSED(write_objects(file(), objects), HasSubstr("point 3 is not finite"));
  EXPECT_EQ(folder_.file_count(), 0);
  std::filesystem::create_directory(file());
  EXPECT_REFUSED(write_objects(file(), three_objects()), HasSubstr("cannot be written"));
  EXPECT_EQ(folder_.file_count(), 1);
}

TEST_P(EachObjectFormat, CutOffOrDamagedIsRefusedInOneLineOrStillObjects) {
  write_objects(file(), three_objects());
  const std::string whole = read_bytes(file());
  std::mt19937 generator(3);
  int refused = 0;
  for (int round = 0; round < 600; ++round) {
    std::string bytes = whole;
    if (round % 2 == 0) {
      bytes.resize(whole.size() * static_cast<std::size_t>(round) / 600);
    } else {
      for (unsigned i = 0; i <= generator() % 4; ++i) {
        bytes[generator() % bytes.size()] = static_cast<char>(generator());
      }
    }
    write_bytes(file("bad"), bytes);
    try {
      for (const NamedSurface& object : read_objects(file("bad"))) {
        EXPECT_FALSE(object.surface.triangles.empty());
        EXPECT_FALSE(object.name.empty());
        check_surface(object.surface);
      }
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(ObjectFiles, OtherExtensionsHoldOneObjectAndAreNotWritten) {
  const TempFolder folder;
  EXPECT_EQ(written_object_formats(),
            (std::vector<std::string>{".3mf", ".vtp", ".obj", ".amf", ".glb"}));
  for (const char* name : {"a.stl", "a.ply", "a.vtk", "a", "a.vtp.gz"}) {
    EXPECT_REFUSED(write_objects(folder / name, three_objects()), HasSubstr(".3mf .vtp .obj .amf"));
  }
  for (const char* name : {"a.stl", "a.ply"}) {
    write_surface(folder / name, joined(cube(), cube({5, 5, 5})), {.frame = Frame::kRas});
    const ObjectFile read = read_object_file(folder / name);
    ASSERT_EQ(read.objects.size(), 1u);
    EXPECT_EQ(read.objects[0].surface.triangles.size(), 24u);
    EXPECT_EQ(read.objects[0].name, "object 1");
    EXPECT_EQ(read.frame, Frame::kRas);
    EXPECT_FALSE(read.coloured);
  }
  EXPECT_REFUSED(read_objects(folder / "a.off"), HasSubstr(".vtk"));
}

TEST(ObjectPath, HasASafeName) {
  const auto name_for = [](const std::string& name) {
    return object_path("some/out.stl", name).string();
  };
  EXPECT_EQ(name_for("femur"), "some/out-femur.stl");
  EXPECT_EQ(name_for("Left hip-2_b.c"), "some/out-Left_hip-2_b.c.stl");
  EXPECT_EQ(name_for("../../etc/x"), "some/out-.._.._etc_x.stl");
  EXPECT_EQ(name_for("H\xc3\xbc"
                     "fte"),
            "some/out-H_fte.stl");
  EXPECT_EQ(name_for("a\n\"b\"*?"), "some/out-a__b___.stl");
  for (const char* none : {"", "...", "\xe9\xaa\xa8", " - "}) {
    EXPECT_EQ(name_for(none), "some/out-object.stl");
  }
  EXPECT_EQ(name_for(std::string(1000, 'x')).size(), std::strlen("some/out-.stl") + 100);
}

std::vector<NamedSurface> named(const std::vector<std::string>& names) {
  std::vector<NamedSurface> objects;
  for (const std::string& name : names) {
    objects.push_back({name, {}, static_cast<Index>(objects.size() + 1), {}});
  }
  return objects;
}

TEST(ObjectPaths, DifferEvenWhereCaseDoesNotCount) {
  const auto paths =
      object_paths("o.stl", named({"rib", "Rib", "skull", "r\xc3\xa9", "r\xc3\xa0"}));
  EXPECT_EQ(paths, (std::vector<std::filesystem::path>{"o-rib-1.stl", "o-Rib-2.stl", "o-skull.stl",
                                                       "o-r_-4.stl", "o-r_-5.stl"}));
  // Names that look like those with a label, and long ones.
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"a-2", "a", "a", "A-3", "a-2-1", "a-2-2"},
        {std::string(200, 'x'), std::string(300, 'x'), "", " ", "object", "object-3"}}) {
    std::set<std::string> seen;
    for (const auto& path : object_paths("o.stl", named(names))) {
      EXPECT_TRUE(seen.insert(lower(path.string())).second) << path;
    }
    EXPECT_EQ(seen.size(), names.size());
  }
  std::vector<NamedSurface> same = named({"a", "b"});
  same[1].label = 1;
  EXPECT_REFUSED(object_paths("o.stl", same), HasSubstr("two have the label 1"));
}

/// One file per object: each stays as it is, and neighbours share their boundary.
TEST(JoinedObjects, KeepTheirOwnPointsAndKnowTheirTriangles) {
  const std::vector<NamedSurface> objects = three_objects();
  const JoinedObjects all = joined(objects);
  ASSERT_EQ(all.object_of.size(), all.surface.triangles.size());
  std::size_t point = 0, triangle = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const TriMesh& surface = objects[i].surface;
    for (const Triangle& t : surface.triangles) {
      EXPECT_EQ(all.object_of[triangle], static_cast<Index>(i));
      for (std::size_t c = 0; c < 3; ++c) {
        const auto corner = static_cast<std::size_t>(all.surface.triangles[triangle][c]);
        EXPECT_EQ(corner, point + static_cast<std::size_t>(t[c]));
        EXPECT_EQ(all.surface.points[corner], surface.points[static_cast<std::size_t>(t[c])]);
      }
      ++triangle;
    }
    point += surface.points.size();
  }
  EXPECT_EQ(all.surface.points.size(), point);
  EXPECT_TRUE(joined(std::span<const NamedSurface>{}).object_of.empty());
}

TEST(RoundedTogether, KeepsStlFilesOfNeighboursInContact) {
  const TempFolder folder;
  std::vector<NamedSurface> objects = three_objects();
  for (NamedSurface& object : objects) {
    for (Vec3& p : object.surface.points) p = p + Vec3{1e5, 0, 0};
  }
  objects[1].surface.points[0] = objects[0].surface.points[1];
  const std::vector<NamedSurface> rounded = rounded_together(objects);
  EXPECT_EQ(rounded[1].surface.points[0], rounded[0].surface.points[1]);
  EXPECT_EQ(rounded[2].name, "sacrum");
  const auto paths = object_paths(folder / "o.stl", rounded);
  for (std::size_t i = 0; i < 3; ++i) {
    write_surface(paths[i], rounded[i].surface);
    const TriMesh read = read_surface(paths[i]);
    ASSERT_EQ(read.triangles.size(), rounded[i].surface.triangles.size());
    for (std::size_t t = 0; t < read.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(read.points[read.triangles[t][c]],
                  rounded[i].surface.points[rounded[i].surface.triangles[t][c]]);
      }
    }
  }
}

TEST(ObjectNumbers, ArePlainLabels) {
  EXPECT_EQ(object_label_in("12"), 12);
  EXPECT_EQ(object_label_in("0"), 0);
  for (const char* none : {"", "-1", "1.5", "x", "99999999999", "1 2"}) {
    EXPECT_EQ(object_label_in(none), std::nullopt) << none;
  }
}

TEST(Channel, OfAShareIsAByte) {
  EXPECT_EQ(channel_of(0.2), 51);
  EXPECT_EQ(channel_of(7), 255);
  EXPECT_EQ(channel_of(-1), 0);
  EXPECT_EQ(channel_of(std::nan("")), 0);
  for (int byte = 0; byte < 256; ++byte) EXPECT_EQ(channel_of(byte / 255.0), byte);
}

}  // namespace
}  // namespace mesamis
