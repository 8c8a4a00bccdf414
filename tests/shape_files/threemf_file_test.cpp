// SPDX-License-Identifier: Apache-2.0
// What we find in the files of lib3mf.
#include <cmath>

#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "shape_files/threemf_model.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/zip_bytes.h"

namespace mesamis {
namespace {

using ::testing::HasSubstr;

void write(Model& model, const std::filesystem::path& file) {
  ASSERT_EQ(NMR::lib3mf_model_querywriter(model.get(), "3mf", model.add()), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_writer_writetofileutf8(model.last(), file.c_str()), LIB3MF_OK);
}

/// A tetrahedron with corners at 0 and at 1 on each axis.
NMR::PLib3MFBase* add_tetrahedron(Model& model) {
  NMR::MODELMESHVERTEX points[] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  NMR::MODELMESHTRIANGLE triangles[] = {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{0, 3, 2}}};
  EXPECT_EQ(NMR::lib3mf_model_addmeshobject(model.get(), model.add()), LIB3MF_OK);
  NMR::PLib3MFBase* mesh = model.last();
  EXPECT_EQ(NMR::lib3mf_meshobject_setgeometry(mesh, points, 4, triangles, 4), LIB3MF_OK);
  return mesh;
}

TEST(ThreeMf, ReadsWhatIsBuiltWhereItIsBuilt) {
  const TempFolder folder;
  Model model;
  NMR::lib3mf_model_setunit(model.get(), NMR::MODELUNIT_INCH);
  NMR::PLib3MFBase* mesh = add_tetrahedron(model);
  ASSERT_EQ(NMR::lib3mf_model_addcomponentsobject(model.get(), model.add()), LIB3MF_OK);
  NMR::PLib3MFBase* pair = model.last();
  // A quarter turn about z, then 10 along x.
  NMR::MODELTRANSFORM turn{{{0, -1, 0, 10}, {1, 0, 0, 0}, {0, 0, 1, 0}}};
  NMR::MODELTRANSFORM lift{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 5}}};
  ASSERT_EQ(NMR::lib3mf_componentsobject_addcomponent(pair, mesh, &turn, model.add()), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_componentsobject_addcomponent(pair, mesh, nullptr, model.add()), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_model_addbuilditem(model.get(), pair, &lift, model.add()), LIB3MF_OK);
  write(model, folder / "a.3mf");

  const TriMesh surface = read_surface(folder / "a.3mf");
  ASSERT_EQ(surface.points.size(), 8u);
  EXPECT_LT(norm(surface.points[1] - 25.4 * Vec3{10, 1, 5}), 1e-4);
  EXPECT_LT(norm(surface.points[2] - 25.4 * Vec3{9, 0, 5}), 1e-4);
  EXPECT_LT(norm(surface.points[5] - 25.4 * Vec3{1, 0, 5}), 1e-4);
  EXPECT_TRUE(check_surface(surface).closed());
  EXPECT_NEAR(check_surface(surface).volume, 2 * std::pow(25.4, 3) / 6, 0.1);
}

TEST(ThreeMf, AMirroredPartStillFacesOutward) {
  const TempFolder folder;
  Model model;
  NMR::PLib3MFBase* mesh = add_tetrahedron(model);
  NMR::MODELTRANSFORM mirror{{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  ASSERT_EQ(NMR::lib3mf_model_addbuilditem(model.get(), mesh, &mirror, model.add()), LIB3MF_OK);
  write(model, folder / "a.3mf");
  EXPECT_NEAR(check_surface(read_surface(folder / "a.3mf")).volume, 1.0 / 6, 1e-6);
}

TEST(ThreeMf, WithEndlessComponentsIsRefused) {
  const TempFolder folder;
  Model model;
  NMR::PLib3MFBase* inner = add_tetrahedron(model);
  for (int level = 0; level < 25; ++level) {
    ASSERT_EQ(NMR::lib3mf_model_addcomponentsobject(model.get(), model.add()), LIB3MF_OK);
    NMR::PLib3MFBase* pair = model.last();
    for (int i = 0; i < 2; ++i) {
      ASSERT_EQ(NMR::lib3mf_componentsobject_addcomponent(pair, inner, nullptr, model.add()),
                LIB3MF_OK);
    }
    inner = pair;
  }
  ASSERT_EQ(NMR::lib3mf_model_addbuilditem(model.get(), inner, nullptr, model.add()), LIB3MF_OK);
  write(model, folder / "a.3mf");
  EXPECT_REFUSED(read_surface(folder / "a.3mf"), HasSubstr("too many components"));
}

/// A few hundred components that each hold one large mesh: small files, gigabytes of triangles.
TEST(ThreeMf, WithTooManyCopiesOfAMeshIsRefused) {
  const TempFolder folder;
  Model model;
  const std::vector<NMR::MODELMESHTRIANGLE> triangles(20'000, NMR::MODELMESHTRIANGLE{{0, 1, 2}});
  NMR::PLib3MFBase* inner = add_tetrahedron(model);
  NMR::MODELMESHVERTEX points[] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}};
  ASSERT_EQ(NMR::lib3mf_meshobject_setgeometry(
                inner, points, 3, const_cast<NMR::MODELMESHTRIANGLE*>(triangles.data()),
                static_cast<DWORD>(triangles.size())),
            LIB3MF_OK);
  for (int level = 0; level < 2; ++level) {
    ASSERT_EQ(NMR::lib3mf_model_addcomponentsobject(model.get(), model.add()), LIB3MF_OK);
    NMR::PLib3MFBase* many = model.last();
    for (int i = 0; i < 100; ++i) {
      ASSERT_EQ(NMR::lib3mf_componentsobject_addcomponent(many, inner, nullptr, model.add()),
                LIB3MF_OK);
    }
    inner = many;
  }
  ASSERT_EQ(NMR::lib3mf_model_addbuilditem(model.get(), inner, nullptr, model.add()), LIB3MF_OK);
  write(model, folder / "a.3mf");
  EXPECT_REFUSED(read_surface(folder / "a.3mf"), HasSubstr("points and triangles in all"));
}

/// An assembly of one coloured mesh twice, and a mesh without a name or a colour.
TEST(ThreeMf, EachMeshOfTheBuildIsAnObject) {
  const TempFolder folder;
  Model model;
  NMR::PLib3MFBase* mesh = add_tetrahedron(model);
  NMR::lib3mf_object_setnameutf8(mesh, "tooth <4>");
  NMR::MODELMESHCOLOR_SRGB red{200, 10, 20, 255};
  ASSERT_EQ(NMR::lib3mf_object_createdefaultpropertyhandler(mesh, model.add()), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_defaultpropertyhandler_setcolor(model.last(), &red), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_model_addcomponentsobject(model.get(), model.add()), LIB3MF_OK);
  NMR::PLib3MFBase* pair = model.last();
  NMR::MODELTRANSFORM lift{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 5}}};
  ASSERT_EQ(NMR::lib3mf_componentsobject_addcomponent(pair, mesh, nullptr, model.add()), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_componentsobject_addcomponent(pair, mesh, &lift, model.add()), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_model_addbuilditem(model.get(), pair, nullptr, model.add()), LIB3MF_OK);
  NMR::PLib3MFBase* plain = add_tetrahedron(model);
  ASSERT_EQ(NMR::lib3mf_model_addbuilditem(model.get(), plain, nullptr, model.add()), LIB3MF_OK);
  write(model, folder / "a.3mf");
  const ObjectFile file = read_object_file(folder / "a.3mf");
  ASSERT_EQ(file.objects.size(), 3u);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(file.objects[i].name, "tooth <4>");
    EXPECT_EQ(file.objects[i].colour, (std::array<std::uint8_t, 3>{200, 10, 20}));
  }
  EXPECT_EQ(file.objects[1].label, 2);
  EXPECT_EQ(file.objects[1].surface.points.at(0), (Vec3{0, 0, 5}));
  EXPECT_EQ(file.objects[2].name, "object 3");
  EXPECT_FALSE(file.coloured) << "the last one has no colour";
}

using Parts = std::vector<std::pair<std::string, std::string>>;

/// Parts of an archive that a model of its own makes a package.
std::string package_of(Parts parts) {
  parts.insert(parts.begin(),
               {"_rels/.rels",
                "<Relationships><Relationship Id=\"r\" Target=\"/3D/3dmodel.model\" "
                "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
                "</Relationships>"});
  return zip_bytes(parts, true);
}

std::string model_of(const std::string& resources, const std::string& build,
                     const std::string& unit = "millimeter") {
  return "<model unit=\"" + unit +
         "\" requiredextensions=\"p\" xmlns:p=\"http://schemas."
         "microsoft.com/3dmanufacturing/production/2015/06\"><resources>" +
         resources + "</resources><build>" + build + "</build></model>";
}

std::string tetrahedron(const std::string& id, const std::string& name = "") {
  return "<object id=\"" + id + "\" name=\"" + name +
         "\"><mesh><vertices>"
         "<vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
         "<vertex x=\"0\" y=\"1\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles>"
         "<triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
         "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"0\" v2=\"3\" v3=\"2\"/>"
         "</triangles></mesh></object>";
}

std::string placed(const std::string& id, const std::string& path, const std::string& x) {
  return "<object id=\"" + id + "\"><components><component p:path=\"" + path +
         "\" objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 " + x + " 0 0\"/></components></object>";
}

TEST(ThreeMf, PartsInModelsOfTheirOwnAreBuilt) {
  const TempFolder folder;
  // An item may name another model as well; that one is in inches.
  const std::string root = model_of(placed("2", "/3D/Objects/a.model", "10"),
                                    "<item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 0 5 0\"/>"
                                    "<item objectid=\"1\" p:path=\"/3D/Objects/b.model\"/>");
  write_bytes(folder / "a.3mf",
              package_of({{"3D/3dmodel.model", root},
                          {"3D/Objects/a.model", model_of(tetrahedron("1", "a"), "")},
                          {"3D/Objects/b.model", model_of(tetrahedron("1", "b"), "", "inch")}}));
  const ObjectFile file = read_object_file(folder / "a.3mf");
  ASSERT_EQ(file.objects.size(), 2u);
  EXPECT_EQ(file.objects[0].name, "a");
  EXPECT_EQ(file.objects[0].surface.points[1], (Vec3{11, 5, 0}));
  EXPECT_EQ(file.objects[1].surface.points[1], (Vec3{25.4, 0, 0}));
  EXPECT_NEAR(check_surface(read_surface(folder / "a.3mf")).volume, (1 + std::pow(25.4, 3)) / 6,
              1e-6);
}

TEST(ThreeMf, PartsThatAreMissingOrPlaceEachOtherAreRefused) {
  const TempFolder folder;
  const std::string item = "<item objectid=\"2\"/>";
  const auto refused = [&](const Parts& parts, const char* why) {
    write_bytes(folder / "a.3mf", package_of(parts));
    EXPECT_REFUSED(read_surface(folder / "a.3mf"), HasSubstr(why));
  };
  const std::string root = model_of(placed("2", "/3D/b.model", "0"), item);
  refused({{"3D/3dmodel.model", root}}, "expected the model \"3D/b.model\" in the archive");
  refused({{"3D/3dmodel.model", root}, {"3D/b.model", model_of(tetrahedron("7"), "")}},
          "an object of the model that path names");
  refused({{"3D/3dmodel.model", root},
           {"3D/b.model", model_of(placed("1", "/3D/c.model", "0"), "")},
           {"3D/c.model", model_of(placed("1", "/3D/b.model", "0"), "")}},
          "models that do not place each other");
}

TEST(ThreeMf, ThatBuildsNothingIsRefused) {
  const TempFolder folder;
  Model model;
  add_tetrahedron(model);
  write(model, folder / "a.3mf");
  EXPECT_REFUSED(read_surface(folder / "a.3mf"), HasSubstr("holds no triangle"));
}

}  // namespace
}  // namespace mesamis
