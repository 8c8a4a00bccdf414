// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/chunk_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::SizeIs;

/// One array of 2 x 2 x 3, in one chunk.
void write_array(const std::filesystem::path& array, const std::vector<std::uint32_t>& values) {
  write_bytes(array / ".zarray",
              R"({"zarr_format": 2, "shape": [2, 2, 3], "chunks": [2, 2, 3], "dtype": "<u4",
                  "compressor": null, "filters": null, "fill_value": 0, "order": "C"})");
  write_bytes(array / "0.0.0", bytes_of_all(values));
}

/// A group that is an image of one level.
void write_image(const std::filesystem::path& group, const std::vector<std::uint32_t>& values) {
  write_bytes(group / ".zgroup", R"({"zarr_format": 2})");
  write_bytes(group / ".zattrs",
              R"({"multiscales": [{"axes": [{"name": "z", "unit": "micrometer"},
                  {"name": "y", "unit": "micrometer"}, {"name": "x", "unit": "micrometer"}],
                  "datasets": [{"path": "0", "coordinateTransformations":
                  [{"type": "scale", "scale": [20, 10, 10]}]}]}]})");
  write_array(group / "0", values);
}

const std::vector<std::uint32_t> kGrey{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
const std::vector<std::uint32_t> kLabels{0, 0, 7, 0, 70000, 0, 0, 0, 0, 0, 0, 1};

TEST(ChunkLabels, OfAnImageThoseThatLieInIt) {
  const TempFolder folder;
  write_image(folder / "a.zarr", kGrey);
  write_bytes(folder / "a.zarr/labels/.zgroup", R"({"zarr_format": 2})");
  write_image(folder / "a.zarr/labels/cells", kLabels);
  for (const char* name : {"a.zarr", "a.zarr/labels", "a.zarr/labels/cells"}) {
    const LabelFile file = read_label_map(folder / name);
    EXPECT_EQ(file.format, "OME-Zarr");
    EXPECT_EQ(file.map.spacing, (Vec3{0.01, 0.01, 0.02}));
    EXPECT_THAT(file.map.layers, ElementsAre(ElementsAre(0, 0, 7, 0, 8, 0, 0, 0, 0, 0, 0, 1)));
    EXPECT_EQ(find_segment(file.map.segments, "70000").label, 8);
    EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("70000 becomes 8")));
  }
  write_image(folder / "a.zarr/labels/nuclei", kLabels);
  EXPECT_REFUSED(read_label_map(folder / "a.zarr"),
                 AllOf(HasSubstr("found 2: labels/cells, labels/nuclei")));
}

TEST(ChunkLabels, OfAnArrayAlone) {
  const TempFolder folder;
  write_array(folder / "a", kGrey);
  const LabelFile file = read_label_map(folder / "a");
  EXPECT_EQ(file.format, "Zarr");
  EXPECT_THAT(file.map.layers[0], ElementsAreArray(kGrey));
  EXPECT_THAT(file.map.segments, SizeIs(12));
}

TEST(ChunkLabels, TakeAtMostTheMemoryAllowed) {
  const TempFolder folder;
  write_bytes(folder / "a/.zarray",
              R"({"zarr_format": 2, "shape": [1000, 1000, 1000], "chunks": [8, 8, 8], "dtype":
                  "|u1", "compressor": null, "filters": null, "fill_value": 0, "order": "C"})");
  EXPECT_REFUSED(read_label_map(folder / "a", {{.memory_gb = 0.5}}), HasSubstr("memory: expected"));
}

/// Attributes of an image of labels of one level.
std::string attributes_with(const std::string& labels) {
  return R"({"multiscales": [{"datasets": [{"path": "0"}]}], "image-label": )" + labels + "}";
}

TEST(ChunkLabels, HaveTheNamesAndColoursOfTheImage) {
  const TempFolder folder;
  write_image(folder / "a.zarr", kLabels);
  write_bytes(folder / "a.zarr/.zattrs",
              attributes_with(R"({"colors": [{"label-value": 7, "rgba": [1, 2, 3, 255]},
                  {"label-value": 0, "rgba": [0, 0, 0, 0]}, {"label-value": -1}],
                  "properties": [{"label-value": 70000, "name": "isocortex"}]})"));
  for (const char* name : {"a.zarr", "a.zarr/0"}) {
    const LabelFile file = read_label_map(folder / name);
    const Segment seven = find_segment(file.map.segments, "7");
    EXPECT_EQ(seven.name, "label 7");
    EXPECT_THAT(seven.colour, ElementsAre(1, 2, 3));
    EXPECT_EQ(find_segment(file.map.segments, "isocortex").number_in_file, 70000);
    EXPECT_THAT(file.map.segments, SizeIs(3));
    EXPECT_TRUE(is_label_file(folder / name));
  }
  write_image(folder / "b.zarr", kLabels);
  EXPECT_FALSE(is_label_file(folder / "b.zarr"));
}

TEST(ChunkLabels, NumbersThatSinglePrecisionRoundsStayApart) {
  const TempFolder folder;
  std::vector<std::uint32_t> labels = kLabels;
  labels[0] = 614454277;
  labels[1] = 614454278;
  write_array(folder / "a", labels);
  const LabelFile file = read_label_map(folder / "a");
  const auto& map = file.map;
  EXPECT_EQ(find_segment(map.segments, "614454277").label, map.layers[0][0]);
  EXPECT_EQ(find_segment(map.segments, "614454278").label, map.layers[0][1]);
  EXPECT_NE(map.layers[0][0], map.layers[0][1]);
}

TEST(ChunkLabels, LieInsideAnImage) {
  const TempFolder folder;
  write_image(folder / "a.zarr", kGrey);
  EXPECT_FALSE(is_mask_folder(folder / "a.zarr"));
  write_bytes(folder / "a.zarr/labels/.zgroup", R"({"zarr_format": 2})");
  write_image(folder / "a.zarr/labels/cells", kLabels);
  EXPECT_TRUE(is_mask_folder(folder / "a.zarr"));
}

}  // namespace
}  // namespace mesamis
