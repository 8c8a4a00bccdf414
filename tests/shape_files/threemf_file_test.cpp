// SPDX-License-Identifier: Apache-2.0
// What lib3mf itself finds in our files, and what we find in its.
#include <Model/COM/NMR_DLLInterfaces.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "mesamis/shape_files/surface_files.h"
#include "support/shapes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using ::testing::HasSubstr;

/// lib3mf's objects of one test, released together.
class Model {
 public:
  Model() { EXPECT_EQ(NMR::lib3mf_createmodel(add()), LIB3MF_OK); }
  ~Model() {
    for (NMR::PLib3MFBase* object : objects_) NMR::lib3mf_release(object);
  }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  NMR::PLib3MFBase* get() const { return objects_.front(); }
  NMR::PLib3MFBase* last() const { return objects_.back(); }
  NMR::PLib3MFBase** add() { return &objects_.emplace_back(nullptr); }

 private:
  std::deque<NMR::PLib3MFBase*> objects_;
};

void read(Model& model, const std::filesystem::path& file) {
  ASSERT_EQ(NMR::lib3mf_model_queryreader(model.get(), "3mf", model.add()), LIB3MF_OK);
  NMR::PLib3MFBase* reader = model.last();
  NMR::lib3mf_reader_setstrictmodeactive(reader, 1);
  ASSERT_EQ(NMR::lib3mf_reader_readfromfileutf8(reader, file.c_str()), LIB3MF_OK);
  DWORD warnings = 99;
  NMR::lib3mf_reader_getwarningcount(reader, &warnings);
  EXPECT_EQ(warnings, 0u);
}

void write(Model& model, const std::filesystem::path& file) {
  ASSERT_EQ(NMR::lib3mf_model_querywriter(model.get(), "3mf", model.add()), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_writer_writetofileutf8(model.last(), file.c_str()), LIB3MF_OK);
}

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

TEST(ThreeMf, HasUnitNameFactsAndAClosedMeshForLib3mf) {
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

TEST(ThreeMf, GreyValuesAreColoursOfTheCorners) {
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

TEST(ThreeMf, ThatBuildsNothingIsRefused) {
  const TempFolder folder;
  Model model;
  add_tetrahedron(model);
  write(model, folder / "a.3mf");
  EXPECT_REFUSED(read_surface(folder / "a.3mf"), HasSubstr("holds no triangle"));
}

}  // namespace
}  // namespace mesamis
