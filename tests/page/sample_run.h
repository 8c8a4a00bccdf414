// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/page/run_page.h"
#include "support/ball_volume.h"
#include "support/solids.h"

namespace mesamis {

/// A report as `segment` writes it, of a ball, with names that are not for anyone.
inline nlohmann::json sample_report() {
  return nlohmann::json::parse(R"({
    "program": {"name": "mesamis", "version": "9.8.7", "commit": "abc1234"},
    "input": {"path": "/home/x/UNMISTAKABLE NAME/scan.nii.gz", "format": "NIfTI", "modality": "CT",
      "sha256": "00ff", "size": [40, 40, 40], "spacing_mm": [1, 1, 1], "range": [90, 240],
      "warnings": ["/home/x/UNMISTAKABLE NAME/scan.nii.gz: no spacing, <1 mm> is taken"]},
    "command": ["segment", "/home/x/UNMISTAKABLE NAME/scan.nii.gz", "-o", "UNMISTAKABLE.stl", "--quiet",
      "--threads", "2", "--level", "175", "--error", "--name", "UNMISTAKABLE", "--html=UNMISTAKABLE.html"],
    "output": {"frame": "lps", "threads": 2},
    "object": {"removed": [{"what": "table", "cm3": 145.25}], "padding": null},
    "settings": {"level": 175.5, "max_tets": 20000, "threshold": 130, "window": [100, 240], "restore": true,
      "gamma": 0.4375},
    "chosen": {"level": {"value": 175.5, "source": "given", "uncertainty": null, "reason": null},
      "max_tets": {"value": 20000, "source": "measured", "uncertainty": null, "reason": "from the surface"},
      "gamma": {"value": 0.4375, "source": "measured", "uncertainty": null, "reason": "4 epsilon beta"}},
    "given": ["level"],
    "grey": {"window_native": [100, 240]},
    "quality": {"noise": 4.125, "noise_left": 3.5, "blur": [1, 1, 1],
      "expected_error_mm": {"mean": 0.0625, "p95": 0.125, "max": 0.5}},
    "iterations": [
      {"tets": 5000, "nodes": 1000, "energy": 70.5, "energy_parts": {"total": 70.5, "fidelity": 20,
       "smoothing": 30, "edge": 20.5}, "energy_change": null, "surface_change_mm": null, "seconds": {"amis": 1}},
      {"tets": 20100, "nodes": 4000, "energy": 60.25, "energy_parts": {"total": 60.25, "fidelity": 20,
       "smoothing": 20, "edge": 20.25}, "energy_change": -0.145, "surface_change_mm": 0.01,
       "surface_tolerance_mm": 0.02, "seconds": {"amis": 1}}],
    "mesh": {"tets": 20100, "nodes": 4000},
    "surface": {"kind": "solid", "level_native": 175.5, "triangles": 12345, "closed": true, "islands": 1,
      "volume_mm3": 5575.28, "parts": {"islands_dropped": 3, "volume_dropped_mm3": 1.5,
      "cavities_filled": 0, "volume_filled_mm3": 0}},
    "warnings": ["scan.nii.gz: a <b>warning</b>"],
    "verdict": {"kept": true, "message": ""},
    "converged": true, "seconds": 33.256789, "peak_memory_mb": 99, "seconds_parts": {"method": 31},
    "files": [{"path": "out/UNMISTAKABLE.stl", "bytes": 5, "sha256": "aa"}]})");
}

/// A run on a ball; a page refers to it.
struct SampleRun {
  Volume scan = make_ball({});
  TriMesh surface = moved(ball_surface(11, 32), {19.5, 19.5, 19.5});
  TetMesh mesh = box_mesh({{0, 0, 0}, {39, 39, 39}}, {6, 6, 6});
  std::vector<double> grey;

  SampleRun() {
    for (const Vec3& p : mesh.points)
      grey.push_back(norm(p - Vec3{19.5, 19.5, 19.5}) < 11 ? 230 : 20);
  }
  RunPage page() const {
    RunPage shown{sample_report()};
    shown.scan = &scan;
    shown.surfaces = {{&surface, "", {200, 100, 50}}};
    shown.mesh = &mesh;
    shown.grey = grey;
    return shown;
  }
};

}  // namespace mesamis
