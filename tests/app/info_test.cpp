// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/object_files.h"
#include "support/contour_bytes.h"
#include "support/picture_bytes.h"
#include "support/run_program.h"
#include "support/scan_bytes.h"
#include "support/seg_bytes.h"
#include "support/shapes.h"
#include "support/test_data.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Info, DescribesAVolumeInOneLine) {
  const TempFolder folder;
  write_bytes(folder / "v.nrrd",
              "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n"
              "space: left-posterior-superior\nspace directions: (0.5,0,0) (0,1,0) (0,0,2)\n"
              "space origin: (0,0,0)\n\nABCDEFGHIJKLMNOPQRSTUVWX");
  const ProgramRun run = run_program(folder, {"info", folder / "v.nrrd"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1);
  EXPECT_THAT(run.out, HasSubstr("NRRD"));
  EXPECT_THAT(run.out, HasSubstr("2 x 3 x 4 voxels of 0.5 x 1 x 2 mm"));
  EXPECT_THAT(run.out,
              HasSubstr("axes LPS, origin 0 0 0 mm, directions 1 0 0, 0 1 0, 0 0 1 (LPS)"));
  EXPECT_THAT(run.out, HasSubstr("values 65 to 88\n"));
}

std::string nrrd_of(const std::string& directions, const std::vector<std::int16_t>& samples) {
  return "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nendian: little\n"
         "space: left-posterior-superior\nspace directions: " +
         directions + "\nspace origin: (1,2,3)\n\n" + bytes_of_all(samples);
}

TEST(Info, TellsHowTheGridLiesInTheBody) {
  const TempFolder folder;
  const std::vector<std::int16_t> samples{0, 1, 2, 3, 4, 5, 6, 7};
  write_bytes(folder / "ras.nrrd", nrrd_of("(-1,0,0) (0,-1,0) (0,0,1)", samples));
  EXPECT_THAT(run_program(folder, {"info", folder / "ras.nrrd"}).out,
              HasSubstr("axes RAS, origin 1 2 3 mm, directions -1 0 0, 0 -1 0, 0 0 1 (LPS)"));
  write_bytes(folder / "oblique.nrrd", nrrd_of("(0.8,0.6,0) (-0.6,0.8,0) (0,0,-2)", samples));
  EXPECT_THAT(run_program(folder, {"info", folder / "oblique.nrrd"}).out,
              HasSubstr("axes LPI, oblique by 36.8699 degrees, origin 1 2 3 mm, directions "
                        "0.8 0.6 0, -0.6 0.8 0, 0 0 -1 (LPS)"));
}

TEST(Info, TellsWhatTheValuesAreLike) {
  const TempFolder folder;
  const std::string directions = "(1,0,0) (0,1,0) (0,0,1)";
  const auto line = [&](const std::vector<std::int16_t>& samples) {
    write_bytes(folder / "a.nrrd", nrrd_of(directions, samples));
    return run_program(folder, {"info", folder / "a.nrrd"}).out;
  };
  EXPECT_THAT(line({-1000, -1000, -990, 20, 40, 60, 300, 900}),
              HasSubstr("values -1000 to 900: CT likely (HU)"));
  EXPECT_THAT(line({0, 1, 2, 3, 4, 5, 6, 1200}), HasSubstr("values 0 to 1200\n"));
  const std::string whole = read_bytes(folder / "a.nrrd");
  write_bytes(folder / "a.nrrd", whole.substr(0, whole.size() - 3));
  const ProgramRun cut = run_program(folder, {"info", folder / "a.nrrd"});
  EXPECT_EQ(cut.status, 0);
  EXPECT_THAT(cut.out, HasSubstr("not usable: "));
}

std::string two_labels() { return nrrd_of("(1,0,0) (0,1,0) (0,0,2)", {0, 0, 3, 3, 0, 0, 5, 5}); }

TEST(Info, ListsTheLabelsOfALabelMap) {
  const TempFolder folder;
  write_bytes(folder / "a.nrrd", two_labels());
  const ProgramRun run = run_program(folder, {"info", folder / "a.nrrd"});
  EXPECT_THAT(run.out, HasSubstr("values 0 to 5: labels likely (--labels)\n"
                                 "  3  label 3  2 voxels  4 mm^3\n"
                                 "  5  label 5  2 voxels  4 mm^3\n"));
}

/// Label maps that are folders: slices, and arrays in chunks.
TEST(Info, ListsTheLabelsOfSlicesAndChunks) {
  const TempFolder folder;
  const std::string lines = ": labels likely (--labels)\n  2  label 2  2 voxels  2 mm^3\n";
  write_bytes(folder / "slices/s1.png", png_bytes(2, 2, std::string("\0\0\2\0", 4)));
  write_bytes(folder / "slices/s2.png", png_bytes(2, 2, std::string("\0\0\2\0", 4)));
  EXPECT_THAT(run_program(folder, {"info", folder / "slices"}).out, HasSubstr(lines));
  write_bytes(folder / "a.zarr/.zarray",
              R"({"zarr_format": 2, "shape": [2, 2, 2], "chunks": [2, 2, 2], "dtype": "|u1",
              "compressor": null, "fill_value": 0, "order": "C"})");
  write_bytes(folder / "a.zarr/0.0.0", std::string("\0\0\0\0\2\2\0\0", 8));
  EXPECT_THAT(run_program(folder, {"info", folder / "a.zarr"}).out, HasSubstr(lines));
}

TEST(Info, TakesAFolderOfOneScanForNoLabels) {
  const TempFolder folder;
  write_bytes(folder / "case/ct.nrrd",
              nrrd_of("(1,0,0) (0,1,0) (0,0,1)", {0, 1, 2, 3, 4, 5, 6, 1200}));
  EXPECT_THAT(run_program(folder, {"info", folder / "case"}).out,
              testing::Not(HasSubstr("as --labels")));
  write_bytes(folder / "case/ct.nrrd", two_labels());
  EXPECT_THAT(run_program(folder, {"info", folder / "case"}).out, HasSubstr("as --labels"));
}

TEST(Info, WarnsOfWhatTheHeaderLacks) {
  const TempFolder folder;
  std::string bytes = nrrd_of("(1,0,0) (0,1,0) (0,0,1)", {0, 1, 2, 3, 4, 5, 6, 1200});
  bytes.replace(bytes.find("left-posterior-superior"), 23, "scanner-xyz");
  write_bytes(folder / "a.nrrd", bytes);
  const ProgramRun run = run_program(folder, {"info", folder / "a.nrrd"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("warning: the header names no anatomical space"));
}

TEST(Info, DoesNotCallInfiniteValuesUsable) {
  const TempFolder folder;
  const auto line = [&](float odd) {
    write_bytes(folder / "a.nrrd",
                "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n"
                "endian: little\n\n" +
                    bytes_of_all(std::vector<float>{0.5F, 1, 2, 3, 4, 5, 6, odd}));
    return run_program(folder, {"info", folder / "a.nrrd"}).out;
  };
  EXPECT_THAT(line(INFINITY), HasSubstr("not usable: "));
  EXPECT_THAT(line(NAN), HasSubstr("values 0.5 to 6\n"));
}

TEST(Info, ReadsDicomSegmentationsAndStructureSets) {
  const TempFolder folder;
  write_bytes(folder / "seg.dcm", small_seg().bytes());
  EXPECT_THAT(run_program(folder, {"info", folder / "seg.dcm"}).out,
              HasSubstr("seg.dcm  DICOM labels  3 x 5 x 3 voxels of 0.5 x 1.25 x 2 mm"));
  StructureBytes set = small_structure_set();
  write_bytes(folder / "rt.dcm", set.bytes());
  EXPECT_THAT(run_program(folder, {"info", folder / "rt.dcm"}).out, HasSubstr("  1  bone  "));
  set.regions[0].contours[0].data = "x";
  write_bytes(folder / "rt.dcm", set.bytes());
  const ProgramRun broken = run_program(folder, {"info", folder / "rt.dcm"});
  EXPECT_EQ(broken.status, 0);
  EXPECT_THAT(broken.out, HasSubstr("rt.dcm  labels  not usable: "));
}

TEST(Info, ReadsFoldersOfDicomLabelsAlone) {
  const TempFolder folder;
  write_bytes(folder / "case/seg.dcm", small_seg().bytes());
  for (const auto& path : {folder / "case", folder / "case/"}) {
    const ProgramRun run = run_program(folder, {"info", path});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, StartsWith("case  DICOM labels  3 x 5 x 3 voxels"));
  }
  write_bytes(folder / "case/rt.dcm", small_structure_set().bytes());
  EXPECT_THAT(run_program(folder, {"info", folder / "case"}).out,
              HasSubstr("found 2: rt.dcm, seg.dcm; name one of them"));
}

TEST(Info, ListsTheLabelsOfAnOmeZarrImage) {
  const TempFolder folder;
  const std::string image = R"({"multiscales": [{"datasets": [{"path": "0"}]}])";
  const std::string array = R"({"zarr_format": 2, "shape": [1, 2, 3], "chunks": [1, 2, 3],
      "dtype": "|u1", "compressor": null, "fill_value": 0, "order": "C"})";
  for (const char* group : {"a.zarr", "a.zarr/labels", "a.zarr/labels/bones"}) {
    write_bytes(folder / group / ".zgroup", R"({"zarr_format": 2})");
  }
  for (const char* group : {"a.zarr", "a.zarr/labels/bones"}) {
    write_bytes(folder / group / "0/.zarray", array);
    write_bytes(folder / group / "0/0.0.0", std::string("\0\2\2\0\0\2", 6));
  }
  write_bytes(folder / "a.zarr/.zattrs", image + "}");
  write_bytes(folder / "a.zarr/labels/bones/.zattrs",
              image + R"(, "image-label": {"properties": [{"label-value": 2, "name": "hip"}]}})");
  EXPECT_THAT(run_program(folder, {"info", folder / "a.zarr"}).out,
              HasSubstr("as --labels:\n  2  hip  3 voxels  3 mm^3\n"));
  EXPECT_THAT(run_program(folder, {"info", folder / "a.zarr/labels/bones"}).out,
              HasSubstr("bones  OME-Zarr labels  3 x 2 x 1 voxels"));
}

TEST(Info, ListsTheObjectsOfAFolderOfMasks) {
  const TempFolder folder;
  const std::string axes = "(1,0,0) (0,1,0) (0,0,2)";
  write_bytes(folder / "masks/left.nrrd", nrrd_of(axes, {0, 1, 1, 0, 0, 0, 0, 0}));
  write_bytes(folder / "masks/right.nrrd", nrrd_of(axes, {0, 0, 0, 0, 0, 0, 1, 0}));
  EXPECT_THAT(
      run_program(folder, {"info", folder / "masks"}).out,
      HasSubstr("as --labels:\n  1  left  2 voxels  4 mm^3\n  2  right  1 voxel  2 mm^3\n"));
}

TEST(Info, SaysWhatAFolderHoldsThatIsNoScan) {
  const TempFolder folder;
  write_bytes(folder / "case/ct.nrrd", two_labels());
  const ProgramRun run = run_program(folder, {"segment", folder / "case", "-o", folder / "a.stl"});
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("found none but ct.nrrd; name the file itself, as "));
}

TEST(Info, DescribesAScanInChunks) {
  const TempFolder folder;
  write_bytes(folder / "a.zarr/.zarray",
              R"({"zarr_format": 2, "shape": [4, 3, 2], "chunks": [4, 3, 2], "dtype": "|u1",
              "compressor": null, "fill_value": 0, "order": "C"})");
  write_bytes(folder / "a.zarr/0.0.0", "ABCDEFGHIJKLMNOPQRSTUVWX");
  const ProgramRun run = run_program(folder, {"info", folder / "a.zarr", "--spacing", "0.5,1,2"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("a.zarr  Zarr  2 x 3 x 4 voxels of 0.5 x 1 x 2 mm"));
  write_bytes(folder / "a.zarr/.zarray", "{");
  EXPECT_THAT(run_program(folder, {"info", folder / "a.zarr"}).out,
              HasSubstr("not usable: " + (folder / "a.zarr/.zarray").string() + ": expected JSON"));
}

TEST(Info, ReadsARawFileWhateverItsName) {
  const TempFolder folder;
  write_bytes(folder / "scan.stl", std::string(24, 'x'));
  const ProgramRun run = run_program(
      folder, {"info", folder / "scan.stl", "--raw", "2,3,4,uint8", "--spacing", "1,2,3"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("scan.stl  raw  2 x 3 x 4 voxels of 1 x 2 x 3 mm"));
}

TEST(Info, DescribesAMeshAndItsArrays) {
  const TempFolder folder;
  const TetMesh mesh = box_mesh({{0, 0, 0}, {2, 3, 4}}, {1, 1, 1});
  const std::vector<MeshArray> arrays{{"u", 1, std::vector<double>(8, 1)}};
  write_vtu(folder / "m.vtu", mesh, {.point_arrays = arrays});
  const ProgramRun run = run_program(folder, {"info", folder / "m.vtu"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("6 tetrahedra, 8 vertices, 2 x 3 x 4 mm, arrays u"));
}

TEST(Info, ListsTheObjectsOfASurfaceFile) {
  const TempFolder folder;
  write_objects(folder / "a.3mf", std::vector<NamedSurface>{{"hip", {}, 7, cube()},
                                                            {"femur", {}, 3, cube({5, 0, 0}, 2)}});
  const ProgramRun run = run_program(folder, {"info", folder / "a.3mf"});
  EXPECT_THAT(run.out, HasSubstr("surface  24 triangles"));
  EXPECT_THAT(run.out, HasSubstr("\n  hip  label 7, 12 triangles, 1 mm^3, closed\n"
                                 "  femur  label 3, 12 triangles, 8 mm^3, closed\n"));
  write_surface(folder / "b.stl", cube());
  const std::string one = run_program(folder, {"info", folder / "b.stl"}).out;
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 1);
}

TEST(Info, RefusesWhatIsNotThereOrNothingKnown) {
  const TempFolder folder;
  write_bytes(folder / "a.txt", "just text");
  EXPECT_FAILS(run_program(folder, {"info", folder / "none"}), 3, "none");
  EXPECT_FAILS(run_program(folder, {"info", folder / "a.txt"}), 3, "a.txt");
  EXPECT_FAILS(run_program(folder, {"info", folder / "none.stl"}), 3, "none.stl");
  EXPECT_FAILS(run_program(folder, {"info", folder / "none.vtu"}), 3, "none.vtu");
}

TEST(Info, ListsEachSeriesOfADirectory) {
  const auto data = test_data("data/dicom_ct_j2k");
  MESAMIS_REQUIRE_DATA(data);
  const TempFolder folder;
  const ProgramRun run = run_program(folder, {"info", data});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("CT  512 x 512 x 20 voxels"));
}

}  // namespace
}  // namespace mesamis
