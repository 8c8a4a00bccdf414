// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/slabs/team.h"

namespace mesamis::detail::parallel {

/// The processes that mpirun or srun has started together.
class MpiTeam : public Team {
 public:
  /// Joins the others. There may be one object of this class in the life of a process.
  /// @param count, arguments  as main() has them.
  /// @throws NumericalError  if MPI cannot be started.
  MpiTeam(int& count, char**& arguments);
  /// Leaves; waits for the others.
  ~MpiTeam() override;
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;

  int size() const noexcept override { return size_; }
  int rank() const noexcept override { return rank_; }
  /// Sleeps until all are there: the others may need the processors.
  void wait_for_all() override;
  /// Ends all processes of the team at once, this one too.
  /// @param status  exit status, above 0.
  [[noreturn]] void end_all(int status);

 private:
  int size_ = 1, rank_ = 0;
};

}  // namespace mesamis::detail::parallel
