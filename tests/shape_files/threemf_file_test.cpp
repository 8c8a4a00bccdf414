// SPDX-License-Identifier: Apache-2.0
// What we find in the files of lib3mf.
#include <cmath>

#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "shape_files/threemf_model.h"
#include "support/temp_folder.h"
#include "support/throws.h"

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

TEST(ThreeMf, ThatBuildsNothingIsRefused) {
  const TempFolder folder;
  Model model;
  add_tetrahedron(model);
  write(model, folder / "a.3mf");
  EXPECT_REFUSED(read_surface(folder / "a.3mf"), HasSubstr("holds no triangle"));
}

}  // namespace
}  // namespace mesamis
