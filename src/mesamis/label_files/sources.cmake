# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  label_table.h
  read_labels.h
  write_labels.h)
set(ROOM_SOURCES
  cielab.cpp
  dicom_seg.cpp
  label_table.cpp
  label_values.cpp
  nifti_labels.cpp
  nrrd_segments.cpp
  read_labels.cpp
  seg_file.cpp
  seg_grid.cpp
  write_labels.cpp)
