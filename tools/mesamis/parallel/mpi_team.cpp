// SPDX-License-Identifier: Apache-2.0
#include "mesamis/parallel/mpi_team.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "mesamis/base/error.h"

namespace mesamis::detail::parallel {

MpiTeam::MpiTeam(int& count, char**& arguments) {
  int provided = 0;
  if (MPI_Init_thread(&count, &arguments, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS) {
    throw NumericalError("MPI cannot be started");
  }
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
}

MpiTeam::~MpiTeam() {
  wait_for_all();
  MPI_Finalize();
}

void MpiTeam::wait_for_all() {
  constexpr auto kFirst = std::chrono::microseconds(50),
                 kLongest = std::chrono::microseconds(20'000);
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  auto pause = kFirst;
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, kLongest);
  }
}

void MpiTeam::end_all(int status) {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::_Exit(status);
}

}  // namespace mesamis::detail::parallel
