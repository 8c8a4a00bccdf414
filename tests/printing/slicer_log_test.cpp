// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/slicer_log.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

TEST(SlicerLog, FailuresAreNamedByTheirOwnLine) {
  EXPECT_EQ(failure_line("[x] [trace]   Initializing StaticPrintConfigs\n"
                         "10 => Processing triangulated mesh\n"
                         "No layers were detected. Repair it.\n\n"),
            "No layers were detected. Repair it.");
  EXPECT_EQ(failure_line("terminate called after throwing an instance of 'E'\n"
                         "  what():  Objects could not fit on the bed\nlast\n"),
            "what():  Objects could not fit on the bed");
  EXPECT_EQ(failure_line("88 => Generating skirt and brim\n"
                         "There is an object with no extrusions in the first layer.\n"
                         "Object name: surface.stl\n"),
            "There is an object with no extrusions in the first layer. Object name: surface.stl");
  EXPECT_EQ(failure_line("[ERROR] Failed to load model: a.stl.\nUsage\n"),
            "[ERROR] Failed to load model: a.stl.");
  EXPECT_EQ(failure_line("error: " + std::string(500, 'x')).size(), 200u);
  EXPECT_EQ(failure_line("error: \x1b[31mred\n"), "error:  [31mred");
  EXPECT_EQ(failure_line(""), "");
}

TEST(SlicerLog, ALineHasNoControlCharacters) {
  EXPECT_EQ(one_log_line("a\tb\x7f\r\n"), "a b");
  EXPECT_EQ(one_log_line("two\nlines  "), "two lines");
  EXPECT_EQ(one_log_line(""), "");
}

}  // namespace
}  // namespace mesamis
