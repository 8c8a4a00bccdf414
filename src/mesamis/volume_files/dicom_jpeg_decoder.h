// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mesamis/volume_files/dicom_jpeg.h"

/// The decoder of one precision. Each dicom_jpeg<BITS>.cpp includes the jpeglib.h of that
/// precision before this header: the three libraries share their names, not their sample types. The
/// template's argument tells their decoders apart.
namespace mesamis::detail::volume_files {

/// The library's state. Errors leave through `escape_`, warnings are counted, nothing is printed.
template <int kPrecision>
class JpegDecoder {
 public:
  JpegDecoder(Bytes picture, const PictureHeader& header) : picture_(picture), header_(header) {
    line_.resize(static_cast<std::size_t>(header.columns));
    samples_.resize(line_.size() * static_cast<std::size_t>(header.rows));
    connect();
  }

  std::optional<JpegSamples> decode() {
    const bool done = run();
    jpeg_destroy_decompress(&info_);
    if (!done) return std::nullopt;
    return JpegSamples{std::move(samples_), errors_.num_warnings == 0};
  }

 private:
  [[noreturn]] static void on_error(j_common_ptr info) {
    std::longjmp(static_cast<JpegDecoder*>(info->client_data)->escape_, 1);
  }
  static void on_message(j_common_ptr info, int level) {
    if (level < 0) ++info->err->num_warnings;
  }
  static void print_nothing(j_common_ptr) {}
  static void do_nothing(j_decompress_ptr) {}

  /// Behind the end of the data: an end marker, and the picture is not intact.
  static boolean supply_end(j_decompress_ptr info) {
    static constexpr std::array<JOCTET, 2> kEnd{0xff, JPEG_EOI};
    info->src->next_input_byte = kEnd.data();
    info->src->bytes_in_buffer = kEnd.size();
    ++info->err->num_warnings;
    return TRUE;
  }

  static void skip(j_decompress_ptr info, long count) {
    if (count <= 0) return;
    const std::size_t step = std::min(static_cast<std::size_t>(count), info->src->bytes_in_buffer);
    info->src->next_input_byte += step;
    info->src->bytes_in_buffer -= step;
  }

  void connect() {
    info_.client_data = this;
    info_.err = jpeg_std_error(&errors_);
    errors_.error_exit = on_error;
    errors_.emit_message = on_message;
    errors_.output_message = print_nothing;
    source_.next_input_byte = picture_.data();
    source_.bytes_in_buffer = picture_.size();
    source_.init_source = do_nothing;
    source_.fill_input_buffer = supply_end;
    source_.skip_input_data = skip;
    source_.resync_to_restart = jpeg_resync_to_restart;
    source_.term_source = do_nothing;
  }

  /// longjmp() comes back here; the functions that it leaves have no destructors to run.
  bool run() {
    if (setjmp(escape_) != 0) return false;
    jpeg_create_decompress(&info_);
    info_.client_data = this;
    info_.src = &source_;
    jpeg_read_header(&info_, TRUE);
    jpeg_start_decompress(&info_);
    if (info_.output_width != static_cast<JDIMENSION>(header_.columns) ||
        info_.output_height != static_cast<JDIMENSION>(header_.rows) ||
        info_.output_components != 1 || info_.data_precision != header_.bits) {
      return false;
    }
    read_lines();
    jpeg_finish_decompress(&info_);
    return true;
  }

  void read_lines() {
    JSAMPROW line = line_.data();
    std::uint16_t* out = samples_.data();
    while (info_.output_scanline < info_.output_height) {
      jpeg_read_scanlines(&info_, &line, 1);
      for (const JSAMPLE sample : line_) *out++ = static_cast<std::uint16_t>(sample);
    }
  }

  jpeg_decompress_struct info_{};
  jpeg_error_mgr errors_{};
  jpeg_source_mgr source_{};
  std::jmp_buf escape_{};
  Bytes picture_;
  PictureHeader header_;
  std::vector<JSAMPLE> line_;
  std::vector<std::uint16_t> samples_;
};

}  // namespace mesamis::detail::volume_files
