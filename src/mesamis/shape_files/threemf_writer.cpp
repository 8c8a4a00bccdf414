// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>

#include "mesamis/files/xml_text.h"
#include "mesamis/shape_files/object_formats.h"
#include "mesamis/shape_files/threemf_handle.h"

namespace mesamis::detail::shape_files {
namespace {

constexpr std::size_t kCorners = 3;

/// An identifier that only depends on what it names (RFC 9562, version 8): lib3mf's own are drawn
/// at random, and no two files would be alike.
class Identifier {
 public:
  explicit Identifier(std::uint64_t salt)
      : hash_{0xcbf29ce484222325 ^ salt, 0x84222325cbf29ce4 ^ salt} {}

  Identifier& add(const TriMesh& surface) {
    for (const Vec3& p : surface.points) {
      for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint64_t>(p[axis] + 0.0));
    }
    for (const Triangle& t : surface.triangles) {
      for (const Index p : t) add(static_cast<std::uint64_t>(p));
    }
    return *this;
  }

  std::string text() const {
    char text[40];
    std::snprintf(
        text, sizeof text, "%08x-%04x-8%03x-%04x-%012llx", static_cast<unsigned>(hash_[0] >> 32),
        static_cast<unsigned>(hash_[0] >> 16 & 0xffff), static_cast<unsigned>(hash_[0] & 0xfff),
        static_cast<unsigned>(0x8000 | (hash_[1] >> 48 & 0x3fff)),
        static_cast<unsigned long long>(hash_[1] & 0xffffffffffff));
    return text;
  }

 private:
  void add(std::uint64_t word) {
    constexpr std::uint64_t kPrime = 0x100000001b3;  // FNV-1a, on words
    hash_[0] = (hash_[0] ^ word) * kPrime;
    hash_[1] = (hash_[1] ^ std::rotl(word, 32)) * kPrime;
  }

  std::array<std::uint64_t, 2> hash_;
};

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

void begin_model(const Handle& model, const SurfaceWriteOptions& options) {
  require_done(NMR::lib3mf_model_setunit(model.get(), NMR::MODELUNIT_MILLIMETER));
  add_metadata(model, options);
}

/// Adds a mesh object to the model and to its build.
/// @param number  of the object: equal ones must not have equal identifiers.
void add_object(const Handle& model, const Handle& object, const TriMesh& surface,
                std::uint64_t number) {
  Handle item;
  set_geometry(object, surface);
  require_done(NMR::lib3mf_model_addbuilditem(model.get(), object.get(), nullptr, item.put()));
  const auto identifier = [&](std::uint64_t salt) {
    return Identifier(salt + 4 * number).add(surface).text();
  };
  require_done(NMR::lib3mf_object_setuuidutf8(object.get(), identifier(1).c_str()));
  require_done(NMR::lib3mf_builditem_setuuidutf8(item.get(), identifier(2).c_str()));
}

void begin_object(const Handle& model, Handle& object, const std::string& name) {
  require_done(NMR::lib3mf_model_addmeshobject(model.get(), object.put()));
  require_done(NMR::lib3mf_object_setnameutf8(object.get(), xml_escaped(name).c_str()));
}

/// The materials of all objects.
class Materials {
 public:
  explicit Materials(const Handle& model) {
    require_done(NMR::lib3mf_model_addbasematerialgroup(model.get(), group_.put()));
    require_done(NMR::lib3mf_basematerial_getresourceid(group_.get(), &id_));
  }

  /// Makes an object of a material of its own.
  void add(const Handle& object, const std::string& name, const Colour& colour) {
    DWORD index = 0;
    Handle whole;
    require_done(NMR::lib3mf_basematerial_addmaterialutf8(group_.get(), xml_escaped(name).c_str(),
                                                          colour[0], colour[1], colour[2], &index));
    require_done(NMR::lib3mf_object_createdefaultpropertyhandler(object.get(), whole.put()));
    require_done(NMR::lib3mf_defaultpropertyhandler_setbasematerial(whole.get(), id_, index));
  }

 private:
  Handle group_;
  DWORD id_ = 0;
};

}  // namespace

std::string threemf_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  Handle model, object;
  require_done(NMR::lib3mf_createmodel(model.put()));
  begin_model(model, options);
  begin_object(model, object, options.name);
  add_object(model, object, surface, 0);
  if (!options.grey.empty()) set_colors(object, surface, options.grey);
  const std::string build = Identifier(3).add(surface).text();
  require_done(NMR::lib3mf_model_setbuilduuidutf8(model.get(), build.c_str()));
  return bytes_of(model);
}

std::string threemf_object_bytes(std::span<const NamedSurface> objects,
                                 const SurfaceWriteOptions& options) {
  Handle model;
  require_done(NMR::lib3mf_createmodel(model.put()));
  begin_model(model, options);
  Materials materials(model);
  Identifier build(3);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto& [name, colour, label, surface] = objects[i];
    Handle object;
    begin_object(model, object, name);
    const std::string number = std::to_string(label);
    require_done(NMR::lib3mf_object_setpartnumberutf8(object.get(), number.c_str()));
    add_object(model, object, surface, i);
    materials.add(object, name, colour);
    build.add(surface);
  }
  require_done(NMR::lib3mf_model_setbuilduuidutf8(model.get(), build.text().c_str()));
  return bytes_of(model);
}

}  // namespace mesamis::detail::shape_files
