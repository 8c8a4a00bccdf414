// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/body_request.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/available_memory.h"
#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/body/rim.h"
#include "mesamis/report/filled_objects.h"

namespace mesamis {
namespace {

/// The skin's tolerance as a share of the element size, where none is given: corners that are as
/// round as scans show them are kept within it.
constexpr double kToleranceOfSize = 0.1;

[[noreturn]] void refuse(const std::string& what, const std::string& expected, double found) {
  throw InputError(what + ": expected " + expected + ", found " + number_text(found));
}

/// @throws InputError  unless the number is finite and 0 or more.
void require_amount(const char* what, double number) {
  if (!(number >= 0 && std::isfinite(number))) refuse(what, "a finite number of 0 or more", number);
}

/// @throws InputError  unless the number lies between others.
void require_range(const char* what, double number, const std::array<double, 2>& range) {
  if (number >= range[0] && number <= range[1]) return;
  refuse(what, number_text(range[0]) + " to " + number_text(range[1]), number);
}

/// A set between objects names two of those that there are.
void require_objects_of(std::span<const FaceQuery> sets, std::span<const FoundObject> objects) {
  for (const FaceQuery& set : sets) {
    const auto last = std::max(set.objects[0], set.objects[1]);
    if (set.kind != FaceQuery::Kind::kBetween || last <= std::ssize(objects)) continue;
    std::string names;
    for (std::size_t n = 0; n < objects.size(); ++n) {
      names += (n > 0 ? ", " : "") + std::to_string(n + 1) + " '" + objects[n].segment.name + "'";
    }
    throw InputError("set " + set.name + ": expected two of the objects " + names + ", found " +
                     std::to_string(last));
  }
}

/// How many elements fit into the memory that the body may take.
std::int64_t most_elements(double memory_gb) {
  constexpr double kBytesPerElement = 600;  // measured, see make_body()
  constexpr double kUnknown = 1e12;
  return static_cast<std::int64_t>(memory_limit(memory_gb).value_or(kUnknown) / kBytesPerElement);
}

}  // namespace

std::string wrong_least_size(const BodyOptions& options) {
  if (options.element_size <= 0 || options.least_size <= options.element_size) return "";
  return "expected at most the element size " + rounded_text(options.element_size) + ", found " +
         rounded_text(options.least_size);
}

void require_valid(const BodyWishes& wishes) {
  const BodyOptions& e = wishes.elements;
  require_amount("element size", e.element_size);
  require_amount("least size", e.least_size);
  if (const std::string wrong = wrong_least_size(e); !wrong.empty()) {
    throw InputError("least size: " + wrong);
  }
  if (const auto& t = wishes.tolerance; t && !(*t > 0 && std::isfinite(*t))) {
    refuse("tolerance", "a finite number above 0", *t);
  }
  require_range("gradation", e.gradation, kGradations);
  require_range("wall elements", e.through_wall, {kWallElements[0], kWallElements[1]});
  if (wishes.rim) require_amount("material rim", *wishes.rim);
  if (!wishes.material) return;
  require_amount("material gap", wishes.material->gap);
  if (const auto& ratio = wishes.material->poisson) {
    require_range("poisson", *ratio, kPoissonRatios);
  }
}

namespace detail::report {

void require_fillable(const Settings& settings, std::optional<double> tolerance) {
  if (settings.surface == SurfaceKind::kBand) {
    throw InputError("surface: expected solid, found band");
  }
  if (tolerance) return;
  if (settings.tolerance && !(*settings.tolerance > 0) && !settings.preview) {
    throw InputError("tolerance: expected one above 0 for the skin, found 0");
  }
  if (settings.triangles && !settings.tolerance) {
    throw InputError("tolerance: expected one beside triangles for the skin, found none");
  }
}

BodyRequest complete_request(const BodyWishes& wishes, std::span<const FoundObject> objects,
                             const BodySource& source) {
  require_valid(wishes);
  require_set_names(wishes.sets);
  require_objects_of(wishes.sets, objects);
  BodyRequest request{wishes.elements, wishes.material, {}, wishes.sets};
  const double of_size = kToleranceOfSize * element_size(wishes.elements, source.grid);
  const double of_run = source.tolerance.value_or(0);  // 0: a preview's
  request.elements.tolerance = wishes.tolerance.value_or(of_run > 0 ? of_run : of_size);
  request.elements.most_elements = most_elements(source.memory_gb);
  if (!wishes.material) return request;
  request.rim = wishes.rim ? Vec3{*wishes.rim, *wishes.rim, *wishes.rim}
                           : rim_depth(source.grid, source.blur);
  return request;
}

std::string loose_parts(std::int64_t parts, std::int64_t objects) {
  if (parts <= objects) return "";
  return "expected " + std::to_string(objects) + " parts at most, found " + std::to_string(parts) +
         " that do not touch; a solver needs supports on each";
}

}  // namespace detail::report

}  // namespace mesamis
