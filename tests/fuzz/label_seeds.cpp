// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "fuzz_seeds.h"
#include "mesamis/label_files/label_table.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/settings_json.h"
#include "support/contour_bytes.h"
#include "support/scan_bytes.h"

namespace mesamis {
namespace {

LabelMap small_map(std::size_t layers) {
  LabelMap map;
  map.size = {4, 3, 2};
  for (std::size_t layer = 0; layer < layers; ++layer) {
    std::vector<std::uint16_t> labels(24, 0);
    labels[5 + layer] = 1;
    labels[7] = 300;
    map.layers.push_back(std::move(labels));
    map.segments.push_back({"pelvis", 1, static_cast<Index>(layer), {255, 128, 0}});
    map.segments.push_back({"left femur", 300, static_cast<Index>(layer), {0, 128, 255}});
  }
  return map;
}

std::string probabilities() {
  const std::vector<float> values{0, 1, 0.5f, 0.25f, 1, 0, 0, 1, 0.5f, 0.75f, 0, 1, 1, 1, 0, 0};
  return "NRRD0004\ntype: float\ndimension: 4\nsizes: 2 2 2 2\n"
         "space: left-posterior-superior\nkinds: list domain domain domain\n"
         "space directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"
         "endian: little\nencoding: raw\n\n" +
         bytes_of_all(values);
}

void write_contour_seeds(const SeedFolder& seeds) {
  StructureBytes set = small_structure_set();
  set.regions.push_back({2, "marrow", "0\\0\\255", "1.2.9", {}});
  for (int k = 0; k < 3; ++k) {
    const RegionContour box = rectangle_contour({-2, -1, 3 + 2.0 * k}, 4, 3);
    const RegionContour hole = rectangle_contour({-1, 0, 3 + 2.0 * k}, 2, 1);
    set.regions[1].contours.insert(set.regions[1].contours.end(), {box, hole});
    set.regions[0].contours[static_cast<std::size_t>(k)] =
        rectangle_contour({0, 0, 3 + 2.0 * k}, 4, 4);
  }
  seeds.add("label_contours", "explicit", set.bytes());
  set.open = true;
  set.regions[1].contours[0].type = "CLOSEDPLANAR_XOR";
  set.regions[1].contours[1].type = "POINT";
  seeds.add("label_contours", "open", set.bytes());
  set.coding = DicomCoding::kImplicit;
  seeds.add("label_contours", "implicit", set.bytes());
}

}  // namespace

void write_label_seeds(const SeedFolder& seeds) {
  // The writers decide by the name, the targets have one of their own.
  write_label_map(seeds.file("label_nifti", "map.nii"), small_map(1));
  write_label_map(seeds.file("label_nifti", "map.nii.gz"), small_map(1));
  write_label_map(seeds.file("label_nrrd", "map.seg.nrrd"), small_map(1));
  write_label_map(seeds.file("label_nrrd", "layers.seg.nrrd"), small_map(2));
  seeds.add("label_nrrd", "probabilities", probabilities());
  seeds.add("label_nrrd", "plain",
            "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 2 2\n"
            "space: left-posterior-superior\nkinds: list domain domain domain\n"
            "space directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"
            "encoding: ascii\nSegment0_ID:=a\nSegment0_Name:=bone\nSegment0_Color:=1 0.5 0\n"
            "Segment0_LabelValue:=1\nSegment0_Layer:=0\nSegment1_LabelValue:=2\n"
            "Segment1_Layer:=1\n\n1 0 0 2 0 0 1 2 0 0 0 0 1 2 1 2\n");
  write_contour_seeds(seeds);
  const std::string mask =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nspace: left-posterior-superior\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: ascii\n\n1 0 0 1 0 0 1 0\n";
  seeds.add("label_masks", "pair", "\x80" + mask + mask);
  const LabelMap map = small_map(1);
  write_label_table(seeds.file("label_table", "itksnap"), map.segments);
  seeds.add("label_table", "slicer", "# Color table\n0 Background 0 0 0 0\n1 bone 255 128 0 255\n");
  seeds.add("label_table", "names", "1 pelvis\n2 \"left femur\" 1 2 3\n");
  for (const std::string& preset : preset_names()) {
    write_json(seeds.file("settings_json", preset), to_json(preset_settings(preset)));
  }
  seeds.add("settings_json", "report", R"({"settings": {"crop": [[0, 10], [0, 10], [0, 10]],
    "stride": [1, 1, 2], "preview": true, "level": 0.5}})");
}

}  // namespace mesamis
