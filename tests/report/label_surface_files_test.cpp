// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/label_surface_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/shapes.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::ElementsAre;

Segment segment(const std::string& name, Index label, Index layer = 0) {
  return {name, label, layer, {1, 2, 3}};
}

LabelResult two_cubes() {
  LabelResult result;
  for (const auto& s : {segment("left hip", 3), segment("femur", 4)}) {
    LabelledObject object;
    object.segment = s;
    object.surface = cube();
    object.expected_error.assign(object.surface.points.size(), 0.25);
    result.objects.push_back(object);
  }
  return result;
}

TEST(LabelSurfaceFiles, SegmentsKeepTheirLabelsUnlessLayersShareThem) {
  const std::vector<Segment> apart{segment("a", 7), segment("b", 2)};
  const std::vector<Segment> shared{segment("a", 7), segment("b", 7, 1)};
  EXPECT_EQ(named_segments(apart)[0].label, 7);
  EXPECT_EQ(named_segments(apart)[1].label, 2);
  EXPECT_EQ(named_segments(shared)[0].label, 1);
  EXPECT_EQ(named_segments(shared)[1].label, 2);
  EXPECT_EQ(named_surfaces(two_cubes())[1].name, "femur");
  EXPECT_EQ(named_surfaces(two_cubes())[1].surface.points, cube().points);
}

TEST(LabelSurfaceFiles, PathsNameEachObjectOrAll) {
  const auto objects = named_surfaces(two_cubes());
  EXPECT_TRUE(holds_all("all.3mf"));
  EXPECT_TRUE(holds_all("all.VTP"));
  EXPECT_FALSE(holds_all("all.stl"));
  EXPECT_FALSE(holds_all("{label}.vtp"));
  EXPECT_TRUE(names_each("{label}.vtp"));
  EXPECT_FALSE(names_each("{label}/all.vtp"));
  EXPECT_THAT(label_paths("out/bone_{label}.stl", objects, true),
              ElementsAre("out/bone_left_hip.stl", "out/bone_femur.stl"));
  EXPECT_THAT(label_paths("out.ply", objects, true),
              ElementsAre("out-left_hip.ply", "out-femur.ply"));
  EXPECT_THAT(label_paths("out.ply", std::span(objects).first(1), false), ElementsAre("out.ply"));
}

TEST(LabelSurfaceFiles, WritesNamedSurfacesInOneOrOneOfEach) {
  const TempFolder folder;
  const auto objects = named_surfaces(two_cubes());
  write_named_surfaces(folder / "all.amf", objects, {.frame = std::nullopt, .name = "both"});
  EXPECT_EQ(read_object_file(folder / "all.amf").objects[0].name, "left hip");
  EXPECT_EQ(read_object_file(folder / "all.amf").frame, std::nullopt);
  write_named_surfaces(folder / "x.stl", objects, {.frame = Frame::kRas});
  write_named_surfaces(folder / "{label}.vtp", objects, {});
  EXPECT_EQ(read_surface_file(folder / "x-femur.stl").frame, Frame::kRas);
  EXPECT_EQ(read_surface(folder / "left_hip.vtp").triangles.size(), cube().triangles.size());
}

TEST(LabelSurfaceFiles, WritesAllInOneOrOneOfEach) {
  const TempFolder folder;
  const std::vector<OutputPath> paths{folder / "all.vtp", folder / "{label}.ply", folder / "x.stl"};
  write_label_surfaces(paths, two_cubes(), {.error = true}, true);
  EXPECT_EQ(folder.file_count(), 5);
  const auto all = read_objects(folder / "all.vtp");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "left hip");
  EXPECT_EQ(all[1].label, 4);
  EXPECT_THAT(read_point_array(folder / "femur.ply", "expected_error"),
              testing::Each(testing::DoubleEq(0.25)));
  EXPECT_EQ(read_surface(folder / "x-femur.stl").triangles.size(), cube().triangles.size());
}

}  // namespace
}  // namespace mesamis
