// SPDX-License-Identifier: Apache-2.0
// What lib3mf itself finds in our files.
#include <gmock/gmock.h>

#include "mesamis/shape_files/surface_files.h"
#include "shape_files/object_example.h"
#include "shape_files/threemf_model.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using ::testing::HasSubstr;

std::string metadata(const Model& model, const std::string& wanted) {
  DWORD count = 0;
  NMR::lib3mf_model_getmetadatacount(model.get(), &count);
  for (DWORD i = 0; i < count; ++i) {
    char key[1000] = "", value[10'000] = "";
    NMR::lib3mf_model_getmetadatakeyutf8(model.get(), i, key, sizeof key, nullptr);
    NMR::lib3mf_model_getmetadatavalueutf8(model.get(), i, value, sizeof value, nullptr);
    if (key == wanted) return value;
  }
  return "none";
}

/// The one mesh of the model.
NMR::PLib3MFBase* mesh_of(Model& model) {
  EXPECT_EQ(NMR::lib3mf_model_getmeshobjects(model.get(), model.add()), LIB3MF_OK);
  NMR::PLib3MFBase* list = model.last();
  BOOL more = 0;
  EXPECT_EQ(NMR::lib3mf_resourceiterator_movenext(list, &more), LIB3MF_OK);
  EXPECT_NE(more, 0);
  EXPECT_EQ(NMR::lib3mf_resourceiterator_getcurrent(list, model.add()), LIB3MF_OK);
  return model.last();
}

TEST(ThreeMfWriter, HasUnitNameFactsAndAClosedMeshForLib3mf) {
  const TempFolder folder;
  SurfaceWriteOptions options{.frame = Frame::kRas, .name = "a <b> & \"c\""};
  options.metadata = {{"producer", "mesamis 1.2"}, {"settings", "{\"beta\": 2}"}};
  write_surface(folder / "a.3mf", cube(), options);
  Model model;
  read(model, folder / "a.3mf");
  DWORD unit = 0;
  NMR::lib3mf_model_getunit(model.get(), &unit);
  EXPECT_EQ(unit, static_cast<DWORD>(NMR::MODELUNIT_MILLIMETER));
  // lib3mf leaves entities as they are; whoever reads XML turns them back.
  const std::string escaped = "a &lt;b&gt; &amp; &quot;c&quot;";
  EXPECT_EQ(metadata(model, "Title"), escaped);
  EXPECT_EQ(metadata(model, "Application"), "mesamis 1.2");
  EXPECT_THAT(metadata(model, "Description"),
              testing::AllOf(HasSubstr("SPACE=RAS"), HasSubstr("settings {&quot;beta&quot;: 2}")));
  NMR::PLib3MFBase* mesh = mesh_of(model);
  char name[100] = "";
  NMR::lib3mf_object_getnameutf8(mesh, name, sizeof name, nullptr);
  EXPECT_EQ(name, escaped);
  BOOL closed = 0;
  NMR::lib3mf_meshobject_ismanifoldandoriented(mesh, &closed);
  EXPECT_NE(closed, 0);
}

TEST(ThreeMfWriter, GreyValuesAreColoursOfTheCorners) {
  const TempFolder folder;
  const TriMesh surface = cube();
  SurfaceWriteOptions options;
  options.grey = {0, 51, 102.4, 153, 204.6, 255, 300, -7};
  const std::vector<int> expected{0, 51, 102, 153, 205, 255, 255, 0};
  write_surface(folder / "a.3mf", surface, options);
  Model model;
  read(model, folder / "a.3mf");
  NMR::PLib3MFBase* mesh = mesh_of(model);
  ASSERT_EQ(NMR::lib3mf_meshobject_createpropertyhandler(mesh, model.add()), LIB3MF_OK);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    NMR::MODELMESH_TRIANGLECOLOR_SRGB color{};
    ASSERT_EQ(NMR::lib3mf_propertyhandler_getcolor(model.last(), static_cast<DWORD>(t), &color),
              LIB3MF_OK);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& c = color.m_Colors[i];
      EXPECT_EQ(c.m_Red, expected[surface.triangles[t][i]]) << t;
      EXPECT_TRUE(c.m_Green == c.m_Red && c.m_Blue == c.m_Red && c.m_Alpha == 255);
    }
  }
}

TEST(ThreeMfWriter, EachObjectHasNameLabelColourAndItsPlaceInTheBuild) {
  const TempFolder folder;
  const std::vector<NamedSurface> objects = three_objects();
  write_objects(folder / "a.3mf", objects, {.name = "pelvis"});
  Model model;
  read(model, folder / "a.3mf");
  EXPECT_EQ(metadata(model, "Title"), "pelvis");
  ASSERT_EQ(NMR::lib3mf_model_getbuilditems(model.get(), model.add()), LIB3MF_OK);
  NMR::PLib3MFBase* items = model.last();
  for (const NamedSurface& object : objects) {
    BOOL more = 0, closed = 0;
    ASSERT_EQ(NMR::lib3mf_builditemiterator_movenext(items, &more), LIB3MF_OK);
    ASSERT_NE(more, 0);
    NMR::lib3mf_builditemiterator_getcurrent(items, model.add());
    NMR::PLib3MFBase* item = model.last();
    NMR::lib3mf_builditem_getobjectresource(item, model.add());
    NMR::PLib3MFBase* mesh = model.last();
    char text[100] = "";
    NMR::lib3mf_object_getpartnumberutf8(mesh, text, sizeof text, nullptr);
    EXPECT_EQ(text, std::to_string(object.label));
    NMR::lib3mf_meshobject_ismanifoldandoriented(mesh, &closed);
    EXPECT_NE(closed, 0);
    NMR::lib3mf_object_createdefaultpropertyhandler(mesh, model.add());
    DWORD group = 0, index = 9;
    ASSERT_EQ(NMR::lib3mf_defaultpropertyhandler_getbasematerial(model.last(), &group, &index),
              LIB3MF_OK);
    NMR::lib3mf_model_getbasematerialbyid(model.get(), group, model.add());
    BYTE r = 0, g = 0, b = 0, a = 0;
    ASSERT_EQ(NMR::lib3mf_basematerial_getdisplaycolor(model.last(), index, &r, &g, &b, &a),
              LIB3MF_OK);
    EXPECT_EQ((std::array<std::uint8_t, 3>{r, g, b}), object.colour);
  }
  BOOL more = 1;
  NMR::lib3mf_builditemiterator_movenext(items, &more);
  EXPECT_EQ(more, 0);
}

/// Equal objects are different objects.
TEST(ThreeMfWriter, EqualObjectsHaveDifferentIdentifiers) {
  const TempFolder folder;
  write_objects(folder / "a.3mf",
                std::vector<NamedSurface>{{"a", {}, 1, cube()}, {"a", {}, 2, cube()}});
  Model model;
  read(model, folder / "a.3mf");
  NMR::lib3mf_model_getmeshobjects(model.get(), model.add());
  NMR::PLib3MFBase* list = model.last();
  std::vector<std::string> identifiers;
  for (BOOL more = 1;
       NMR::lib3mf_resourceiterator_movenext(list, &more) == LIB3MF_OK && more != 0;) {
    NMR::lib3mf_resourceiterator_getcurrent(list, model.add());
    BOOL has = 0;
    char text[100] = "";
    NMR::lib3mf_object_getuuidutf8(model.last(), &has, text);
    EXPECT_NE(has, 0);
    identifiers.emplace_back(text);
  }
  ASSERT_EQ(identifiers.size(), 2u);
  EXPECT_NE(identifiers[0], identifiers[1]);
}

}  // namespace
}  // namespace mesamis
