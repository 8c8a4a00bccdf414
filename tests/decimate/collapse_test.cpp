// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/collapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "decimate/collapses.h"

namespace mesamis {
namespace {

std::vector<Vec3> normals_of(const Collapses& now) {
  std::vector<Vec3> normals;
  for (Index t = 0; t < now.surface.count(); ++t) {
    const Triangle k = now.surface.triangle(t);
    normals.push_back(unit_normal({now.points[k[0]], now.points[k[1]], now.points[k[2]]}));
  }
  return normals;
}

/// Height over longest side of the flattest triangle.
double flattest(const TriMesh& mesh, Index point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles) {
    if (std::find(t.begin(), t.end(), point) == t.end()) continue;
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    least = std::min(least, norm(cross(b - a, c - a)) / (longest * longest));
  }
  return least;
}

/// What is listed to change is what differs between the surfaces.
void expect_listed(const Collapses& collapses, const Collapse& collapse, const TriMesh& after) {
  std::multiset<Triangle> expected, found;
  const TriMesh before = collapses.now();
  for (const Triangle& t : after.triangles) {
    const bool was =
        std::find(before.triangles.begin(), before.triangles.end(), t) != before.triangles.end();
    const bool moved = collapse.moves && std::find(t.begin(), t.end(), collapse.kept) != t.end();
    if (was && !moved) continue;
    Triangle sorted = t;
    std::sort(sorted.begin(), sorted.end());
    expected.insert(sorted);
  }
  for (std::size_t i = 0; i < collapse.faces.size(); ++i) {
    const Index h = collapse.outer[i];
    Triangle sorted{collapse.kept, collapses.surface.from(h), collapses.surface.to(h)};
    EXPECT_EQ(collapse.after[i][0], collapse.place);
    EXPECT_EQ(collapse.after[i][1], collapses.points[sorted[1]]);
    EXPECT_EQ(collapse.after[i][2], collapses.points[sorted[2]]);
    const Vec3 last = i > 0 ? collapse.after[i - 1][2] : collapse.after[i][1];
    EXPECT_EQ(collapse.after[i][1], last) << "one after the other";
    std::sort(sorted.begin(), sorted.end());
    found.insert(sorted);
  }
  EXPECT_EQ(found, expected);
}

TEST(Describe, ListsTheTrianglesThatChangeAsTheyWillBe) {
  Collapses collapses(small_sphere());
  collapses.for_each(7, [&](const Collapse& collapse, const TriMesh& after) {
    expect_listed(collapses, collapse, after);
  });
}

TEST(DescribeAtRim, ListsTheTrianglesThatChangeAsTheyWillBe) {
  Collapses collapses(small_bowl());
  int seen = 0;
  collapses.for_each_at_rim([&](const Collapse& collapse, const TriMesh& after) {
    expect_listed(collapses, collapse, after);
    ++seen;
  });
  EXPECT_GT(seen, 40);
}

TEST(SpoilsShape, RefusesTrianglesFlatterThanBefore) {
  TriMesh mesh = small_sphere();
  for (Vec3& p : mesh.points) p.z *= 0.01;  // many triangles become flat by a collapse
  Collapses collapses(mesh);
  const std::vector<Vec3> normals = normals_of(collapses);
  int refused = 0, allowed = 0;
  collapses.for_each(1, [&](const Collapse& collapse, const TriMesh& after) {
    if (spoils_shape(collapses.surface, collapses.points, normals, collapse, false)) {
      ++refused;
      return;
    }
    ++allowed;
    const double limit =
        std::min({0.01, flattest(mesh, collapse.removed), flattest(mesh, collapse.kept)});
    EXPECT_GE(flattest(after, collapse.kept), limit * (1 - 1e-9));
  });
  EXPECT_GT(refused, 0);
  EXPECT_GT(allowed, 0);
}

/// The creases of a surface, edge by edge.
double creases_of(const TriMesh& mesh) {
  std::map<std::pair<Index, Index>, Vec3> sides;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      sides[{t[i], t[(i + 1) % 3]}] = unit_normal(corners_of(mesh, t));
    }
  }
  double sum = 0;
  for (const auto& [edge, normal] : sides) {
    const auto other = sides.find({edge.second, edge.first});
    if (other == sides.end() || edge.first > edge.second) continue;
    sum += crease_at(mesh.points[edge.first], mesh.points[edge.second], normal, other->second);
  }
  return sum;
}

TEST(SpoilsShape, CountsAllCreasesThatCollapsesAtRimsChange) {
  Collapses collapses(small_bowl());
  const TriMesh mesh = collapses.now();
  const std::vector<Vec3> normals = normals_of(collapses);
  int refused = 0, allowed = 0;
  collapses.for_each_at_rim([&](const Collapse& collapse, const TriMesh& after) {
    if (spoils_shape(collapses.surface, collapses.points, normals, collapse, false)) return;
    const bool spoils = spoils_shape(collapses.surface, collapses.points, normals, collapse, true);
    (spoils ? refused : allowed) += 1;
    // What does not change adds to both: growth by a tenth of the part is less of the whole.
    const double before = creases_of(mesh), now = creases_of(after);
    if (spoils) {
      EXPECT_GT(now, before);
    } else {
      EXPECT_LE(now, 1.1 * before);
    }
  });
  EXPECT_GT(refused, 5);
  EXPECT_GT(allowed, 5);
}

TEST(SpoilsShape, MakesNoCreaseWhereThereIsNone) {
  const TriMesh mesh = level_set({{-1, -1, -1}, {1, 1, 1}}, {24, 24, 24},
                                 [](const Vec3& p) { return 0.8 - norm(p); });
  Collapses collapses(mesh);
  const std::vector<Vec3> normals = normals_of(collapses);
  const auto sharpest = [](const TriMesh& m, Index point) {
    std::map<std::pair<Index, Index>, Vec3> sides;
    for (const Triangle& t : m.triangles) {
      const Vec3 n = unit_normal(corners_of(m, t));
      for (std::size_t i = 0; i < 3; ++i) sides[{t[i], t[(i + 1) % 3]}] = n;
    }
    double least = 1;
    for (const Triangle& t : m.triangles) {
      if (std::find(t.begin(), t.end(), point) == t.end()) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        least = std::min(least,
                         dot(sides.at({t[i], t[(i + 1) % 3]}), sides.at({t[(i + 1) % 3], t[i]})));
      }
    }
    return least;
  };
  int refused = 0, allowed = 0;
  collapses.for_each(997, [&](const Collapse& collapse, const TriMesh& after) {
    const double before = std::min(sharpest(mesh, collapse.removed), sharpest(mesh, collapse.kept));
    if (before < 0.91) return;
    const bool spoils = spoils_shape(collapses.surface, collapses.points, normals, collapse, true);
    refused += spoils ? 1 : 0;
    allowed += spoils ? 0 : 1;
    if (!spoils) {
      EXPECT_GE(sharpest(after, collapse.kept), 0.906);
    }
  });
  EXPECT_GT(allowed, 10);
}

}  // namespace
}  // namespace mesamis
