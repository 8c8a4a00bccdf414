// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/foreign_format.h"

#include <gmock/gmock.h>

#include "support/read_scan.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(ForeignFormat, IsNamedWithAWayOut) {
  EXPECT_EQ(foreign_format("dir/a.CZI"), "a Zeiss CZI file: save it as OME-TIFF (Fiji, bfconvert)");
  EXPECT_EQ(foreign_format("a.mnc"), "a MINC file: convert it to NIfTI (mnc2nii)");
  for (const char* mesh : {"a.inp", "a.feb", "a.msh"}) {
    EXPECT_THAT(foreign_format(mesh), HasSubstr("meshes are read as .vtu and .mesh")) << mesh;
  }
  EXPECT_EQ(foreign_format("a.nii"), "");
  EXPECT_EQ(foreign_format("czi"), "");
}

TEST(ForeignFormat, IsRefusedByItsName) {
  const TempFolder folder;
  EXPECT_THAT(complaint(folder, "a.lif", std::string(600, 'x')),
              AllOf(HasSubstr("expected .nii"), HasSubstr("found a Leica LIF file: save it as")));
}

}  // namespace
}  // namespace mesamis
