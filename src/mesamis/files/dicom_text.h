// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mesamis/files/dicom_data.h"

namespace mesamis::detail::files {

/// A text of the file in UTF-8. Of the other character sets Latin-1 is converted; ASCII is UTF-8.
///
/// O(characters).
std::string utf8_text(const DicomFile& file, const DicomSet& item, DicomTag tag);

}  // namespace mesamis::detail::files
