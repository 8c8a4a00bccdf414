// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/volume_files/tiff_layout.h"

struct tiff;  // libtiff's

/// What the tags of a TIFF page say of the whole file: its description, the size of its voxels, and
/// what the microscopes' programs add.
namespace mesamis::detail::volume_files {

/// ImageDescription; empty if there is none.
std::string description_of(tiff* page);

/// The size of a voxel along x, y, z, from the layout or the tags, mm. Where neither states a length
/// it is 1.
/// @param warnings  gets a line for what was assumed, or looks like the resolution of a screen.
Vec3 spacing_of(tiff* page, const TiffLayout& layout, std::vector<std::string>& warnings);

/// Adds what the tag of Zeiss' LSM files says: the size of a voxel, and how many times there are.
void take_lsm(tiff* page, TiffLayout& layout);

/// Stacks of MetaMorph have planes behind one directory that no other tag counts.
/// @param file  for the message.
/// @throws InputError  for such a stack.
void refuse_metamorph(const std::filesystem::path& file, tiff* page);

}  // namespace mesamis::detail::volume_files
