// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/dicom_text.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

std::string converted(const std::string& text, const std::string& character_set) {
  const auto bytes = [](const std::string& s) {
    return Bytes(reinterpret_cast<const unsigned char*>(s.data()), s.size());
  };
  DicomFile file;
  file.elements[dicom::kCharacterSet].value = bytes(character_set);
  file.elements[dicom::kSegmentLabel].value = bytes(text);
  return utf8_text(file, file.elements, dicom::kSegmentLabel);
}

TEST(DicomText, Latin1BecomesUtf8) {
  EXPECT_EQ(converted("H\xfc"
                      "fte ",
                      "ISO_IR 100"),
            "H\xc3\xbc"
            "fte");
  EXPECT_EQ(converted("H\xc3\xbc"
                      "fte",
                      "ISO_IR 192"),
            "H\xc3\xbc"
            "fte");
  EXPECT_EQ(converted("hip", ""), "hip");
}

}  // namespace
}  // namespace mesamis
