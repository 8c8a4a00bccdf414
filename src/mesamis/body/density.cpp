// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/body/material_law.h"

namespace mesamis {

namespace {

[[noreturn]] void refuse_calibration(std::string_view text) {
  throw InputError("calibration: expected a,b or HU1:rho1,HU2:rho2, found " + quoted_text(text));
}

/// The number that follows a mark.
double number_after(std::string_view mark, std::string_view& rest, std::string_view text) {
  if (!take(rest, mark)) refuse_calibration(text);
  const auto number = take_number(rest);
  if (!number) refuse_calibration(text);
  return *number;
}

void require_positive(double value, const char* what) {
  if (value > 0 && std::isfinite(value)) return;
  throw InputError(std::string("density: expected a positive ") + what + ", found " +
                   number_text(value));
}

void require_finite(double value, const char* what) {
  if (std::isfinite(value)) return;
  throw InputError(std::string("density: expected a finite ") + what + ", found " +
                   number_text(value));
}

}  // namespace

const char* density_name(DensityKind kind) noexcept {
  switch (kind) {
    case DensityKind::kQct:
      return "QCT";
    case DensityKind::kAsh:
      return "ash";
    case DensityKind::kApparent:
      break;
  }
  return "apparent";
}

Calibration calibration_through(const CalibrationPoint& first, const CalibrationPoint& second) {
  const double slope = (second.density - first.density) / (second.native - first.native);
  if (!(slope > 0 && std::isfinite(slope))) {
    throw InputError("calibration: expected a density that rises with the native value, found " +
                     number_text(first.native) + ":" + number_text(first.density) + "," +
                     number_text(second.native) + ":" + number_text(second.density));
  }
  return {first.density - slope * first.native, slope};
}

Calibration parse_calibration(std::string_view text) {
  std::string_view rest = text;
  const double first = number_after("", rest, text);
  if (rest.starts_with(',')) {
    const Calibration line{first, number_after(",", rest, text)};
    if (!rest.empty()) refuse_calibration(text);
    require_positive(line.slope, "slope b of the calibration");
    return line;
  }
  const double first_density = number_after(":", rest, text);
  const double second = number_after(",", rest, text);
  const double second_density = number_after(":", rest, text);
  if (!rest.empty()) refuse_calibration(text);
  return calibration_through({first, first_density}, {second, second_density});
}

AshRule find_ash_rule(std::string_view name) {
  if (name == "equal") return kAshEqualsQct;
  if (name == "schileo-2008") return kSchileoAsh2008;
  throw InputError("ash density: expected equal or schileo-2008, found " + quoted_text(name));
}

Calibration calibration_to(DensityKind kind, const DensityModel& model) {
  require_finite(model.qct.offset, "offset of the calibration");
  require_positive(model.qct.slope, "slope of the calibration");
  if (kind == DensityKind::kQct) return model.qct;
  require_finite(model.ash.offset, "offset of the ash density");
  require_positive(model.ash.slope, "slope of the ash density");
  Calibration line{model.ash.at(model.qct.offset), model.ash.slope * model.qct.slope};
  if (kind == DensityKind::kAsh) return line;
  require_positive(model.ash_over_apparent, "ratio of ash to apparent density");
  return {line.offset / model.ash_over_apparent, line.slope / model.ash_over_apparent};
}

}  // namespace mesamis
