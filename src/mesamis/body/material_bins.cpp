// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/material_bins.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"

namespace mesamis::detail::body {

namespace {

void require_options(const MaterialBinOptions& options) {
  if (!(options.gap >= 0 && std::isfinite(options.gap))) {
    throw InputError("material bins: expected a gap of at least 0 MPa, found " +
                     number_text(options.gap));
  }
  if (!(options.poisson > -1 && options.poisson < 0.5)) {
    throw InputError("material bins: expected a Poisson ratio above -1 and below 0.5, found " +
                     number_text(options.poisson));
  }
}

void require_values(std::span<const double> modulus, std::span<const double> density) {
  if (modulus.empty()) throw InputError("material bins: expected an element, found none");
  if (modulus.size() != density.size()) {
    throw InputError("material bins: expected a density for each of " +
                     std::to_string(modulus.size()) + " elements, found " +
                     std::to_string(density.size()));
  }
  for (std::size_t c = 0; c < modulus.size(); ++c) {
    if (modulus[c] > 0 && std::isfinite(modulus[c]) && std::isfinite(density[c])) continue;
    throw InputError("material bins: expected a positive modulus and a finite density, found " +
                     number_text(modulus[c]) + " MPa and " + number_text(density[c]) +
                     " g/cm^3 at element " + std::to_string(c));
  }
}

/// The elements by falling modulus; equal ones in the order of their index.
std::vector<Index> falling(std::span<const double> modulus) {
  std::vector<Index> order(modulus.size());
  std::iota(order.begin(), order.end(), Index{0});
  const auto of = [&](Index c) { return modulus[static_cast<std::size_t>(c)]; };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return of(a) > of(b); });
  return order;
}

/// From sums to means.
void finish(MaterialBin& bin, const MaterialBinOptions& options) {
  bin.density /= bin.cells;
  const double mean = std::clamp(bin.modulus / bin.cells, bin.modulus_low, bin.modulus_high);
  bin.modulus = options.modulus == BinModulus::kHighest ? bin.modulus_high : mean;
  bin.poisson = options.poisson;
}

}  // namespace

MaterialBins bin_materials(std::span<const double> modulus, std::span<const double> density,
                           const MaterialBinOptions& options) {
  require_options(options);
  require_values(modulus, density);
  MaterialBins result;
  result.of_cell.resize(modulus.size());
  for (const Index c : falling(modulus)) {
    const auto cell = static_cast<std::size_t>(c);
    const double e = modulus[cell];
    if (result.bins.empty() || result.bins.back().modulus_high - e > options.gap) {
      result.bins.emplace_back().modulus_high = e;
    }
    MaterialBin& bin = result.bins.back();
    bin.modulus += e;
    bin.density += density[cell];
    bin.modulus_low = e;
    ++bin.cells;
    result.of_cell[cell] = static_cast<Index>(result.bins.size()) - 1;
  }
  for (MaterialBin& bin : result.bins) finish(bin, options);
  return result;
}

}  // namespace mesamis::detail::body
