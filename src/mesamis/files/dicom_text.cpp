// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/dicom_text.h"

namespace mesamis::detail::files {

std::string utf8_text(const DicomFile& file, const DicomSet& item, DicomTag tag) {
  const std::string text = text_of(item, tag);
  if (text_of(file.elements, dicom::kCharacterSet) != "ISO_IR 100") return text;
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xc0 | code >> 6);
      out += static_cast<char>(0x80 | (code & 0x3f));
    }
  }
  return out;
}

}  // namespace mesamis::detail::files
