// SPDX-License-Identifier: Apache-2.0
// Surfaces in DICOM, judged by dciodvfy where it is installed.
#include <gmock/gmock.h>

#include "mesamis/files/dicom_data.h"
#include "mesamis/files/dicom_writer.h"
#include "mesamis/shape_files/file_kind.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "support/external_program.h"
#include "support/shapes.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::Not;

DicomSubject patient() {
  DicomSubject subject;
  subject.patient_name = "M\xc3\xbcller^Eva";
  subject.patient_id = "42";
  subject.birth_date = "19700101";
  subject.sex = "F";
  subject.study_uid = "1.2.5";
  subject.frame_of_reference = "1.2.9";
  subject.source_series = "1.2.7";
  subject.sources = {{"1.2.840.10008.5.1.4.1.1.2", "1.2.6"}};
  return subject;
}

TEST(Encapsulated, ComesBackAsItWasWritten) {
  const TempFolder folder;
  const TriMesh shape = cube({1, 2, 3}, 4);
  for (const char* name : {"a.dcm", "a.obj.dcm", "B.DCM"}) {
    write_surface(folder / name, shape, {.name = "hip"});
    EXPECT_EQ(kind_of(folder / name), FileKind::kSurface);
    const SurfaceFile back = read_surface_file(folder / name);
    EXPECT_EQ(back.frame, Frame::kLps);
    EXPECT_EQ(back.surface.triangles.size(), shape.triangles.size());
    EXPECT_NEAR(check_surface(back.surface).volume, 64, 1e-9);
    EXPECT_EQ(read_object_file(folder / name).objects.size(), 1u);
  }
  // Whatever its name is.
  std::filesystem::rename(folder / "a.dcm", folder / "IM0001");
  EXPECT_EQ(read_surface(folder / "IM0001").triangles.size(), shape.triangles.size());
}

TEST(Encapsulated, CoordinatesAreLpsWhateverTheFrame) {
  const TempFolder folder;
  write_surface(folder / "a.dcm", cube({1, 2, 3}, 4), {.frame = Frame::kRas});
  const SurfaceFile back = read_surface_file(folder / "a.dcm");
  EXPECT_EQ(back.frame, Frame::kLps);
  EXPECT_GE(back.surface.points[0].x, 1);
}

DicomFile parsed(const std::filesystem::path& path) {
  WideBudget budget;
  return read_dicom_file(path, budget);
}

TEST(Encapsulated, BelongsToThePatientThatIsGivenAndElseToNone) {
  const TempFolder folder;
  write_surface(folder / "a.dcm", cube({}, 1), {.name = "hip", .subject = patient()});
  const DicomFile first = parsed(folder / "a.dcm");
  const DicomSet& known = first.elements;
  EXPECT_EQ(text_of(known, 0x00100010), "M\xc3\xbcller^Eva");
  EXPECT_EQ(text_of(known, 0x0020000d), "1.2.5");
  EXPECT_EQ(text_of(known, 0x00200052), "1.2.9");
  EXPECT_EQ(text_of(known.at(0x00420013).items.at(0), 0x00081155), "1.2.6");
  EXPECT_EQ(text_of(known, 0x00420010), "hip");
  write_surface(folder / "b.dcm", cube({}, 1), {});
  const DicomFile second = parsed(folder / "b.dcm");
  const DicomSet& none = second.elements;
  EXPECT_EQ(text_of(none, 0x00100010), "");
  EXPECT_THAT(text_of(none, 0x0020000d), testing::StartsWith("2.25."));
  EXPECT_NE(text_of(none, 0x0020000d), text_of(none, 0x0020000e));
  EXPECT_EQ(none.count(0x00420013), 0u);
  write_surface(folder / "c.dcm", cube({}, 1), {});
  EXPECT_EQ(read_bytes(folder / "b.dcm"), read_bytes(folder / "c.dcm"));
}

TEST(Encapsulated, OfOtherProgramsIsReadInItsUnit) {
  const TempFolder folder;
  const std::string text =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 2 0\n"
      "endloop\nendfacet\nendsolid a\n";
  const auto file = [&](const std::string& unit, const std::string& document) {
    DicomSetWriter set;
    set.set(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.104.3");
    set.set(0x00420011, "OB", document);
    if (!unit.empty()) set.set_items(0x004008ea, {dicom_code({unit, "UCUM", unit})});
    write_bytes(folder / "a.dcm",
                dicom_file_bytes(set, {"1.2.840.10008.5.1.4.1.1.104.3", "1.2.3"}));
    return read_surface(folder / "a.dcm").points[1].x;
  };
  EXPECT_EQ(text.size() % 2, 1u);  // a zero byte makes it even, and no length is stated
  EXPECT_DOUBLE_EQ(file("", text), 2);
  EXPECT_DOUBLE_EQ(file("cm", text), 20);
  EXPECT_DOUBLE_EQ(file("um", text + "\n"), 2e-3);
  EXPECT_REFUSED(file("furlong", text), HasSubstr("expected a Measurement Unit"));
  EXPECT_REFUSED(file("mm", "nothing"), HasSubstr("is not an STL file"));
}

TEST(Encapsulated, OtherDicomFilesAreNoSurfaces) {
  const TempFolder folder;
  DicomSetWriter set;
  set.set(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
  write_bytes(folder / "a.dcm", dicom_file_bytes(set, {"1.2.840.10008.5.1.4.1.1.2", "1.2.3"}));
  EXPECT_EQ(kind_of(folder / "a.dcm"), FileKind::kVolume);
  EXPECT_REFUSED(read_surface(folder / "a.dcm"),
                 HasSubstr("expected an Encapsulated STL or OBJ in DICOM"));
  write_bytes(folder / "b.dcm", "");
  EXPECT_EQ(kind_of(folder / "b.dcm"), FileKind::kVolume);
  EXPECT_EQ(kind_of(folder / "none.dcm"), FileKind::kVolume);
}

TEST(Encapsulated, ObjectsHaveFilesOfTheirOwn) {
  EXPECT_EQ(object_path("x/out.dcm", "hip"), "x/out-hip.dcm");
  EXPECT_EQ(object_path("x/out.obj.dcm", "hip"), "x/out-hip.obj.dcm");
}

TEST(Encapsulated, IsValidForDciodvfy) {
  MESAMIS_REQUIRE_PROGRAM("dciodvfy");
  const TempFolder folder;
  for (const DicomSubject& subject : {DicomSubject{}, patient()}) {  // it does not know OBJ
    write_surface(folder / "a.dcm", cube({}, 1), {.name = "hip", .subject = subject});
    run_in(folder.path(), "dciodvfy a.dcm");
    const std::string said = read_bytes(folder / "log");
    EXPECT_THAT(said, HasSubstr("EncapsulatedSTL"));
    EXPECT_THAT(said, Not(HasSubstr("Error"))) << said;
  }
}

}  // namespace
}  // namespace mesamis
