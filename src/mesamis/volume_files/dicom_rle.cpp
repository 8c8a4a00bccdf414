// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_rle.h"

#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

/// One RLE segment (PackBits) fills `out`, whose bytes lie `stride` apart.
bool unpack_segment(Bytes in, unsigned char* out, std::size_t count, std::size_t stride) {
  std::size_t at = 0, done = 0;
  while (done < count && at < in.size()) {
    const int n = static_cast<signed char>(in[at++]);  // NOLINT(bugprone-signed-char-misuse)
    if (n == -128) continue;
    const auto run = static_cast<std::size_t>(n >= 0 ? n + 1 : 1 - n);
    const std::size_t stored = n >= 0 ? run : 1;
    if (run > count - done || stored > in.size() - at) return false;
    for (std::size_t i = 0; i < run; ++i) out[(done + i) * stride] = in[at + (n >= 0 ? i : 0)];
    at += stored;
    done += run;
  }
  return done == count;
}

std::size_t little32(Bytes in, std::size_t at) {
  return std::size_t{in[at]} | std::size_t{in[at + 1]} << 8 | std::size_t{in[at + 2]} << 16 |
         std::size_t{in[at + 3]} << 24;
}

}  // namespace

std::vector<unsigned char> decode_rle(const std::filesystem::path& file, Bytes packed,
                                      std::size_t pixels, std::size_t width) {
  if (packed.size() < 64 || little32(packed, 0) != width) {
    refuse(file, message("expected RLE pixels in ", width, " segments"));
  }
  std::vector<unsigned char> out(pixels * width);
  for (std::size_t s = 0; s < width; ++s) {
    const std::size_t begin = little32(packed, 4 + 4 * s);
    const std::size_t end = s + 1 < width ? little32(packed, 8 + 4 * s) : packed.size();
    if (begin < 64 || begin > end || end > packed.size() ||
        !unpack_segment(packed.subspan(begin, end - begin), out.data() + (width - 1 - s), pixels,
                        width)) {
      refuse(file, message("the RLE pixels are broken in segment ", s));
    }
  }
  return out;
}

}  // namespace mesamis::detail::volume_files
