// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// From native grey values to the densities that laws of stiffness are stated in, g/cm^3.
namespace mesamis {

/// Which density a number is.
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

/// rho_ash = rho_QCT: the phantom is taken at its word.
inline constexpr AshRule kAshEqualsQct{};
/// rho_ash = 0.877 rho_QCT + 0.079. Source: Schileo et al., An accurate estimation of bone density
/// improves the accuracy of subject-specific finite element models, J Biomech 41, 2008.
inline constexpr AshRule kSchileoAsh2008{0.079, 0.877};

/// Finds the rule of a name: "equal" or "schileo-2008".
/// @throws InputError  naming the names there are.
AshRule find_ash_rule(std::string_view name);

/// How densities of one kind follow from another.
struct DensityModel {
  Calibration qct;                 ///< native values to QCT density
  AshRule ash = kSchileoAsh2008;   ///< QCT to ash density
  double ash_over_apparent = 0.6;  ///< no unit, > 0; the ratio of Schileo 2008
};

/// Composes the steps from native values to a kind of density: all of them are linear.
/// @return g/cm^3 and g/cm^3 per native unit.
/// @throws InputError  if a slope or the ratio is not positive and finite, or an offset not finite.
Calibration calibration_to(DensityKind kind, const DensityModel& model);

}  // namespace mesamis
