# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  chunked_scan.h)
set(ROOM_SOURCES
  chunk_array.cpp
  chunk_codec.cpp
  hdf5_file.cpp
  multiscales.cpp
  zarr_array.cpp
  zarr_store.cpp)
