# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  mpi_team.h)
set(ROOM_SOURCES
  mpi_team.cpp)
