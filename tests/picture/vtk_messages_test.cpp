// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/vtk_messages.h"

#include <gtest/gtest.h>
#include <vtkLogger.h>
#include <vtkPolyData.h>

namespace mesamis::detail {
namespace {

/// Reports an error in the way of VTK's classes.
void report_error(const char* text) {
  auto source = vtkSmartPointer<vtkPolyData>::New();
  vtkErrorWithObjectMacro(source.Get(), << text);
}

void report_warning(const char* text) {
  auto source = vtkSmartPointer<vtkPolyData>::New();
  vtkWarningWithObjectMacro(source.Get(), << text);
}

TEST(VtkMessages, KeepTheFirstErrorInOneLineAndPrintNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::string kept;
  {
    const VtkMessages messages;
    report_error("the file\nis damaged");
    report_error("another error");
    vtkLog(ERROR, "a line of the log");
    kept = messages.first_error();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(kept, "the file is damaged");
}

TEST(VtkMessages, WarningsAreNoErrors) {
  testing::internal::CaptureStderr();
  {
    const VtkMessages messages;
    EXPECT_EQ(messages.first_error(), "");
    report_warning("something is odd");
    EXPECT_EQ(messages.first_error(), "");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(VtkMessages, OfAnInnerScopeAreNotThoseOfTheOuterOne) {
  const VtkMessages outer;
  {
    const VtkMessages inner;
    report_error("inner");
    EXPECT_EQ(inner.first_error(), "inner");
  }
  EXPECT_EQ(outer.first_error(), "");
  report_error("outer");
  EXPECT_EQ(outer.first_error(), "outer");
}

TEST(VtkMessages, VtkIsAsBeforeAfterwards) {
  vtkOutputWindow* window = vtkOutputWindow::GetInstance();
  const auto verbosity = vtkLogger::GetCurrentVerbosityCutoff();
  {
    const VtkMessages messages;
    EXPECT_NE(vtkOutputWindow::GetInstance(), window);
  }
  EXPECT_EQ(vtkOutputWindow::GetInstance(), window);
  EXPECT_EQ(vtkLogger::GetCurrentVerbosityCutoff(), verbosity);
}

}  // namespace
}  // namespace mesamis::detail
