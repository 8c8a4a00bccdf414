// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/edge_profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mesamis {
namespace {

/// What median_profile() would find on an edge without noise.
Profile profile_of(const EdgeModel& edge) {
  const auto step = [&edge](double t) { return 0.5 * std::erfc(-t / (edge.sigma * std::sqrt(2))); };
  Profile profile;
  for (std::size_t n = 0; n < profile.size(); ++n) {
    const double t = (static_cast<double>(n) - kProfileHalf) * kProfileStep - edge.shift;
    profile[n] = edge.background + (edge.shell - edge.background) * step(t) +
                 (edge.core - edge.shell) * step(t - edge.thickness);
  }
  return profile;
}

TEST(FitEdgeModel, FindsWhatTheProfileWasMadeOf) {
  for (const double core : {200.0, 120.0}) {
    for (const double thickness : {1.3, 2.0}) {
      for (const double shift : {-0.4, 0.2}) {
        const EdgeModel truth{120, 230, core, thickness, 0.5, shift};
        const EdgeModel found = fit_edge_model(profile_of(truth));
        EXPECT_NEAR(found.level(), truth.level(), 2) << core << " " << thickness << " " << shift;
        EXPECT_NEAR(found.background, truth.background, 0.2);
        EXPECT_NEAR(found.core, truth.core, 2);
        EXPECT_NEAR(found.thickness, truth.thickness, 0.15);
        EXPECT_NEAR(found.sigma, truth.sigma, 0.05);
        EXPECT_NEAR(found.shift, truth.shift, 0.05);
      }
    }
  }
}

TEST(FitEdgeModel, SeesAShellThatIsAsThickAsTwiceItsBlur) {
  const EdgeModel truth{120, 230, 200, 2, 1, 0.1};
  const EdgeModel found = fit_edge_model(profile_of(truth));
  EXPECT_NEAR(found.level(), truth.level(), 0.02 * truth.height());
  EXPECT_NEAR(found.shift, truth.shift, 0.05);
  // Midway between what is seen a voxel and a half to either side.
  const Profile profile = profile_of(truth);
  EXPECT_LT((profile[kProfileHalf - 6] + profile[kProfileHalf + 6]) / 2, truth.level() - 2.5);
}

TEST(FitEdgeModel, NoiseIsNoShell) {
  Profile profile = profile_of({120, 230, 230, 1, 1, 0});
  for (std::size_t n = 0; n < profile.size(); ++n) profile[n] += n % 2 == 0 ? 0.3 : -0.3;
  EXPECT_NEAR(fit_edge_model(profile).level(), 175, 0.3);
}

TEST(FitEdgeModel, TellsWhatIsNoSuchEdge) {
  const EdgeModel truth{120, 230, 230, 1, 0.7, 0};
  EXPECT_LT(fit_edge_model(profile_of(truth)).residual, 0.01);
  for (const double beyond : {-1000.0, 230.0}) {  // air beyond a thin skin, the next bone
    Profile profile = profile_of(truth);
    for (std::size_t n = 0; n < profile.size(); ++n) {
      const double t = (static_cast<double>(n) - kProfileHalf) * kProfileStep;
      profile[n] += (beyond - 120) * 0.5 * std::erfc((t + 2.5) / (0.7 * std::sqrt(2)));
    }
    const EdgeModel found = fit_edge_model(profile);
    EXPECT_GT(found.residual, 0.01 * found.height()) << beyond;
  }
}

TEST(FitEdgeModel, AShellIsNeverDarkerThanWhatIsBehind) {
  // Bone that gets denser with depth: an edge, not a shell.
  const EdgeModel found = fit_edge_model(profile_of({120, 200, 230, 1.5, 0.8, 0}));
  EXPECT_EQ(found.core, found.shell);
  EXPECT_GT(found.height(), 80);
  EXPECT_NEAR(found.level(), (found.background + found.shell) / 2, 1e-9);
}

}  // namespace
}  // namespace mesamis
