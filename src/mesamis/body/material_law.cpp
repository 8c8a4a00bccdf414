// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/material_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"

namespace mesamis {

namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

// Carter and Hayes state E = 3790 strain_rate^0.06 rho^3; this is the usual rate of a slow test.
constexpr double kStrainRate = 0.01;  // 1/s

// Stiffness of one and the same bone by its ash density, with Schileo's rho_ash = 0.6 rho_app.
constexpr double kAshOverApparent = 0.6;

constexpr const char* kMorgan =
    "Morgan, Bayraktar, Keaveny: Trabecular bone modulus-density relationships depend on anatomic "
    "site, J Biomech 36, 2003";
constexpr const char* kMorganDoi = "10.1016/s0021-9290(03)00071-x";

std::vector<MaterialLaw> make_laws() {
  const double carter = 3790 * std::pow(kStrainRate, 0.06);
  const double schileo = 6850 / std::pow(kAshOverApparent, 1.49);
  return {
      {"morgan-2003-femoral-neck",
       DensityKind::kApparent,
       {{kNoEnd, 6850, 1.49}},
       {{0.26, 0.75}},
       0.3,
       kMorgan,
       kMorganDoi},
      {"morgan-2003-pooled",
       DensityKind::kApparent,
       {{kNoEnd, 8920, 1.83}},
       {{0.09, 0.75}},
       0.3,
       kMorgan,
       kMorganDoi},
      {"keyak-1994",
       DensityKind::kAsh,
       {{0.27, 33900, 2.20}, {0.6, 5307, 1, 469}, {kNoEnd, 10200, 2.01}},
       {},
       0.4,
       "Keyak, Lee, Skinner: Correlations between orthogonal mechanical properties and density of "
       "trabecular bone: use of different densitometric measures, J Biomed Mater Res 28, 1994; "
       "above 0.6 g/cm^3 Keller: Predicting the compressive mechanical behavior of bone, J Biomech "
       "27, 1994; joined by a line as in Keyak, Rossi, Jones, Skinner: Prediction of femoral "
       "fracture load using automated finite element modeling, J Biomech 31, 1998"},
      {"carter-hayes-1977",
       DensityKind::kApparent,
       {{kNoEnd, carter, 3}},
       {},
       0.3,
       "Carter, Hayes: The compressive behavior of bone as a two-phase porous structure, J Bone "
       "Joint Surg Am 59, 1977; at a strain rate of 0.01/s"},
      {"schileo-2008",
       DensityKind::kAsh,
       {{kNoEnd, schileo, 1.49}},
       {{0.26 * kAshOverApparent, 0.75 * kAshOverApparent}},
       0.3,
       "Morgan's law of the femoral neck by ash density, with rho_ash = 0.6 rho_app, as used in "
       "Schileo et al.: An accurate estimation of bone density improves the accuracy of "
       "subject-specific finite element models, J Biomech 41, 2008"},
  };
}

std::string names() {
  std::string all;
  for (const MaterialLaw& law : material_laws()) all += (all.empty() ? "" : ", ") + law.name;
  return all;
}

const MaterialLaw* law_named(std::string_view name) {
  const auto& laws = material_laws();
  const auto found = std::find_if(laws.begin(), laws.end(),
                                  [&](const MaterialLaw& law) { return law.name == name; });
  return found == laws.end() ? nullptr : &*found;
}

std::optional<DensityKind> take_density(std::string_view& text) {
  if (take(text, "rho_ash")) return DensityKind::kAsh;
  if (take(text, "rho_qct")) return DensityKind::kQct;
  if (take(text, "rho_app") || take(text, "rho")) return DensityKind::kApparent;
  return std::nullopt;
}

/// The law that the text states; none where it states none.
std::optional<MaterialLaw> power_law(std::string_view text) {
  std::string_view rest = text;
  if (!take(rest, "E=")) return std::nullopt;
  const auto coefficient = take_number(rest);
  if (!coefficient || !take(rest, "*")) return std::nullopt;
  const auto density = take_density(rest);
  if (!density || !take(rest, "^")) return std::nullopt;
  const auto exponent = take_number(rest);
  if (!exponent) return std::nullopt;
  if (!rest.empty() && !rest.starts_with('+')) return std::nullopt;
  const auto offset = rest.empty() ? 0 : take_number(rest);
  if (!offset || !rest.empty()) return std::nullopt;
  if (!(*coefficient > 0 && *exponent > 0 && *offset >= 0)) return std::nullopt;
  MaterialLaw law{std::string(text), *density, {{kNoEnd, *coefficient, *exponent, *offset}}};
  return law;
}

}  // namespace

double modulus_at(const MaterialLaw& law, double density) noexcept {
  const double rho = density < 0 ? 0 : density;
  const auto range = std::find_if(law.ranges.begin(), law.ranges.end() - 1,
                                  [rho](const LawRange& p) { return rho <= p.up_to; });
  return range->offset + range->coefficient * std::pow(rho, range->exponent);
}

const std::vector<MaterialLaw>& material_laws() {
  static const std::vector<MaterialLaw> laws = make_laws();
  return laws;
}

MaterialLaw find_material_law(std::string_view name) {
  if (const MaterialLaw* law = law_named(name)) return *law;
  throw InputError("material law: expected one of " + names() + ", found " + quoted_text(name));
}

MaterialLaw parse_material_law(std::string_view text) {
  if (const MaterialLaw* law = law_named(text)) return *law;
  if (auto law = power_law(text)) return *law;
  throw InputError("material law: expected one of " + names() +
                   ", or E=c*rho^p with c, p > 0 and rho, rho_app, rho_ash or rho_qct, found " +
                   quoted_text(text));
}

}  // namespace mesamis
