// SPDX-License-Identifier: Apache-2.0
#include "command_guide.h"

#include <map>

namespace mesamis {
namespace {

CommandGuide segment_guide() {
  return {{"--output", "--report", "--html", "--mesh", "--body", "--labels", "--label", "--tissue",
           "--seed", "--box", "--series", "--preview", "--accuracy", "--level", "--tolerance"},
          {{"The bone of a CT, as a surface to print", "mesamis segment ct.nii.gz -o bone.stl"},
           {"A folder of DICOM files; a page to look at the result in a browser",
            "mesamis segment dicom/ --tissue bone -o bone.3mf --html bone.html"},
           {"Two objects of a label map, a file for each",
            "mesamis segment ct.nii.gz --labels labels.nii.gz --label 1 2 -o '{label}.stl'"},
           {"A mesh for a finite-element solver, with stiffness from the scan",
            "mesamis segment ct.nii.gz --labels femur.nii.gz --body femur.inp "
            "--material keyak-1994 --calibration 0,0.001"}}};
}

/// Commands with few options have no list of those used most.
std::map<std::string, CommandGuide> build_guides() {
  std::map<std::string, CommandGuide> guides{{"segment", segment_guide()}};
  const auto add = [&](const char* command, const char* purpose, const std::string& rest) {
    guides[command].examples.push_back({purpose, std::string("mesamis ") + command + " " + rest});
  };
  add("decimate", "Fewer triangles within 0.2 mm of a surface",
      "bone.stl -o small.stl --tolerance 0.2");
  add("remesh", "The mesh of a box for a metric, both as Medit files",
      "box.mesh --metric metric.sol -o adapted.mesh");
  add("baseline", "An isosurface for comparison",
      "ct.nii.gz --method isosurface --level 200 -o isosurface.stl");
  add("compare", "Distances between two surfaces, as colours in ParaView",
      "truth.stl bone.stl --colored distances.vtp");
  add("label", "A mask on the grid of a scan", "bone.stl --like ct.nii.gz -o mask.nii.gz");
  add("study", "Surfaces of a scan at two resolutions against a reference",
      "ct.nii.gz --reference truth.stl --subsample 1,2 -o study/");
  add("phantom", "A femur with noise, and its true surface",
      "femur -o femur.nrrd --truth femur.ply --noise 8");
  add("picture", "A surface cut open", "bone.stl -o bone.png --view front --clip x,10");
  add("report", "A page of a run made before", "bone.json --html bone.html");
  add("info", "The series in a folder of DICOM files", "dicom/");
  add("settings", "Settings as a file to edit", "--preset default");
  add("slice", "Layers for a printer", "bone.stl --slicer prusa -o bone.gcode");
  add("bids", "The CT images of a dataset", "dataset/ derivatives/ participant --datatype ct");
  add("manual", "Completion for bash", "--bash mesamis.bash");
  return guides;
}

}  // namespace

const CommandGuide& guide_of(const std::string& command) {
  static const std::map<std::string, CommandGuide> guides = build_guides();
  static const CommandGuide none;
  const auto found = guides.find(command);
  return found == guides.end() ? none : found->second;
}

}  // namespace mesamis
