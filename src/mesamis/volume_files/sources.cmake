# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  chunked_scan.h
  dicom_pixels.h
  dicom_slice.h
  dicom_spacing.h
  formats.h
  nrrd_header.h
  open_slices.h
  read_volume.h
  rounding_record.h
  scan_file.h
  sheared_grid.h
  slice_reader.h
  slice_stack.h
  write_volume.h)
set(ROOM_SOURCES
  bmp_file.cpp
  dicom_file.cpp
  dicom_jpeg.cpp
  dicom_pixels.cpp
  dicom_resample.cpp
  dicom_rle.cpp
  dicom_series.cpp
  dicom_slice.cpp
  dicom_spacing.cpp
  foreign_format.cpp
  grey_pixels.cpp
  inv3_file.cpp
  NEXT gdcm_picture.cpp
  meta_file.cpp
  nrrd_header.cpp
  open_slices.cpp
  png_file.cpp
  raw_file.cpp
  read_volume.cpp
  rounding_record.cpp
  scan_file.cpp
  slice_stack.cpp
  text_header.cpp
  tiff_file.cpp
  write_volume.cpp
  NEXT dicom_phases.cpp
  dicom_store.cpp
  jpeg_file.cpp
  mgh_file.cpp
  sheared_grid.cpp
  sidecar.cpp
  skyscan_log.cpp
  NEXT scanco_file.cpp
  tiff_layout.cpp
  tiff_tags.cpp
  vgi_file.cpp
  NEXT nifti_file.cpp
  spm_matrix.cpp
  NEXT nrrd_file.cpp
  NEXT chunk_array.cpp
  chunk_codec.cpp
  hdf5_file.cpp
  multiscales.cpp
  zarr_array.cpp
  zarr_store.cpp
  NEXT dicom_jpeg8.cpp
  NEXT dicom_jpeg12.cpp
  NEXT dicom_jpeg16.cpp)
