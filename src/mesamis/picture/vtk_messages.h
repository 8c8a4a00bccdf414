// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <string>

namespace mesamis::detail {

/// While it lives, VTK prints nothing; what it would have called an error is kept instead.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// The first error since the start, as one line without VTK's source positions; empty: none.
  std::string first_error() const;

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkSmartPointer<vtkOutputWindow> collector_;
  int verbosity_before_ = 0;
};

}  // namespace mesamis::detail
