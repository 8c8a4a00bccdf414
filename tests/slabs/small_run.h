// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "mesamis/phantom/degrade.h"
#include "mesamis/slabs/tasks.h"
#include "support/sampled_volume.h"
#include "support/temp_folder.h"

namespace mesamis {

/// A rod that leans, and crosses every border between slabs: where it lies is known.
struct Rod {
  Vec3 a, b;
  double radius = 7;

  /// Positive inside, mm.
  double depth(const Vec3& p) const {
    const Vec3 way = b - a;
    const double along = std::clamp(dot(p - a, way) / dot(way, way), 0.0, 1.0);
    return radius - norm(p - (a + along * way));
  }
};

inline Rod rod_in(Index slices) { return {{11, 14, 12}, {20, 15, slices - 13.0}}; }

/// With the blur and the noise of a scan.
inline Volume scan_of_rod(Index slices) {
  const Rod rod = rod_in(slices);
  const Volume sharp = sampled_volume({32, 30, slices}, {1, 1, 1}, [&](const Vec3& p) {
    return 120 + 110 * std::clamp(0.5 + rod.depth(p), 0.0, 1.0);
  });
  return degrade(sharp, {.blur = 0.7, .noise = 4});
}

inline Settings quick_settings() {
  Settings settings;
  settings.max_tets = 6000;
  settings.adaptations = 2;
  return settings;
}

/// A scan with its plan and choice, and a folder for scratch files.
struct SmallRun {
  explicit SmallRun(Index slices, std::vector<Index> cuts,
                    const Settings& settings = quick_settings())
      : scan(scan_of_rod(slices)),
        source(scan),
        scratch(folder.path()),
        run{source, scratch, {}, choose_from_part(scan, scan, settings).chosen} {
    Parameters& p = run.choice.parameters;
    const std::vector<double> work(static_cast<std::size_t>(slices), 1.0);
    run.plan =
        plan_slabs(scan, work, {p.unit_mm, p.functional.beta, static_cast<Index>(cuts.size()) - 1});
    run.plan.cuts = std::move(cuts);
    p.h_max = std::min(p.h_max, run.plan.least_thickness());
  }
  /// With what the tasks of the other have left so far, in a folder of its own.
  SmallRun(const SmallRun& other)
      : scan(other.scan),
        source(scan),
        scratch(folder.path()),
        run{source, scratch, other.run.plan, other.run.choice} {
    using enum std::filesystem::copy_options;
    std::filesystem::copy(other.scratch.folder(), scratch.folder(), recursive | overwrite_existing);
  }
  SmallRun& operator=(const SmallRun&) = delete;

  TempFolder folder;
  Volume scan;
  VolumeSlices source;
  Scratch scratch;
  SlabRun run;
};

}  // namespace mesamis
