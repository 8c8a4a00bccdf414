// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/mesh_output.h"

#include <algorithm>
#include <numeric>
#include <sstream>

#include "mesamis/adapt/estimator.h"
#include "mesamis/base/error.h"
#include "mesamis/fem/transfer.h"
#include "mesamis/files/output_set.h"
#include "mesamis/files/refuse.h"
#include "mesamis/mesh/region.h"
#include "mesamis/mesh/value_bins.h"
#include "mesamis/report/cell_labels.h"
#include "mesamis/surface/extract.h"

namespace mesamis::detail::report {
namespace {

namespace fs = std::filesystem;

std::vector<Index> all_cells(const TetMesh& mesh) {
  std::vector<Index> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

/// The object by its cells; which of its parts, as for the surface.
std::vector<Index> object_cells(const Result& result) {
  const Parameters& p = result.parameters;
  std::vector<double> levelled = result.u;
  for (std::size_t n = 0; n < result.level_excess.size(); ++n) {
    levelled[n] -= result.level_excess[n];
  }
  const auto above = cells_mostly_above(result.mesh, levelled, p.grey.to_grey(p.level));
  const auto cells =
      select_cells(result.mesh, above, {p.min_volume, p.keep_largest, p.fill_cavities});
  if (cells.empty()) {
    std::ostringstream message;
    message << "mesh region: expected cells with u above the level of " << p.level
            << (above.empty() ? "" : " in parts of the volume asked for") << ", found none";
    throw InputError(message.str());
  }
  return cells;
}

std::vector<double> values_at(const std::vector<Index>& nodes, const std::vector<double>& values) {
  std::vector<double> taken;
  taken.reserve(nodes.size());
  for (const Index n : nodes) taken.push_back(values[n]);
  return taken;
}

std::vector<double> metric_at(const std::vector<Index>& nodes, const std::vector<Sym3>& metrics) {
  std::vector<double> values;
  values.reserve(6 * nodes.size());
  for (const Index n : nodes) {
    const Sym3& m = metrics[n];
    values.insert(values.end(), {m.xx, m.yy, m.zz, m.xy, m.yz, m.xz});
  }
  return values;
}

std::vector<double> to_native(const GreyMap& map, std::vector<double> grey) {
  for (double& value : grey) value = map.to_native(value);
  return grey;
}

/// The aspect ratios (6), and 1 where the cell belongs to an edge.
std::vector<MeshArray> shape_arrays(const TetMesh& mesh, const std::vector<double>& v,
                                    double band_threshold) {
  std::vector<MeshArray> arrays{{"s1", 1, {}}, {"s2", 1, {}}, {"s3", 1, {}}, {"edge", 1, {}}};
  for (const auto& s : aspect_ratios(mesh)) {
    for (std::size_t i = 0; i < 3; ++i) arrays[i].values.push_back(s[i]);
  }
  arrays[3].values.assign(mesh.cells.size(), 0);
  for (const Index cell : band_cells(mesh, v, band_threshold)) {
    arrays[3].values[static_cast<std::size_t>(cell)] = 1;
  }
  return arrays;
}

void add_fields(const Result& result, const RestrictedMesh& part, const ImageMeans& native,
                MeshWithArrays& grid) {
  const std::vector<double> u = values_at(part.nodes, result.u);
  const std::vector<double> v = values_at(part.nodes, result.v);
  const std::vector<double> u_of_cells = cell_means(part.mesh, u);
  grid.point_arrays = {{"u", 1, u},
                       {"v", 1, v},
                       {"f", 1, values_at(part.nodes, result.f)},
                       {"metric", 6, metric_at(part.nodes, result.metric)},
                       {"u_native", 1, to_native(result.parameters.grey, u)},
                       {"native", 1, native.nodes}};
  grid.cell_arrays = shape_arrays(part.mesh, v, result.parameters.band_threshold);
  grid.cell_arrays.push_back({"u", 1, u_of_cells});
  grid.cell_arrays.push_back({"u_native", 1, to_native(result.parameters.grey, u_of_cells)});
  grid.cell_arrays.push_back({"native", 1, native.cells});
}

/// As many digits for each number as the last one needs, two at least.
std::string bin_name(std::size_t number, std::size_t count) {
  const std::string text = std::to_string(number);
  const std::size_t width = std::max<std::size_t>(2, std::to_string(count).size());
  return "GREY_BIN_" + std::string(width - text.size(), '0') + text;
}

std::string bin_note(const MeshBin& bin) {
  std::ostringstream note;
  note << "native " << bin.low << " to " << bin.high << ", ";
  if (bin.cells == 0) return note.str() + "no cell";
  note << "mean " << bin.native_mean << ", " << bin.cells << " cells, " << bin.volume << " mm^3";
  return note.str();
}

/// Cells, volume and mean native value of each set.
/// @param native  of the cells.
void measure_sets(const std::vector<double>& native, MeshOutput& out) {
  const TetMesh& mesh = out.grid.mesh;
  for (std::size_t c = 0; c < native.size(); ++c) {
    MeshBin& bin = out.bins[static_cast<std::size_t>(out.sets.of_cell[c])];
    const double volume = cell_volume(mesh, static_cast<Index>(c));
    ++bin.cells;
    bin.volume += volume;
    bin.native_mean += volume * native[c];
    out.volume += volume;
  }
  for (MeshBin& bin : out.bins) {
    if (bin.cells > 0) bin.native_mean /= bin.volume;
  }
}

/// Sets by equal ranges of the native value, numbered from 1.
void sort_into_bins(const std::vector<double>& native, MeshOutput& out) {
  ValueBins sorted = equal_bins(native, out.options.bins);
  out.bins.resize(sorted.edges.size() - 1);
  out.sets.of_cell = std::move(sorted.of_value);
  for (std::size_t b = 0; b < out.bins.size(); ++b) {
    out.bins[b].low = sorted.edges[b];
    out.bins[b].high = sorted.edges[b + 1];
    out.numbers.push_back(static_cast<Index>(b) + 1);
  }
  measure_sets(native, out);
  for (std::size_t b = 0; b < out.bins.size(); ++b) {
    out.sets.sets.push_back({bin_name(b + 1, out.bins.size()), bin_note(out.bins[b])});
  }
}

/// Sets by label, 0 for the background.
void sort_by_label(const std::vector<double>& native, CellSets labels,
                   std::span<const FoundObject> objects, MeshOutput& out) {
  out.sets = std::move(labels);
  out.bins.resize(out.sets.sets.size());
  out.numbers = {0};
  for (const FoundObject& object : objects) out.numbers.push_back(object.segment.label);
  std::vector<char> seen(out.bins.size(), 0);
  for (std::size_t c = 0; c < native.size(); ++c) {
    const auto set = static_cast<std::size_t>(out.sets.of_cell[c]);
    MeshBin& bin = out.bins[set];
    bin.low = seen[set] != 0 ? std::min(bin.low, native[c]) : native[c];
    bin.high = seen[set] != 0 ? std::max(bin.high, native[c]) : native[c];
    seen[set] = 1;
  }
  measure_sets(native, out);
}

/// The number of each cell's set.
std::vector<Index> set_numbers(const MeshOutput& mesh) {
  std::vector<Index> numbers;
  numbers.reserve(mesh.sets.of_cell.size());
  for (const Index set : mesh.sets.of_cell) {
    numbers.push_back(mesh.numbers[static_cast<std::size_t>(set)]);
  }
  return numbers;
}

void add_numbers(const std::string& name, MeshOutput& out) {
  const std::vector<Index> numbers = set_numbers(out);
  out.grid.cell_arrays.push_back({name, 1, std::vector<double>(numbers.begin(), numbers.end())});
}

const MeshArray& array_of(const std::vector<MeshArray>& arrays, std::string_view name) {
  return *std::find_if(arrays.begin(), arrays.end(),
                       [name](const MeshArray& array) { return array.name == name; });
}

std::vector<std::vector<double>> values_of(const std::vector<MeshArray>& arrays,
                                           const std::vector<std::string_view>& names) {
  std::vector<std::vector<double>> values;
  values.reserve(names.size());
  for (const auto name : names) values.push_back(array_of(arrays, name).values);
  return values;
}

void write_medit(const OutputPath& path, const MeshOutput& mesh, Frame frame) {
  OutputSet both(path.set);
  write_medit_mesh(both.file(path), mesh.grid.mesh, frame, set_numbers(mesh));
  fs::path fields = path;
  write_medit_scalars(both.file(fields.replace_extension(".sol")),
                      values_of(mesh.grid.point_arrays, {"u", "v", "f", "u_native", "native"}),
                      values_of(mesh.grid.cell_arrays, {"u", "u_native", "native"}));
  both.commit();
}

void write_gmsh(const OutputPath& path, const MeshOutput& mesh, Frame frame) {
  MeshWithArrays grid{mesh.grid.mesh, {}, {}};
  for (const auto* name : {"u", "u_native", "native"}) {
    grid.point_arrays.push_back(array_of(mesh.grid.point_arrays, name));
    grid.cell_arrays.push_back(array_of(mesh.grid.cell_arrays, name));
  }
  write_gmsh(path, grid, mesh.sets, frame);
}

/// The cells of a region and their fields.
/// @param native  gets their native values.
MeshOutput region_of(const Result& result, const VolumeView& volume, const MeshOptions& options,
                     const std::vector<Index>& cells, std::vector<double>& native) {
  RestrictedMesh part = restrict_mesh(result.mesh, cells);
  ImageMeans means = average_image(volume, part.mesh);
  MeshOutput out;
  out.options = options;
  out.level_native = result.parameters.level;
  out.components = count_face_parts(part.mesh);
  add_fields(result, part, means, out.grid);
  out.grid.mesh = std::move(part.mesh);
  native = std::move(means.cells);
  return out;
}

/// Leaves out the background.
/// @return the cells that stay, and their sets in `labels`.
std::vector<Index> labelled_cells(CellSets& labels) {
  std::vector<Index> cells, sets;
  for (std::size_t c = 0; c < labels.of_cell.size(); ++c) {
    if (labels.of_cell[c] == 0) continue;
    cells.push_back(static_cast<Index>(c));
    sets.push_back(labels.of_cell[c]);
  }
  labels.of_cell = std::move(sets);
  if (cells.empty()) throw InputError("mesh region: expected cells within an object, found none");
  return cells;
}

}  // namespace

MeshOutput make_mesh_output(const Result& result, const VolumeView& volume,
                            const MeshOptions& options) {
  const bool object = options.region == MeshRegion::kObject;
  std::vector<double> native;
  MeshOutput out = region_of(result, volume, options,
                             object ? object_cells(result) : all_cells(result.mesh), native);
  sort_into_bins(native, out);
  add_numbers("bin", out);
  return out;
}

MeshOutput make_mesh_output(const Result& result, const VolumeView& volume,
                            const MeshOptions& options, std::span<const FoundObject> objects) {
  const bool object = options.region == MeshRegion::kObject;
  CellSets labels = label_sets(result.mesh, objects);
  const auto cells = object ? labelled_cells(labels) : all_cells(result.mesh);
  std::vector<double> native;
  MeshOutput out = region_of(result, volume, options, cells, native);
  out.level_native.reset();
  sort_by_label(native, std::move(labels), objects, out);
  add_numbers("label", out);
  return out;
}

MeshWithArrays make_mesh_piece(const Result& piece, const VolumeView& volume) {
  RestrictedMesh all = restrict_mesh(piece.mesh, all_cells(piece.mesh));
  MeshWithArrays grid;
  add_fields(piece, all, average_image(volume, all.mesh), grid);
  grid.mesh = std::move(all.mesh);
  return grid;
}

void write_mesh(const OutputPath& path, const MeshOutput& mesh, Frame frame) {
  const std::string extension = lower_extension(path);
  if (extension == ".mesh") {
    write_medit(path, mesh, frame);
  } else if (extension == ".msh") {
    write_gmsh(path, mesh, frame);
  } else if (extension == ".inp") {
    write_abaqus(path, mesh.grid.mesh, mesh.sets, frame);
  } else {
    write_vtu(path, mesh.grid.mesh, {mesh.grid.point_arrays, mesh.grid.cell_arrays, frame});
  }
}

std::vector<std::string> written_mesh_formats() { return {".vtu", ".mesh", ".msh", ".inp"}; }

void write_band_mesh(const OutputPath& path, const Result& result, Frame frame) {
  const RestrictedMesh band = restrict_mesh(
      result.mesh, band_cells(result.mesh, result.v, result.parameters.band_threshold));
  const std::vector<MeshArray> points{{"v", 1, values_at(band.nodes, result.v)}};
  write_vtu(path, band.mesh, {.point_arrays = points, .frame = frame});
}

}  // namespace mesamis::detail::report
