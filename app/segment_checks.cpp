// SPDX-License-Identifier: Apache-2.0
#include "segment_checks.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "arguments.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"
#include "mesamis/method/label_surfaces.h"
#include "mesamis/report/label_surface_files.h"
#include "mesamis/report/mesh_output.h"
#include "mesamis/shape_files/surface_files.h"
#include "outputs.h"
#include "page_options.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

/// A run without any output is not started.
void require_some_output(const SegmentOptions& options) {
  if (!options.out.surfaces.empty() || !options.out.meshes.empty() ||
      !options.out.band_meshes.empty() || !options.out.labelmap.empty() ||
      options.out.wants_report() || options.body.given()) {
    return;
  }
  throw CLI::ValidationError(
      "segment",
      "expected --output, --mesh, --body, --band-mesh, --labelmap, --report, --html or --pictures, "
      "found nothing to write");
}

/// A Medit mesh has its fields in a file of their own.
fs::path fields_beside(const fs::path& mesh) { return fs::path(mesh).replace_extension(".sol"); }

Paths all_outputs_of(const SegmentOptions& options) {
  Paths outputs = page_outputs(options.out.page);
  outputs.insert(outputs.end(),
                 {options.out.labelmap, options.out.report, options.report_reader_file});
  for (const auto* paths : {&options.out.surfaces, &options.out.meshes, &options.out.band_meshes,
                            &options.body.files}) {
    outputs.insert(outputs.end(), paths->begin(), paths->end());
  }
  for (const fs::path& mesh : options.out.meshes) {
    if (lower_extension(mesh) == ".mesh") outputs.push_back(fields_beside(mesh));
  }
  return outputs;
}

Paths inputs_of(const SegmentOptions& options) {
  const ScanArguments& scan = options.scan;
  Paths inputs{scan.input,       scan.labels.file,   scan.labels.names,
               scan.places.mask, scan.places.remove, options.settings.file};
  const Paths& more = scan.labels.probabilities;
  inputs.insert(inputs.end(), more.begin(), more.end());
  return inputs;
}

/// Only surfaces in DICOM have a place for a patient.
void require_patient(const SegmentOptions& options) {
  if (!options.scan.patient) return;
  const auto is_dicom = [](const fs::path& path) { return lower_extension(path) == ".dcm"; };
  if (std::none_of(options.out.surfaces.begin(), options.out.surfaces.end(), is_dicom)) {
    throw CLI::ValidationError("--patient", "expected a .dcm among --output, found none");
  }
  if (options.scan.input.empty() || options.slabs.given()) {
    throw CLI::ValidationError("--patient",
                               "expected a DICOM scan and no --slabs, found " +
                                   std::string(options.slabs.given() ? "--slabs" : "no scan"));
  }
}

/// {label} stands for an object of several.
void require_objects_to_name(const SegmentOptions& options) {
  if (options.scan.labels.given() || options.scan.places.seeds.size() > 1) return;
  for (const fs::path& path : options.out.surfaces) {
    if (!names_each(path)) continue;
    throw CLI::ValidationError(
        "--output", "expected --labels or several --seed for {label}, found " + path.string());
  }
}

/// Options that only change what others make.
void require_masters(const SegmentOptions& options, const Settings& settings) {
  const RunFiles& out = options.out;
  require_beside(options.of_mesh, !out.meshes.empty(), "--mesh beside it, found none");
  require_beside(options.of_surfaces, !out.surfaces.empty(), "--output beside it, found none");
  std::vector<std::string> of_band;
  for (const auto& setting : options.settings.overrides) {
    if (setting.name == "band_threshold") of_band.push_back(setting.option);
  }
  require_beside(of_band, settings.surface == SurfaceKind::kBand || !out.band_meshes.empty(),
                 "--surface band or --band-mesh beside it, found neither");
}

void require_outputs(const SegmentOptions& options, const Settings& settings) {
  require_some_output(options);
  require_objects_to_name(options);
  require_masters(options, settings);
  require_utf8(options.out.name, "--name");
  for (const fs::path& path : options.out.surfaces) {
    require_output(path, written_surface_formats(), "--output");
  }
  if (options.out.error &&
      std::none_of(options.out.surfaces.begin(), options.out.surfaces.end(), carries_arrays)) {
    throw CLI::ValidationError("--error", "expected a .vtp or .ply among --output, found none");
  }
  require_patient(options);
  std::vector<std::string> mesh_formats = written_mesh_formats();
  if (options.slabs.given()) mesh_formats.emplace_back(kPiecesExtension);
  for (const fs::path& path : options.out.meshes) require_output(path, mesh_formats, "--mesh");
  for (const fs::path& path : options.out.meshes) {
    if (lower_extension(path) == ".mesh") require_writable(fields_beside(path));
  }
  for (const fs::path& path : options.out.band_meshes)
    require_output(path, {".vtu"}, "--band-mesh");
  require_body(options.body);
  if (options.body.meshing() && options.out.surfaces.empty()) {
    throw CLI::ValidationError("--surface-quality", "expected --output for meshing, found none");
  }
  if (!options.out.labelmap.empty()) require_labelmap(options.out.labelmap, "--labelmap");
  if (!options.out.report.empty()) require_output(options.out.report, {".json"}, "--report");
  require_page(options.out.page);
  require_distinct_files(all_outputs_of(options), inputs_of(options));
}

/// A preview makes no mesh.
void require_mesh_for(const SegmentOptions& options, const Settings& settings) {
  if (settings.preview && options.wants_mesh()) {
    throw CLI::ValidationError("--preview", "expected neither --mesh nor --band-mesh, found one");
  }
}

/// Refuses an option that needs the grey values of the scan, which the image of a dark tissue lacks.
void require_grey_values(const PlaceArguments& places, const std::string& option) {
  if (tissue_kind(places) == TissueKind::kBright) return;
  throw CLI::ValidationError(
      option, "expected a bright --tissue, whose grey values are those of the scan, found " +
                  places.tissue);
}

/// Elements fill a solid, and a material needs the grey values of the scan.
void require_body_for(const SegmentOptions& options, const Settings& settings) {
  require_elements_for(options.body, settings);
  if (!options.body.material.empty()) require_grey_values(options.scan.places, "--material");
}

/// Whether anything is said of how a scan is read, or of which part, that labels alone have not.
bool tells_of_scan(const ReadOptions& read, const Settings& settings) {
  return !(settings.crop == CropRange{}) || read.raw || read.volume || read.channel ||
         !read.series.empty() || !read.modality.empty();
}

/// What needs no scan to be refused.
void require_places(const SegmentOptions& options, const Settings& settings) {
  const PlaceArguments& places = options.scan.places;
  require_places(places, options.scan.labels, settings);
  const bool has_scan = !options.scan.input.empty();
  if (!has_scan && places.given()) {
    throw CLI::ValidationError(
        "input",
        "expected a scan for --tissue, --seed, --box, --mask, --remove or --padding, found none");
  }
  if (!has_scan && options.scan.labels.given() && tells_of_scan(options.scan.read, settings)) {
    throw CLI::ValidationError("input",
                               "expected a scan for --crop, --series, --raw, --volume, --channel "
                               "or --modality, found labels alone");
  }
  if (!options.out.meshes.empty()) require_grey_values(places, "--mesh");
}

/// Where the error at each point is asked for, a file of one object each must have a place for it.
void require_error_place(const SegmentOptions& options) {
  const auto holds = [](const fs::path& path) { return carries_arrays(path) && !holds_all(path); };
  if (options.out.error &&
      std::none_of(options.out.surfaces.begin(), options.out.surfaces.end(), holds)) {
    throw CLI::ValidationError(
        "--error", "expected a .ply, or a .vtp with {label} in its name, for several objects");
  }
  if (options.out.error && options.scan.input.empty()) {
    throw CLI::ValidationError("--error", "expected a scan beside the labels, found none");
  }
}

/// A mesh is made of the scan.
void require_scan_for_mesh(const SegmentOptions& options) {
  if (options.wants_mesh() && options.scan.input.empty()) {
    throw CLI::ValidationError("--mesh", "expected a scan beside the labels, found none");
  }
  if (options.body.given() && options.scan.input.empty()) {
    throw CLI::ValidationError("--body", "expected a scan beside the labels, found none");
  }
}

/// The files of objects, whose names are known with the labels, can be written.
void require_separate_files(const SegmentOptions& options, const std::vector<Segment>& wanted) {
  const std::vector<NamedSurface> objects = named_segments(wanted);
  Paths all;
  for (const fs::path& path : options.out.surfaces) {
    const bool together = holds_all(path);
    const Paths files = together ? Paths{path} : label_paths(path, objects, wanted.size() > 1);
    all.insert(all.end(), files.begin(), files.end());
    if (together && lower_extension(path) == ".obj") {
      all.push_back(fs::path(path).replace_extension(".mtl"));
    }
  }
  for (const fs::path& path : all) require_writable(path);
  require_distinct_files(all, {});
}

/// A NIfTI file has one layer.
void require_layers(const SegmentOptions& options, const std::vector<Segment>& wanted) {
  if (options.out.labelmap.empty() || lower_extension(options.out.labelmap) == ".nrrd") return;
  for (const Segment& s : wanted) {
    if (s.layer != wanted.front().layer) {
      throw InputError("--labelmap: expected a .nrrd or .seg.nrrd, as '" + s.name +
                       "' may overlap others, found " + options.out.labelmap.string());
    }
  }
}

/// Objects that share boundaries are solids, and each boundary has a level of its own.
void require_settings_of_objects(const SegmentOptions& options, const Settings& settings) {
  const ScanArguments& scan = options.scan;
  const bool labels = scan.labels.given();
  if (labels || scan.places.seeds.size() > 1) {
    parsed("--surface", [&] { require_solids(settings); });
  }
  if (labels && scan.input.empty() && settings.accuracy) {
    throw CLI::ValidationError("--accuracy", "expected a scan beside the labels, found none");
  }
  for (const auto& [name, text, option] : options.settings.overrides) {
    if (name != "level" || !labels || text == "local" || text == "auto") continue;
    if (scan.input.empty()) {
      throw CLI::ValidationError(option, "expected a scan beside the labels, found none");
    }
    log_warning(option +
                ": each boundary of labels has its own level; this one only measures the "
                "scan's edges and guides the mesh");
  }
}

/// A list takes all words up to the next option, the scan with them.
void require_input_before_list(const ScanArguments& scan) {
  if (!scan.input.empty() || scan.labels.chosen.empty()) return;
  const std::string& last = scan.labels.chosen.back();
  if (!fs::exists(last)) return;
  throw CLI::ValidationError("--label", "expected names or numbers of objects, found the file " +
                                            in_quotes(last) + "; the scan goes before --label");
}

}  // namespace

void require_segment(const SegmentOptions& options, const Settings& settings) {
  require_input_before_list(options.scan);
  if (!options.plan) require_outputs(options, settings);
  require_places(options, settings);
  require_settings_of_objects(options, settings);
  require_mesh_for(options, settings);
  require_body_for(options, settings);
  if (options.time_limit && options.scan.labels.given()) {
    throw CLI::ValidationError("--time-limit", "expected a run for one object, found several");
  }
}

void require_several(const SegmentOptions& options) {
  require_error_place(options);
  require_scan_for_mesh(options);
}

void require_object_files(const SegmentOptions& options, const std::vector<Segment>& wanted) {
  require_layers(options, wanted);
  require_separate_files(options, wanted);
}

void require_labelmap(const fs::path& path, const std::string& option) {
  const bool packed = lower_extension(path) == ".gz" && lower_extension(path.stem()) == ".nii";
  require_output(path, {".nii", packed ? ".gz" : ".nii.gz", ".nrrd"}, option);
}

}  // namespace mesamis
