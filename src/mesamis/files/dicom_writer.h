// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/files/dicom_data.h"

/// The data elements of a DICOM file that is written: explicit little endian.
namespace mesamis::detail::files {

/// A data set, whose elements are written in the order of their tags.
class DicomSetWriter {
 public:
  /// Sets an element; the value is padded to an even length.
  /// @param vr  two letters, not SQ.
  void set(DicomTag tag, std::string_view vr, std::string_view value);
  /// Sets an unsigned 16-bit or 32-bit number (VR US or UL).
  void set_number(DicomTag tag, std::string_view vr, std::uint32_t value);
  /// Sets a sequence of data sets.
  void set_items(DicomTag tag, const std::vector<DicomSetWriter>& items);

  /// The bytes of all elements. O(bytes).
  std::string bytes() const;

 private:
  std::map<DicomTag, std::string> elements_;
};

/// A code of a terminology: value, scheme and meaning, as an item of a code sequence has them.
DicomSetWriter dicom_code(const std::array<std::string_view, 3>& code);

/// A whole file: preamble, meta elements and a data set.
/// @param set  holds the UIDs of its SOP class and instance.
/// @param sop  class and instance.
std::string dicom_file_bytes(const DicomSetWriter& set, const std::array<std::string, 2>& sop);

/// A UID under 2.25 that is made of what it names: the same for the same text, another one for
/// another, but for chance. O(characters).
std::string dicom_uid_of(std::string_view text);

}  // namespace mesamis::detail::files
