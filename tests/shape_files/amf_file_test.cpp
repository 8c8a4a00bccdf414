// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <regex>

#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "support/shapes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using ::testing::HasSubstr;

std::vector<double> numbers_in(const std::string& text, const std::string& tag) {
  const std::regex pattern("<" + tag + ">([^<]*)</" + tag + ">");
  std::vector<double> numbers;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    numbers.push_back(std::stod((*match)[1]));
  }
  return numbers;
}

TEST(Amf, HoldsTheSameDoublesAndTriangles) {
  const TempFolder folder;
  const TriMesh surface = cube({0.1, -1e5 / 3, 1e-7}, 1.0 / 3);
  write_surface(folder / "a.amf", surface);
  const std::string text = read_bytes(folder / "a.amf");
  EXPECT_THAT(text, HasSubstr("<amf unit=\"millimeter\" version=\"1.1\">"));
  const auto x = numbers_in(text, "x"), y = numbers_in(text, "y"), z = numbers_in(text, "z");
  ASSERT_EQ(x.size(), surface.points.size());
  for (std::size_t n = 0; n < x.size(); ++n) {
    EXPECT_EQ((Vec3{x[n], y[n], z[n]}), surface.points[n]);
  }
  const auto a = numbers_in(text, "v1"), b = numbers_in(text, "v2"), c = numbers_in(text, "v3");
  ASSERT_EQ(a.size(), surface.triangles.size());
  for (std::size_t t = 0; t < a.size(); ++t) {
    EXPECT_EQ(
        (Triangle{static_cast<Index>(a[t]), static_cast<Index>(b[t]), static_cast<Index>(c[t])}),
        surface.triangles[t]);
  }
  EXPECT_EQ(text.find("<color>"), std::string::npos);
}

TEST(Amf, GreyValuesBecomeColoursOfThePoints) {
  const TempFolder folder;
  SurfaceWriteOptions options;
  options.grey = {0, 51, 102, 153, 204, 255, 300, -7};
  write_surface(folder / "a.amf", cube(), options);
  const std::string text = read_bytes(folder / "a.amf");
  const std::vector<double> expected{0, 0.2, 0.4, 0.6, 0.8, 1, 1, 0};
  for (const char* channel : {"r", "g", "b"}) EXPECT_EQ(numbers_in(text, channel), expected);
  options.grey[3] = std::nan("");
  EXPECT_REFUSED(write_surface(folder / "b.amf", cube(), options), HasSubstr("not finite"));
  options.grey.pop_back();
  EXPECT_REFUSED(write_surface(folder / "b.amf", cube(), options),
                 HasSubstr("expected a grey value per point (8), found 7"));
  EXPECT_FALSE(std::filesystem::exists(folder / "b.amf"));
}

TEST(Amf, NamesFactsAndFrameWithoutBreakingTheMarkup) {
  const TempFolder folder;
  SurfaceWriteOptions options{.frame = Frame::kRas, .name = "a <b> & \"c\""};
  options.metadata = {{"settings", "{\"beta\": 2}"}};
  write_surface(folder / "a.amf", cube(), options);
  const std::string text = read_bytes(folder / "a.amf");
  EXPECT_THAT(text,
              HasSubstr("<metadata type=\"name\">a &lt;b&gt; &amp; &quot;c&quot;</metadata>"));
  EXPECT_THAT(text, HasSubstr("<metadata type=\"settings\">{&quot;beta&quot;: 2}</metadata>"));
  EXPECT_THAT(text, HasSubstr("SPACE=RAS"));
}

TEST(Amf, ReadsUnitsAndEveryObjectAndVolume) {
  const TempFolder folder;
  auto vertex = [](const char* x, const char* y, const char* z) {
    return std::string("<vertex><coordinates><x>") + x + "</x><y>" + y + "</y><z> " + z +
           " </z></coordinates></vertex>";
  };
  const std::string vertices = "<vertices>" + vertex("0", "0", "0") + vertex("1", "0", "0") +
                               vertex("0", "1", "0") + vertex("0", "0", "1e0") + "</vertices>";
  auto volume = [](const std::string& a, const std::string& b, const std::string& c) {
    return "<volume><metadata type=\"name\">x</metadata><triangle><v1>" + a + "</v1><v2>" + b +
           "</v2><v3>" + c + "</v3></triangle></volume>";
  };
  const std::string object = "<object id=\"1\"><mesh>" + vertices + volume("0", "2", "1") +
                             volume("0", "1", "3") + "</mesh></object>";
  const std::string begin = "<?xml version=\"1.0\"?>\n<!-- by hand -->\n<amf unit=\"inch\">";
  write_bytes(folder / "a.amf", begin + object + object + "</amf>");
  const TriMesh surface = read_surface(folder / "a.amf");
  ASSERT_EQ(surface.points.size(), 8u);
  EXPECT_EQ(surface.points[7], (Vec3{0, 0, 25.4}));
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {4, 6, 5}, {4, 5, 7}}));
  write_bytes(folder / "b.amf", "<amf unit=\"cubit\"></amf>");
  EXPECT_REFUSED(read_surface(folder / "b.amf"), HasSubstr("expected a unit of AMF"));
  write_bytes(folder / "c.amf", "<amf><object><mesh></mesh></object></amf>");
  EXPECT_REFUSED(read_surface(folder / "c.amf"), HasSubstr("expected <vertices> in <mesh>"));
}

/// One triangle whose first point's x is the given markup.
std::string triangle_at(const std::string& x) {
  return "<amf><object><mesh><vertices><vertex><coordinates><x>" + x +
         "</x><y>0</y><z>0</z></coordinates></vertex>"
         "<vertex><coordinates><x>1</x><y>0</y><z>0</z></coordinates></vertex>"
         "<vertex><coordinates><x>0</x><y>1</y><z>0</z></coordinates></vertex></vertices>"
         "<volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></object></"
         "amf>";
}

TEST(Amf, MarkupInsideANumberDoesNotChangeIt) {
  const TempFolder folder;
  for (const char* ten : {"10", "1<!--c-->0", "<![CDATA[10]]>", " 1&#48; "}) {
    write_bytes(folder / "a.amf", triangle_at(ten));
    EXPECT_EQ(read_surface(folder / "a.amf").points[0].x, 10) << ten;
  }
  for (const char* none : {"1<b/>0", "1 0", "", "1&x;0", "ten"}) {
    write_bytes(folder / "a.amf", triangle_at(none));
    EXPECT_REFUSED(read_surface(folder / "a.amf"), HasSubstr("a.amf: ")) << none;
  }
  write_bytes(folder / "a.amf", "<!DOCTYPE amf [<!ENTITY x \"10\">]>" + triangle_at("&x;"));
  EXPECT_REFUSED(read_surface(folder / "a.amf"), HasSubstr("declarations of entities"));
}

/// Only what stands in the object itself names and colours it.
TEST(Amf, ObjectsOfOtherWritersHaveNamesAndColours) {
  const TempFolder folder;
  const std::string one = triangle_at("0");
  const std::string mesh =
      one.substr(one.find("<mesh>"), one.find("</object>") - one.find("<mesh>"));
  const auto object = [&](const std::string& id, const std::string& facts) {
    return "<object id=\"" + id + "\">" + facts + mesh + "</object>";
  };
  const std::string red = "<color><r>1</r><g>0</g><b>0.2</b><a>1</a></color>";
  write_bytes(folder / "a.amf",
              "<amf>" + object("4", "<metadata type=\"name\"> hip </metadata>" + red) +
                  object("9", "<metadata type=\"url\">x</metadata>" + red) + "</amf>");
  const ObjectFile file = read_object_file(folder / "a.amf");
  ASSERT_EQ(file.objects.size(), 2u);
  EXPECT_EQ(file.objects[0].name, "hip");
  EXPECT_EQ(file.objects[0].label, 4);
  EXPECT_EQ(file.objects[0].colour, (std::array<std::uint8_t, 3>{255, 0, 51}));
  EXPECT_EQ(file.objects[1].name, "object 9");
  EXPECT_TRUE(file.coloured);
  // Formulas, as AMF permits them, and channels that are missing.
  for (const char* none : {"<color><r>x/2</r><g>0</g><b>0</b></color>", "<color/>"}) {
    write_bytes(folder / "b.amf", "<amf>" + object("4", none) + object("4", red) + "</amf>");
    const ObjectFile other = read_object_file(folder / "b.amf");
    EXPECT_FALSE(other.coloured);
    EXPECT_EQ(other.objects.at(1).label, 2) << "equal labels are replaced";
  }
}

/// The tree would need gigabytes for the elements of a real file; points and triangles are taken
/// out of it as they come.
TEST(Amf, MoreElementsThanATreeMayHoldAreRead) {
  const TempFolder folder;
  TriMesh surface;
  for (int n = 0; n < 60'000; ++n) {
    const auto first = static_cast<Index>(surface.points.size());
    surface.points.insert(surface.points.end(), {{1.0 * n, 0, 0}, {1.0 * n, 1, 0}, {0, 0, 1}});
    surface.triangles.push_back({first, first + 1, first + 2});
  }
  write_surface(folder / "a.amf", surface);
  const TriMesh back = read_surface(folder / "a.amf");
  EXPECT_EQ(back.points, surface.points);
  EXPECT_EQ(back.triangles, surface.triangles);
}

}  // namespace
}  // namespace mesamis
