// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/page_files.h"

#include <array>

#include "mesamis/files/atomic_file.h"
#include "mesamis/files/output_set.h"
#include "mesamis/page/run_page.h"

namespace mesamis {
namespace {

constexpr std::array kPictures{"surface-front.png",   "surface-left.png", "surface-top.png",
                               "surface-oblique.png", "slice-axial.png",  "slice-coronal.png",
                               "slice-sagittal.png",  "mesh-cut.png"};

}  // namespace

std::vector<std::filesystem::path> page_outputs(const PageFiles& files) {
  std::vector<std::filesystem::path> outputs;
  if (!files.html.empty()) outputs.push_back(files.html);
  if (files.pictures.empty()) return outputs;
  for (const char* name : kPictures) outputs.push_back(files.pictures / name);
  return outputs;
}

void write_page(const PageFiles& files, const RunPage& page, OutputSet& set) {
  if (!files.html.empty()) write_run_page(set.file(files.html), page);
  if (files.pictures.empty()) return;
  std::filesystem::create_directory(files.pictures);
  for (const RunPicture& picture : run_pictures(page)) {
    write_file(set.file(files.pictures / picture.name), picture.png);
  }
}

}  // namespace mesamis
