// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/files/value_axes.h"
#include "mesamis/volume_files/dicom_series.h"

/// Series that show the same places several times: phases of the heart, times, echoes.
namespace mesamis::detail::volume_files {

/// By what slices at one place may differ: the values of the tags that tell times, phases, echoes
/// and acquisitions, in a fixed order. O(tags).
/// @throws nothing
std::string phase_marks(const DicomFile& file, std::size_t frame);

/// Whether an Instance Number is among the marks that phase_marks() returns. O(1).
/// @throws nothing
bool has_instance_number(const std::string& marks);

/// The stack of one phase.
struct PhaseChoice {
  DicomStack stack;
  std::string note;  ///< which one was taken; empty: there is only one
};

/// Chooses one phase of a stack that has every place equally often.
///
/// Slices of a phase share the value of a tag, or of two tags, by which those at one place differ;
/// else the first at each place, by Instance Number and file, are the first phase, and so on. Any
/// other stack is returned as it is.
/// @param path  begins the message.
/// @throws InputError  as take_value(): the message says what tells the phases, and their values.
///
/// O(slices log slices * tags squared).
PhaseChoice choose_phase(const std::filesystem::path& path, const DicomStack& stack,
                         const ValueChoice& choice);

}  // namespace mesamis::detail::volume_files
