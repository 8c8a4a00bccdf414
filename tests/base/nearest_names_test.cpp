// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/nearest_names.h"

#include <gmock/gmock.h>

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(EditDistance, CountsEachKindOfSlipOnce) {
  EXPECT_EQ(edit_distance("level", "level"), 0u);
  EXPECT_EQ(edit_distance("level", "levl"), 1u);
  EXPECT_EQ(edit_distance("level", "levvel"), 1u);
  EXPECT_EQ(edit_distance("level", "lebel"), 1u);
  EXPECT_EQ(edit_distance("level", "leevl"), 1u);
  EXPECT_EQ(edit_distance("", "level"), 5u);
  EXPECT_EQ(edit_distance("level", ""), 5u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(EditDistance, IsTheSameBothWays) {
  for (const char* a : {"", "a", "tolerance", "tau", "label", "--labels"}) {
    for (const char* b : {"toleranec", "level", "labels", "tua", "-"}) {
      EXPECT_EQ(edit_distance(a, b), edit_distance(b, a)) << a << " " << b;
    }
  }
}

TEST(NearestNames, AreTheNearestOnly) {
  const std::vector<std::string> names{"--tolerance", "--tol-mesh", "--tol-energy", "--label",
                                       "--labels",    "--level",    "--box"};
  EXPECT_THAT(nearest_names("--tolerence", names), ElementsAre("--tolerance"));
  EXPECT_THAT(nearest_names("--lable", names), ElementsAre("--label"));
  EXPECT_THAT(nearest_names("--tol", names),
              ElementsAre("--tolerance", "--tol-mesh", "--tol-energy"));
  EXPECT_THAT(nearest_names("--frobnicate", names), IsEmpty());
  EXPECT_THAT(nearest_names("--xyz", names), IsEmpty()) << "two of three differ from box";
  EXPECT_THAT(nearest_names("", names), IsEmpty());
  EXPECT_THAT(nearest_names("--", names), IsEmpty());
  EXPECT_THAT(nearest_names(std::string(10'000, 'x'), names), IsEmpty());
}

TEST(NearestNames, AreAskedForInASentence) {
  const std::vector<std::string> names{"level", "label", "labels"};
  EXPECT_EQ(did_you_mean("levels", names), "; did you mean level?");
  EXPECT_EQ(did_you_mean("lab", names), "; did you mean label or labels?");
  EXPECT_EQ(did_you_mean("window", names), "");
}

}  // namespace
}  // namespace mesamis
