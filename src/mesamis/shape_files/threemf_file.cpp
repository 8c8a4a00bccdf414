// SPDX-License-Identifier: Apache-2.0
// 3MF (core specification 1.3, materials and production extensions) read by our own parser: what a
// file of a few kilobytes makes of memory is counted before it is made.
#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>

#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/files/xml.h"
#include "mesamis/files/zip_archive.h"
#include "mesamis/shape_files/object_formats.h"
#include "mesamis/shape_files/polygons.h"

namespace mesamis::detail::shape_files {
namespace {

namespace fs = std::filesystem;

/// A row vector (x, y, z, 1) times these four rows, as the format writes them.
using Transform = std::array<Vec3, 4>;

constexpr Transform kStays{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, 0}};

Vec3 turned_by(const Transform& t, const Vec3& p) { return p.x * t[0] + p.y * t[1] + p.z * t[2]; }

Vec3 moved(const Transform& t, const Vec3& p) { return turned_by(t, p) + t[3]; }

/// First the inner transform, then the outer one.
Transform joined(const Transform& inner, const Transform& outer) {
  return {turned_by(outer, inner[0]), turned_by(outer, inner[1]), turned_by(outer, inner[2]),
          moved(outer, inner[3])};
}

bool mirrors(const Transform& t) { return dot(t[0], cross(t[1], t[2])) < 0; }

/// A few objects that hold each other twice are billions.
constexpr std::uint64_t kMostVisits = 100'000;

/// An object at its place.
struct Component {
  std::size_t object = 0;  ///< that is placed
  Transform transform = kStays;
};

struct Resource {
  ObjectFacts facts;
  TriMesh mesh;
  std::vector<Component> components;
  // What the object makes once it is built, with all that it holds.
  std::uint64_t visits = 1, objects = 0, points = 0, triangles = 0, name_bytes = 0;
  int depth = 1;
};

std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == name.npos ? name : name.substr(colon + 1);
}

/// The path without the prefixes of name spaces.
std::string local_path(std::string_view path) {
  std::string local;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    ((local += local.empty() ? "" : "/") += local_name(path.substr(0, end)));
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return local;
}

/// The name of a part of the archive, without the slash that it may begin with.
std::string part_name(std::string_view name) {
  return std::string(name.starts_with('/') ? name.substr(1) : name);
}

/// The objects of all models of an archive. Models may place objects of others (production
/// extension), which are read when they are named.
class Package {
 public:
  Package(const fs::path& file, ZipArchive& archive, MemoryBudget& budget)
      : file_(file), archive_(archive), budget_(budget) {}

  /// An object of another model; none if that has no such object.
  /// @throws InputError  if there is no such model, or if models place each other.
  std::optional<std::size_t> find(const std::string& part, const std::string& id);

  /// The text of a part. @throws InputError  if there is none.
  std::string text_of(const std::string& part) {
    if (auto model = archive_.part(part)) return std::move(*model);
    refuse(file_, message("expected the model ", in_quotes(part), " in the archive, found none"));
  }

  const fs::path& file() const { return file_; }
  MemoryBudget& budget() { return budget_; }

  std::vector<Resource> resources{};  ///< lengths in mm once their model is read

 private:
  using Numbers = std::map<std::string, std::size_t>;

  const fs::path& file_;
  ZipArchive& archive_;
  MemoryBudget& budget_;
  std::map<std::string, std::optional<Numbers>> read_;  // none: being read
};

double unit_in_mm(const fs::path& file, const std::string& name);

/// Gathers the resources and the build of a model as their elements end; the tree keeps neither.
class ModelReader {
 public:
  explicit ModelReader(Package& package)
      : package_(package), file_(package.file()), budget_(package.budget()) {
    begin_object();
  }

  /// Reads a whole model; then all its lengths are in mm.
  void read(std::string_view model) {
    const auto consume_one = [&](const XmlElement& e, std::string_view path) {
      return consume(e, path);
    };
    const XmlElement root = parse_xml(file_, model, budget_, {.consume = consume_one}).root;
    if (local_name(root.name) != "model") {
      refuse(file_, "expected <model>, found " + in_quotes(root.name));
    }
    const double unit = unit_in_mm(file_, root.attribute("unit"));
    if (unit == 1) return;
    for (const auto& [id, number] : numbers_) to_mm(package_.resources[number], unit);
    for (Component& item : items) item.transform[3] = unit * item.transform[3];
  }

  bool consume(const XmlElement& element, std::string_view path) {
    const std::string local = path.find(':') == path.npos ? "" : local_path(path);
    take(element, local.empty() ? path : local);
    return true;
  }

  std::vector<Component> items{};  ///< of the build
  std::optional<Frame> frame{};
  const std::map<std::string, std::size_t>& numbers() const { return numbers_; }

 private:
  static void to_mm(Resource& object, double unit) {
    for (Vec3& p : object.mesh.points) p = unit * p;
    for (Component& part : object.components) part.transform[3] = unit * part.transform[3];
  }

  void take(const XmlElement& element, std::string_view path) {
    if (path == "model/resources/object/mesh/vertices/vertex") {
      const Vec3 p{number(element, "x"), number(element, "y"), number(element, "z")};
      append_within(budget_, object_.mesh.points, p, "points");
    } else if (path == "model/resources/object/mesh/triangles/triangle") {
      const double corners[] = {number(element, "v1"), number(element, "v2"),
                                number(element, "v3")};
      sink_->add(corners, false);
    } else if (path == "model/resources/object/components/component") {
      append_within(budget_, object_.components, component_in(element), "components");
    } else if (path == "model/resources/object") {
      end_object(element);
    } else if (path == "model/build/item") {
      append_within(budget_, items, component_in(element), "items of the build");
    } else if (path == "model/resources/basematerials/base") {
      add_colour(element.attribute("displaycolor"));
    } else if (path == "model/resources/colorgroup/color") {
      add_colour(element.attribute("color"));
    } else if (path == "model/resources/basematerials" || path == "model/resources/colorgroup") {
      groups_[element.attribute("id")] = std::exchange(colours_, {});
    } else if (path == "model/metadata") {
      if (!frame) frame = frame_named_in(element.text);
    }
  }

  [[noreturn]] void refuse_value(const XmlElement& element, const char* name,
                                 const char* expected) const {
    refuse(file_, message("expected ", expected, " as ", name, " of <", shown(element.name),
                          ">, found ", in_quotes(element.attribute(name))));
  }

  double number(const XmlElement& element, const char* name) const {
    const std::string text = element.attribute(name);
    double value = 0;
    if (!parse_number(trimmed(text), value)) refuse_value(element, name, "a number");
    return value;
  }

  void add_colour(const std::string& text) {
    append_within(budget_, colours_, colour_in(text), "colours");
  }

  /// "#RRGGBB" or "#RRGGBBAA"; none for anything else.
  static std::optional<Colour> colour_in(const std::string& text) {
    if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return std::nullopt;
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c) {
      const char* from = text.data() + 1 + 2 * c;
      const auto [stop, error] = std::from_chars(from, from + 2, colour[c], 16);
      if (error != std::errc{} || stop != from + 2) return std::nullopt;
    }
    return colour;
  }

  Transform transform_in(const XmlElement& element) const {
    const std::string whole = element.attribute("transform");
    if (whole.empty()) return kStays;
    std::string_view text = whole;
    Transform t;
    for (Vec3& row : t) {
      for (int axis = 0; axis < 3; ++axis) {
        if (!parse_number(take_word(text), row[axis])) {
          refuse_value(element, "transform", "12 numbers");
        }
      }
    }
    if (!trimmed(text).empty()) refuse_value(element, "transform", "12 numbers");
    return t;
  }

  /// Objects stand before those that hold them, or in another model: none can hold itself.
  Component component_in(const XmlElement& element) {
    const std::string id = element.attribute("objectid");
    for (const auto& [name, part] : element.attributes) {
      if (local_name(name) != "path") continue;
      const auto found = package_.find(part_name(part), id);
      if (!found) refuse_value(element, "objectid", "an object of the model that path names");
      return {*found, transform_in(element)};
    }
    const auto found = numbers_.find(id);
    if (found == numbers_.end()) refuse_value(element, "objectid", "an object that stands before");
    return {found->second, transform_in(element)};
  }

  void begin_object() {
    object_ = {};
    sink_.emplace(file_, object_.mesh, budget_);
  }

  void end_object(const XmlElement& element) {
    const std::string id = element.attribute("id");
    if (!numbers_.emplace(id, package_.resources.size()).second) {
      refuse_value(element, "id", "a number of its own");
    }
    object_.facts.name = xml_unescaped(element.attribute("name"));  // lib3mf escapes names twice
    object_.facts.label = object_label_in(element.attribute("partnumber"));
    object_.facts.colour = colour_named(element.attribute("pid"), element.attribute("pindex"));
    count();
    budget_.claim(3, object_.facts.name.size() + id.size() + sizeof(std::string), "names");
    append_within(budget_, package_.resources, std::move(object_), "objects");
    begin_object();
  }

  /// Sums stay below 2^63: an object beyond the bound of all visits is refused at once.
  void count() {
    const auto points = std::ssize(object_.mesh.points);
    for (const Triangle& t : object_.mesh.triangles) {
      if (*std::max_element(t.begin(), t.end()) < points) continue;
      refuse(file_,
             message("expected triangles of ", points, " points, found one of a missing point"));
    }
    object_.points = object_.mesh.points.size();
    object_.triangles = object_.mesh.triangles.size();
    object_.objects = object_.triangles > 0 ? 1 : 0;
    object_.name_bytes = object_.facts.name.size();
    for (const Component& component : object_.components)
      add_counts(package_.resources[component.object]);
  }

  void add_counts(const Resource& part) {
    constexpr int kDeepest = 32;
    object_.visits += part.visits;
    object_.objects += part.objects;
    object_.points += part.points;
    object_.triangles += part.triangles;
    object_.name_bytes += part.name_bytes;
    object_.depth = std::max(object_.depth, part.depth + 1);
    if (object_.depth > kDeepest) refuse(file_, "too many components within one another");
    if (object_.visits > kMostVisits) {
      refuse(file_, message("too many components: expected at most ", kMostVisits, ", found more"));
    }
  }

  std::optional<Colour> colour_named(const std::string& group, const std::string& index) const {
    const auto found = groups_.find(group);
    std::int64_t n = 0;
    if (found == groups_.end() || !parse_number(std::string_view(index), n) || n < 0 ||
        n >= std::ssize(found->second)) {
      return std::nullopt;
    }
    return found->second[static_cast<std::size_t>(n)];
  }

  Package& package_;
  const fs::path& file_;
  MemoryBudget& budget_;
  Resource object_;                             // that is read
  std::optional<PolygonSink> sink_;             // of its triangles
  std::vector<std::optional<Colour>> colours_;  // of the group that is read
  std::map<std::string, std::vector<std::optional<Colour>>> groups_;
  std::map<std::string, std::size_t> numbers_;  // of the objects
};

std::optional<std::size_t> Package::find(const std::string& part, const std::string& id) {
  constexpr std::size_t kMostModels = 10'000;
  const auto [model, is_new] = read_.emplace(part, std::nullopt);
  if (is_new) {
    if (read_.size() > kMostModels) {
      refuse(file_, message("expected at most ", kMostModels, " models, found more"));
    }
    budget_.claim(1, part.size() + 256, "models");
    const std::string text = text_of(part);
    ModelReader reader(*this);
    reader.read(text);
    model->second = reader.numbers();
  }
  if (!model->second)
    refuse(file_, "expected models that do not place each other, found " + in_quotes(part));
  const auto found = model->second->find(id);
  return found == model->second->end() ? std::nullopt : std::optional(found->second);
}

/// The build: every mesh at each of its places.
class Builder {
 public:
  Builder(const fs::path& file, const std::vector<Resource>& resources)
      : file_(file), resources_(resources) {}

  /// Counts what the items make, and claims it.
  /// @param most_items  copies of components may not multiply the file without limit.
  void claim(const std::vector<Component>& items, std::uint64_t most_items, MemoryBudget& budget) {
    Resource all;
    for (const Component& item : items) {
      const Resource& part = resources_[item.object];
      all.visits += part.visits;
      all.objects += part.objects;
      all.points += part.points;
      all.triangles += part.triangles;
      all.name_bytes += part.name_bytes;
      if (all.visits > kMostVisits) {
        refuse(file_,
               message("too many components: expected at most ", kMostVisits, ", found more"));
      }
    }
    if (all.points > most_items || all.triangles > most_items) {
      refuse(file_,
             message("expected at most ", most_items, " points and triangles in all components, ",
                     "found ", all.points, " and ", all.triangles));
    }
    reserve_within(budget, result_.file.surface.points, all.points, "points");
    reserve_within(budget, result_.file.surface.triangles, all.triangles, "triangles");
    reserve_within(budget, result_.object_of, all.triangles, "triangles");
    reserve_within(budget, result_.objects, all.objects, "objects");
    budget.claim(1, all.name_bytes, "names of objects");
  }

  void add(const Component& placed, const Transform& outer) {
    const Resource& object = resources_[placed.object];
    const Transform transform = joined(placed.transform, outer);
    if (!object.mesh.triangles.empty()) add_mesh(object, transform);
    for (const Component& component : object.components) add(component, transform);
  }

  ParsedObjects result() { return std::move(result_); }

 private:
  void add_mesh(const Resource& object, const Transform& transform) {
    TriMesh& surface = result_.file.surface;
    const auto base = static_cast<Index>(surface.points.size());
    for (const Vec3& p : object.mesh.points) {
      surface.points.push_back(moved(transform, p));
    }
    const bool mirrored = mirrors(transform);
    for (const auto& [a, b, c] : object.mesh.triangles) {
      surface.triangles.push_back({base + a, base + (mirrored ? c : b), base + (mirrored ? b : c)});
    }
    result_.object_of.resize(surface.triangles.size(), static_cast<Index>(result_.objects.size()));
    result_.objects.push_back(object.facts);
  }

  const fs::path& file_;
  const std::vector<Resource>& resources_;
  ParsedObjects result_;
};

double unit_in_mm(const fs::path& file, const std::string& name) {
  constexpr std::pair<const char*, double> kUnits[] = {
      {"", 1},        {"millimeter", 1}, {"micron", 1e-3}, {"centimeter", 10},
      {"inch", 25.4}, {"foot", 304.8},   {"meter", 1000}};
  for (const auto& [unit, mm] : kUnits) {
    if (name == unit) return mm;
  }
  refuse(file, "expected a unit of 3MF, found " + in_quotes(name));
}

/// The part that the package names as its first model.
std::string first_model(const fs::path& file, ZipArchive& archive, MemoryBudget& budget) {
  const auto relations = archive.part("_rels/.rels");
  if (!relations) refuse(file, "is not a 3MF file: expected the part \"_rels/.rels\", found none");
  const XmlElement root = parse_xml(file, *relations, budget).root;
  for (const XmlElement& relation : root.children) {
    if (!relation.attribute("Type").ends_with("/3dmanufacturing/2013/01/3dmodel")) continue;
    return part_name(relation.attribute("Target"));
  }
  refuse(file, "is not a 3MF file: its package names no model");
}

}  // namespace

ParsedObjects parse_threemf_objects(const fs::path& file, std::string_view bytes,
                                    MemoryBudget& budget) {
  ZipArchive archive(file, bytes, budget);
  Package package(file, archive, budget);
  ModelReader reader(package);
  reader.read(package.text_of(first_model(file, archive, budget)));
  Builder builder(file, package.resources);
  constexpr std::uint64_t kMost = std::numeric_limits<Index>::max();
  const std::uint64_t most_items = std::min(kMost, 1'000'000 + 50 * std::uint64_t{bytes.size()});
  builder.claim(reader.items, most_items, budget);
  for (const Component& item : reader.items) builder.add(item, kStays);
  ParsedObjects result = builder.result();
  result.file.frame = reader.frame;
  return result;
}

SurfaceFile parse_threemf(const fs::path& file, std::string_view bytes, MemoryBudget& budget) {
  return parse_threemf_objects(file, bytes, budget).file;
}

}  // namespace mesamis::detail::shape_files
