// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/profile.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "mesamis/base/error.h"

namespace mesamis::detail::slabs {
namespace {

constexpr std::size_t kFactors = std::tuple_size_v<Complexities>;

std::vector<double> factors() {
  constexpr double kMost = 12;  // of the logarithm
  std::vector<double> all(kFactors);
  for (std::size_t i = 0; i < kFactors; ++i) {
    all[i] = std::exp(kMost * static_cast<double>(i) / (kFactors - 1));
  }
  return all;
}

/// The nodes in each slice of the scan.
std::vector<std::vector<std::size_t>> nodes_of_slices(const SlabPlan& plan, const TetMesh& mesh) {
  std::vector<std::vector<std::size_t>> nodes(static_cast<std::size_t>(plan.whole.size[2]));
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    nodes[plan.slice_at(mesh.points[n].z)].push_back(n);
  }
  return nodes;
}

}  // namespace

Profile profile_of(const SlabPlan& plan, const Piece& own, const SizeControl& sizes) {
  const std::vector<double> mass = lumped_mass_of(own.mesh);
  const auto nodes = nodes_of_slices(plan, own.mesh);
  const auto has_nodes = [](const auto& slice) { return !slice.empty(); };
  const auto first = std::find_if(nodes.begin(), nodes.end(), has_nodes);
  const auto last = std::find_if(nodes.rbegin(), nodes.rend(), has_nodes).base();
  Profile profile{static_cast<Index>(first - nodes.begin()), {}};
  for (auto slice = first; slice < last; ++slice) {
    std::vector<Sym3> metrics;
    std::vector<double> weights;
    for (const std::size_t n : *slice) {
      metrics.push_back(own.nodes[n].metric);
      weights.push_back(mass[n]);
    }
    const auto found = clamped_complexities(metrics, weights, sizes, factors());
    std::copy(found.begin(), found.end(), profile.slices.emplace_back().begin());
  }
  return profile;
}

void add_profile(ArchiveWriter& archive, const Profile& profile) {
  archive.add_one(profile.first_slice);
  archive.add(profile.slices);
}

void add_next_profile(ArchiveReader& archive, std::span<Complexities> sums) {
  const auto first = static_cast<std::size_t>(archive.next_one<Index>());
  const auto slices = archive.next<Complexities>();
  if (first > sums.size() || slices.size() > sums.size() - first) {
    throw InputError("slabs: expected a profile of " + std::to_string(sums.size()) +
                     " slices, found one to slice " + std::to_string(first + slices.size()));
  }
  for (std::size_t k = 0; k < slices.size(); ++k) {
    for (std::size_t i = 0; i < kFactors; ++i) sums[first + k][i] += slices[k][i];
  }
}

Complexities sum_of(std::span<const Complexities> slices) {
  Complexities sum{};
  for (const Complexities& some : slices) {
    for (std::size_t i = 0; i < kFactors; ++i) sum[i] += some[i];
  }
  return sum;
}

double complexity_at(const Complexities& c, double factor) {
  const std::vector<double> all = factors();
  std::size_t i = 1;
  while (i + 1 < kFactors && all[i] < factor) ++i;
  const double share = std::log(factor / all[i - 1]) / std::log(all[i] / all[i - 1]);
  return c[i - 1] > 0 ? c[i - 1] * std::pow(c[i] / c[i - 1], share) : 0;
}

double factor_for(const Complexities& c, double bound) {
  const std::vector<double> all = factors();
  if (c[0] <= bound) return 1;
  std::size_t i = 1;
  while (i + 1 < kFactors && c[i] > bound) ++i;
  const double share = std::log(c[i - 1] / bound) / std::log(c[i - 1] / c[i]);
  return all[i - 1] * std::pow(all[i] / all[i - 1], std::min(share, 1.0));
}

}  // namespace mesamis::detail::slabs
