// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <utility>

#include "fuzz_seeds.h"
#include "mesamis/method/setting_table.h"

namespace mesamis {
namespace {

/// Lines of the command line, blanks between the arguments.
constexpr std::pair<const char*, const char*> kLines[] = {
    {"program", "segment scan.nrrd -o out.stl --quiet --threads 2 --memory 1.5"},
    {"program", "--log-json info scan.nii --allow-outside"},
    {"program", "--version"},
    {"segment",
     "scan.nii.gz -o a.stl b.3mf --mesh m.vtu --mesh-region object --bins 5 --report r.json"},
    {"segment", "scan.nrrd --labels l.nii --label femur --label 3 --label-names n.txt --margin 2"},
    {"segment",
     "dicom --series 1.2.3 --resample --seed 1,2,3 --seed 4,5,6 --box 0:10,,:5 -o x.ply"},
    {"segment",
     "raw.bin --raw 4,3,5,int16be,8 --spacing 1,1,2 --tissue bone --remove body -o x.obj"},
    {"segment", "scan.mha --probabilities a.nii b.nii --labelmap l.nrrd --time-limit 60 --name x"},
    {"segment", "scan.tif --preset paper --level 0.5 --max-tets 1e6 --crop 0:9,0:9,0:9 --stride 2"},
    {"segment",
     "scan.nrrd -o a.stl --surface-quality meshing --element-size 3 --least-size 1 --tolerance "
     "0.2"},
    {"body", "--set LOAD=top:z,2mm --set FIX=bottom:x,1.5 --set IN=box:-1,-2,-3,4,5,6e1"},
    {"body", "--set N=normal:0,0.6,-0.8,30 --set B=between:1,2"},
    {"body", "--material keyak-1994 --calibration -0.0039,0.00079 --ash equal --poisson 0.3"},
    {"body", "--material E=6850*rho_app^1.49+10 --calibration 0:0,1000:0.8 --material-gap 50"},
    {"body", "--material E=1e3*rho_qct^+2 --calibration +0,1e-3 --element tet10"},
    {"body", "--material E=14664*rho_ash^1.49 --calibration=-1:0,1:1 --surface-quality meshing"},
    {"decimate", "in.stl -o out.stl --tolerance 0.1 --min-volume 4 --fill-cavities"},
    {"decimate", "in.ply -o out.3mf --triangles 1000 --keep-largest 1 --name x --report r.json"},
    {"remesh", "m.mesh --metric m.sol -o n.mesh --max-tets 1e5 --report r.json"},
    {"baseline", "scan.nrrd -o s.stl --method isosurface --level 100 --smooth 1 --close"},
    {"baseline", "scan.nrrd -o s.stl --method geodesic --alpha -1 --beta 2 --iterations 10"},
    {"compare", "a.stl b.ply --report r.json --histogram h.csv --colored c.vtp --frames auto"},
    {"compare", "a.stl b.ply --box 0,0,0,1,2,3 --frames as-is"},
    {"study", "scan.nrrd --reference r.stl -o folder --subsample 1,2,4 --frames auto --frame ras"},
    {"study", "scan.nrrd --reference r.stl -o f --region 0:9,0:9,0:9 --region-subsample 1,2"},
    {"phantom", "femur -o p.nrrd --truth t.stl --size 40,40,40 --spacing 1,1,2 --samples 4 --gzip"},
    {"phantom", "ball -o p.nrrd --blur 1 --noise 5 --speckle 0.1 --salt-pepper 0.01 --seed 7"},
    {"phantom", "--list"},
    {"picture",
     "in.vtu -o p.png --view oblique --zoom 2 --focus 1,2,3 --edges --clip x,3 --color u"},
    {"picture", "scan.nrrd -o p.png --size 400,300 --window -100:400 --outline s.stl --clip z,10"},
    {"bids", "in out participant --participant-label 01 sub-02 --suffix ct --format stl vtp"},
    {"bids", "in out group --session_label a --desc bone --dseg --skip-existing --max-tets 1e5"},
    {"slicer_segment",
     "--returnparameterfile r.params --tissue bright --region 1,2,3,4,5,6 --seed -1,2,3 s.nrrd "
     "m.vtp"},
    {"slicer_segment", "--xml --level auto --no_restore --label 1,femur --values 100:"},
    {"info", "scan.nrrd --spacing 1,1,1 --series 1.2.3"},
    {"settings", "--preset paper --markdown"},
    {"slice", "s.stl --slicer prusa -o s.gcode --layer 0.2 --infill 10% --perimeters 3 --support"},
    {"slice", "s.stl --slicer cura --bed 200,200,150 --report r.json"},
    {"texts", "--tissue bone --seed 1,2,3 --seed -1,+2,3e1 --box 0:10,,:5 --frame ras"},
    {"texts", "--tissue 100:300 --margin 2 --mask m.nii --remove body"},
    {"texts", "--preset paper --crop 0:10,,5: --stride 1,1,2 --window 0,100 --keep-surroundings"},
    {"texts", "--labels l.nii --label femur --keep-surroundings --no-preview"},
};

std::string as_arguments(std::string line) {
  std::replace(line.begin(), line.end(), ' ', '\n');
  return line;
}

/// Each setting with its default and with the paper's value.
void write_settings(const SeedFolder& seeds) {
  const Settings paper = preset_settings("paper");
  for (const Setting& setting : setting_table()) {
    std::string option = "--" + setting.name;
    std::replace(option.begin(), option.end(), '_', '-');
    const bool is_switch = setting.count == 0 && setting.words.empty();
    const std::string line =
        is_switch ? option : option + "\n" + text_of(setting, setting.get(paper));
    seeds.add("options_texts", setting.name, line);
  }
}

}  // namespace

void write_option_seeds(const SeedFolder& seeds) {
  int count = 0;
  for (const auto& [command, line] : kLines) {
    seeds.add(std::string("options_") + command, "line" + std::to_string(++count),
              as_arguments(line));
  }
  write_settings(seeds);
}

}  // namespace mesamis
