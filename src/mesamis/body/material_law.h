// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// From native grey values to densities, g/cm^3, and from densities to Young's modulus: the laws of
/// the literature, and options.
namespace mesamis {

/// Kinds of density.
enum class DensityKind {
  kQct,       ///< of the calibration phantom's mineral (K2HPO4 or hydroxyapatite) per volume
  kAsh,       ///< ash mass per volume of tissue, pores included
  kApparent,  ///< wet mass per volume of tissue, pores included
};

/// The name of a kind of density: "QCT", "ash" or "apparent".
const char* density_name(DensityKind kind) noexcept;

/// A density as a linear function of the native value: rho = offset + slope * native.
struct Calibration {
  double offset = 0;  ///< g/cm^3
  double slope = 0;   ///< g/cm^3 per native unit, > 0

  /// The density of a native value, g/cm^3; it may be negative.
  double at(double native) const noexcept { return offset + slope * native; }
  friend bool operator==(const Calibration&, const Calibration&) = default;
};

/// A native value whose density is known.
struct CalibrationPoint {
  double native = 0;   ///< native units
  double density = 0;  ///< g/cm^3
};

/// Finds the line through two points.
/// @param first, second  finite, in native units and g/cm^3.
/// @throws InputError  unless the density rises with the native value.
Calibration calibration_through(const CalibrationPoint& first, const CalibrationPoint& second);

/// Reads a calibration: "a,b" for a + b * native, or "HU1:rho1,HU2:rho2" for the line through two
/// points.
/// @param text  native units and g/cm^3; no blanks.
/// @throws InputError  if the text is neither, or the density does not rise with the native value.
Calibration parse_calibration(std::string_view text);

/// The ash density as a linear function of the QCT density.
struct AshRule {
  double offset = 0;  ///< g/cm^3
  double slope = 1;   ///< no unit, > 0

  /// The ash density of a QCT density, both in g/cm^3.
  constexpr double at(double qct) const noexcept { return offset + slope * qct; }
  friend bool operator==(const AshRule&, const AshRule&) = default;
};

/// rho_ash = rho_QCT.
inline constexpr AshRule kAshEqualsQct{};
/// rho_ash = 0.877 rho_QCT + 0.079. Source: Schileo et al., An accurate estimation of bone density
/// improves the accuracy of subject-specific finite element models, J Biomech 41, 2008.
inline constexpr AshRule kSchileoAsh2008{0.079, 0.877};

/// Finds the rule of a name: "equal" or "schileo-2008".
/// @throws InputError  naming the names there are.
AshRule find_ash_rule(std::string_view name);

/// Conversions between kinds of density.
struct DensityModel {
  Calibration qct;                 ///< native values to QCT density
  AshRule ash = kSchileoAsh2008;   ///< QCT to ash density
  double ash_over_apparent = 0.6;  ///< no unit, > 0; the ratio of Schileo 2008
};

/// Composes the steps from native values to a kind of density: all of them are linear.
/// @return g/cm^3 and g/cm^3 per native unit.
/// @throws InputError  if a slope or the ratio is not positive and finite, or an offset not finite.
Calibration calibration_to(DensityKind kind, const DensityModel& model);

/// One range of densities of a law: E = offset + coefficient * rho^exponent.
struct LawRange {
  double up_to;        ///< g/cm^3; the range holds up to this density, included
  double coefficient;  ///< MPa per (g/cm^3)^exponent
  double exponent;     ///< no unit
  double offset = 0;   ///< MPa
};

/// A material law. docs/materials.md says what was checked.
struct MaterialLaw {
  std::string name;
  DensityKind density = DensityKind::kApparent;  ///< that the law takes
  std::vector<LawRange> ranges;                  ///< at least one, in increasing order of up_to
  /// g/cm^3: the densities of the specimens; none: not known.
  std::optional<std::array<double, 2>> valid{};
  double poisson = 0.3;    ///< no unit; the usual choice beside the law, not part of it
  std::string citation{};  ///< authors, title, journal, year
  std::string doi{};       ///< empty: not certain
};

/// The modulus at a density, MPa.
/// @param density  g/cm^3, of the kind that the law takes; below 0 it counts as 0.
double modulus_at(const MaterialLaw& law, double density) noexcept;

/// The laws that have a name. O(1): the table is made once.
const std::vector<MaterialLaw>& material_laws();

/// Finds the law of a name.
/// @throws InputError  naming the names there are.
MaterialLaw find_material_law(std::string_view name);

/// Reads a law: a name of material_laws(), or a power law "E=c*rho^p" or "E=c*rho^p+d" of the
/// user's own, whose density is rho or rho_app (apparent), rho_ash or rho_qct.
/// @param text  c and d in MPa for densities in g/cm^3; c > 0, p > 0, d >= 0; no blanks.
/// @return a law of the user's own has the text as its name, and no citation.
/// @throws InputError  naming the names there are and the form of a power law.
MaterialLaw parse_material_law(std::string_view text);

/// The modulus of the elements of a bin.
enum class BinModulus {
  kHighest,  ///< of its elements, as Bonemat does
  kMean,     ///< of its elements, each counted once
};

/// From grey values to materials. The law and the calibration have no default: both depend on the
/// bone, the scanner and its phantom.
struct MaterialOptions {
  std::optional<MaterialLaw> law{};          ///< see parse_material_law(); needed
  std::optional<Calibration> calibration{};  ///< native to QCT, see parse_calibration(); needed
  AshRule ash = kSchileoAsh2008;             ///< QCT to ash density
  double ash_over_apparent = 0.6;            ///< no unit, > 0
  double density_min = 0;                    ///< g/cm^3, of the kind the law takes
  double density_max = std::numeric_limits<double>::infinity();  ///< g/cm^3, of that kind
  double modulus_min = 0.01;                                     ///< MPa, > 0
  double gap = 50;  ///< MPa between the ends of a bin, >= 0
  BinModulus bin_modulus = BinModulus::kHighest;
  std::optional<double> poisson{};  ///< no unit; none: the law's
};

}  // namespace mesamis
