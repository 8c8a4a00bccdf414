// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/face_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "mesamis/base/error.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using Kind = FaceQuery::Kind;

constexpr Box kBox{{0, 0, 0}, {2, 3, 4}};

/// A box of bricks of side 1; below z = 2 it is object 1, above object 2.
BodyMesh bricks() {
  BodyMesh body{box_mesh(kBox, {2, 3, 4}), {}, {}};
  for (const Cell& cell : body.mesh.cells) {
    double z = 0;
    for (const Index p : cell) z += body.mesh.points[p].z / 4;
    body.materials.push_back(z < 2 ? 1 : 2);
  }
  return body;
}

double area_of(const BodyMesh& body, const std::vector<CellFace>& faces) {
  double area = 0;
  for (const auto& [cell, face] : faces) {
    const auto p = cell_corners(body.mesh, body.mesh.cells[cell]);
    const auto& k = kCellFaces[static_cast<std::size_t>(face)];
    area += 0.5 * norm(cross(p[k[1]] - p[k[0]], p[k[2]] - p[k[0]]));
  }
  return area;
}

double area_of(const std::string& query) {
  const BodyMesh body = bricks();
  return area_of(body, find_faces(body, parse_face_query(query)));
}

TEST(FaceSets, EndsAreTheFacesThatLookAlongTheAxis) {
  EXPECT_DOUBLE_EQ(area_of("a=top:z,0.5mm"), 6);
  EXPECT_DOUBLE_EQ(area_of("a=bottom:z,0.5"), 6);
  EXPECT_DOUBLE_EQ(area_of("a=top:x,1mm"), 12);
  EXPECT_DOUBLE_EQ(area_of("a=bottom:y,2"), 8);
}

TEST(FaceSets, ABoxHoldsWholeFaces) {
  EXPECT_DOUBLE_EQ(area_of("a=box:-1,-1,-1,3,4,0.5"), 6);
  EXPECT_DOUBLE_EQ(area_of("a=box:-1,-1,-1,3,4,9"), 52);      // all of the boundary
  EXPECT_DOUBLE_EQ(area_of("a=box:-1,-1,-1,3,4,1"), 6 + 10);  // and the lowest bricks' sides
}

TEST(FaceSets, NormalsAreWithinTheAngle) {
  EXPECT_DOUBLE_EQ(area_of("a=normal:0,0,5,1"), 6);
  EXPECT_DOUBLE_EQ(area_of("a=normal:0,-2,0,10"), 8);
  EXPECT_DOUBLE_EQ(area_of("a=normal:1,1,0,46"), 12 + 8);
  EXPECT_DOUBLE_EQ(area_of("a=normal:1,0,0,180"), 52);
}

TEST(FaceSets, BetweenObjectsEachFaceCountsOnce) {
  const BodyMesh body = bricks();
  for (const char* text : {"a=between:1,2", "a=between:2,1"}) {
    const FaceQuery query = parse_face_query(text);
    const auto faces = find_faces(body, query);
    EXPECT_DOUBLE_EQ(area_of(body, faces), 6);
    for (const auto& [cell, face] : faces) EXPECT_EQ(body.materials[cell], query.objects[0]);
  }
}

Vec3 middle(const TetMesh& mesh, const Cell& cell) {
  const auto p = cell_corners(mesh, cell);
  return 0.25 * (p[0] + p[1] + p[2] + p[3]);
}

/// A box of bricks of side 1 without those that a box holds.
BodyMesh bricks_without(const Box& hole, const Box& box = {{0, 0, 0}, {5, 5, 5}}) {
  const Vec3 size = box.extent();
  const auto count = [](double x) { return static_cast<Index>(x); };
  BodyMesh body{box_mesh(box, {count(size.x), count(size.y), count(size.z)}), {}, {}};
  std::erase_if(body.mesh.cells,
                [&](const Cell& cell) { return hole.contains(middle(body.mesh, cell)); });
  body.materials.assign(body.mesh.cells.size(), 1);
  return body;
}

double area_of(const BodyMesh& body, const char* query) {
  return area_of(body, find_faces(body, parse_face_query(query)));
}

TEST(FaceSets, ACavityIsInnerAndTheRestIsOuter) {
  const BodyMesh body = bricks_without({{1, 2, 2}, {3, 3, 3}});
  EXPECT_DOUBLE_EQ(area_of(body, "a=outer"), 6 * 25);
  EXPECT_DOUBLE_EQ(area_of(body, "a=inner"), 10);
}

TEST(FaceSets, ADentIsOuter) {
  const BodyMesh body = bricks_without({{1, 2, 0}, {3, 3, 2}});
  EXPECT_DOUBLE_EQ(area_of(body, "a=outer"), 6 * 25 + 12);
  EXPECT_TRUE(find_faces(body, parse_face_query("a=inner")).empty());
}

/// A part that hangs in a cavity has an outer boundary of its own.
TEST(FaceSets, APartInACavityIsOuter) {
  BodyMesh body = bricks_without({{1, 1, 1}, {4, 4, 4}});
  const BodyMesh whole = bricks_without({{9, 9, 9}, {9, 9, 9}});
  for (const Cell& cell : whole.mesh.cells) {
    if (!Box{{2, 2, 2}, {3, 3, 3}}.contains(middle(whole.mesh, cell))) continue;
    body.mesh.cells.push_back(cell);
    body.materials.push_back(1);
  }
  EXPECT_DOUBLE_EQ(area_of(body, "a=outer"), 6 * 25 + 6);
  EXPECT_DOUBLE_EQ(area_of(body, "a=inner"), 6 * 9);
}

/// What two objects share is no boundary of the body.
TEST(FaceSets, ACoreThatFillsACavityLeavesNone) {
  BodyMesh body = bricks_without({{9, 9, 9}, {9, 9, 9}});
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c) {
    const Vec3 at = middle(body.mesh, body.mesh.cells[c]);
    if (Box{{1, 1, 1}, {4, 4, 4}}.contains(at)) body.materials[c] = 2;
  }
  EXPECT_DOUBLE_EQ(area_of(body, "a=outer"), 6 * 25);
  EXPECT_DOUBLE_EQ(area_of(body, "a=between:1,2"), 6 * 9);
  EXPECT_TRUE(find_faces(body, parse_face_query("a=inner")).empty());
}

TEST(FaceSets, WhatHoldsNoFaceIsRefused) {
  const BodyMesh body = bricks();
  EXPECT_TRUE(find_faces(body, parse_face_query("load=box:5,5,5,6,6,6")).empty());
  EXPECT_TRUE(find_faces(body, parse_face_query("load=between:1,3")).empty());
}

TEST(FaceSets, QueriesAreRead) {
  const FaceQuery top = parse_face_query("Upper_1=top:y,2.5mm");
  EXPECT_EQ(top.name, "Upper_1");
  EXPECT_EQ(top.kind, Kind::kTop);
  EXPECT_EQ(top.axis, 1);
  EXPECT_EQ(top.depth, 2.5);
  const FaceQuery normal = parse_face_query("n=normal:3,0,4,30");
  EXPECT_EQ(normal.kind, Kind::kNormal);
  EXPECT_DOUBLE_EQ(normal.normal.z, 0.8);
  EXPECT_EQ(normal.angle_deg, 30);
  const FaceQuery box = parse_face_query("b=box:-1,-2,-3,4mm,5,6");
  EXPECT_EQ(box.box, (Box{{-1, -2, -3}, {4, 5, 6}}));
  EXPECT_EQ(parse_face_query("o=outer").kind, Kind::kOuter);
  EXPECT_EQ(parse_face_query("i=inner").kind, Kind::kInner);
}

TEST(FaceSets, OtherTextIsRefusedInOneLine) {
  for (const char* text : {"",
                           "a",
                           "a=",
                           "=top:z,1",
                           "a=top",
                           "a=top:",
                           "a=top:z",
                           "a=top:w,1",
                           "a=top:z,0",
                           "a=top:z,-1",
                           "a=top:z,1,2",
                           "a=top:z\n,1",
                           "a=top:z,1cm",
                           "a=top:z,nan",
                           "a=top:z,inf",
                           "1a=top:z,1",
                           "a b=top:z,1",
                           "a=box:0,0,0,1,1",
                           "a=box:0,0,0,1,1,0",
                           "a=box:0,0,0,1,1,1,1",
                           "a=normal:0,0,0,5",
                           "a=normal:1,0,0,0",
                           "a=normal:1,0,0,181",
                           "a=between:1,1",
                           "a=between:0,1",
                           "a=between:1,256",
                           "a=between:1.5,2",
                           "a=side:z,1",
                           "a=outer:",
                           "a=inner:z,1",
                           "a=out",
                           "a b=inner",
                           "=outer",
                           "a:b=top:z,1"}) {
    EXPECT_REFUSED(parse_face_query(text), HasSubstr("set: expected NAME="));
  }
  EXPECT_REFUSED(parse_face_query(std::string(100000, 'a')), HasSubstr("found 'aaa"));
}

/// Half a turn around z: the same faces, whichever frame they are named in.
TEST(InLps, NamesTheSameFacesInEitherFrame) {
  const auto text_in = [](const char* ras, const char* lps) {
    const FaceQuery turned = in_lps(parse_face_query(ras), Frame::kRas);
    const FaceQuery query = parse_face_query(lps);
    EXPECT_EQ(turned.kind, query.kind) << ras;
    EXPECT_EQ(turned.axis, query.axis) << ras;
    EXPECT_EQ(norm(turned.box.lo - query.box.lo) + norm(turned.box.hi - query.box.hi), 0) << ras;
    EXPECT_LT(norm(turned.normal - query.normal), 1e-12) << ras;
  };
  text_in("a=top:x,1", "a=bottom:x,1");
  text_in("a=bottom:y,1", "a=top:y,1");
  text_in("a=top:z,1", "a=top:z,1");
  text_in("a=box:1,2,3,4,5,6", "a=box:-4,-5,3,-1,-2,6");
  text_in("a=normal:1,2,3,10", "a=normal:-1,-2,3,10");
  EXPECT_EQ(in_lps(parse_face_query("a=top:x,1"), Frame::kLps).kind, FaceQuery::Kind::kTop);
}

}  // namespace
}  // namespace mesamis
