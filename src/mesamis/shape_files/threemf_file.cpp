// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "mesamis/files/refuse.h"
#include "mesamis/files/xml.h"
#include "mesamis/shape_files/object_formats.h"
#include "mesamis/shape_files/polygons.h"
#include "mesamis/shape_files/threemf_handle.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

using Transform = NMR::MODELTRANSFORM;

/// lib3mf gives the format's matrix turned: the last column moves.
Vec3 moved(const Transform& t, const Vec3& p) {
  Vec3 q;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& row = t.m_fFields[axis];
    q[axis] = double{row[0]} * p.x + double{row[1]} * p.y + double{row[2]} * p.z + double{row[3]};
  }
  return q;
}

bool mirrors(const Transform& t) {
  const auto row = [&t](int axis) {
    const auto& r = t.m_fFields[axis];
    return Vec3{r[0], r[1], r[2]};
  };
  return dot(row(0), cross(row(1), row(2))) < 0;
}

double unit_in_mm(const Handle& model) {
  constexpr double kMillimetres[] = {1e-3, 1, 10, 25.4, 304.8, 1000};  // in the order of MODELUNIT
  DWORD unit = NMR::MODELUNIT_MILLIMETER;
  NMR::lib3mf_model_getunit(model.get(), &unit);
  return kMillimetres[std::min<std::size_t>(unit, std::size(kMillimetres) - 1)];
}

/// A text of lib3mf's, empty if it does not tell.
/// @param get  called with a buffer, its size and where the number of characters goes.
template <class Get>
std::string text_of(const Get& get) {
  ULONG size = 0;
  if (get(nullptr, 0, &size) != LIB3MF_OK) return {};
  std::string text(std::size_t{size} + 1, '\0');  // whether or not it counts the final zero
  if (get(text.data(), static_cast<ULONG>(text.size()), &size) != LIB3MF_OK) return {};
  return text.substr(0, text.find('\0'));
}

std::string metadata_text(const Handle& model, DWORD index) {
  return text_of([&](char* text, ULONG size, ULONG* needed) {
    return NMR::lib3mf_model_getmetadatavalueutf8(model.get(), index, text, size, needed);
  });
}

/// lib3mf leaves entities as they are.
std::string name_of(const Handle& object) {
  return xml_unescaped(text_of([&](char* text, ULONG size, ULONG* needed) {
    return NMR::lib3mf_object_getnameutf8(object.get(), text, size, needed);
  }));
}

std::string part_number_of(const Handle& object) {
  return text_of([&](char* text, ULONG size, ULONG* needed) {
    return NMR::lib3mf_object_getpartnumberutf8(object.get(), text, size, needed);
  });
}

/// The colour of an object as a whole.
std::optional<Colour> colour_of(const Handle& model, const Handle& object) {
  Handle whole, group;
  NMR::eModelPropertyType type = NMR::MODELPROPERTYTYPE_NONE;
  if (NMR::lib3mf_object_createdefaultpropertyhandler(object.get(), whole.put()) != LIB3MF_OK ||
      NMR::lib3mf_defaultpropertyhandler_getpropertytype(whole.get(), &type) != LIB3MF_OK) {
    return std::nullopt;
  }
  NMR::MODELMESHCOLOR_SRGB c{};
  if (type == NMR::MODELPROPERTYTYPE_COLOR &&
      NMR::lib3mf_defaultpropertyhandler_getcolor(whole.get(), 0, &c) == LIB3MF_OK) {
    return Colour{c.m_Red, c.m_Green, c.m_Blue};
  }
  DWORD id = 0, index = 0;
  if (type == NMR::MODELPROPERTYTYPE_BASEMATERIALS &&
      NMR::lib3mf_defaultpropertyhandler_getbasematerial(whole.get(), &id, &index) == LIB3MF_OK &&
      NMR::lib3mf_model_getbasematerialbyid(model.get(), id, group.put()) == LIB3MF_OK &&
      NMR::lib3mf_basematerial_getdisplaycolor(group.get(), index, &c.m_Red, &c.m_Green, &c.m_Blue,
                                               &c.m_Alpha) == LIB3MF_OK) {
    return Colour{c.m_Red, c.m_Green, c.m_Blue};
  }
  return std::nullopt;
}

std::optional<Frame> stated_frame(const Handle& model) {
  DWORD count = 0;
  std::optional<Frame> frame;
  if (NMR::lib3mf_model_getmetadatacount(model.get(), &count) != LIB3MF_OK) return frame;
  for (DWORD i = 0; i < count && !frame; ++i) frame = frame_named_in(metadata_text(model, i));
  return frame;
}

/// Collects the meshes of the build items.
class Gatherer {
 public:
  /// @param file_size  bytes; copies of components may not multiply the file without limit.
  Gatherer(const fs::path& file, const Handle& model, std::size_t file_size)
      : file_(file),
        model_(model),
        unit_(unit_in_mm(model)),
        most_items_(1'000'000 + 50 * file_size) {}

  void add_build() {
    Handle items;
    require(NMR::lib3mf_model_getbuilditems(model_.get(), items.put()), model_);
    auto another = [&] {
      BOOL more = 0;
      require(NMR::lib3mf_builditemiterator_movenext(items.get(), &more), items);
      return more != 0;
    };
    while (another()) {
      Handle item, object;
      require(NMR::lib3mf_builditemiterator_getcurrent(items.get(), item.put()), items);
      require(NMR::lib3mf_builditem_getobjectresource(item.get(), object.put()), item);
      BOOL moved = 0;
      std::vector<Transform> path(1);
      require(NMR::lib3mf_builditem_hasobjecttransform(item.get(), &moved), item);
      if (moved == 0) {
        path.clear();
      } else {
        require(NMR::lib3mf_builditem_getobjecttransform(item.get(), path.data()), item);
      }
      add_object(object, path);
    }
  }

  ParsedObjects result() { return std::move(result_); }

 private:
  void require(LIB3MFRESULT result, const Handle& source) const {
    if (result != LIB3MF_OK) refuse(file_, "lib3mf: " + source.last_error());
  }

  /// @param path  transforms, the object's own last.
  void add_object(const Handle& object, std::vector<Transform>& path) {
    constexpr std::size_t kDeepest = 32;
    constexpr int kMostVisits = 100'000;  // a few objects that name each other twice are billions
    if (path.size() > kDeepest) refuse(file_, "too many components within one another");
    if (++visits_ > kMostVisits) refuse(file_, "too many components");
    BOOL is_mesh = 0, is_list = 0;
    require(NMR::lib3mf_object_ismeshobject(object.get(), &is_mesh), object);
    require(NMR::lib3mf_object_iscomponentsobject(object.get(), &is_list), object);
    if (is_mesh != 0 && add_mesh(object, path)) add_facts(object);
    DWORD count = 0;
    if (is_list != 0) {
      require(NMR::lib3mf_componentsobject_getcomponentcount(object.get(), &count), object);
    }
    for (DWORD i = 0; i < count; ++i) {
      Handle component, part;
      require(NMR::lib3mf_componentsobject_getcomponent(object.get(), i, component.put()), object);
      require(NMR::lib3mf_component_getobjectresource(component.get(), part.put()), component);
      path.emplace_back();
      require(NMR::lib3mf_component_gettransform(component.get(), &path.back()), component);
      add_object(part, path);
      path.pop_back();
    }
  }

  /// The triangles added last are an object.
  void add_facts(const Handle& mesh) {
    const auto number = static_cast<Index>(result_.objects.size());
    result_.objects.push_back(
        {name_of(mesh), object_label_in(part_number_of(mesh)), colour_of(model_, mesh)});
    result_.object_of.resize(result_.file.surface.triangles.size(), number);
  }

  /// @return  whether the mesh has triangles.
  bool add_mesh(const Handle& mesh, const std::vector<Transform>& path) {
    TriMesh& surface = result_.file.surface;
    DWORD points = 0, triangles = 0, got = 0;
    require(NMR::lib3mf_meshobject_getvertexcount(mesh.get(), &points), mesh);
    require(NMR::lib3mf_meshobject_gettrianglecount(mesh.get(), &triangles), mesh);
    if (points == 0 || triangles == 0) return false;
    if (points > most_items_ - surface.points.size() ||
        triangles > most_items_ - surface.triangles.size()) {
      refuse(file_, say("expected at most ", most_items_,
                        " points and triangles in all components, found more"));
    }
    std::vector<NMR::MODELMESHVERTEX> at(points);
    std::vector<NMR::MODELMESHTRIANGLE> corners(triangles);
    require(NMR::lib3mf_meshobject_getvertices(mesh.get(), at.data(), points, &got), mesh);
    require(NMR::lib3mf_meshobject_gettriangleindices(mesh.get(), corners.data(), triangles, &got),
            mesh);
    PolygonSink sink(file_, surface);
    for (const auto& [p] : at) {
      Vec3 q{p[0], p[1], p[2]};
      for (auto t = path.rbegin(); t != path.rend(); ++t) q = moved(*t, q);
      surface.points.push_back(unit_ * q);
    }
    const bool mirrored = std::count_if(path.begin(), path.end(), mirrors) % 2 != 0;
    for (auto& [c] : corners) {
      if (mirrored) std::swap(c[1], c[2]);
      const double polygon[] = {double(c[0]), double(c[1]), double(c[2])};
      sink.add(polygon, false);
    }
    return true;
  }

  const fs::path& file_;
  const Handle& model_;
  double unit_;
  std::size_t most_items_;
  int visits_ = 0;
  ParsedObjects result_;
};

}  // namespace

ParsedObjects parse_threemf_objects(const fs::path& file, std::string_view bytes) {
  Handle model, reader;
  require_done(NMR::lib3mf_createmodel(model.put()));
  require_done(NMR::lib3mf_model_queryreader(model.get(), "3mf", reader.put()));
  std::vector<BYTE> copy(bytes.begin(), bytes.end());  // lib3mf asks for bytes it may change
  if (NMR::lib3mf_reader_readfrombuffer(reader.get(), copy.data(), copy.size()) != LIB3MF_OK) {
    refuse(file, "is not a 3MF file that lib3mf reads: " + reader.last_error());
  }
  Gatherer gatherer(file, model, bytes.size());
  gatherer.add_build();
  ParsedObjects result = gatherer.result();
  result.file.frame = stated_frame(model);
  return result;
}

SurfaceFile parse_threemf(const fs::path& file, std::string_view bytes) {
  return parse_threemf_objects(file, bytes).file;
}

}  // namespace mesamis::detail
