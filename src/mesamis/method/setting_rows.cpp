// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/setting_rows.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <type_traits>

#include "mesamis/restore/deblur.h"

namespace mesamis::detail::method {

bool is_word(const SettingValue& value, std::string_view word) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr && *text == word;
}

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Smallest and largest positive values that make sense of a weight or a length.
constexpr double kTiny = 1e-12, kHuge = 1e12;
/// Native values are single precision.
constexpr double kLargestValue = 1e38;
constexpr double kLargestIndex = std::numeric_limits<Index>::max();

using Numbers = std::vector<double>;

// ---- From a member of Settings to a value and back.

template <class T>
requires std::is_arithmetic_v<T> Numbers numbers_of(T x) { return {static_cast<double>(x)}; }
template <class T>
Numbers numbers_of(const std::array<T, 3>& x) {
  return {x.begin(), x.end()};
}
Numbers numbers_of(const Window& w) { return {w.low, w.high}; }
Numbers numbers_of(const CropRange& range) {
  Numbers numbers;
  for (std::size_t a = 0; a < 3; ++a) {
    numbers.insert(numbers.end(),
                   {static_cast<double>(range.begin[a]), static_cast<double>(range.end[a])});
  }
  return numbers;
}

template <class T>
requires std::is_arithmetic_v<T>
void take(const Numbers& n, T& x) { x = static_cast<T>(n[0]); }
template <class T>
void take(const Numbers& n, std::array<T, 3>& x) {
  for (std::size_t a = 0; a < 3; ++a) x[a] = static_cast<T>(n[a]);
}
void take(const Numbers& n, Window& w) { w = {n[0], n[1]}; }
void take(const Numbers& n, CropRange& range) {
  for (std::size_t a = 0; a < 3; ++a) {
    range.begin[a] = static_cast<Index>(n[2 * a]);
    range.end[a] = static_cast<Index>(n[2 * a + 1]);
  }
}

template <class T>
void bind_value(Setting& row, T Settings::*member) {
  row.get = [member](const Settings& s) { return SettingValue(numbers_of(s.*member)); };
  row.set = [member](Settings& s, const SettingValue& value) {
    take(std::get<Numbers>(value), s.*member);
  };
}

void bind_value(Setting& row, bool Settings::*member) {
  row.get = [member](const Settings& s) { return SettingValue(s.*member); };
  row.set = [member](Settings& s, const SettingValue& value) { s.*member = std::get<bool>(value); };
}

/// Without a value the setting is "auto".
template <class T>
void bind_value(Setting& row, std::optional<T> Settings::*member) {
  row.get = [member](const Settings& s) {
    return s.*member ? SettingValue(numbers_of(*(s.*member))) : SettingValue("auto");
  };
  row.set = [member](Settings& s, const SettingValue& value) {
    (s.*member).reset();
    if (!is_word(value, "auto")) take(std::get<Numbers>(value), (s.*member).emplace());
  };
}

/// The row's words in the order of the enumerators.
template <class Enum>
requires std::is_enum_v<Enum>
void bind_value(Setting& row, Enum Settings::*member) {
  const std::vector<std::string> words = row.words;
  row.get = [=](const Settings& s) {
    return SettingValue(words[static_cast<std::size_t>(s.*member)]);
  };
  row.set = [=](Settings& s, const SettingValue& value) {
    const auto at = std::find(words.begin(), words.end(), std::get<std::string>(value));
    s.*member = static_cast<Enum>(at - words.begin());
  };
}

// ---- From a member of Settings to that of Parameters and back.

template <class T, class OfRun>
void bind_run(Setting& row, T Settings::*member, OfRun of_run) {
  row.use = [=](const Settings& s, Parameters& p) { std::invoke(of_run, p) = s.*member; };
  row.repeat = [=](const Parameters& p, Settings& s) { s.*member = std::invoke(of_run, p); };
}

/// What is "auto" stays as it was chosen.
template <class T, class OfRun>
void bind_run(Setting& row, std::optional<T> Settings::*member, OfRun of_run) {
  row.use = [=](const Settings& s, Parameters& p) {
    if (s.*member) std::invoke(of_run, p) = *(s.*member);
  };
  row.repeat = [=](const Parameters& p, Settings& s) { s.*member = std::invoke(of_run, p); };
}

/// A member of the functional's parameters.
auto of_functional(double AtParameters::*member) {
  return [member](auto& p) -> auto& { return p.functional.*member; };
}

/// @param of_run  the member of Parameters, or what returns a reference to it.
template <class Member, class OfRun>
Setting bound(Setting row, Member member, OfRun of_run) {
  bind_value(row, member);
  bind_run(row, member, of_run);
  return row;
}

/// The same where 0 is none, which was not asked for.
template <class Member, class OfRun>
Setting bound_unless_zero(Setting row, Member member, OfRun of_run) {
  row = bound(std::move(row), member, of_run);
  row.repeat = [=](const Parameters& p, Settings& s) {
    if (std::invoke(of_run, p) > 0) s.*member = std::invoke(of_run, p);
  };
  return row;
}

// ---- Settings whose value or whose use is of a kind of its own.

/// The run has a map of grey values in its place.
Setting window_row(Setting row) {
  bind_value(row, &Settings::window);
  row.use = [](const Settings&, Parameters&) {};
  row.repeat = [](const Parameters& p, Settings& s) { s.window = Window{p.grey.low, p.grey.high}; };
  return row;
}

/// A band has none. Where each place has its own, a repeated run finds the same again.
Setting level_row(Setting row) {
  row = bound(std::move(row), &Settings::level, &Parameters::level);
  row.get = [get = row.get](const Settings& s) {
    return s.local_level && !s.level ? SettingValue("local") : get(s);
  };
  row.set = [set = row.set](Settings& s, const SettingValue& value) {
    s.local_level = is_word(value, "local");
    set(s, s.local_level ? SettingValue("auto") : value);
  };
  row.use = [use = row.use](const Settings& s, Parameters& p) {
    use(s, p);
    p.local_level = s.has_local_level();
  };
  row.repeat = [](const Parameters& p, Settings& s) {
    s.local_level = p.local_level;
    if (p.surface == SurfaceKind::kSolid && !p.local_level) s.level = p.level;
  };
  return row;
}

Setting threshold_row(Setting row) {
  row.get = [](const Settings& s) -> SettingValue {
    switch (s.threshold_rule) {
      case ThresholdRule::kAuto:
        return "auto";
      case ThresholdRule::kNone:
        return "none";
      case ThresholdRule::kPaper:
        return "paper";
      case ThresholdRule::kValue:
        break;
    }
    return Numbers{s.threshold};
  };
  row.set = [](Settings& s, const SettingValue& value) {
    s.threshold_rule = is_word(value, "auto")    ? ThresholdRule::kAuto
                       : is_word(value, "none")  ? ThresholdRule::kNone
                       : is_word(value, "paper") ? ThresholdRule::kPaper
                                                 : ThresholdRule::kValue;
    if (s.threshold_rule == ThresholdRule::kValue) s.threshold = std::get<Numbers>(value)[0];
  };
  row.use = [](const Settings&, Parameters&) {};
  row.repeat = [](const Parameters& p, Settings& s) {
    s.threshold_rule = p.grey.has_threshold() ? ThresholdRule::kValue : ThresholdRule::kNone;
    s.threshold = p.grey.threshold;
  };
  return row;
}

Setting blur_row(Setting row) {
  row = bound(std::move(row), &Settings::blur, &Parameters::blur);
  row.set = [set = row.set](Settings& s, const SettingValue& value) {
    set(s, is_word(value, "none") ? SettingValue(Numbers{0, 0, 0}) : value);
  };
  return row;
}

Setting tolerance_row(Setting row) {
  row = bound(std::move(row), &Settings::tolerance, &Parameters::tolerance);
  row.get = [get = row.get](const Settings& s) {
    return s.tolerance == kInfinity ? SettingValue("none") : get(s);
  };
  row.set = [set = row.set](Settings& s, const SettingValue& value) {
    set(s, is_word(value, "none") ? SettingValue(Numbers{kInfinity}) : value);
  };
  return row;
}

// ---- The table: a row per setting, in the order in which they are written.

// clang-format off

std::vector<Setting> image_rows() {
  return {
    bound({.name = "crop", .form = "I0:I1,J0:J1,K0:K1", .count = 6, .whole = true, .ranges = true,
           .low = -1, .high = kLargestIndex, .unit = "voxels",
           .help = "Part of the volume to use, ends excluded; nothing, or -1 as an end: the "
               "volume's own bound"}, &Settings::crop, &Parameters::crop),
    bound({.name = "stride", .form = "X,Y,Z", .count = 3, .whole = true, .low = 1, .high = 1000,
           .words = {"auto"}, .unit = "voxels", .help = "Voxels per node of the first grid",
           .automatic = "1; 2 in volumes of more than a million voxels, along the axes where that is no "
               "more than twice the voxels' mean size; for a preview, so that there are at most three "
               "million nodes", .paper = "1,1,1"}, &Settings::stride, &Parameters::stride),
    window_row({.name = "window", .form = "LO,HI", .count = 2, .low = -kLargestValue,
           .high = kLargestValue, .words = {"auto"}, .unit = "native",
           .help = "Values that become grey values 0 and 255",
           .automatic = "CT: -200 HU to the 99.9 percentile, at least 800 and at most 2000 HU; "
               "else the 0.1 and 99.9 percentiles; widened where the level needs room"}),
    threshold_row({.name = "threshold", .form = "T", .count = 1, .low = -kLargestValue,
                   .high = kLargestValue, .words = {"auto", "none", "paper"}, .unit = "native",
                   .help = "T of (13): what is darker counts as T; paper: 140 of 255 grey values",
                   .automatic = "the upper end of the tissue around the object; none for images "
                       "of two classes", .paper = "paper"}),
    bound({.name = "restore", .form = "yes|no",
           .help = "Remove impulses and undo the blur before the method sees the image",
           .paper = "no"}, &Settings::restore, &Parameters::restore),
    bound({.name = "noise", .form = "S", .count = 1, .low = 0, .high = kLargestValue,
           .words = {"auto"}, .unit = "native", .help = "Standard deviation of the noise",
           .automatic = "measured beside the object's surface, on the quieter side"},
          &Settings::noise, &Parameters::noise),
    blur_row({.name = "blur", .form = "X,Y,Z", .count = 3, .low = 0, .high = kLargestBlur,
              .words = {"auto", "none"}, .unit = "voxels",
              .help = "Blur to undo, standard deviation along each axis",
              .automatic = "from the slopes of the object's edges where it is thickest; none without "
                  "restore"}),
  };
}

std::vector<Setting> functional_rows() {
  return {
    bound({.name = "length_unit", .form = "voxel|mm", .words = {"voxel", "mm"},
           .help = "Unit of the lengths in the functional and of h-min and h-max; voxel: the "
               "geometric mean of the spacing", .paper = "mm"}, &Settings::length_unit, &Parameters::length_unit),
    bound({.name = "epsilon", .form = "X", .count = 1, .low = kTiny, .high = kHuge,
           .unit = "length units", .help = "Thickness of the edge indicator"}, &Settings::epsilon, of_functional(&AtParameters::epsilon)),
    bound({.name = "eta", .form = "X", .count = 1, .low = kTiny * kTiny, .high = kHuge,
           .words = {"auto"}, .help = "Smallest diffusion, at edges",
           .automatic = "epsilon squared"}, &Settings::eta, of_functional(&AtParameters::eta)),
    bound({.name = "beta", .form = "X", .count = 1, .low = kTiny, .high = kHuge,
           .unit = "length units squared",
           .help = "Weight of smoothness away from edges"}, &Settings::beta, of_functional(&AtParameters::beta)),
    bound({.name = "gamma", .form = "X", .count = 1, .low = kTiny, .high = kHuge,
           .words = {"auto"}, .unit = "grey values squared times length units",
           .help = "Weight of the edge indicator: the price of edges",
           .automatic = "4 epsilon beta (0.07 contrast + 0.25 noise)^2, both measured",
           .paper = "0.1"}, &Settings::gamma, of_functional(&AtParameters::gamma)),
    bound({.name = "amis_iterations", .form = "N", .count = 1, .whole = true, .low = 1,
           .high = 1000,
           .help = "Jmax of Algorithm 1: alternations per mesh at most"},
          &Settings::amis_iterations, &Parameters::amis_iterations),
    bound({.name = "tol_v", .form = "X", .count = 1, .low = 0, .high = 1,
           .help = "Algorithm 1 stops when v changes by less everywhere"}, &Settings::tol_v, &Parameters::tol_v),
    bound({.name = "solver_tolerance", .form = "X", .count = 1, .low = 1e-14, .high = 1e-2,
           .help = "Relative residual of each linear solve"}, &Settings::solver_tolerance, &Parameters::solver_tolerance),
  };
}

std::vector<Setting> mesh_rows() {
  return {
    bound_unless_zero({.name = "max_tets", .form = "N", .count = 1, .whole = true, .low = 100, .high = 2e8,
           .words = {"auto"}, .help = "NMAX: cells of the mesh at most",
           .automatic = "4.5 for each square of the object's surface with the voxel's shortest "
               "side, 18 in walls and gaps thinner than two voxels, times a tenth of a voxel over accuracy, "
               "a quarter to four, if that is asked for; 20 000 to 2 000 000 in all", .paper = "1300000"}, &Settings::max_tets, &Parameters::max_tets),
    bound({.name = "tau", .form = "X", .count = 1, .low = kTiny, .high = kHuge,
           .help = "Tolerance on the error estimator"}, &Settings::tau, &Parameters::tau),
    bound({.name = "adaptations", .form = "N", .count = 1, .whole = true, .low = 1, .high = 100,
           .help = "Adaptations of the mesh at most"}, &Settings::adaptations, &Parameters::adaptations),
    bound({.name = "tol_mesh", .form = "X", .count = 1, .low = 0, .high = kHuge,
           .help = "The mesh has settled when the cell count changes by less, relatively"},
          &Settings::tol_mesh, &Parameters::tol_mesh),
    bound({.name = "tol_energy", .form = "X", .count = 1, .low = 0, .high = kHuge,
           .help = "The energy has settled when it changes by less, relatively"},
          &Settings::tol_energy, &Parameters::tol_energy),
    bound({.name = "until", .form = "surface|energy|either", .words = {"surface", "energy", "either"},
           .help = "surface: the loop ends when a mesh has moved the solid by less than its expected "
               "error, or a fifth of a voxel, if that is more and the solid then follows the image; "
               "energy, and for a band: when mesh and energy have settled; either: when one has",
           .paper = "either"}, &Settings::until, &Parameters::until),
    bound({.name = "drafts", .form = "yes|no",
           .help = "Meshes are remeshed in fewer rounds; those before the last have fewer cells and approximate fields",
           .paper = "no"}, &Settings::drafts, &Parameters::drafts),
    bound({.name = "max_stretch", .form = "X", .count = 1, .low = 1.1, .high = 1e6,
           .help = "Longest to shortest size of a cell at most",
           .paper = "30000"}, &Settings::max_stretch, &Parameters::max_stretch),
    bound({.name = "gradation", .form = "X", .count = 1, .low = 1.01, .high = 1000,
           .exceptions = {0},
           .help = "Growth of sizes from edge to edge at most; 0: any"}, &Settings::gradation, &Parameters::gradation),
    bound({.name = "h_min", .form = "X", .count = 1, .low = kTiny, .high = kHuge,
           .unit = "length units", .help = "Smallest edge", .paper = "0.1"}, &Settings::h_min, &Parameters::h_min),
    bound({.name = "h_max", .form = "X", .count = 1, .low = kTiny, .high = kHuge,
           .words = {"auto"}, .unit = "length units", .help = "Largest edge",
           .automatic = "a quarter of the box's longest side"}, &Settings::h_max, &Parameters::h_max),
  };
}

std::vector<Setting> surface_rows() {
  return {
    bound({.name = "surface", .form = "solid|band", .words = {"solid", "band"},
           .help = "solid: closed level set of u; band: the paper's surface, the boundary of the "
               "cells where v is small", .paper = "band"}, &Settings::surface, &Parameters::surface),
    level_row({.name = "level", .form = "X", .count = 1, .low = -kLargestValue, .high = kLargestValue,
           .words = {"auto", "local"}, .unit = "native", .help = "Value of the solid surface; local: "
               "that of auto, but where bones of a CT differ in density, for each place midway "
               "between the two sides of the edges around it",
           .automatic = "half maximum of the object's edge, fitted to the image where the object "
               "is thickest; above T"}),
    bound({.name = "follow", .form = "yes|no",
           .help = "Move the solid surface on to the image where that is more exact than the mesh",
           .paper = "no"}, &Settings::follow, &Parameters::follow),
    bound({.name = "fit", .form = "yes|no",
           .help = "Objects of labels: fit their smooth surfaces to the image, where labels are "
               "coarser than the scan after these have flowed to its edges; of labels alone: smooth "
               "the steps of their voxels; without labels: smooth the ripples of noise and the "
               "terraces of thick slices",
           .paper = "no"}, &Settings::fit, &Parameters::fit),
    bound({.name = "keep_topology", .form = "yes|no",
           .help = "Leave the tunnels in thin bones of a CT, narrow contacts of labels, and the gaps of no "
               "volume that open where thin labels pass across edges and corners",
           .paper = "yes"}, &Settings::keep_topology, &Parameters::keep_topology),
    bound({.name = "band_threshold", .form = "X", .count = 1, .low = 0, .high = 1,
           .help = "TOLth: the band's cells have v below this"}, &Settings::band_threshold, &Parameters::band_threshold),
    bound({.name = "min_volume", .form = "X", .count = 1, .low = 0, .high = 1e12,
           .words = {"auto"}, .unit = "mm^3",
           .help = "Smaller islands of the solid go, smaller cavities are filled",
           .automatic = "4 voxels; with labels one, and the largest part stays"}, &Settings::min_volume, &Parameters::min_volume),
    bound({.name = "keep_largest", .form = "N", .count = 1, .whole = true, .low = 0, .high = 1e9,
           .help = "Islands of the solid to keep; 0: all"}, &Settings::keep_largest, &Parameters::keep_largest),
    bound({.name = "fill_cavities", .form = "yes|no",
           .help = "Fill every cavity of the solid"}, &Settings::fill_cavities, &Parameters::fill_cavities),
    bound_unless_zero({.name = "accuracy", .form = "MM", .count = 1, .low = kTiny, .high = kHuge,
           .words = {"auto"}, .unit = "mm",
           .help = "Mean distance of the solid to the truth that is asked for: chooses max-tets and "
               "tolerance where they are auto",
           .automatic = "none is asked for: the usual cells and tolerance"}, &Settings::accuracy, &Parameters::accuracy),
    tolerance_row({.name = "tolerance", .form = "X", .count = 1, .low = 0, .high = kHuge,
                   .words = {"auto", "none"}, .unit = "mm",
                   .help = "Decimation keeps the solid surface within this distance; 0: no "
                       "decimation; none: no bound",
                   .automatic = "5 times the error to expect of the shape, 0.084 to 0.28 voxel (labels: half of that; slabs: "
                                "1.75 times, 0.03 to 0.1; previews: 0), or half of accuracy, if that is asked for; none where "
                                "triangles says where to stop"}),
    bound({.name = "preview", .form = "yes|no",
           .help = "The solid of the first grid, quickly: no mesh is adapted"},
          &Settings::preview, &Parameters::preview),
    bound_unless_zero({.name = "triangles", .form = "N", .count = 1, .whole = true, .low = 4, .high = 2e9,
           .words = {"auto"}, .help = "Decimation stops at this many triangles",
           .automatic = "as few as the tolerance permits"}, &Settings::triangles, &Parameters::triangles),
  };
}
// clang-format on

void add_group(std::vector<Setting>& table, const std::string& group, std::vector<Setting> rows) {
  for (Setting& row : rows) {
    row.group = group;
    table.push_back(std::move(row));
  }
}

}  // namespace

std::vector<Setting> build_setting_rows() {
  std::vector<Setting> table;
  add_group(table, "Image", image_rows());
  add_group(table, "Functional", functional_rows());
  add_group(table, "Mesh", mesh_rows());
  add_group(table, "Surface", surface_rows());
  return table;
}

}  // namespace mesamis::detail::method
