# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  atomic_file.h
  sha256.h)
# For the rooms above alone: not installed.
set(ROOM_INNER_HEADERS
  byte_source.h
  bytes.h
  deflate.h
  file_list.h
  in_one_line.h
  number_type.h
  refuse.h
  text_scan.h
  text_writer.h
  xml.h)
set(ROOM_SOURCES
  atomic_file.cpp
  byte_source.cpp
  deflate.cpp
  file_list.cpp
  refuse.cpp
  sha256.cpp
  xml.cpp)
