# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  grid_space.h
  mesh_space.h
  p1_space.h
  solve.h
  sparse_matrix.h
  spd_operator.h
  transfer.h)
set(ROOM_SOURCES
  cell_quadrature.cpp
  grid_space.cpp
  matrix_operator.cpp
  mesh_space.cpp
  multigrid.cpp
  solve.cpp
  sparse_matrix.cpp
  transfer.cpp)
