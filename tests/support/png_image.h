// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vtkImageData.h>
#include <vtkPNGReader.h>
#include <vtkSmartPointer.h>

#include <array>
#include <filesystem>

namespace mesamis {

struct Rgb {
  int r, g, b;
  bool is_white() const { return r > 250 && g > 250 && b > 250; }
  bool is_bright_grey() const { return r > 150 && r == g && g == b; }
  bool is_orange() const { return r - b > 60; }
};

/// A picture read back; row 0 is the lowest.
class Image {
 public:
  explicit Image(const std::filesystem::path& png) {
    reader_->SetFileName(png.c_str());
    reader_->Update();
  }
  std::array<int, 2> size() const {
    const int* d = reader_->GetOutput()->GetDimensions();
    return {d[0], d[1]};
  }
  Rgb at(int x, int y) const {
    const auto* p =
        static_cast<const unsigned char*>(reader_->GetOutput()->GetScalarPointer(x, y, 0));
    return {p[0], p[1], p[2]};
  }

 private:
  vtkSmartPointer<vtkPNGReader> reader_ = vtkSmartPointer<vtkPNGReader>::New();
};

}  // namespace mesamis
