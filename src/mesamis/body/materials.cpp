// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/materials.h"

#include <algorithm>

#include "mesamis/base/error.h"
#include "mesamis/body/element_moduli.h"
#include "mesamis/image/grey_values.h"

namespace mesamis::detail::body {
namespace {

void require_given(const VolumeView& volume, const MaterialOptions& options) {
  if (!options.law) throw InputError("materials: expected a law of stiffness, found none");
  if (options.calibration) return;
  const bool hu = !volume.samples.empty() && is_hounsfield(volume);
  throw InputError(
      std::string("materials: expected a calibration from grey values to density (a,b or "
                  "HU1:rho1,HU2:rho2), found none for a scan ") +
      (hu ? "in HU" : "whose values are not HU"));
}

ElementModuliOptions moduli_options(const MaterialOptions& options) {
  const DensityModel model{*options.calibration, options.ash, options.ash_over_apparent};
  ElementModuliOptions result;
  result.law = *options.law;
  result.calibration = calibration_to(options.law->density, model);
  result.density_min = options.density_min;
  result.density_max = options.density_max;
  result.modulus_min = options.modulus_min;
  return result;
}

MaterialReport report_of(const ElementModuliOptions& options, const ElementModuli& moduli) {
  const MaterialLaw& law = options.law;
  MaterialReport report{law.name, law.citation, law.doi, law.density, options.calibration};
  report.share_below_min = moduli.share_below_min;
  report.share_above_max = moduli.share_above_max;
  if (law.valid) report.share_outside_law = moduli.share_outside_law;
  report.share_of_modulus_min = moduli.share_of_modulus_min;
  return report;
}

double apparent_density(double density, DensityKind kind, const MaterialOptions& options) {
  if (kind == DensityKind::kApparent) return density;
  const double ash = kind == DensityKind::kQct ? options.ash.at(density) : density;
  return ash / options.ash_over_apparent;
}

/// A number from 1 with leading zeros.
std::string numbered(std::size_t number, std::size_t digits) {
  const std::string text = std::to_string(number);
  return "MAT_" + std::string(digits - std::min(digits, text.size()), '0') + text;
}

}  // namespace

Materials assign_materials(const TetMesh& mesh, const VolumeView& volume,
                           const MaterialOptions& options) {
  require_given(volume, options);
  const ElementModuliOptions how = moduli_options(options);
  ElementModuli moduli = element_moduli(mesh, volume, how);
  const MaterialBinOptions bins{options.gap, options.bin_modulus,
                                options.poisson.value_or(options.law->poisson)};
  Materials result;
  result.report = report_of(how, moduli);
  result.bins = bin_materials(moduli.modulus, moduli.density, bins);
  result.modulus = std::move(moduli.modulus);
  result.density = std::move(moduli.density);
  return result;
}

std::vector<FiniteElements::Elastic> elastic_materials(const Materials& materials,
                                                       const MaterialOptions& options) {
  const auto& bins = materials.bins.bins;
  const std::size_t digits = std::max<std::size_t>(3, std::to_string(bins.size()).size());
  std::vector<FiniteElements::Elastic> result;
  for (const MaterialBin& bin : bins) {
    const double density = apparent_density(bin.density, materials.report.density, options);
    result.push_back({numbered(result.size() + 1, digits), bin.modulus, bin.poisson, density});
  }
  return result;
}

}  // namespace mesamis::detail::body
