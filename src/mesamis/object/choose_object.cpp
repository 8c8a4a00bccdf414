// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/choose_object.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/median.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/sample_slices.h"
#include "mesamis/object/keep.h"
#include "mesamis/object/mirror.h"
#include "mesamis/object/padding.h"
#include "mesamis/object/places.h"
#include "mesamis/object/split_at_seeds.h"
#include "mesamis/object/tissue.h"
#include "mesamis/object/tissue_level.h"
#include "mesamis/object/voxel_islands.h"
#include "mesamis/object/whole_values.h"
#include "mesamis/restore/local_level.h"

namespace mesamis::detail::object {
namespace {

constexpr double kAirHu = -1000, kSoftHu = 40;
constexpr std::size_t kMostLookedAt = std::size_t{1} << 24;  // voxels, for the scatter of levels

/// A text with a number in it.
template <class... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 300> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// Whatever is bright: what a run without a tissue looks for.
Tissue bright_tissue() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {.name = "the object",
          .values = {-kInfinity, kInfinity},
          .levels = {-kInfinity, kInfinity},
          .hounsfield = false};
}

/// What a mask is surrounded by: the median from one to three voxels beside it.
double value_around(const VolumeView& volume, const VoxelMask& grown) {
  const VoxelMask ring = only_in(dilated(grown, volume, 2 * volume.voxel_size()), grown);
  std::vector<double> values;
  for (std::size_t n = 0; n < ring.size(); ++n) {
    if (ring[n] != 0) values.push_back(volume.samples[n]);
  }
  return values.empty() ? sample_range(volume.samples).first : median(values);
}

[[noreturn]] void refuse_without_patient() {
  throw InputError("remove: expected a patient's body in a CT scan, found none");
}

/// A label map that is read as a scan has no grey values: its surface follows the voxels.
void warn_of_labels(const VolumeView& scan, std::vector<std::string>& warnings) {
  if (const auto found = find_few_whole_values(scan)) {
    warnings.push_back(
        line("the scan has only %zu whole values, %g to %g: likely a label map, which --labels "
             "takes",
             found->count, found->least, found->most));
  }
}

/// Whether a surface can lie at the ends of a range: samples lie within it and beyond it.
struct SamplesOfRange {
  float least, most;  ///< of all samples
  bool within = false, beyond = false;
};

SamplesOfRange look_at_range(std::span<const float> samples, const Window& range) {
  SamplesOfRange found{samples.front(), samples.front()};
  for (const float sample : samples) {
    const bool within = range.low < sample && sample < range.high;
    found.within = found.within || within;
    found.beyond = found.beyond || sample < range.low || range.high < sample;
    found.least = std::min(found.least, sample);
    found.most = std::max(found.most, sample);
  }
  return found;
}

/// The steps of choose_object().
class ObjectChooser {
 public:
  ObjectChooser(Volume scan, const ObjectRequest& request)
      : request_(request),
        units_(request.tissue ? request.tissue->kind : TissueKind::kBright),
        in_hounsfield_(is_hounsfield(scan)) {
    chosen_.volume = std::move(scan);
    chosen_.hounsfield = in_hounsfield_;
    if (in_hounsfield_) chosen_.volume.modality = "CT";  // a part without air tells it no more
    chosen_.crop = request.crop;
    if (request.tissue) {
      chosen_.kind = request.tissue->kind;
      chosen_.tissue = request.tissue->name;
    }
  }

  ChosenObject run() {
    cropped_size(chosen_.volume, request_.crop);  // refused before any work
    for (const Vec3& seed : request_.seeds) voxel_at(chosen_.volume, seed);
    if (request_.tissue && !is_level_given()) require_hounsfield(chosen_.volume, *request_.tissue);
    if (!request_.has_labels) warn_of_labels(chosen_.volume, chosen_.warnings);
    fill_padding();
    remove_surroundings();
    if (chosen_.kind == TissueKind::kBright) remove_marked();
    require_range_in_data();
    turn();
    if (chosen_.kind == TissueKind::kDark && request_.tissue->in_patient) fill_around_patient();
    find_level();
    measure_before_crop();
    crop_all();
    if (needs_level_of_crop()) {
      set_level(find_tissue_level(chosen_.volume, bright_tissue()), true);
    } else if (request_.level && !in_hounsfield_ && !request_.tissue) {
      find_background();
    }
    if (chosen_.kind != TissueKind::kBright) remove_marked();
    if (request_.mask) keep_mask();
    if (!request_.seeds.empty()) keep_seeds();
    return std::move(chosen_);
  }

 private:
  /// A range of values without a surface is refused in the units of the scan.
  void require_range_in_data() const {
    if (request_.level || !request_.tissue || !request_.tissue->level_is_given()) return;
    const bool whole = request_.crop == CropRange{};
    const Volume part = whole ? Volume{} : crop(chosen_.volume, request_.crop);
    const SamplesOfRange found =
        look_at_range(whole ? chosen_.volume.samples : part.samples, request_.tissue->values);
    if (found.within && found.beyond) return;
    throw InputError(
        line("tissue: expected a range with samples %s it, which lie between %.6g and "
             "%.6g, found %s",
             found.within ? "beyond" : "within", found.least, found.most, chosen_.tissue.c_str()));
  }

  void fill_padding() {
    auto padding = find_padding(chosen_.volume, request_.padding);
    if (!padding && request_.padding.value) {
      chosen_.warnings.push_back(
          line("padding: expected voxels of %g and others, found none", *request_.padding.value));
    }
    if (!padding) return;
    const double value = in_hounsfield_
                             ? kAirHu
                             : quantiles(samples_outside(chosen_.volume, padding->mask), {0.05})[0];
    chosen_.volume = filled(std::move(chosen_.volume), padding->mask, value);
    chosen_.padding = FilledPadding{padding->voxels, padding->value, value};
    chosen_.unmeasured = std::move(padding->mask);
    chosen_.notes.push_back(
        line("padding: %zu voxels of %g, which the scanner did not measure, "
             "are filled with %g; --padding none leaves them",
             padding->voxels, padding->value, value));
  }

  void remove_surroundings() {
    if (request_.surroundings == SurroundingsRule::kKeep) return;
    const bool asked = request_.surroundings == SurroundingsRule::kRemove;
    patient_ = find_patient(chosen_.volume);
    if (!patient_ && asked) refuse_without_patient();
    if (!patient_ || patient_->removed.empty()) return;
    chosen_.volume = without_surroundings(std::move(chosen_.volume), *patient_);
    chosen_.removed = patient_->removed;
    std::string things;
    for (const Surroundings& thing : patient_->removed) {
      things += line("%s, %.3g cm^3; ", thing.what.c_str(), thing.mm3 / 1000);
    }
    chosen_.notes.push_back("removed: " + things + "--keep-surroundings leaves it");
  }

  /// The air around the patient is as dark as that within, and has more surface: it goes first.
  void fill_around_patient() {
    if (!patient_) {
      chosen_.warnings.push_back("tissue: no body was found; the air around it comes along");
      return;
    }
    const VoxelMask inside = eroded(patient_->mask, chosen_.volume, patient_->grain);
    chosen_.volume = kept_to(std::move(chosen_.volume), inside,
                             {.margin = 0, .background = units_.turned(kSoftHu)});
  }

  void remove_marked() {
    if (!request_.remove) return;
    const VolumeView volume = chosen_.volume;
    const auto mask = mask_on(*request_.remove, request_.remove->segments, volume);
    const std::size_t voxels = count_marked(mask);
    if (voxels == 0) throw InputError("remove: expected marks within the scan, found none");
    const VoxelMask grown = dilated(mask, volume, volume.voxel_size());
    const double around = value_around(volume, grown);
    const Vec3 side = volume.spacing;
    chosen_.volume = without(std::move(chosen_.volume), grown, {.margin = 0, .background = around});
    chosen_.removed.push_back(
        {"marked by a label map", static_cast<double>(voxels) * side.x * side.y * side.z});
  }

  bool is_part() const {
    return !(request_.crop == CropRange{}) || request_.mask || !request_.seeds.empty();
  }

  /// Whether no tissue's level is looked for.
  bool is_level_given() const {
    return request_.level || request_.tissue->kind == TissueKind::kRange;
  }

  /// That of a range is 0 unless it is given: by how much a sample lies within.
  void find_level() {
    if (request_.level) {
      chosen_.level = {units_.turned(*request_.level), LevelSource::kUser};
      if (in_hounsfield_ || request_.tissue) find_background();
    } else if (chosen_.kind == TissueKind::kRange) {
      chosen_.level = {0, LevelSource::kTissue};
    } else if (request_.tissue) {
      set_level(find_tissue_level(chosen_.volume, units_.turned(*request_.tissue)), false);
    } else if (in_hounsfield_ && is_part() && wants_level()) {
      const TissueLevel found = find_tissue_level(chosen_.volume, bright_tissue());
      set_level(found, false);
      seen_ = found.seen;
    }
  }

  bool wants_level() const { return request_.measure_level || !request_.seeds.empty(); }

  /// Whether anything but what was chosen falls away.
  bool leaves_some() const { return request_.mask || !request_.seeds.empty(); }

  bool needs_level_of_crop() const { return !chosen_.level && wants_level() && leaves_some(); }

  /// That beside a level which is given, as where this one is measured.
  void find_background() {
    const Tissue tissue = request_.tissue ? units_.turned(*request_.tissue) : bright_tissue();
    if (!leaves_some() || tissue.kind == TissueKind::kRange || tissue.level_is_given()) return;
    const HalfMaximumLevel seen = see_object(chosen_.volume, {.start = tissue.start}).object;
    const bool stands_out = seen.contrast.difference() != 0 && !seen.in_noise;
    if (stands_out) background_ = seen.contrast.background;
  }

  void set_level(const TissueLevel& found, bool in_crop) {
    const LevelSource from = !found.measured ? LevelSource::kTissue
                             : in_crop       ? LevelSource::kCrop
                                             : LevelSource::kScan;
    chosen_.level = {found.level, from, found.uncertainty};
    if (found.contrast.difference() != 0) background_ = found.contrast.background;
    const bool given = request_.tissue && request_.tissue->level_is_given();
    if (found.measured || given) return;
    chosen_.warnings.push_back(line(
        "tissue: the level %.4g is %s; %s may not be in this scan", units_.turned(found.level),
        found.bounded ? "an end of its range" : "where the search starts, as nothing was found",
        request_.tissue ? chosen_.tissue.c_str() : "the object"));
  }

  /// Parts of a scan are restored alike: bones in a crop, or metal, would tell another contrast.
  void measure_before_crop() {
    const bool is_crop = !(request_.crop == CropRange{});
    if (!is_crop || !in_hounsfield_ || chosen_.kind != TissueKind::kBright) return;
    const Volume& scan = chosen_.volume;
    chosen_.scan = measure_scan(scan, seen_ ? *seen_ : see_object(scan, {.level = asked_level()}));
    if (!chosen_.scan || !chosen_.level || !has_local_level()) return;
    const SliceRange seen = sample_slices(scan, kMostLookedAt);
    const Volume slices = crop(scan, {{0, 0, seen.first}, {-1, -1, seen.first + seen.count}});
    chosen_.scan->level_share = levels_in(slices, *chosen_.scan).local.share;
  }

  /// That of the user, or of the tissue.
  std::optional<double> asked_level() const {
    const bool is_asked = chosen_.level && (request_.level || request_.tissue);
    return is_asked ? std::optional(chosen_.level->value) : std::nullopt;
  }

  void crop_all() {
    if (request_.crop == CropRange{}) return;
    if (!chosen_.unmeasured.empty()) {
      chosen_.unmeasured = crop(chosen_.unmeasured, chosen_.volume, request_.crop);
    }
    chosen_.volume = crop(chosen_.volume, request_.crop);
  }

  /// Makes a dark object, or a range of values, bright.
  void turn() {
    if (chosen_.kind == TissueKind::kRange) {
      chosen_.volume = within_range(std::move(chosen_.volume), request_.tissue->values);
      chosen_.volume.modality = "within range";
    } else if (chosen_.kind == TissueKind::kDark) {
      chosen_.volume = mirrored(std::move(chosen_.volume));
      chosen_.volume.modality = "mirrored";
    }
  }

  /// What falls away falls to this: what is around the object.
  double background() const {
    const auto& level = chosen_.level;
    if (background_ && (!level || *background_ < level->value)) return *background_;
    if (!level) return otsu_split(chosen_.volume.samples).mean_below;
    return otsu_split(chosen_.volume.samples, level->value).mean_above;
  }

  void keep_mask() {
    const auto mask = mask_on(*request_.mask, request_.mask->segments, chosen_.volume);
    const double low = background();
    chosen_.volume =
        kept_to(std::move(chosen_.volume), mask, {.margin = request_.margin, .background = low});
  }

  bool has_local_level() const {
    return request_.local_level && chosen_.may_be_bone() &&
           is_likely_bone(chosen_.volume, chosen_.level->value);
  }

  /// A restored image, and the level of each place in it.
  struct Levels {
    Restored restored;
    LocalLevel local;
  };

  Levels levels_in(const Volume& image, const ScanMeasure& scan) const {
    const auto& [seen, object, window] = scan.object;
    Levels found{restore::restore(clamped(image, window), object, scan.options()), {}};
    found.local = find_local_level(found.restored.volume, object.contrast, chosen_.level->value,
                                   {found.restored.noise_left, scan.level_share});
    return found;
  }

  /// The image, restored, less what the level of each place exceeds that of the object.
  Volume levelled() const {
    const auto scan =
        chosen_.scan ? chosen_.scan
                     : measure_scan(chosen_.volume,
                                    see_object(chosen_.volume, {.level = chosen_.level->value}));
    if (!scan) return chosen_.volume;
    Levels found = levels_in(chosen_.volume, *scan);
    take_off(found.local.excess, found.restored.volume);
    return std::move(found.restored.volume);
  }

  /// A seed in a cavity, as in a marrow canal or spongy bone, counts for what encloses it.
  void keep_seeds() {
    const double level = chosen_.level->value;
    const std::optional<Volume> image =
        has_local_level() ? std::optional(levelled()) : std::nullopt;
    const VolumeView volume = image ? *image : chosen_.volume;
    const VoxelMask above = mask_above(volume, level);
    const VoxelMask solid = without_cavities(above, volume);
    std::vector<std::array<Index, 3>> places;
    for (const Vec3& seed : request_.seeds) places.push_back(place_of(seed, solid));
    chosen_.alone = places.size() == 1;
    if (chosen_.alone) {
      darken_others(above, island_at(solid, volume, places[0]));
      return;
    }
    chosen_.parts = split_at_seeds(volume, solid, level, places);
    const auto& labels = chosen_.parts->layers[0];
    VoxelMask wanted(labels.size());
    for (std::size_t n = 0; n < wanted.size(); ++n) wanted[n] = labels[n] != 0;
    darken_others(above, wanted);
  }

  std::array<Index, 3> place_of(const Vec3& seed, const VoxelMask& solid) const {
    const auto place = voxel_at(chosen_.volume, seed);
    if (has_marked_at(solid, chosen_.volume, place)) return place;
    const bool dark = chosen_.kind == TissueKind::kDark;
    throw InputError(
        line("seed: expected values %s %.4g within %g mm of %g,%g,%g (LPS) or around it, found "
             "none",
             dark ? "below" : "above", units_.turned(chosen_.level->value), kBesideMm, seed.x,
             seed.y, seed.z));
  }

  /// Other islands go, with the blur around them as far as it is not the object's own.
  void darken_others(const VoxelMask& above, const VoxelMask& wanted) {
    const VoxelMask others = only_in(above, wanted);
    if (count_marked(others) == 0) return;
    Volume& volume = chosen_.volume;
    const double side = volume.voxel_size();
    const VoxelMask blur = only_in(dilated(others, volume, side), dilated(wanted, volume, side));
    const auto low = static_cast<float>(background());
    for (std::size_t n = 0; n < others.size(); ++n) {
      if (others[n] != 0 || blur[n] != 0) volume.samples[n] = std::min(volume.samples[n], low);
    }
  }

  const ObjectRequest& request_;
  ImageUnits units_;
  bool in_hounsfield_;
  ChosenObject chosen_;
  std::optional<Patient> patient_;
  std::optional<SeenObject> seen_;    // in the whole scan; nothing: a tissue's or a given level
  std::optional<double> background_;  // measured at the object's surface, units of the image
};

}  // namespace

ChosenObject choose_object(Volume scan, const ObjectRequest& request) {
  return ObjectChooser(std::move(scan), request).run();
}

std::optional<ChosenObject> choose_in_place(const VolumeView& scan, const ObjectRequest& request) {
  const bool asked = request.tissue || request.remove || request.mask || !request.seeds.empty();
  if (asked || !(request.crop == CropRange{}) || find_padding(scan, request.padding)) {
    return std::nullopt;
  }
  if (request.surroundings != SurroundingsRule::kKeep) {
    const std::optional<Patient> patient = find_patient(scan);
    if (patient && !patient->removed.empty()) return std::nullopt;
    if (!patient && request.surroundings == SurroundingsRule::kRemove) refuse_without_patient();
  }
  ChosenObject chosen;
  static_cast<VoxelGrid&>(chosen.volume) = scan;
  chosen.hounsfield = is_hounsfield(scan);
  if (chosen.hounsfield) chosen.volume.modality = "CT";
  if (!request.has_labels) warn_of_labels(scan, chosen.warnings);
  if (request.level) chosen.level = {*request.level, LevelSource::kUser};
  return chosen;
}

std::vector<std::string> surface_warnings(const ChosenObject& object, double level) {
  return surface_warnings(object, object.volume, level);
}

std::vector<std::string> surface_warnings(const ChosenObject& object, const VolumeView& image,
                                          double level) {
  constexpr double kMostAtBorder = 0.05;
  const double in_image = object.units().turned(level);
  std::vector<std::string> warnings;
  const bool given = object.level && object.level->from == LevelSource::kUser;
  const bool guessed = object.tissue.empty() && !given;
  if (guessed && surface_at_level(image, in_image) == "skin") {
    warnings.push_back(line(
        "surface: the level %.4g HU is likely that of the skin; --tissue selects another", level));
  }
  if (object.unmeasured.empty()) return warnings;
  const double share = share_at_border(image, object.unmeasured, in_image);
  if (share > kMostAtBorder) {
    warnings.push_back(
        line("surface: %.0f %% of it is likely the border of the padding, where the "
             "field of view ends",
             100 * share));
  }
  return warnings;
}

}  // namespace mesamis::detail::object
