// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/length_unit.h"

#include <algorithm>
#include <array>
#include <string>

#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

struct LengthUnit {
  std::string_view name;
  double mm;
};

constexpr double kInch = 25.4;

/// Words are in the singular and in American spelling.
constexpr std::array kUnits{
    LengthUnit{"mm", 1},
    LengthUnit{"millimeter", 1},
    LengthUnit{"um", 1e-3},
    LengthUnit{"\xc2\xb5m", 1e-3},  // micro sign
    LengthUnit{"\xce\xbcm", 1e-3},  // Greek mu
    LengthUnit{"\xb5m", 1e-3},      // Latin-1
    LengthUnit{"\\u00b5m", 1e-3},   // as Java escapes it
    LengthUnit{"micron", 1e-3},
    LengthUnit{"micrometer", 1e-3},
    LengthUnit{"nm", 1e-6},
    LengthUnit{"nanometer", 1e-6},
    LengthUnit{"pm", 1e-9},
    LengthUnit{"picometer", 1e-9},
    LengthUnit{"angstrom", 1e-7},
    LengthUnit{"\xc3\x85", 1e-7},
    LengthUnit{"cm", 10},
    LengthUnit{"centimeter", 10},
    LengthUnit{"dm", 100},
    LengthUnit{"decimeter", 100},
    LengthUnit{"m", 1e3},
    LengthUnit{"meter", 1e3},
    LengthUnit{"km", 1e6},
    LengthUnit{"kilometer", 1e6},
    LengthUnit{"in", kInch},
    LengthUnit{"inch", kInch},
    LengthUnit{"inche", kInch},
    LengthUnit{"\"", kInch},
    LengthUnit{"thou", kInch / 1000},
    LengthUnit{"mil", kInch / 1000},
    LengthUnit{"ft", 12 * kInch},
    LengthUnit{"foot", 12 * kInch},
    LengthUnit{"yd", 36 * kInch},
    LengthUnit{"yard", 36 * kInch},
    LengthUnit{"li", kInch / 12},  // a line, of OME-XML as the next
    LengthUnit{"pt", kInch / 72},
};

std::optional<double> find(std::string_view name) {
  const auto* found = std::find_if(kUnits.begin(), kUnits.end(),
                                   [name](const LengthUnit& unit) { return unit.name == name; });
  return found == kUnits.end() ? std::nullopt : std::optional(found->mm);
}

}  // namespace

std::optional<double> mm_per_unit(std::string_view text) {
  std::string name = lower(trimmed(text));
  const auto british = name.find("metre");
  if (british != std::string::npos) name.replace(british, 5, "meter");
  const auto unit = find(name);
  if (unit || name.size() < 4 || !name.ends_with('s')) return unit;
  name.pop_back();
  return find(name);
}

}  // namespace mesamis::detail::files
