// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/given_spacing.h"

#include <gmock/gmock.h>

#include <limits>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(GivenSpacing, IsPositiveAndFiniteAlongEachAxis) {
  require_positive_spacing("scan.nii", {0.5, 1e-3, 40});
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const Vec3& wrong : {Vec3{0, 1, 1}, Vec3{1, -2, 1}, Vec3{1, 1, kInfinite}}) {
    EXPECT_REFUSED(require_positive_spacing("scan.nii", wrong),
                   AllOf(HasSubstr("scan.nii: expected a positive spacing"), HasSubstr("mm")));
  }
}

TEST(GivenSpacing, NamesTheOneThatItReplaces) {
  EXPECT_EQ(spacing_is_replaced({0.5, 0.5, 2}),
            "the file's spacing, 0.5 x 0.5 x 2 mm, is replaced by the one given");
}

}  // namespace
}  // namespace mesamis
