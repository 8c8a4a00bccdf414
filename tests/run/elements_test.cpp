// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/elements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run/small_request.h"
#include "support/throws.h"

namespace mesamis {
namespace {

Request body_request() {
  Request request = ball_request();
  request.settings.preview = true;
  request.elements.wishes.elements.element_size = 4;
  request.elements.wishes.tolerance = 0.3;
  return request;
}

TEST(MakeElements, MakesNothingUnlessAsked) {
  const OutcomeDetails& found = ball_outcome().details();
  const ElementResults none =
      make_elements({}, {found.objects(), found.grid, found.image(), found.parameters()}, {});
  EXPECT_FALSE(none.body);
  EXPECT_TRUE(none.skins.empty());
}

TEST(MakeElements, ABodyFillsTheObject) {
  Request request = body_request();
  request.elements.body = true;
  const Outcome found = segment(std::move(request));
  ASSERT_TRUE(found.details().elements.body);
  EXPECT_EQ(found.details().elements.unmet, "");
  const FiniteElements& body = found.details().elements.body->elements;
  const TetMesh mesh{body.points, body.cells};
  double volume = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    volume += cell_volume(mesh, static_cast<Index>(c));
  }
  EXPECT_NEAR(volume, found.details().checks[0].volume, 0.03 * found.details().checks[0].volume);
}

/// The surface becomes that of the elements, with the errors that were expected of it.
TEST(MakeElements, SkinsReplaceSurfaces) {
  Request request = body_request();
  const Outcome before = segment(request);
  request.elements.skins = true;
  const Outcome after = segment(std::move(request));
  EXPECT_FALSE(after.details().elements.body);
  ASSERT_EQ(after.details().elements.quality.size(), 1U);
  EXPECT_LE(after.details().elements.quality[0].to_given, 0.3);
  EXPECT_NE(after.details().one->surface.points, before.details().one->surface.points);
  EXPECT_EQ(after.details().expected_error(0).size(), after.details().one->surface.points.size());
}

TEST(MakeElements, NeedASurface) {
  Request request = body_request();
  request.elements.body = true;
  request.settings.min_volume = 1e6;
  EXPECT_REFUSED(
      segment(std::move(request)),
      testing::HasSubstr("expected a part of at least --min-volume 1e+06 mm^3, found 1 of "));
}

}  // namespace
}  // namespace mesamis
