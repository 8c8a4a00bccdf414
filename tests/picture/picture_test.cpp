// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/picture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "support/png_image.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// Where the pixels of one kind lie: bounds and centre of gravity, above the labels' strip and
/// left of the colour bar where there is one.
struct Ink {
  int count = 0;
  std::array<double, 2> lo{1e9, 1e9}, hi{-1, -1}, center{0, 0};

  template <class IsInk>
  Ink(const Image& image, IsInk is_ink, double share_of_width = 0.87) {
    for (int y = image.size()[1] / 10; y < image.size()[1]; ++y) {
      for (int x = 0; x < share_of_width * image.size()[0]; ++x) {
        if (is_ink(image.at(x, y))) add({double(x), double(y)});
      }
    }
    for (double& c : center) c /= count;
  }
  std::array<double, 2> middle() const { return {(lo[0] + hi[0]) / 2, (lo[1] + hi[1]) / 2}; }

 private:
  void add(const std::array<double, 2>& p) {
    ++count;
    for (std::size_t i = 0; i < 2; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
      center[i] += p[i];
    }
  }
};

constexpr auto kDrawn = [](const Rgb& c) { return !c.is_white(); };

void add_octahedron(TriMesh& surface, const Vec3& center, double radius) {
  const auto first = static_cast<Index>(surface.points.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {radius, -radius}) {
      Vec3 p = center;
      p[axis] += side;
      surface.points.push_back(p);
    }
  }
  for (const Triangle& t : std::array<Triangle, 8>{{{0, 2, 4},
                                                    {2, 1, 4},
                                                    {1, 3, 4},
                                                    {3, 0, 4},
                                                    {2, 0, 5},
                                                    {1, 2, 5},
                                                    {3, 1, 5},
                                                    {0, 3, 5}}}) {
    surface.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

PictureOptions small(const std::string& view = "oblique") {
  PictureOptions options;
  options.pixels = {400, 320};
  options.view = view;
  return options;
}

TEST(Picture, FillsTheFrameAndKeepsTheShape) {
  const TempFolder folder;
  TriMesh surface;
  add_octahedron(surface, {100, 200, -300}, 20);
  draw_surface(folder / "a.png", surface, small("front"));
  EXPECT_EQ(read_bytes(folder / "a.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(folder.file_count(), 1);
  const Image image(folder / "a.png");
  EXPECT_EQ(image.size(), (std::array<int, 2>{400, 320}));
  const Ink ink(image, kDrawn, 1);
  const double width = ink.hi[0] - ink.lo[0], height = ink.hi[1] - ink.lo[1];
  EXPECT_NEAR(width, height, 4);
  EXPECT_GT(height, 0.8 * 320);
  EXPECT_NEAR(ink.count, width * height / 2, 0.05 * width * height);
  EXPECT_NEAR(ink.middle()[0], 200, 3);
}

/// A large body with a small satellite in one direction: the body's centre of gravity tells on
/// which side of the picture the satellite is.
std::array<double, 2> side_of_satellite(const TempFolder& folder, const std::string& view,
                                        const Vec3& direction) {
  TriMesh surface;
  add_octahedron(surface, {0, 0, 0}, 10);
  add_octahedron(surface, 40 * direction, 2);
  draw_surface(folder / "a.png", surface, small(view));
  const Ink ink(Image(folder / "a.png"), kDrawn, 1);
  return {ink.middle()[0] - ink.center[0], ink.middle()[1] - ink.center[1]};
}

TEST(Picture, ViewsAreAnatomical) {
  const TempFolder folder;
  const Vec3 left{1, 0, 0}, back{0, 1, 0}, head{0, 0, 1};
  struct View {
    const char* name;
    Vec3 on_the_right, above;
  };
  for (const View& v :
       {View{"front", left, head}, View{"back", -left, head}, View{"left", back, head},
        View{"right", -back, head}, View{"top", -left, -back}, View{"bottom", left, -back}}) {
    EXPECT_GT(side_of_satellite(folder, v.name, v.on_the_right)[0], 20) << v.name;
    EXPECT_GT(side_of_satellite(folder, v.name, v.above)[1], 20) << v.name;
  }
}

MeshWithArrays box_with_heights() {
  MeshWithArrays m{box_mesh({{0, 0, 0}, {10, 10, 10}}, {10, 10, 10}), {}, {{"height", 1, {}}}};
  m.point_arrays = {{"x", 1, {}}, {"metric", 6, std::vector<double>(6 * m.mesh.points.size(), 1)}};
  for (const Vec3& p : m.mesh.points) m.point_arrays[0].values.push_back(p.x);
  for (const Cell& c : m.mesh.cells) {
    double sum = 0;
    for (const Index i : c) sum += m.mesh.points[static_cast<std::size_t>(i)].z;
    m.cell_arrays[0].values.push_back(sum / 4);
  }
  return m;
}

TEST(Picture, ClipTakesAwayWholeCellsOnTheViewersSide) {
  const TempFolder folder;
  const MeshWithArrays mesh = box_with_heights();
  const auto center = [&](const std::string& view, std::optional<Clip> clip) {
    PictureOptions options = small(view);
    options.color = "height";
    options.clip = clip;
    draw_mesh(folder / "a.png", mesh, options);
    const Ink ink(Image(folder / "a.png"), kDrawn);
    return Image(folder / "a.png").at(int(ink.middle()[0]), int(ink.middle()[1]));
  };
  const Rgb top = center("top", {}), bottom = center("bottom", {});
  EXPECT_GT(top.r, top.b + 50) << "yellow";
  EXPECT_GT(bottom.b, bottom.g + 20) << "violet";
  for (const auto* view : {"top", "bottom"}) {
    const Rgb cut = center(view, Clip{2, 5});
    EXPECT_GT(cut.g, cut.r + 40) << view << ": green";
  }
}

TEST(Picture, ColoursByPointArraysWithABar) {
  const TempFolder folder;
  PictureOptions options = small("front");
  options.color = "x";
  draw_mesh(folder / "a.png", box_with_heights(), options);
  const Image image(folder / "a.png");
  const Ink box(image, kDrawn);
  const int y = int(box.middle()[1]);
  const Rgb low = image.at(int(box.lo[0]) + 5, y), high = image.at(int(box.hi[0]) - 5, y);
  EXPECT_GT(low.b, low.g);
  EXPECT_GT(high.r, high.b + 50);
  int bar = 0;
  for (int row = 0; row < 320; ++row) bar += kDrawn(image.at(366, row));
  EXPECT_NEAR(bar, 0.62 * 320, 20);
}

TEST(Picture, ColoursSurfacesByValuesOfTheirPoints) {
  const TempFolder folder;
  TriMesh surface;
  add_octahedron(surface, {0, 0, 0}, 10);
  std::vector<double> heights;
  for (const Vec3& p : surface.points) heights.push_back(p.z);
  PictureOptions options = small("front");
  options.color = "height";
  for (const bool edges : {false, true}) {
    options.edges = edges;
    draw_surface(folder / "a.png", surface, options, heights);
    const Image image(folder / "a.png");
    const Ink body(image, kDrawn);
    const int x = int(body.middle()[0]) + 3;
    const Rgb low = image.at(x, int(body.lo[1]) + 12), high = image.at(x, int(body.hi[1]) - 12);
    EXPECT_GT(low.b, low.g) << "violet";
    EXPECT_GT(high.r, high.b + 50) << "yellow";
  }
  EXPECT_REFUSED(draw_surface(folder / "b.png", surface, options, std::vector<double>(3)),
                 HasSubstr("found 3 values"));
}

/// Red, green and blue from left to right, as seen from the front.
std::vector<NamedSurface> three_octahedra() {
  std::vector<NamedSurface> objects{
      {"a", {230, 20, 20}, 1, {}}, {"b", {20, 200, 20}, 2, {}}, {"c", {20, 20, 230}, 3, {}}};
  for (std::size_t i = 0; i < 3; ++i) {
    add_octahedron(objects[i].surface, {25.0 * static_cast<double>(i), 0, 0}, 10);
  }
  return objects;
}

TEST(Picture, ObjectsAreShownInTheirColours) {
  const TempFolder folder;
  PictureOptions options = small("front");
  for (const bool edges : {false, true}) {
    options.edges = edges;
    draw_objects(folder / "a.png", three_octahedra(), options);
    const Image image(folder / "a.png");
    const Ink red(
        image, [](const Rgb& c) { return c.r > c.g + 60 && c.r > c.b + 60; }, 1);
    const Ink green(
        image, [](const Rgb& c) { return c.g > c.r + 60 && c.g > c.b + 60; }, 1);
    const Ink blue(
        image, [](const Rgb& c) { return c.b > c.r + 60 && c.b > c.g + 60; }, 1);
    EXPECT_GT(std::min({red.count, green.count, blue.count}), 500);
    EXPECT_LT(red.hi[0], green.lo[0]);
    EXPECT_LT(green.hi[0], blue.lo[0]);
  }
}

TEST(Picture, ClipHidesWholeObjectsToo) {
  const TempFolder folder;
  PictureOptions options = small("left");  // seen from +x, where the blue one is
  const auto count_blue = [&] {
    draw_objects(folder / "a.png", three_octahedra(), options);
    return Ink(
               Image(folder / "a.png"), [](const Rgb& c) { return c.b > c.r + 60; }, 1)
        .count;
  };
  EXPECT_GT(count_blue(), 500);
  options.clip = Clip{0, 38};
  EXPECT_EQ(count_blue(), 0);
  options.clip = Clip{0, -11};
  EXPECT_REFUSED(count_blue(), HasSubstr("nothing is left"));
}

TEST(PictureObjects, AreRefusedWhereThereIsNothingToDraw) {
  const TempFolder folder;
  EXPECT_REFUSED(draw_objects(folder / "a.png", {}), HasSubstr("nothing to draw"));
  std::vector<NamedSurface> objects = three_octahedra();
  objects[1].surface.points[2].y = std::numeric_limits<double>::infinity();
  EXPECT_REFUSED(draw_objects(folder / "a.png", objects), HasSubstr("not finite"));
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(Picture, EdgesShowTheTriangles) {
  const TempFolder folder;
  PictureOptions options = small("front");
  const MeshWithArrays mesh = box_with_heights();
  const auto dark = [&] {
    draw_mesh(folder / "a.png", mesh, options);
    return Ink(Image(folder / "a.png"), [](const Rgb& c) { return c.r < 110; }).count;
  };
  const int without = dark();
  options.edges = true;
  EXPECT_GT(dark(), without + 1000);
}

/// A bright block left, anterior and superior of the centre, however the grid is stored.
Volume volume_with_block(const Mat3& direction) {
  Volume v;
  v.size = {24, 20, 16};
  v.spacing = {1, 2, 1.5};
  v.direction = direction;
  v.origin = Vec3{5, 6, 7} - direction * (0.5 * v.box().hi);
  for (Index k = 0; k < v.size[2]; ++k) {
    for (Index j = 0; j < v.size[1]; ++j) {
      for (Index i = 0; i < v.size[0]; ++i) {
        const Vec3 p = v.to_world({i * v.spacing.x, j * v.spacing.y, k * v.spacing.z});
        v.samples.push_back(p.x > 6 && p.y < 5 && p.z > 8 ? 1000.0f : 0.0f);
      }
    }
  }
  return v;
}

TEST(Picture, SlicesAreOrientedByTheWorldNotByTheGrid) {
  const TempFolder folder;
  const Mat3 identity, turned{{Vec3{-1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 1, 0}}},
      cyclic{{Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}};
  struct Cut {
    Clip clip;
    bool right, above;  // where the block lies on the page
  };
  for (const Mat3& direction : {identity, turned, cyclic}) {
    const Volume volume = volume_with_block(direction);
    for (const Cut& cut :
         {Cut{{0, 9}, false, true}, Cut{{1, 2}, true, true}, Cut{{2, 10}, true, true}}) {
      PictureOptions options = small();
      options.clip = cut.clip;
      draw_slice(folder / "a.png", volume, nullptr, options);
      const Image image(folder / "a.png");
      const Ink slice(image, [](const Rgb& c) { return c.r == c.g && c.g == c.b && c.r < 240; });
      const Ink block(image, [](const Rgb& c) { return c.r == 255 && c.b == 255; });
      const Ink black(image, [](const Rgb& c) { return c.r + c.g + c.b == 0; });
      ASSERT_GT(slice.count, 1000);
      // The dark rest leans away from the corner that the bright block fills.
      EXPECT_EQ(black.center[0] < black.middle()[0], cut.right) << cut.clip.axis;
      EXPECT_EQ(black.center[1] < black.middle()[1], cut.above) << cut.clip.axis;
    }
    PictureOptions empty = small();
    empty.clip = Clip{2, 4};
    draw_slice(folder / "b.png", volume, nullptr, empty);
    const Ink dark(Image(folder / "b.png"), [](const Rgb& c) { return c.r + c.g + c.b == 0; });
    EXPECT_NEAR(dark.center[0], dark.middle()[0], 1) << "below the block all is dark";
  }
}

TEST(Picture, OutlineLiesWhereTheSurfaceIs) {
  const TempFolder folder;
  const Volume volume = volume_with_block({});  // 23 mm wide, 38 mm deep
  TriMesh surface;
  add_octahedron(surface, {5, 6, 12}, 9);
  PictureOptions options = small();
  options.clip = Clip{2, 9.25};  // a slice 2.75 mm below the octahedron's centre: a square's tips
  draw_slice(folder / "a.png", volume, &surface, options);
  const Image image(folder / "a.png");
  const Ink frame(image, [](const Rgb& c) { return c.r + c.g + c.b < 30 || c.is_orange(); });
  const Ink line(image, [](const Rgb& c) { return c.is_orange(); });
  const double mm = 38 / (frame.hi[1] - frame.lo[1]);
  EXPECT_NEAR((frame.hi[0] - frame.lo[0]) * mm, 23, 0.5);
  EXPECT_NEAR((line.hi[0] - line.lo[0]) * mm, 12.5, 0.6);
  EXPECT_NEAR((line.hi[1] - line.lo[1]) * mm, 12.5, 0.6);
  EXPECT_NEAR((line.middle()[0] - frame.middle()[0]) * mm, 0, 0.3);
}

/// Beside the program: 16 million pixels took 0.15 GB, a surface of 589 000 triangles 0.15 GB.
TEST(Picture, TheMemoryOfADrawingIsAboveWhatWasMeasured) {
  PictureOptions options;
  EXPECT_GT(drawing_memory(589'000, options), 0.15e9);
  EXPECT_LT(drawing_memory(589'000, options), 1.7 * 0.15e9);
  options.pixels = {4000, 4000};
  EXPECT_GT(drawing_memory(4, options), 0.153e9);
  EXPECT_LT(drawing_memory(4, options), 1.6 * 0.153e9);
}

TEST(Picture, RefusesPlainlyAndLeavesNothingBehind) {
  const TempFolder folder;
  const MeshWithArrays mesh = box_with_heights();
  TriMesh surface;
  EXPECT_REFUSED(draw_surface(folder / "a.png", surface), HasSubstr("nothing to draw"));
  add_octahedron(surface, {0, 0, 0}, 1);
  EXPECT_REFUSED(draw_surface(folder / "a.png", surface, small("up")), HasSubstr("no view 'up'"));
  PictureOptions options = small();
  options.color = "y";
  EXPECT_REFUSED(draw_mesh(folder / "a.png", mesh, options), HasSubstr("there is x, height"));
  EXPECT_REFUSED(draw_surface(folder / "a.png", surface, options), HasSubstr("no array 'y'"));
  options.color = "metric";
  EXPECT_REFUSED(draw_mesh(folder / "a.png", mesh, options), HasSubstr("6 components"));
  options.color = "";
  options.clip = Clip{0, -1};
  EXPECT_REFUSED(draw_mesh(folder / "a.png", mesh, options), HasSubstr("x = -1 mm"));
  options.clip = Clip{2, 100};
  EXPECT_REFUSED(draw_slice(folder / "a.png", volume_with_block({}), nullptr, options),
                 HasSubstr("no slice at z"));
  options.clip = {};
  options.pixels = {1, 100000};
  EXPECT_REFUSED(draw_surface(folder / "a.png", surface, options), HasSubstr("1 x 100000"));
  surface.points[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(draw_surface(folder / "a.png", surface), HasSubstr("not finite"));
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(Picture, RefusesAFolderThatIsNotThere) {
  const TempFolder folder;
  TriMesh surface;
  add_octahedron(surface, {0, 0, 0}, 1);
  EXPECT_THROW(draw_surface(folder / "none/a.png", surface, small()), InputError);
}

TEST(Picture, PrintsNothingOnStdout) {
  const TempFolder folder;
  TriMesh surface;
  add_octahedron(surface, {0, 0, 0}, 1);
  testing::internal::CaptureStdout();
  draw_surface(folder / "a.png", surface, small());
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace mesamis
