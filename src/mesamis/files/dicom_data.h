// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/files/memory_budget.h"

/// The data elements of one DICOM file. The parser is our own, so that every length a file claims
/// is checked against the bytes that are there before it is used.
namespace mesamis::detail::files {

using DicomTag = std::uint32_t;  ///< group << 16 | element
using Bytes = std::span<const unsigned char>;

struct DicomElement;
using DicomSet = std::map<DicomTag, DicomElement>;

struct DicomElement {
  Bytes value;                   ///< of an element that is no sequence and has a length
  std::vector<DicomSet> items;   ///< a sequence
  std::vector<Bytes> fragments;  ///< pixel data in capsules, without the offset table
};

namespace dicom {
inline constexpr DicomTag kTransferSyntax = 0x00020010, kCharacterSet = 0x00080005,
                          kImageType = 0x00080008, kModality = 0x00080060,
                          kSeriesDescription = 0x0008103e, kSeriesUid = 0x0020000e,
                          kPosition = 0x00200032, kOrientation = 0x00200037,
                          kFrameOfReference = 0x00200052, kSamplesPerPixel = 0x00280002,
                          kPhotometric = 0x00280004, kFrames = 0x00280008, kRows = 0x00280010,
                          kColumns = 0x00280011, kPixelSpacing = 0x00280030,
                          kBitsAllocated = 0x00280100, kBitsStored = 0x00280101,
                          kHighBit = 0x00280102, kPixelRepresentation = 0x00280103,
                          kIntercept = 0x00281052, kSlope = 0x00281053, kModalityLut = 0x00283000,
                          kPixelData = 0x7fe00010, kFloatPixelData = 0x7fe00008,
                          kDoublePixelData = 0x7fe00009, kSopInstance = 0x00080018,
                          kInstanceNumber = 0x00200013, kSliceLocation = 0x00201041,
                          kFrameIncrement = 0x00280009, kFrameOffsets = 0x3004000c,
                          kDoseScaling = 0x3004000e, kLossy = 0x00282110;
inline constexpr DicomTag kSharedGroups = 0x52009229, kFrameGroups = 0x52009230,
                          kFrameContent = 0x00209111, kPlanePosition = 0x00209113,
                          kPlaneOrientation = 0x00209116, kPixelMeasures = 0x00289110,
                          kPixelTransformation = 0x00289145, kSliceThickness = 0x00180050,
                          kSliceSpacing = 0x00180088, kDetectors = 0x00540022;
// Segmentations.
inline constexpr DicomTag kSopClass = 0x00080016, kSegmentationType = 0x00620001,
                          kSegments = 0x00620002, kSegmentNumber = 0x00620004,
                          kSegmentLabel = 0x00620005, kSegmentIdentification = 0x0062000a,
                          kReferencedSegment = 0x0062000b, kCieLab = 0x0062000d,
                          kMostFraction = 0x0062000e;
// Structure sets of radiotherapy.
inline constexpr DicomTag kReferencedFrames = 0x30060010, kRegions = 0x30060020,
                          kRegionNumber = 0x30060022, kRegionFrame = 0x30060024,
                          kRegionName = 0x30060026, kRegionColour = 0x3006002a,
                          kRegionContours = 0x30060039, kContours = 0x30060040,
                          kContourType = 0x30060042, kContourPoints = 0x30060050,
                          kReferencedRegion = 0x30060084;
}  // namespace dicom

/// A file in memory and its elements, which point into its bytes.
struct DicomFile {
  DicomFile() = default;
  DicomFile(DicomFile&&) = default;
  DicomFile& operator=(DicomFile&&) = default;

  std::filesystem::path path;
  std::vector<unsigned char> bytes;
  std::string transfer_syntax;  ///< its UID; empty: not stated
  bool big_endian = false;      ///< numbers of the data set and native pixels
  DicomSet elements;            ///< up to and including the pixel data
  std::string problem;          ///< why parsing ended early; empty: it did not
};

/// Whether the bytes begin like DICOM: "DICM" behind a preamble, or a first element of group 2
/// or 8.
bool begins_like_dicom(Bytes bytes);

/// Reads and parses a file. `problem` describes broken content; elements before it are kept.
///
/// Memory: the file once, deflated files unpacked, and what its elements take: claimed
/// before it is taken, and held.
/// @throws InputError  if the file cannot be read, and as MemoryBudget::claim().
DicomFile read_dicom_file(const std::filesystem::path& path, MemoryBudget& budget);
/// The same of bytes in memory, which were claimed.
/// @param path  for messages.
DicomFile parse_dicom_file(const std::filesystem::path& path, std::vector<unsigned char> bytes,
                           MemoryBudget& budget);

/// Parses the bytes of a file that are in memory already; else as read_dicom_file(). Memory: they
/// are copied.
DicomFile parse_dicom(const std::filesystem::path& path, std::string_view bytes,
                      MemoryBudget& budget);

/// Text without padding, 64 KiB at most; empty if the element is not there.
std::string text_of(const DicomSet& set, DicomTag tag);
/// An unsigned 16-bit number.
std::optional<int> number_of(const DicomFile& file, const DicomSet& set, DicomTag tag);
/// `count` unsigned 16-bit numbers; none if there are fewer.
std::optional<std::vector<int>> numbers_of(const DicomFile& file, const DicomSet& set, DicomTag tag,
                                           std::size_t count);
/// The decimals of an element, separated by backslashes; none if they are not `count` numbers.
std::optional<std::vector<double>> decimals_of(const DicomSet& set, DicomTag tag,
                                               std::size_t count);
/// The first item of a sequence; null if there is none.
const DicomSet* first_item(const DicomSet& set, DicomTag tag);

}  // namespace mesamis::detail::files
