// SPDX-License-Identifier: Apache-2.0
// Compiled where ITK is not installed.
#include "mesamis/base/error.h"
#include "mesamis/baseline/itk_level_set.h"

namespace mesamis::detail::baseline {
namespace {

[[noreturn]] void refuse() {
  throw InputError("geodesic contour: not in this program, which was built without ITK");
}

}  // namespace

bool have_itk() { return false; }
Volume diffused(const Volume&, int, double, const Progress&) { refuse(); }
Volume gradient_magnitude(const Volume&, double) { refuse(); }
Volume signed_distance(const Volume&, double, double) { refuse(); }
EvolutionResult evolved(const Volume&, const Volume&, const Evolution&, const Progress&) {
  refuse();
}

}  // namespace mesamis::detail::baseline
