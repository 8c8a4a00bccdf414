// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/mesh_parts.h"

#include <atomic>

#include "mesamis/base/parallel.h"
#include "mesamis/remesh/split.h"
#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

const FormulaMetric kFine = uniform_metric(0.15);

WorkingMesh loaded(const TetMesh& start, const MetricSampler& sampler) {
  WorkingMesh mesh = load(start, bounding_box(start.points));
  compact(mesh);
  measure_all(mesh, sampler);
  return mesh;
}

TEST(Partition, IdlePartsJoinToTheSameMesh) {
  const TetMesh start = perturbed_box(kUnitBox, {6, 5, 7}, 0.2);
  const MetricSampler sampler(kFine, kUnitBox);
  for (int round = 0; round < 5; ++round) {
    WorkingMesh mesh = loaded(start, sampler);
    std::atomic<std::int64_t> cells = 0;
    work_on_parts(mesh, {round, 7}, [&](WorkingMesh& part) {
      cells += part.cell_count();
      return Counters{};
    });
    EXPECT_EQ(cells, std::ssize(start.cells));
    EXPECT_EQ(mesh.cell_count(), std::ssize(start.cells));
    EXPECT_EQ(mesh.vertex_count(), std::ssize(start.points));
    expect_sound(mesh);
  }
}

TEST(Partition, PartsAreBalancedAndBordersMove) {
  const TetMesh start = box_mesh(kUnitBox, {12, 12, 12});
  const MetricSampler sampler(kFine, kUnitBox);
  std::array<std::int64_t, 2> frozen{};
  for (int round = 0; round < 2; ++round) {
    WorkingMesh mesh = loaded(start, sampler);
    std::atomic<std::int64_t> largest = 0, sum = 0;
    work_on_parts(mesh, {round, 4}, [&](WorkingMesh& part) {
      std::int64_t seen = largest;
      while (part.cell_count() > seen && !largest.compare_exchange_weak(seen, part.cell_count())) {
      }
      for (const Vertex& v : part.vertices) sum += (v.mask & kFrozen) != 0;
      return Counters{};
    });
    EXPECT_LT(largest, std::ssize(start.cells) / 2);
    frozen[static_cast<std::size_t>(round)] = sum;
  }
  EXPECT_NE(frozen[0], frozen[1]);
}

TEST(Partition, WorkOnPartsGivesAValidMeshAndTheSameBitsForAnyThreads) {
  const TetMesh start = perturbed_box(kUnitBox, {6, 6, 6}, 0.2);
  const MetricSampler sampler(kFine, kUnitBox);
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 8}) {
    with_threads(threads, [&] {
      WorkingMesh mesh = loaded(start, sampler);
      Counters sum;
      for (int round = 0; round < 4; ++round) {
        const PartsReport done = work_on_parts(mesh, {round, 5}, [&](WorkingMesh& part) {
          Workbench bench(part, sampler);
          return Counters{.splits = split_long_edges(bench, {})};
        });
        EXPECT_EQ(done.seconds.size(), 5u);
        sum += done.counters;
        expect_sound(mesh);
      }
      EXPECT_GT(sum.splits, 100);
      hashes.push_back(mesh_hash(unload(mesh)));
    });
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

}  // namespace
}  // namespace mesamis
