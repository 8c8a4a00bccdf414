// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/object_files.h"

#include <algorithm>
#include <limits>
#include <set>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/decimate/round_together.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/files/byte_source.h"
#include "mesamis/files/output_set.h"
#include "mesamis/files/refuse.h"
#include "mesamis/shape_files/object_formats.h"

namespace mesamis {

namespace {

namespace fs = std::filesystem;

using Objects = std::span<const NamedSurface>;
using Parser = ParsedObjects (*)(const fs::path&, std::string_view, MemoryBudget&);
using Formatter = std::string (*)(Objects, const SurfaceWriteOptions&);

struct Format {
  const char* extension;
  Parser parse;     // null: not read
  Formatter bytes;  // null: two files
  bool single = false;
};

constexpr Format kFormats[] = {{".3mf", parse_threemf_objects, threemf_object_bytes, true},
                               {".vtp", parse_vtp_objects, vtp_object_bytes},
                               {".obj", parse_obj_objects, nullptr},
                               {".amf", parse_amf_objects, amf_object_bytes},
                               {".glb", nullptr, glb_object_bytes}};

/// Null if files of this extension hold one object.
const Format* format_named(const std::string& extension) {
  const auto* format = std::find_if(std::begin(kFormats), std::end(kFormats),
                                    [&](const Format& f) { return extension == f.extension; });
  return format == std::end(kFormats) ? nullptr : format;
}

// ---------------------------------------------------------------- writing

void require_labels(Objects objects) {
  std::set<Index> labels;
  for (const NamedSurface& object : objects) {
    if (object.label < 0)
      throw InputError(message("objects: the label ", object.label, " is negative"));
    if (!labels.insert(object.label).second) {
      throw InputError(message("objects: two have the label ", object.label));
    }
  }
}

void require_writable(const fs::path& path, Objects objects) {
  if (objects.empty()) refuse(path, "expected at least one object to write, found none");
  require_labels(objects);
  constexpr std::size_t kMost = std::numeric_limits<Index>::max();
  std::size_t points = 0, triangles = 0;
  for (const NamedSurface& object : objects) {
    if (object.surface.triangles.empty()) {
      refuse(path, "an empty surface is not written: " + in_quotes(object.name));
    }
    require_sound(object.surface);
    points += object.surface.points.size();
    triangles += object.surface.triangles.size();
  }
  if (points > kMost || triangles > kMost / 3) {
    refuse(path, message(points, " points and ", triangles, " triangles exceed 32-bit indices"));
  }
}

std::string usable_name(const std::string& name, Index label) {
  const std::string line = one_line(name);
  const std::string_view usable = trimmed(line);
  return usable.empty() ? "object " + std::to_string(label) : std::string(usable);
}

std::vector<NamedSurface> prepared(Objects objects, const Format& format,
                                   std::optional<Frame> frame) {
  std::vector<NamedSurface> result(objects.begin(), objects.end());
  for (NamedSurface& object : result) {
    object.name = usable_name(object.name, object.label);
    if (frame == Frame::kRas) object.surface = turned(std::move(object.surface));
  }
  return format.single ? rounded_together(std::move(result)) : result;
}

/// Both files appear together.
void write_obj(const OutputPath& path, Objects objects, const SurfaceWriteOptions& options) {
  const fs::path materials = fs::path(path).replace_extension(".mtl");
  const std::string name = materials.filename().string();
  if (one_line(name) != name) refuse(path, "expected a name of one line");
  OutputSet both(path.set);
  write_file(both.file(materials), mtl_bytes(objects));
  write_file(both.file(path), obj_object_bytes(objects, options, name));
  both.commit();
}

// ---------------------------------------------------------------- names

constexpr std::size_t kLongestName = 100;

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Each character of UTF-8 counts once: its bytes after the first are left out.
std::string safe_name(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    if ((static_cast<unsigned char>(c) & 0xc0) == 0x80) continue;
    const bool kept = is_letter_or_digit(c) || c == '-' || c == '_' || c == '.';
    safe += kept ? c : '_';
  }
  safe.resize(std::min(safe.size(), kLongestName));
  return std::any_of(safe.begin(), safe.end(), is_letter_or_digit) ? safe : "object";
}

/// "out-NAME.stl", "out-NAME.obj.dcm".
fs::path with_name(const fs::path& path, const std::string& name) {
  const std::string file = path.filename().string();
  const std::size_t end = file.size() - std::min(file.size(), format_extension(path).size());
  return fs::path(path).replace_filename(file.substr(0, end) + "-" + name + file.substr(end));
}

// ---------------------------------------------------------------- reading

/// What read_object_file() makes of them: of each object its triangles, and its points, of which a
/// triangle has three at most.
void claim_parts(MemoryBudget& budget, const ParsedObjects& parsed) {
  const auto& [points, triangles] = parsed.file.surface;
  if (parsed.objects.size() < 2) return;
  budget.claim(parsed.objects.size(), sizeof(NamedSurface) + sizeof(std::vector<Triangle>),
               "objects");
  budget.claim(triangles.size(), 2 * sizeof(Triangle) + 3 * sizeof(Index), "triangles");
  budget.claim(points.size(), sizeof(Index), "points");
  budget.claim(std::min(3 * triangles.size(), points.size()), 2 * sizeof(Vec3), "points");
}

ParsedObjects parse(const fs::path& path, const ReadLimits& limits) {
  const Format* format = format_named(extension_of(path));
  if (format != nullptr && format->parse != nullptr) {
    MemoryBudget budget(path, limits);
    ParsedObjects parsed = format->parse(path, read_all(path, budget), budget);
    require_surface(path, parsed.file.surface);
    claim_parts(budget, parsed);
    return parsed;
  }
  SurfaceFile file = read_surface_file(path, limits);
  const std::size_t triangles = file.surface.triangles.size();
  return {std::move(file), {{}}, std::vector<Index>(triangles, 0)};
}

/// Leaves out the objects without a triangle.
void drop_empty(ParsedObjects& parsed) {
  std::vector<Index> number(parsed.objects.size(), -1);
  for (const Index object : parsed.object_of) number[object] = 0;
  std::vector<ObjectFacts> kept;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<Index>(kept.size());
    kept.push_back(std::move(parsed.objects[i]));
  }
  for (Index& object : parsed.object_of) object = number[object];
  parsed.objects = std::move(kept);
}

/// The triangles of each object, with those points that they use, in the order of the file.
class Splitter {
 public:
  explicit Splitter(ParsedObjects& parsed)
      : all_(parsed.file.surface), new_index_(all_.points.size(), -1) {
    triangles_.resize(parsed.objects.size());
    for (std::size_t t = 0; t < all_.triangles.size(); ++t) {
      triangles_[parsed.object_of[t]].push_back(all_.triangles[t]);
    }
  }

  TriMesh part(std::size_t object) {
    TriMesh part{{}, std::move(triangles_[object])};
    std::vector<Index> used;
    for (const Triangle& t : part.triangles) used.insert(used.end(), t.begin(), t.end());
    sort_once(used);
    for (const Index p : used) {
      new_index_[p] = static_cast<Index>(part.points.size());
      part.points.push_back(all_.points[p]);
    }
    for (Triangle& t : part.triangles) {
      for (Index& p : t) p = new_index_[p];
    }
    return part;
  }

 private:
  const TriMesh& all_;
  std::vector<Index> new_index_;
  std::vector<std::vector<Triangle>> triangles_;
};

bool have_labels(const std::vector<ObjectFacts>& objects) {
  std::set<Index> labels;
  return std::all_of(objects.begin(), objects.end(), [&](const ObjectFacts& object) {
    return object.label && labels.insert(*object.label).second;
  });
}

}  // namespace

namespace detail::shape_files {

std::optional<Index> object_label_in(std::string_view text) {
  std::int64_t label = 0;
  const bool fits =
      parse_number(text, label) && label >= 0 && label <= std::numeric_limits<Index>::max();
  return fits ? std::optional(static_cast<Index>(label)) : std::nullopt;
}

/// A name that got its label differs from all others that got theirs: each gets it twice at most.
std::vector<std::string> safe_names(std::span<const NamedSurface> objects) {
  require_labels(objects);
  std::vector<std::string> names;
  for (const NamedSurface& object : objects) names.push_back(safe_name(object.name));
  for (bool again = true; again;) {
    std::map<std::string, std::vector<std::size_t>> users;
    for (std::size_t i = 0; i < names.size(); ++i) users[lower(names[i])].push_back(i);
    again = false;
    for (const auto& [name, numbers] : users) {
      if (numbers.size() < 2) continue;
      again = true;
      for (const std::size_t i : numbers) names[i] += "-" + std::to_string(objects[i].label);
    }
  }
  return names;
}

}  // namespace detail::shape_files

std::vector<std::string> written_object_formats() {
  std::vector<std::string> extensions;
  for (const Format& format : kFormats) extensions.emplace_back(format.extension);
  return extensions;
}

void write_objects(const OutputPath& path, std::span<const NamedSurface> objects,
                   const SurfaceWriteOptions& options) {
  const Format* format = format_named(lower_extension(path));
  if (format == nullptr) refuse_extension(path, ".3mf .vtp .obj .amf .glb");
  require_writable(path, objects);
  const std::vector<NamedSurface> ready = prepared(objects, *format, options.frame);
  const SurfaceWriteOptions clean = as_written(options);
  if (format->bytes == nullptr) {
    write_obj(path, ready, clean);
  } else {
    write_file(path, format->bytes(ready, clean));
  }
}

fs::path object_path(const fs::path& path, const std::string& name) {
  return with_name(path, safe_name(name));
}

std::vector<fs::path> object_paths(const fs::path& path, std::span<const NamedSurface> objects) {
  std::vector<fs::path> paths;
  for (const std::string& name : safe_names(objects)) {
    paths.push_back(with_name(path, name));
  }
  return paths;
}

std::vector<NamedSurface> rounded_together(std::vector<NamedSurface> objects) {
  std::vector<Vec3> points;
  for (const NamedSurface& object : objects) {
    points.insert(points.end(), object.surface.points.begin(), object.surface.points.end());
  }
  points = round_together(points);
  auto next = points.begin();
  for (NamedSurface& object : objects) {
    for (Vec3& p : object.surface.points) p = *next++;
  }
  return objects;
}

JoinedObjects joined(std::span<const NamedSurface> objects) {
  JoinedObjects all;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto& [points, triangles] = objects[i].surface;
    const auto first = static_cast<Index>(all.surface.points.size());
    all.surface.points.insert(all.surface.points.end(), points.begin(), points.end());
    for (const auto& [a, b, c] : triangles) {
      all.surface.triangles.push_back({first + a, first + b, first + c});
    }
    all.object_of.resize(all.surface.triangles.size(), static_cast<Index>(i));
  }
  return all;
}

ObjectFile read_object_file(const fs::path& path, const ReadLimits& limits) {
  ParsedObjects parsed = parse(path, limits);
  drop_empty(parsed);
  const std::vector<ObjectFacts>& facts = parsed.objects;
  ObjectFile file{{}, parsed.file.frame, true};
  const bool labelled = have_labels(facts), several = facts.size() > 1;
  Splitter splitter(parsed);
  for (std::size_t i = 0; i < facts.size(); ++i) {
    NamedSurface object;
    object.label = labelled ? *facts[i].label : static_cast<Index>(i + 1);
    object.name = usable_name(facts[i].name, object.label);
    object.colour = facts[i].colour.value_or(object.colour);
    object.surface = several ? splitter.part(i) : std::move(parsed.file.surface);
    file.coloured &= facts[i].colour.has_value();
    file.objects.push_back(std::move(object));
  }
  return file;
}

std::vector<NamedSurface> read_objects(const fs::path& path, const ReadLimits& limits) {
  return read_object_file(path, limits).objects;
}

std::vector<NamedSurface> in_lps(ObjectFile file) {
  if (file.frame == Frame::kRas) {
    for (NamedSurface& o : file.objects) o.surface = turned(std::move(o.surface));
  }
  return std::move(file.objects);
}

}  // namespace mesamis
