// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/run_in_slabs.h"

#include <gtest/gtest.h>

#include <tuple>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/edges.h"
#include "mesamis/method/choose.h"
#include "mesamis/surface/components.h"
#include "mesamis/surface/self_intersections.h"
#include "slabs/small_run.h"
#include "slabs/thread_ranks.h"
#include "support/throws.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

SlabRunResult run_with_ranks(const Volume& scan, const SlabRunOptions& options, int size,
                             const Settings& settings = quick_settings()) {
  const VolumeSlices source(scan);
  auto results = results_of_ranks<SlabRunResult>(
      size, [&](Team& team) { return run_in_slabs(source, settings, options, team); });
  for (std::size_t rank = 1; rank < results.size(); ++rank) EXPECT_FALSE(results[rank]);
  return *std::move(results[0]);
}

SlabRunResult run_alone(const Volume& scan, SlabRunOptions options,
                        const Settings& settings = quick_settings(),
                        const Progress& progress = {}) {
  options.progress = progress;
  Alone alone;
  return *run_in_slabs(VolumeSlices(scan), settings, options, alone);
}

/// A rod in two slabs, made by one thread, with all that a run can give: for all tests that compare
/// with it. Its scratch files are kept.
struct RunOfTwoSlabs {
  TempFolder folder;
  Volume scan = scan_of_rod(72);
  SlabRunOptions options{
      .turns = 1000, .slabs = 2, .scratch = folder.path(), .keep_scratch = true, .grey = true};
  int progress_calls = 0;
  SlabRunResult run = with_threads(1, [this] {
    return run_alone(scan, options, quick_settings(), [this](auto, double) {
      ++progress_calls;
      return true;
    });
  });

  /// Another run of the same scan, elsewhere.
  SlabRunOptions options_in(const TempFolder& other) const {
    SlabRunOptions its = options;
    its.scratch = other / "scratch";
    its.keep_scratch = false;
    return its;
  }
};

const RunOfTwoSlabs& two_slabs() {
  static const RunOfTwoSlabs run;
  return run;
}

void expect_same(const SlabRunResult& a, const SlabRunResult& b) {
  EXPECT_TRUE(a.result.surface.points == b.result.surface.points);
  EXPECT_TRUE(a.result.surface.triangles == b.result.surface.triangles);
  EXPECT_TRUE(a.result.mesh.points == b.result.mesh.points);
  EXPECT_TRUE(a.result.mesh.cells == b.result.mesh.cells);
  EXPECT_TRUE(a.result.u == b.result.u);
  EXPECT_TRUE(a.result.expected_error == b.result.expected_error);
  EXPECT_TRUE(a.grey == b.grey);
}

double mean_distance(const Result& result, const Rod& rod) {
  double sum = 0;
  for (const Vec3& p : result.surface.points) sum += std::abs(rod.depth(p));
  return sum / static_cast<double>(result.surface.points.size());
}

/// What every result is.
void expect_sound(const SlabRunResult& run, const Volume& scan) {
  const Result& result = run.result;
  EXPECT_EQ(find_flaw(result.mesh, scan.box()), "");
  EXPECT_EQ(solid_flaws_of(check_surface(result.surface)), "");
  EXPECT_EQ(result.u.size(), result.mesh.points.size());
  EXPECT_EQ(result.metric.size(), result.mesh.points.size());
  EXPECT_EQ(result.expected_error.size(), result.surface.points.size());
  EXPECT_NEAR(static_cast<double>(result.mesh.cells.size()) / 6000, 1, 0.25);
}

/// Work is counted slab by slab, and each slice, row and cell at least once.
void expect_counted(const SlabRunResult& run, const Volume& scan, Index slabs) {
  ASSERT_EQ(std::ssize(run.slabs), slabs);
  EXPECT_EQ(run.plan.count(), slabs);
  SlabWork sum;
  for (const SlabWork& slab : run.slabs) {
    sum.voxels += slab.voxels;
    sum.rows += slab.rows;
    sum.cells += slab.cells;
    EXPECT_GT(slab.bytes, 0);
  }
  const std::int64_t slice = std::int64_t{scan.size[0]} * scan.size[1];
  EXPECT_EQ(sum.voxels, slice * (scan.size[2] + (slabs - 1) * 2 * 16));
  EXPECT_GE(sum.rows, run.own_rows);
  EXPECT_GE(sum.cells, run.own_cells);
}

// The slab in the middle has two borders; of two processes, one has two slabs.
TEST(SlabRun, FindsWhatMesAmisFinds) {
  const TempFolder folder;
  const Volume scan = scan_of_rod(96);
  const SlabRunResult run = run_with_ranks(scan, {.slabs = 3, .scratch = folder / "scratch"}, 2);
  expect_sound(run, scan);
  expect_counted(run, scan, 3);
  const Result whole = mes_amis(scan, quick_settings());
  EXPECT_EQ(run.result.parameters.level, whole.parameters.level);
  EXPECT_EQ(run.result.parameters.functional.gamma, whole.parameters.functional.gamma);
  EXPECT_EQ(run.result.iterations.size(), whole.iterations.size());
  // Thin slabs have large cells: none may be left as a border cut it.
  EXPECT_GT(run.result.fit.unit_edge_fraction, whole.fit.unit_edge_fraction - 0.04);
  EXPECT_GT(run.result.fit.quality_min, 0.1);
  const Rod rod = rod_in(96);
  EXPECT_LT(mean_distance(run.result, rod), 1.3 * mean_distance(whole, rod));
  EXPECT_FALSE(fs::exists(folder / "scratch"));
}

// Large scans have a grid of every second voxel: slabs need not begin at one.
TEST(SlabRun, TheGridMayBeCoarserThanTheVoxels) {
  const TempFolder folder;
  Settings settings = quick_settings();
  settings.stride = {2, 2, 2};
  const Volume scan = scan_of_rod(99);
  const SlabRunResult run = run_alone(scan, {.slabs = 3, .scratch = folder / "scratch"}, settings);
  expect_sound(run, scan);
  const Rod rod = rod_in(99);
  EXPECT_LT(mean_distance(run.result, rod),
            1.3 * mean_distance(mes_amis(scan, quick_settings()), rod));
}

// Where nothing is to be seen, cells are as large as a slab, and belong to pieces of its
// neighbours. Here one slab below the ball is empty, and three above.
TEST(SlabRun, MostSlabsMayBeEmpty) {
  const TempFolder folder;
  const Vec3 middle{15, 14, 60};
  constexpr double kRadius = 8;
  const Volume scan = degrade(sampled_volume({32, 30, 200}, {1, 1, 1},
                                             [&](const Vec3& p) {
                                               const double depth = kRadius - norm(p - middle);
                                               return 120 + 110 * std::clamp(0.5 + depth, 0.0, 1.0);
                                             }),
                              {.blur = 0.7, .noise = 0.5});
  const SlabRunResult run = run_alone(scan, {.slabs = 5, .scratch = folder / "scratch"});
  EXPECT_EQ(find_flaw(run.result.mesh, scan.box()), "");
  EXPECT_EQ(solid_flaws_of(check_surface(run.result.surface)), "");
  ASSERT_FALSE(run.result.surface.points.empty());
  for (const Vec3& p : run.result.surface.points) EXPECT_NEAR(norm(p - middle), kRadius, 0.5);
  double largest = 0;
  for (const Edge& edge : unique_edges(run.result.mesh)) {
    largest = std::max(largest, norm(run.result.mesh.points[static_cast<std::size_t>(edge[0])] -
                                     run.result.mesh.points[static_cast<std::size_t>(edge[1])]));
  }
  EXPECT_GT(largest, 20) << "few cells fill what is empty";
}

/// A hollow ball across the border between two slabs, a ball in the hollow, and one beside.
Volume scan_of_parts() {
  const auto depth = [](const Vec3& p) {
    const double at = norm(p - Vec3{15, 14.5, 47});
    return std::max({std::min(12 - at, at - 8), 4 - at, 6 - norm(p - Vec3{15, 14, 78})});
  };
  return degrade(sampled_volume({32, 30, 96}, {1, 1, 1},
                                [&](const Vec3& p) {
                                  return 120 + 110 * std::clamp(0.5 + depth(p), 0.0, 1.0);
                                }),
                 {.blur = 0.7, .noise = 2});
}

/// The grid is left-handed: in the world, what is seen from outside turns the other way.
Volume left_handed_scan_of_parts() {
  Volume scan = scan_of_parts();
  scan.direction.rows[0] = {-1, 0, 0};
  return scan;
}

Settings settings_for_parts() {
  Settings settings = quick_settings();
  settings.max_tets = 12000;
  settings.min_volume = 10;
  return settings;
}

/// All parts, found in two slabs.
const Result& all_parts() {
  static const SlabRunResult run = [] {
    const TempFolder folder;
    return run_alone(left_handed_scan_of_parts(), {.slabs = 2, .scratch = folder / "s"},
                     settings_for_parts());
  }();
  return run.result;
}

TEST(SlabRun, KeepsAllPartsOfALeftHandedGrid) {
  const Result& result = all_parts();
  const Result whole = mes_amis(left_handed_scan_of_parts(), settings_for_parts());
  const SurfaceCheck check = check_surface(result.surface);
  EXPECT_EQ(solid_flaws_of(check), "");
  EXPECT_EQ(check.islands, 3);
  EXPECT_EQ(check.cavities, 1);
  EXPECT_NEAR(check.volume / check_surface(whole.surface).volume, 1, 0.01);
  EXPECT_EQ(result.printable.parts->islands, 3);
  EXPECT_EQ(result.printable.parts->cavities, 1);
  const double errors = kErrorsOfObject / kErrorsOfDecimation;
  EXPECT_NEAR(errors * *result.parameters.tolerance / *whole.parameters.tolerance, 1, 0.1)
      << "the points of the whole move after decimation, see simplify()";
}

TEST(SlabRun, ChoosesPartsThatReachOverBorders) {
  const TempFolder folder;
  Settings settings = settings_for_parts();
  settings.keep_largest = 1;
  settings.fill_cavities = true;
  const SlabRunResult run =
      run_alone(left_handed_scan_of_parts(), {.slabs = 2, .scratch = folder / "s"}, settings);
  const SurfaceCheck check = check_surface(run.result.surface);
  EXPECT_EQ(solid_flaws_of(check), "");
  EXPECT_EQ(check.islands, 1);
  EXPECT_EQ(check.cavities, 0);
  const SelectionReport found = *run.result.printable.parts;
  EXPECT_EQ(found.islands_dropped, 2);
  EXPECT_EQ(found.cavities_filled, 1);
  // The hollow ball, the wall of its cavity, the ball beside it and the one in the hollow.
  const auto sizes = find_components(all_parts().surface).sizes;
  ASSERT_EQ(sizes.size(), 4U);
  EXPECT_NEAR(check.volume / sizes[0].volume, 1, 0.01);
  const double dropped = sizes[2].volume + sizes[3].volume, filled = -sizes[1].volume;
  EXPECT_NEAR(found.volume_dropped, dropped, 0.02 * dropped);
  EXPECT_NEAR(found.volume_filled, filled, 0.02 * filled);
}

/// An upright prism, blurred, without noise: on its walls cells, and so triangles, are as long as a
/// slab.
Volume scan_of_prism(Index slices) {
  return sampled_volume({24, 24, slices}, {1, 1, 1}, [&](const Vec3& p) {
    const double depth =
        std::min({p.x - 6.3, 16.7 - p.x, p.y - 6.2, 16.9 - p.y, p.z - 3.2, slices - 4.4 - p.z});
    return 120 + 110 * std::clamp(0.5 + 0.5 * depth, 0.0, 1.0);
  });
}

TEST(SlabRun, LongTrianglesReachOverBorders) {
  const TempFolder folder;
  Settings settings = quick_settings();
  settings.noise = 0;
  for (const auto& [slices, slabs, cells, follow] :
       {std::tuple{66, 2, 1500, false}, {132, 4, 2000, true}}) {
    settings.max_tets = cells;
    settings.follow = follow;
    const SlabRunResult run = run_alone(
        scan_of_prism(slices), {.slabs = slabs, .scratch = folder / "s", .mesh = false}, settings);
    const SurfaceCheck check = check_surface(run.result.surface);
    EXPECT_EQ(solid_flaws_of(check), "") << slices;
    EXPECT_EQ(check.components, 1);
    EXPECT_TRUE(find_self_intersections(run.result.surface).empty());
    EXPECT_NEAR(check.volume / (10.4 * 10.7 * (slices - 7.6)), 1, 0.05) << "the blur rounds edges";
    EXPECT_TRUE(run.result.printable.within(*run.result.parameters.tolerance));
  }
}

TEST(SlabRun, TheMeshIsKeptForThoseWhoWantIt) {
  const TempFolder folder;
  SlabRunOptions options = two_slabs().options_in(folder);
  options.mesh = false;
  const SlabRunResult without = run_alone(two_slabs().scan, options);
  const SlabRunResult& with = two_slabs().run;
  EXPECT_TRUE(without.result.surface.points == with.result.surface.points);
  EXPECT_TRUE(without.result.surface.triangles == with.result.surface.triangles);
  EXPECT_TRUE(without.grey == with.grey);
  EXPECT_EQ(without.grey.size(), with.result.surface.points.size());
  EXPECT_TRUE(without.result.mesh.cells.empty() && without.result.u.empty());
  EXPECT_EQ(without.result.fit.quality_min, with.result.fit.quality_min);
  EXPECT_EQ(without.result.iterations.back().tets, std::ssize(with.result.mesh.cells));
  EXPECT_EQ(without.result.iterations.back().nodes, std::ssize(with.result.mesh.points));
}

/// The whole surface is decimated at once where the number of triangles counts, or none is.
TEST(SlabRun, DecimatesAsIsAskedFor) {
  const TempFolder folder;
  const Volume scan = scan_of_rod(72);
  const SlabRunOptions options{
      .slabs = 2, .scratch = folder / "scratch", .mesh = false, .grey = true};
  Settings settings = quick_settings();
  settings.adaptations = 1;
  settings.triangles = 600;
  const SlabRunResult few = run_alone(scan, options, settings);
  EXPECT_EQ(few.result.surface.triangles.size(), 600u);
  settings.triangles = {};
  settings.tolerance = 0;
  const SlabRunResult all = run_alone(scan, options, settings);
  EXPECT_EQ(std::ssize(all.result.surface.triangles), all.result.printable.triangles_extracted);
  for (const SlabRunResult* run : {&few, &all}) {
    EXPECT_EQ(solid_flaws_of(check_surface(run->result.surface)), "");
    EXPECT_EQ(run->grey.size(), run->result.surface.points.size());
    EXPECT_TRUE(run->result.mesh.cells.empty());
  }
}

TEST(SlabRun, OneSlabIsARunLikeAnyOther) {
  const TempFolder folder;
  const Volume scan = scan_of_rod(40);
  const SlabRunResult run = run_alone(scan, {.slabs = 1, .scratch = folder / "scratch"});
  const Result whole = mes_amis(scan, quick_settings());
  EXPECT_TRUE(run.result.surface.points == whole.surface.points);
  EXPECT_TRUE(run.result.mesh.cells == whole.mesh.cells);
  ASSERT_EQ(run.slabs.size(), 1U);
  EXPECT_EQ(run.slabs[0].voxels, static_cast<std::int64_t>(scan.voxel_count()));
  EXPECT_EQ(run.slabs[0].rows, run.own_rows);
  EXPECT_EQ(run.slabs[0].cells, run.own_cells);
  EXPECT_EQ(run.slabs[0].bytes, 0);
}

TEST(SlabRun, TheSameBitsForAnyNumberOfThreadsAndTurns) {
  const TempFolder folder;
  SlabRunOptions options = two_slabs().options_in(folder);
  options.turns = 1;  // both slabs at a time; the other run has them one by one
  expect_same(with_threads(4, [&] { return run_alone(two_slabs().scan, options); }),
              two_slabs().run);
  options.turns = 0;
  EXPECT_REFUSED(run_alone(two_slabs().scan, options), HasSubstr("found 0"));
}

TEST(SlabRun, TheSameBitsForMoreRanksThanSlabs) {
  const TempFolder folder;
  expect_same(run_with_ranks(two_slabs().scan, two_slabs().options_in(folder), 3), two_slabs().run);
}

TEST(SlabRun, OneMeshIsEnough) {
  const TempFolder folder;
  Settings settings = quick_settings();
  settings.adaptations = 1;
  const Volume scan = scan_of_rod(72);
  const SlabRunResult run = run_alone(scan, {.slabs = 2, .scratch = folder / "scratch"}, settings);
  expect_sound(run, scan);
  EXPECT_EQ(run.result.iterations.size(), 2U) << "on the grid, and on the mesh";
  EXPECT_GT(run.own_cells, 0);
  EXPECT_FALSE(run.result.converged) << "as for mes_amis(): nothing was compared";
}

/// The file that says that the last task is done.
std::optional<fs::path> newest_done_file(const fs::path& folder) {
  std::optional<fs::path> newest;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().rfind("done.", 0) != 0) continue;
    if (!newest || fs::last_write_time(entry) > fs::last_write_time(*newest)) newest = entry.path();
  }
  return newest;
}

TEST(SlabRun, GoesOnWhereItWasStopped) {
  const TempFolder folder;
  const Volume& scan = two_slabs().scan;
  const SlabRunOptions options = two_slabs().options_in(folder);
  EXPECT_GT(two_slabs().progress_calls, 20);
  std::optional<SlabRunResult> found;
  int stops = 0;
  for (int last = 2; !found; last += 5) {
    int call = 0;
    try {
      found =
          run_alone(scan, options, quick_settings(), [&](auto, double) { return ++call < last; });
    } catch (const Cancelled&) {
      ++stops;
      // As if it had been killed before it could say so: the task is done again.
      const auto done = newest_done_file(folder / "scratch/mesamis-slabs");
      if (done) fs::remove(*done);
    }
  }
  EXPECT_GT(stops, 6);
  expect_same(*found, two_slabs().run);
}

TEST(SlabRun, RefusesTheFolderOfAnotherRun) {
  const TempFolder folder;
  const Volume scan = scan_of_rod(72);
  const SlabRunOptions options{.slabs = 2, .scratch = folder.path()};
  const Progress stop = [](auto stage, double) { return stage != "slabs: choose"; };
  EXPECT_THROW(run_alone(scan, options, quick_settings(), stop), Cancelled);
  const auto refused = AllOf(HasSubstr(folder.path().string()), HasSubstr("another scan"));
  Settings other = quick_settings();
  other.max_tets = 7000;
  EXPECT_REFUSED(run_alone(scan, options, other), refused);
  EXPECT_REFUSED(run_alone(scan, {.slabs = 1, .scratch = folder.path()}), refused);
  SlabRunOptions elsewhere = options;
  elsewhere.input = "another file";
  EXPECT_REFUSED(run_alone(scan, elsewhere), refused);
  Volume moved = scan;
  moved.origin.y += 1;
  EXPECT_REFUSED(run_alone(moved, options), refused);
  Volume changed = scan;
  for (float& sample : changed.samples) sample += 1;
  EXPECT_REFUSED(run_alone(changed, options), refused);
  EXPECT_THROW(run_alone(scan, options, quick_settings(), stop), Cancelled) << "its own is left";
}

TEST(SlabRun, RefusesScratchFilesThatAreCutOff) {
  const Volume& scan = two_slabs().scan;
  const SlabRunOptions& options = two_slabs().options;
  const fs::path files = two_slabs().folder / "mesamis-slabs";
  for (const char* name : {"run", "choice", "image", "grid.0", "profile.1.0", "final.2.1",
                           "surface.decimated.1", "done.prepare.0"}) {
    const std::string bytes = read_bytes(files / name);
    ASSERT_FALSE(bytes.empty()) << name;
    write_bytes(files / name, bytes.substr(0, bytes.size() / 2));
    EXPECT_REFUSED(run_alone(scan, options), HasSubstr(std::string("/") + name + ": "));
    fs::remove(files / name);
    if (std::string(name) != "run" && std::string(name) != "done.prepare.0") {
      EXPECT_REFUSED(run_alone(scan, options), HasSubstr(std::string("/") + name + ": "));
    }
    write_bytes(files / name, bytes);
  }
  expect_same(run_alone(scan, options), two_slabs().run);
  EXPECT_TRUE(fs::exists(files)) << "kept";
}

/// Two rods of which one is less dense but for its core, in Hounsfield units.
Volume unlike_rods() {
  Volume scan = sampled_volume({52, 26, 72}, {1, 1, 1}, [](const Vec3& p) {
    const auto rod = [&p](double x, double radius) {
      const double outside = std::hypot(p.x - x, p.y - 13) - radius;
      return std::clamp(0.5 - outside, 0.0, 1.0) * std::clamp(p.z - 9.5, 0.0, 1.0) *
             std::clamp(62.5 - p.z, 0.0, 1.0);
    };
    return 50 + 1150 * rod(13, 8) + 300 * rod(38, 8) + 600 * rod(38, 1.5);
  });
  scan.modality = "CT";
  return degrade(scan, {.blur = 0.7, .noise = 4});
}

TEST(SlabRun, HasTheLevelsOfEachPlaceOfTheWholeScan) {
  const Volume scan = unlike_rods();
  const TempFolder folder;
  const SlabRunOptions in_turns{.turns = 2, .slabs = 2, .scratch = folder / "a", .grey = true};
  const SlabRunOptions at_once{.turns = 1, .slabs = 2, .scratch = folder / "b", .grey = true};
  Settings settings = quick_settings();
  settings.max_tets = 20'000;  // coarser surfaces differ by a per cent of the volume
  const SlabRunResult run = run_alone(scan, in_turns, settings);
  expect_same(run_alone(scan, at_once, settings), run);
  expect_same(run_with_ranks(scan, in_turns, 2, settings), run);

  const Result whole = mes_amis(scan, settings);
  EXPECT_FALSE(run.is_too_large);
  EXPECT_TRUE(run.result.parameters.local_level);
  EXPECT_EQ(run.result.image.level_range, whole.image.level_range);
  const SurfaceCheck check = check_surface(run.result.surface);
  EXPECT_EQ(solid_flaws_of(check), "");
  EXPECT_EQ(check.components, 2);
  EXPECT_NEAR(check.volume / check_surface(whole.surface).volume, 1, 0.005);
  // The fields are those of the scan: without the excess the light rod has 800.
  ASSERT_EQ(run.result.u.size(), run.result.mesh.points.size());
  for (std::size_t n = 0; n < run.result.u.size(); ++n) {
    const Vec3& p = run.result.mesh.points[n];
    const double light = std::hypot(p.x - 38, p.y - 13);
    if (light > 3.5 && light < 5.5 && p.z > 16 && p.z < 56) {
      EXPECT_NEAR(run.result.parameters.grey.to_native(run.result.u[n]), 350, 100);
    }
  }
}

/// What is chosen from a part of the scan is one level; whoever asked for more is told.
TEST(SlabRun, OfMoreVoxelsThanAreLookedAtHasOneLevel) {
  Volume scan = unlike_rods();
  const TempFolder folder;
  SlabRunOptions options{.slabs = 2, .scratch = folder / "a", .most_looked_at = 52 * 26 * 60};
  const SlabRunResult run = run_alone(scan, options);
  EXPECT_TRUE(run.is_too_large);
  EXPECT_FALSE(run.result.parameters.local_level);
  EXPECT_FALSE(run.result.image.has_local_levels());
  scan.modality = "MR";  // no scan for which each place would have a level
  options.scratch = folder / "b";
  EXPECT_FALSE(run_alone(scan, options).is_too_large);
}

TEST(SlabRun, RefusesWhatHasNoMeaningInSlabs) {
  const TempFolder folder;
  const Volume scan = scan_of_rod(72);
  const auto run_with = [&](const std::function<void(Settings&)>& change) {
    Settings settings = quick_settings();
    change(settings);
    run_alone(scan, {.slabs = 2, .scratch = folder / "scratch"}, settings);
  };
  EXPECT_REFUSED(run_with([](Settings& s) { s.preview = true; }), HasSubstr("preview"));
  EXPECT_REFUSED(run_with([](Settings& s) { s.crop.begin[0] = 2; }), HasSubstr("crop"));
  EXPECT_REFUSED(run_with([](Settings& s) { s.until = StopRule::kEnergy; }), HasSubstr("energy"));
  EXPECT_REFUSED(run_with([](Settings& s) { s.surface = SurfaceKind::kBand; }), HasSubstr("band"));
  EXPECT_FALSE(fs::exists(folder / "scratch")) << "nothing was begun";
  EXPECT_REFUSED(run_alone(scan, {.slabs = 9, .scratch = folder / "scratch"}),
                 HasSubstr("expected 1 to 2"));
}

}  // namespace
}  // namespace mesamis
