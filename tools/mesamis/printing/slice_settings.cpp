// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/slice_settings.h"

#include <sstream>

#include "mesamis/base/error.h"

namespace mesamis::detail::printing {
namespace {

struct Range {
  const char* name;
  double lowest, highest;
  const char* unit;
};

void require_in(const Range& range, double value) {
  if (value >= range.lowest && value <= range.highest) return;
  std::ostringstream message;
  message << range.name << ": expected " << range.lowest << " to " << range.highest << range.unit
          << ", found " << value;
  throw InputError(message.str());
}

}  // namespace

void require_valid(const SliceSettings& settings) {
  require_in({"layer", kLayerMin, kNozzle, " mm"}, settings.layer);
  require_in({"infill", 0, 100, " percent"}, settings.infill);
  require_in({"perimeters", 0, kPerimetersMax, ""}, settings.perimeters);
  require_valid(settings.bed);
}

}  // namespace mesamis::detail::printing
