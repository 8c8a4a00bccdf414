// SPDX-License-Identifier: Apache-2.0
#include <Model/COM/NMR_DLLInterfaces.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/xml.h"
#include "mesamis/shape_files/polygons.h"
#include "mesamis/shape_files/surface_formats.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kCorners = 3;

/// Something of lib3mf's, released at the end.
class Handle {
 public:
  Handle() = default;
  ~Handle() {
    if (pointer_ != nullptr) NMR::lib3mf_release(pointer_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  NMR::PLib3MFBase* get() const { return pointer_; }
  /// Where a function of lib3mf puts what it makes.
  NMR::PLib3MFBase** put() { return &pointer_; }

  std::string last_error() const {
    DWORD code = 0;
    LPCSTR message = nullptr;
    NMR::lib3mf_getlasterror(pointer_, &code, &message);
    return message == nullptr ? "error " + std::to_string(code) : message;
  }

 private:
  NMR::PLib3MFBase* pointer_ = nullptr;
};

/// A call that fails only for want of memory, or by a mistake of ours.
void require_done(LIB3MFRESULT result) {
  if (result == LIB3MF_OK) return;
  throw InputError("surface: lib3mf could not format it: error " + std::to_string(result));
}

/// An identifier that only depends on what it names (RFC 9562, version 8): lib3mf's own are drawn
/// at random, and no two files would be alike.
std::string uuid_of(const TriMesh& surface, std::uint64_t salt) {
  constexpr std::uint64_t kPrime = 0x100000001b3;  // FNV-1a, on words
  std::array<std::uint64_t, 2> hash{0xcbf29ce484222325 ^ salt, 0x84222325cbf29ce4 ^ salt};
  auto add = [&](std::uint64_t word) {
    hash[0] = (hash[0] ^ word) * kPrime;
    hash[1] = (hash[1] ^ std::rotl(word, 32)) * kPrime;
  };
  for (const Vec3& p : surface.points) {
    for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint64_t>(p[axis] + 0.0));
  }
  for (const Triangle& t : surface.triangles) {
    for (const Index p : t) add(static_cast<std::uint64_t>(p));
  }
  char text[40];
  std::snprintf(text, sizeof text, "%08x-%04x-8%03x-%04x-%012llx",
                static_cast<unsigned>(hash[0] >> 32), static_cast<unsigned>(hash[0] >> 16 & 0xffff),
                static_cast<unsigned>(hash[0] & 0xfff),
                static_cast<unsigned>(0x8000 | (hash[1] >> 48 & 0x3fff)),
                static_cast<unsigned long long>(hash[1] & 0xffffffffffff));
  return text;
}

void set_geometry(const Handle& object, const TriMesh& surface) {
  std::vector<NMR::MODELMESHVERTEX> points(surface.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      points[i].m_fPosition[axis] = static_cast<float>(surface.points[i][axis]);
    }
  }
  std::vector<NMR::MODELMESHTRIANGLE> triangles(surface.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < kCorners; ++i) {
      triangles[t].m_nIndices[i] = static_cast<DWORD>(surface.triangles[t][i]);
    }
  }
  require_done(NMR::lib3mf_meshobject_setgeometry(
      object.get(), points.data(), static_cast<DWORD>(points.size()), triangles.data(),
      static_cast<DWORD>(triangles.size())));
}

NMR::MODELMESHCOLOR_SRGB color_of(double grey) {
  const auto level = static_cast<BYTE>(std::lround(std::clamp(grey, 0.0, 255.0)));
  return {level, level, level, 255};
}

/// A colour per corner; the object's own, which readers without colours per corner take, is white.
void set_colors(const Handle& object, const TriMesh& surface, const std::vector<double>& grey) {
  std::vector<NMR::MODELMESH_TRIANGLECOLOR_SRGB> colors(surface.triangles.size());
  for (std::size_t t = 0; t < colors.size(); ++t) {
    for (std::size_t i = 0; i < kCorners; ++i) {
      colors[t].m_Colors[i] = color_of(grey[surface.triangles[t][i]]);
    }
  }
  Handle corners, whole;
  require_done(NMR::lib3mf_meshobject_createpropertyhandler(object.get(), corners.put()));
  require_done(NMR::lib3mf_propertyhandler_setgradientcolorarray(corners.get(), colors.data()));
  require_done(NMR::lib3mf_object_createdefaultpropertyhandler(object.get(), whole.put()));
  NMR::MODELMESHCOLOR_SRGB white = color_of(255);
  require_done(NMR::lib3mf_defaultpropertyhandler_setcolor(whole.get(), &white));
}

/// Names beside those that the format knows would need a name space, which lib3mf does not write:
/// all other facts are told in the description. It does not escape either.
void add_metadata(const Handle& model, const SurfaceWriteOptions& options) {
  std::string application, description = frame_note(options.frame);
  for (const auto& [type, text] : options.metadata) {
    if (type == kProducer) {
      application = text;
    } else {
      ((description += "; ") += type) += " " + text;
    }
  }
  auto add = [&](const char* key, const std::string& text) {
    require_done(NMR::lib3mf_model_addmetadatautf8(model.get(), key, xml_escaped(text).c_str()));
  };
  add("Description", description);  // first: it states the frame
  if (!options.name.empty()) add("Title", options.name);
  add("Application", application);
}

std::string bytes_of(const Handle& model) {
  Handle writer;
  require_done(NMR::lib3mf_model_querywriter(model.get(), "3mf", writer.put()));
  ULONG64 size = 0;
  require_done(NMR::lib3mf_writer_getstreamsize(writer.get(), &size));
  std::string bytes(size, '\0');
  require_done(
      NMR::lib3mf_writer_writetobuffer(writer.get(), reinterpret_cast<BYTE*>(bytes.data()), size));
  return bytes;
}

}  // namespace

std::string threemf_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  Handle model, object, item;
  require_done(NMR::lib3mf_createmodel(model.put()));
  require_done(NMR::lib3mf_model_setunit(model.get(), NMR::MODELUNIT_MILLIMETER));
  add_metadata(model, options);
  require_done(NMR::lib3mf_model_addmeshobject(model.get(), object.put()));
  const std::string name = xml_escaped(options.name);
  require_done(NMR::lib3mf_object_setnameutf8(object.get(), name.c_str()));
  set_geometry(object, surface);
  if (!options.grey.empty()) set_colors(object, surface, options.grey);
  require_done(NMR::lib3mf_model_addbuilditem(model.get(), object.get(), nullptr, item.put()));
  require_done(NMR::lib3mf_object_setuuidutf8(object.get(), uuid_of(surface, 1).c_str()));
  require_done(NMR::lib3mf_builditem_setuuidutf8(item.get(), uuid_of(surface, 2).c_str()));
  require_done(NMR::lib3mf_model_setbuilduuidutf8(model.get(), uuid_of(surface, 3).c_str()));
  return bytes_of(model);
}

namespace {

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

/// Collects the meshes of the build items.
class Gatherer {
 public:
  /// @param file_size  bytes; copies of components may not multiply the file without limit.
  Gatherer(const fs::path& file, double unit, std::size_t file_size)
      : file_(file), unit_(unit), most_items_(1'000'000 + 50 * file_size) {}

  void add_build(const Handle& model) {
    Handle items;
    require(NMR::lib3mf_model_getbuilditems(model.get(), items.put()), model);
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

  TriMesh surface() { return std::move(surface_); }

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
    if (is_mesh != 0) add_mesh(object, path);
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

  void add_mesh(const Handle& mesh, const std::vector<Transform>& path) {
    DWORD points = 0, triangles = 0, got = 0;
    require(NMR::lib3mf_meshobject_getvertexcount(mesh.get(), &points), mesh);
    require(NMR::lib3mf_meshobject_gettrianglecount(mesh.get(), &triangles), mesh);
    if (points == 0 || triangles == 0) return;
    if (points > most_items_ - surface_.points.size() ||
        triangles > most_items_ - surface_.triangles.size()) {
      refuse(file_, say("expected at most ", most_items_,
                        " points and triangles in all components, found more"));
    }
    std::vector<NMR::MODELMESHVERTEX> at(points);
    std::vector<NMR::MODELMESHTRIANGLE> corners(triangles);
    require(NMR::lib3mf_meshobject_getvertices(mesh.get(), at.data(), points, &got), mesh);
    require(NMR::lib3mf_meshobject_gettriangleindices(mesh.get(), corners.data(), triangles, &got),
            mesh);
    PolygonSink sink(file_, surface_);
    for (const auto& [p] : at) {
      Vec3 q{p[0], p[1], p[2]};
      for (auto t = path.rbegin(); t != path.rend(); ++t) q = moved(*t, q);
      surface_.points.push_back(unit_ * q);
    }
    const bool mirrored = std::count_if(path.begin(), path.end(), mirrors) % 2 != 0;
    for (auto& [c] : corners) {
      if (mirrored) std::swap(c[1], c[2]);
      const double polygon[] = {double(c[0]), double(c[1]), double(c[2])};
      sink.add(polygon, false);
    }
  }

  const fs::path& file_;
  double unit_;
  std::size_t most_items_;
  int visits_ = 0;
  TriMesh surface_;
};

/// The value of a fact about the model, empty if lib3mf does not tell.
std::string metadata_text(const Handle& model, DWORD index) {
  ULONG size = 0;
  if (NMR::lib3mf_model_getmetadatavalueutf8(model.get(), index, nullptr, 0, &size) != LIB3MF_OK) {
    return {};
  }
  std::string text(std::size_t{size} + 1, '\0');  // whether or not it counts the final zero
  const LIB3MFRESULT result = NMR::lib3mf_model_getmetadatavalueutf8(
      model.get(), index, text.data(), static_cast<ULONG>(text.size()), &size);
  return result == LIB3MF_OK ? text : std::string{};
}

std::optional<Frame> stated_frame(const Handle& model) {
  DWORD count = 0;
  std::optional<Frame> frame;
  if (NMR::lib3mf_model_getmetadatacount(model.get(), &count) != LIB3MF_OK) return frame;
  for (DWORD i = 0; i < count && !frame; ++i) frame = frame_named_in(metadata_text(model, i));
  return frame;
}

}  // namespace

SurfaceFile parse_threemf(const fs::path& file, std::string_view bytes) {
  Handle model, reader;
  require_done(NMR::lib3mf_createmodel(model.put()));
  require_done(NMR::lib3mf_model_queryreader(model.get(), "3mf", reader.put()));
  std::vector<BYTE> copy(bytes.begin(), bytes.end());  // lib3mf asks for bytes it may change
  if (NMR::lib3mf_reader_readfrombuffer(reader.get(), copy.data(), copy.size()) != LIB3MF_OK) {
    refuse(file, "is not a 3MF file that lib3mf reads: " + reader.last_error());
  }
  Gatherer gatherer(file, unit_in_mm(model), bytes.size());
  gatherer.add_build(model);
  return {gatherer.surface(), stated_frame(model)};
}

}  // namespace mesamis::detail
