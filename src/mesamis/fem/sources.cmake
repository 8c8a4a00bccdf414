# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  amis.h
  functional.h
  grid_amis.h
  grid_mass.h
  grid_space.h
  mesh_space.h
  p1_space.h
  single_grid_system.h
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
  single_grid_system.cpp
  solve.cpp
  sparse_matrix.cpp
  transfer.cpp
  NEXT amis.cpp
  functional.cpp
  grid_amis.cpp)
