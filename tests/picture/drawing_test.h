// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "mesamis/printing/child_process.h"
#include "support/variable.h"
#include "virtual_display.h"

namespace mesamis {

/// A test that draws: it has a virtual display of its own, which DISPLAY names, or is skipped where
/// Xvfb is not installed.
class DrawingTest : public testing::Test {
 protected:
  void SetUp() override {
    if (find_program("Xvfb").empty())
      GTEST_SKIP() << "Xvfb, which is needed to draw, is not installed";
    display_ = std::make_unique<VirtualDisplay>();
    variable_ = std::make_unique<Variable>("DISPLAY", display_->name());
  }

  const std::string& display() const { return display_->name(); }

 private:
  std::unique_ptr<VirtualDisplay> display_;
  std::unique_ptr<Variable> variable_;
};

}  // namespace mesamis
