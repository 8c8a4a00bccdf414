// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Trees of the Brain Imaging Data Structure: which images a dataset has, and where what is made of
/// them goes.
namespace mesamis {

/// An image of a dataset.
struct BidsImage {
  std::filesystem::path path;  ///< of the file
  std::string name;            ///< in the dataset: "sub-01/ct/sub-01_acq-thin_ct.nii.gz"
  std::string folder;          ///< of it: "sub-01/ct"
  std::string entities;        ///< "sub-01_acq-thin"
  std::string suffix;          ///< "ct"
};

/// Which images are meant. Participants and sessions are labels: "01".
struct BidsFilter {
  std::vector<std::string> participants, sessions;   ///< empty: all
  std::vector<std::string> datatypes{"anat", "ct"};  ///< folders
  std::vector<std::string> suffixes;                 ///< empty: all but those of label maps
};

struct BidsImages {
  std::vector<BidsImage> images;      ///< in the order of their names
  std::vector<std::string> warnings;  ///< of files that are left out, as their names are not BIDS's
};

/// Finds the images of a dataset.
/// @throws InputError  if a folder cannot be read, a participant that is asked for is not there, or
///                     nothing is found.
BidsImages find_images(const std::filesystem::path& dataset, const BidsFilter& filter);

/// The "Name" of a dataset, from its dataset_description.json.
/// @throws InputError  if that file is missing or lacks Name or BIDSVersion.
std::string dataset_name(const std::filesystem::path& dataset);

/// A file made of an image, in a folder of derivatives: "OUT/sub-01/ct/sub-01_desc-ct_mesh.stl".
/// @param ending  suffix and extension: "mesh.stl".
std::filesystem::path derivative_of(const BidsImage& image, const std::filesystem::path& out,
                                    const std::string& desc, const std::string& ending);

/// Makes a folder a dataset of derivatives: dataset_description.json, README and .bidsignore.
/// @param name  of the dataset that the images come from.
/// @throws InputError  if a file cannot be written, or the folder holds a dataset of others.
void write_derivatives(const std::filesystem::path& out, const std::filesystem::path& dataset,
                       const std::string& name);

/// The name of an image as files of the derivatives link to it: "bids:raw:sub-01/ct/...".
std::string uri_of(const BidsImage& image);

}  // namespace mesamis
