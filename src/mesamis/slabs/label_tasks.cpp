// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/label_tasks.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/mesh/kuhn.h"
#include "mesamis/slabs/mapped_items.h"
#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/label_parts.h"
#include "mesamis/surface/lift_memberships.h"
#include "mesamis/surface/part_filter.h"
#include "mesamis/surface/yield_nodes.h"

namespace mesamis::detail::slabs {
namespace {

/// How many slices away the materials matter to whether a node may yield.
constexpr Index kYieldReach = 2;

/// Slices [begin, end) of the block.
struct BlockSlices {
  Index begin = 0, end = 0;
  Index count() const { return end - begin; }
};

Index slice_count(const LayerRun& run) { return run.block.size[2]; }

/// Nodes of so many slices.
std::int64_t nodes_in(const LayerRun& run, Index slices) {
  return std::int64_t{run.block.size[0]} * run.block.size[1] * slices;
}

BlockSlices own_slices(const LayerRun& run, Index s) {
  const auto at = static_cast<std::size_t>(s);
  return {run.cuts[at], run.cuts[at + 1]};
}

/// Those, and so many on both sides, as far as there are any.
BlockSlices around(const LayerRun& run, const BlockSlices& slices, Index reach) {
  return {std::max(0, slices.begin - reach), std::min(slice_count(run), slices.end + reach)};
}

/// Those whose nodes the cells of slab s have.
BlockSlices slices_of_cells(const LayerRun& run, Index s) {
  const BlockSlices own = own_slices(run, s);
  return {own.begin, std::min(slice_count(run), own.end + 1)};
}

SlabWork work_on(const LayerRun& run, const BlockSlices& held) {
  return {.voxels = nodes_in(run, held.count())};
}

/// The labels of some slices, background beyond the map.
std::vector<std::uint16_t> labels_of(const LayerRun& run, const BlockSlices& slices) {
  const LabelMap& head = run.source.head();
  LabelBlock part = run.block;
  part.begin[2] += slices.begin;
  part.size[2] = slices.count();
  const Index first = std::max(0, part.begin[2]);
  const Index end = std::min(head.size[2], part.begin[2] + part.size[2]);
  if (end <= first) return std::vector<std::uint16_t>(nodes_in(run, slices.count()), 0);
  LabelMap some{{head}, {run.source.read(run.layer, first, end - first)}, {}};
  some.size[2] = end - first;
  part.begin[2] -= first;
  std::vector<std::uint16_t> labels = labels_in(some, 0, part);
  if (run.only_chosen) keep_chosen(run.net->chosen, labels);
  take_nodes(run.joins, nodes_in(run, slices.begin), labels);
  return labels;
}

/// The grid of some slices, without labels or materials.
GridMemberships grid_of(const LayerRun& run, const BlockSlices& slices) {
  GridMemberships grid{.size = run.block.size,
                       .spacing = run.source.head().spacing,
                       .material = {},
                       .label = run.parts.label,
                       .first = {},
                       .listed = {},
                       .value = {}};
  grid.size[2] = slices.count();
  grid.below = slices.begin;
  grid.above = slice_count(run) - slices.end;
  return grid;
}

std::filesystem::path part_file(const LayerRun& run) {
  return run.scratch.path(run.file("nodes", 0));
}

/// As find_parts() has left them: the numbers of each slab.
std::vector<Index> read_own_numbers(const LayerRun& run, const BlockSlices& slices) {
  const auto all =
      map_items<Index>(part_file(run), static_cast<std::size_t>(nodes_in(run, slice_count(run))));
  const auto at = all.values.begin() + nodes_in(run, slices.begin);
  return {at, at + nodes_in(run, slices.count())};
}

/// The part of each node of some slices.
std::vector<Index> read_parts(const LayerRun& run, const BlockSlices& slices) {
  std::vector<Index> parts = read_own_numbers(run, slices);
  for (Index s = 0; s < run.count(); ++s) {
    const BlockSlices own = own_slices(run, s);
    const Index begin = std::max(own.begin, slices.begin), end = std::min(own.end, slices.end);
    if (begin >= end) continue;
    const std::vector<Index>& number = run.parts.number[static_cast<std::size_t>(s)];
    const auto from = parts.begin() + nodes_in(run, begin - slices.begin);
    std::transform(from, from + nodes_in(run, end - begin), from,
                   [&](Index own_number) { return number[own_number]; });
  }
  return parts;
}

/// Lets nodes of the block yield that lie in some slices.
void apply(const LayerRun& run, const std::vector<Yield>& yields, const BlockSlices& slices,
           std::vector<Index>& material) {
  const std::int64_t first = nodes_in(run, slices.begin), end = nodes_in(run, slices.end);
  for (const auto& [node, to] : yields) {
    if (node >= first && node < end) material[static_cast<std::size_t>(node - first)] = to;
  }
}

std::vector<Yield> read_yields(const LayerRun& run, const char* what, Index s) {
  return run.scratch.read(run.file(what, s)).next<Yield>();
}

void write_yields(const LayerRun& run, const char* what, Index s, const std::vector<Yield>& all) {
  ArchiveWriter archive;
  archive.add(all);
  run.scratch.write(run.file(what, s), archive);
}

/// Nodes of some slices as nodes of the block, or back.
void shift_nodes(std::vector<Yield>& yields, std::int64_t by) {
  for (Yield& yield : yields) yield.node += by;
}

/// Some of the slices of a grid.
GridMemberships cut_out(const LayerRun& run, const GridMemberships& grid,
                        const BlockSlices& slices) {
  GridMemberships part = grid_of(run, slices);
  const auto from = static_cast<std::ptrdiff_t>(nodes_in(run, slices.begin - grid.below));
  const auto to = from + static_cast<std::ptrdiff_t>(nodes_in(run, slices.count()));
  part.material.assign(grid.material.begin() + from, grid.material.begin() + to);
  part.first.assign(grid.first.begin() + from, grid.first.begin() + to + 1);
  const std::int64_t first = part.first.front(), last = part.first.back();
  part.listed.assign(grid.listed.begin() + first, grid.listed.begin() + last);
  part.value.assign(grid.value.begin() + first, grid.value.begin() + last);
  for (std::int64_t& at : part.first) at -= first;
  return part;
}

/// The memberships of the cells of slab s without constants.
GridMemberships read_base(const LayerRun& run, Index s) {
  GridMemberships grid = grid_of(run, slices_of_cells(run, s));
  ArchiveReader archive = run.scratch.read(run.file("memberships", s));
  grid.material = archive.next<Index>();
  grid.first = archive.next<std::int64_t>();
  grid.listed = archive.next<Index>();
  grid.value = archive.next<float>();
  return grid;
}

GridMemberships with_constants(GridMemberships grid, const VolumeMatch& match) {
  const std::vector<float> base = grid.value;
  add_constants(base, match.constants(), grid);
  return grid;
}

/// Appends the nodes of slices that follow.
void append_slices(const GridMemberships& next, GridMemberships& grid) {
  const std::int64_t listed = grid.first.empty() ? 0 : grid.first.back();
  if (grid.first.empty()) grid.first.push_back(0);
  for (std::size_t n = 1; n < next.first.size(); ++n) grid.first.push_back(listed + next.first[n]);
  const auto append = [](const auto& from, auto& to) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(next.material, grid.material);
  append(next.listed, grid.listed);
  append(next.value, grid.value);
}

/// The memberships of some slices with constants, of all slabs that have any.
GridMemberships gather_memberships(const LayerRun& run, const VolumeMatch& match,
                                   const BlockSlices& slices) {
  GridMemberships grid = grid_of(run, slices);
  for (Index s = 0; s < run.count(); ++s) {
    const BlockSlices own = own_slices(run, s);
    const BlockSlices some{std::max(own.begin, slices.begin), std::min(own.end, slices.end)};
    if (some.count() > 0) append_slices(cut_out(run, read_base(run, s), some), grid);
  }
  return with_constants(std::move(grid), match);
}

std::string round_file(const LayerRun& run, const VolumeMatch& match, Index s) {
  return run.file("volumes." + std::to_string(match.report().rounds), s);
}

PartitionPart read_boundaries(const LayerRun& run, Index s) {
  ArchiveReader archive = run.scratch.read(run.file("boundaries", s));
  PartitionPart part;
  part.sites = archive.next<WholeSite>();
  part.surface.points = archive.next<Vec3>();
  part.surface.triangles = archive.next<Triangle>();
  part.surface.sides = archive.next<std::array<Index, 2>>();
  return part;
}

}  // namespace

SlabWork make_part_file(const LayerRun& run) {
  make_item_file<Index>(part_file(run), static_cast<std::size_t>(nodes_in(run, slice_count(run))));
  return {};
}

SlabWork find_parts(const LayerRun& run, Index s) {
  const BlockSlices own = own_slices(run, s);
  const std::vector<std::uint16_t> labels = labels_of(run, own);
  GridMemberships grid = grid_of(run, own);
  LabelParts parts = find_label_parts({grid.size, grid.spacing, labels});
  grid.label = std::move(parts.label);
  std::vector<std::int64_t> nodes(grid.label.size(), 0);
  for (const Index part : parts.of_node) ++nodes[part];
  write_items<Index>(part_file(run), static_cast<std::size_t>(nodes_in(run, own.begin)),
                     parts.of_node);
  ArchiveWriter archive;
  archive.add(grid.label);
  archive.add(nodes);
  archive.add(voxel_eighths(grid, parts.of_node));
  run.scratch.write(run.file("parts", s), archive);
  return work_on(run, own);
}

SlabWork join_parts(const LayerRun& run, Index s) {
  const auto label_of = [&](Index slab) {
    return run.scratch.read(run.file("parts", slab)).next<Index>();
  };
  const std::vector<Index> below_label = label_of(s), above_label = label_of(s + 1);
  const Index cut = run.cuts[static_cast<std::size_t>(s) + 1];
  const std::vector<Index> below = read_own_numbers(run, {cut - 1, cut});
  const std::vector<Index> above = read_own_numbers(run, {cut, cut + 1});
  const auto [nx, ny, nz] = run.block.size;
  std::vector<std::array<Index, 2>> pairs;
  std::size_t n = 0;
  for (Index j = 0; j < ny; ++j) {
    for (Index i = 0; i < nx; ++i, ++n) {
      for (const auto& [di, dj, dk] : kKuhnSteps) {
        if (dk == 0 || i < di || j < dj) continue;
        const Index under = below[n - static_cast<std::size_t>(di + nx * dj)];
        if (below_label[under] == above_label[above[n]]) pairs.push_back({under, above[n]});
      }
    }
  }
  sort_once(pairs);
  ArchiveWriter archive;
  archive.add(pairs);
  run.scratch.write(run.file("pairs", s), archive);
  return work_on(run, {cut - 1, cut + 1});
}

void learn_parts(LayerRun& run) {
  const Index slabs = run.count();
  std::vector<std::vector<Index>> label;
  std::vector<std::vector<std::int64_t>> nodes, eighths;
  std::vector<std::size_t> first{0};
  for (Index s = 0; s < slabs; ++s) {
    ArchiveReader archive = run.scratch.read(run.file("parts", s));
    label.push_back(archive.next<Index>());
    nodes.push_back(archive.next<std::int64_t>());
    eighths.push_back(archive.next<std::int64_t>());
    first.push_back(first.back() + label.back().size());
  }
  DisjointSets sets(first.back());
  for (Index s = 0; s + 1 < slabs; ++s) {
    const auto at = static_cast<std::size_t>(s);
    const auto pairs = run.scratch.read(run.file("pairs", s)).next<std::array<Index, 2>>();
    for (const auto& [below, above] : pairs) {
      sets.unite(first[at] + static_cast<std::size_t>(below),
                 first[at + 1] + static_cast<std::size_t>(above));
    }
  }
  const DisjointSets::Numbers numbers = sets.numbers();
  const auto count = static_cast<std::size_t>(numbers.count);
  run.parts = {{},
               std::vector<Index>(count),
               std::vector<std::int64_t>(count, 0),
               std::vector<std::int64_t>(count, 0)};
  for (std::size_t s = 0; s < label.size(); ++s) {
    const auto from = numbers.of_item.begin() + static_cast<std::ptrdiff_t>(first[s]);
    run.parts.number.emplace_back(from, from + std::ssize(label[s]));
    for (std::size_t p = 0; p < label[s].size(); ++p) {
      const Index part = run.parts.number[s][p];
      run.parts.label[part] = label[s][p];
      run.parts.nodes[part] += nodes[s][p];
      run.parts.eighths[part] += eighths[s][p];
    }
  }
}

SlabWork find_joins(const LayerRun& run, Index s) {
  const BlockSlices own = own_slices(run, s), held = around(run, own, kJoinReach);
  const std::vector<std::uint16_t> labels = labels_of(run, held);
  const GridMemberships grid = grid_of(run, held);
  std::vector<DiagonalJoin> joins =
      find_diagonal_joins({grid.size, grid.spacing, labels}, read_parts(run, held));
  for (DiagonalJoin& join : joins) join.node += nodes_in(run, held.begin);
  std::erase_if(joins, [&](const DiagonalJoin& join) {
    return join.node < nodes_in(run, own.begin) || join.node >= nodes_in(run, own.end);
  });
  ArchiveWriter archive;
  archive.add(joins);
  run.scratch.write(run.file("joins", s), archive);
  return work_on(run, held);
}

void learn_joins(LayerRun& run) {
  std::vector<DiagonalJoin> all;
  for (Index s = 0; s < run.count(); ++s) {
    const auto joins = run.scratch.read(run.file("joins", s)).next<DiagonalJoin>();
    all.insert(all.end(), joins.begin(), joins.end());
  }
  run.joins = choose_joins(all, run.block.size);
}

SlabWork find_wishes(const LayerRun& run, Index s) {
  const BlockSlices own = own_slices(run, s);
  const BlockSlices held = around(run, own, 2 * filter_radius(run.smoothing.sigma_voxel));
  GridMemberships grid = grid_of(run, held);
  grid.material = read_parts(run, held);
  const std::vector<Index> parts = grid.material;
  filter_parts(parts, run.smoothing.sigma_voxel, grid);
  std::vector<Yield> wishes = find_yields(cut_out(run, grid, own));
  shift_nodes(wishes, nodes_in(run, own.begin));
  write_yields(run, "wishes", s, wishes);
  return work_on(run, held);
}

SlabWork let_yield(const LayerRun& run) {
  SlabWork work;
  std::vector<Yield> before;  // of the slabs below
  for (Index s = 0; s < run.count(); ++s) {
    const BlockSlices held = around(run, own_slices(run, s), kYieldReach);
    const std::int64_t first = nodes_in(run, held.begin);
    GridMemberships grid = grid_of(run, held);
    grid.material = read_parts(run, held);
    apply(run, before, held, grid.material);
    std::vector<Yield> wishes = read_yields(run, "wishes", s);
    shift_nodes(wishes, -first);
    std::vector<Yield> done = yield_where_allowed(wishes, run.parts.nodes, grid);
    shift_nodes(done, first);
    write_yields(run, "yields", s, done);
    before.insert(before.end(), done.begin(), done.end());
    work.voxels = std::max(work.voxels, work_on(run, held).voxels);
  }
  return work;
}

SlabWork smooth_slab(const LayerRun& run, Index s) {
  const BlockSlices wanted = slices_of_cells(run, s);
  const BlockSlices held = around(run, wanted, smoothing_reach(run.smoothing));
  GridMemberships grid = grid_of(run, held);
  {
    const std::vector<Index> parts = read_parts(run, held);
    grid.material = parts;
    for (Index other = 0; other < run.count(); ++other) {
      const BlockSlices its = own_slices(run, other);
      if (its.end <= held.begin || its.begin >= held.end) continue;
      apply(run, read_yields(run, "yields", other), held, grid.material);
    }
    filter_parts(parts, run.smoothing.sigma_voxel, grid);
  }
  lift_memberships(grid);
  grid = cut_out(run, grid, wanted);
  ArchiveWriter archive;
  archive.add(grid.material);
  archive.add(grid.first);
  archive.add(grid.listed);
  archive.add(grid.value);
  run.scratch.write(run.file("memberships", s), archive);
  return work_on(run, held);
}

SlabWork measure_slab(const LayerRun& run, const VolumeMatch& match, Index s) {
  const std::vector<LayerVolumes> layers = measure_layers(with_constants(read_base(run, s), match));
  std::vector<Index> counts;
  LayerVolumes all;
  for (const LayerVolumes& layer : layers) {
    counts.push_back(static_cast<Index>(layer.size()));
    all.insert(all.end(), layer.begin(), layer.end());
  }
  ArchiveWriter archive;
  archive.add(counts);
  archive.add(all);
  run.scratch.write(round_file(run, match, s), archive);
  return work_on(run, slices_of_cells(run, s));
}

std::vector<LayerVolumes> layers_of_slabs(const LayerRun& run, const VolumeMatch& match) {
  std::vector<LayerVolumes> layers;
  for (Index s = 0; s < run.count(); ++s) {
    ArchiveReader archive = run.scratch.read(round_file(run, match, s));
    const auto counts = archive.next<Index>();
    const auto all = archive.next<InterfaceVolume>();
    auto at = all.begin();
    for (const Index count : counts) {
      layers.emplace_back(at, at + count);
      at += count;
    }
  }
  return layers;
}

SlabWork extract_slab(const LayerRun& run, const VolumeMatch& match, Index s) {
  const BlockSlices own = own_slices(run, s);
  const BlockSlices of_net{std::max(0, own.begin - 1), std::min(slice_count(run), own.end + 2)};
  const BlockSlices held = run.net ? of_net : slices_of_cells(run, s);
  const GridMemberships grid = gather_memberships(run, match, held);
  const NodeSlices slices{own.begin - held.begin, own.end - held.begin};
  const PartitionPart part =
      run.net ? extract_net_part(grid, slices, *run.net) : extract_partition_part(grid, slices);
  ArchiveWriter archive;
  archive.add(part.sites);
  archive.add(part.surface.points);
  archive.add(part.surface.triangles);
  archive.add(part.surface.sides);
  run.scratch.write(run.file("boundaries", s), archive);
  return work_on(run, held);
}

std::vector<double> label_volumes(const LayerRun& run) {
  std::vector<std::int64_t> eighths;
  for (std::size_t p = 0; p < run.parts.label.size(); ++p) {
    const auto label = static_cast<std::size_t>(run.parts.label[p]);
    if (label >= eighths.size()) eighths.resize(label + 1, 0);
    eighths[label] += run.parts.eighths[p];
  }
  return volumes_of(eighths, run.source.head().spacing);
}

PartitionSurface joined_boundaries(const LayerRun& run) {
  std::vector<PartitionPart> parts(static_cast<std::size_t>(run.count()));
  for (Index s = 0; s < run.count(); ++s) {
    parts[static_cast<std::size_t>(s)] = read_boundaries(run, s);
  }
  return join_parts(std::move(parts));
}

}  // namespace mesamis::detail::slabs
