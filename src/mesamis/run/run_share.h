// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesamis/rooms.h"

/// How much of a run is done, from the stages that its Progress names.
namespace mesamis::detail::run {

/// A stage with its share of the time.
struct StageShare {
  std::string name;  ///< how the stage's name begins: "adaptation 2 of"
  double share;      ///< of the run, in any unit, > 0
};

/// What decides which stages a run has.
struct RunStages {
  bool labels = false;    ///< several objects: of labels, or of several seeds
  bool scan = true;       ///< false: the labels alone
  bool preview = false;   ///< see Settings::preview
  bool mesh = true;       ///< one object always has one, but for a preview
  bool elements = false;  ///< see ElementRequest::wanted()
  bool slabs = false;     ///< see segment_in_slabs(), segment_labels_in_slabs()
};

/// The stages of a run in their order, with the shares that they took in runs that were measured.
/// "reading" comes first and "writing" last: the caller of segment() tells them.
std::vector<StageShare> stage_shares(const RunStages& run);

/// Adds up the stages of one run.
class RunShare {
 public:
  /// @param stages  in their order; empty: nothing is known of the run as a whole.
  explicit RunShare(std::vector<StageShare> stages);

  /// Whether the stages are known.
  bool is_known() const { return !stages_.empty(); }
  /// The share of the run that is done, 0 to 1, never less than before. A stage that is not in the
  /// list changes nothing; one that was passed over counts as done.
  /// @param fraction  of the stage, 0 to 1.
  double done(std::string_view stage, double fraction);

 private:
  std::vector<StageShare> stages_;
  std::size_t current_ = 0;
  double before_ = 0;  ///< shares of the stages before the current one
  double all_ = 0;     ///< the sum of the shares
  double done_ = 0;
};

}  // namespace mesamis::detail::run
