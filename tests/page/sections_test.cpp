// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/sections.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "page/sample_run.h"

namespace mesamis {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(Verdict, SaysWhatWasNotKept) {
  json report = sample_report();
  EXPECT_THAT(verdict_section(report).str(), HasSubstr("verdict good"));
  report["verdict"] = {{"kept", false}, {"message", "not <closed>"}};
  EXPECT_THAT(verdict_section(report).str(), HasSubstr("verdict bad"));
  EXPECT_THAT(verdict_section(report).str(), HasSubstr("not &lt;closed&gt;"));
  report.erase("verdict");
  report["converged"] = false;
  EXPECT_THAT(verdict_section(report).str(), HasSubstr("did not converge")) << "an older report";
}

TEST(Notes, TellWarningsAndWhatWasLeftOut) {
  const std::string notes = notes_section(sample_report()).str();
  EXPECT_THAT(notes, HasSubstr("&lt;b&gt;warning&lt;/b&gt;"));
  EXPECT_THAT(notes, HasSubstr("Small parts dropped: <data value=\"3\""));
  EXPECT_THAT(notes, Not(HasSubstr("Cavities filled"))) << "none was";
  EXPECT_THAT(notes, HasSubstr("145.2"));
  EXPECT_TRUE(notes_section(json::object()).is_empty());
}

TEST(Choices, AreThoseOfTheReportWithTheirReasons) {
  const std::string choices = choices_section(sample_report()).str();
  EXPECT_THAT(choices, HasSubstr("<data value=\"20000\" data-of=\"/settings/max_tets\">"));
  EXPECT_THAT(choices, HasSubstr("4 epsilon beta"));
  EXPECT_THAT(choices, Not(HasSubstr("/settings/level"))) << "it was given";
  EXPECT_THAT(settings_section(sample_report()).str(), HasSubstr(">given<"));
}

TEST(Surfaces, OfLabelsAreARowEach) {
  json report = sample_report();
  report.erase("surface");
  report["object"] = {{"surfaces",
                       {{{"name", "hip <left>"}, {"triangles", 100}, {"closed", true}},
                        {{"name", "hip right"}, {"triangles", 2000}, {"closed", false}}}}};
  const std::string table = surfaces_section(report).str();
  EXPECT_THAT(table, HasSubstr("hip &lt;left&gt;"));
  EXPECT_THAT(table, HasSubstr("data-of=\"/object/surfaces/1/triangles\""));
  EXPECT_THAT(headline_section(report).str(), HasSubstr("objects"));
  EXPECT_THAT(methods_section(report).str(), HasSubstr("2 labelled objects"));
}

TEST(Headline, SaysFirstWhatASurgeonAsks) {
  const std::string text = headline_section(sample_report(), {1, "", Vec3{22.04, 22, 101.7}}).str();
  const std::vector<std::string> in_order{"object",    "all that is bright",
                                          "size",      "22.0 × 22.0 × 102",
                                          "volume",    "5.58",
                                          "cm³",       "expected error",
                                          ">0.06",     "closed",
                                          "yes",       "level",
                                          "176",       "HU",
                                          "triangles", "tetrahedra"};
  std::size_t at = 0;
  for (const std::string& part : in_order) {
    at = text.find(part, at);
    EXPECT_NE(at, std::string::npos) << part << " in " << text;
  }
  EXPECT_THAT(text, HasSubstr("<data value=\"5575.28\" data-of=\"/surface/volume_mm3\">"));
}

TEST(Headline, AddsObjectsUp) {
  json report = sample_report();
  report.erase("surface");
  const auto object = [](double volume, double area, double error, bool closed) {
    return json{{"name", "hip"},
                {"volume_mm3", volume},
                {"area_mm2", area},
                {"closed", closed},
                {"expected_error_mm", {{"mean", error}}}};
  };
  report["object"] = {{"surfaces", {object(1000, 1, 0.2, true), object(3000, 3, 0.4, false)}}};
  const std::string text = headline_section(report).str();
  for (const char* part : {"2 objects", "4.00", "0.35", "1 of 2"})
    EXPECT_THAT(text, HasSubstr(part));
  report["object"]["surfaces"][0]["expected_error_mm"] = nullptr;
  EXPECT_THAT(headline_section(report).str(), HasSubstr("0.40")) << "of the known ones";
  report["object"]["surfaces"][1]["expected_error_mm"] = nullptr;
  EXPECT_THAT(headline_section(report).str(), Not(HasSubstr("expected error")));
}

TEST(Methods, NameTheProgramTheFiguresAndTheSource) {
  const std::string methods = methods_section(sample_report()).str();
  for (const char* part : {"40 × 40 × 40 voxels", "9.8.7", "in 1 adaptation;", "MOX Report 48/2020",
                           "175.5", "is closed"}) {
    EXPECT_THAT(methods, HasSubstr(part));
  }
}

TEST(Repeat, OffersTheSettingsAsAFile) {
  const std::string repeat = repeat_section(sample_report(), "mesamis segment 'a<b'").str();
  EXPECT_THAT(repeat, HasSubstr("a&lt;b"));
  EXPECT_THAT(repeat, HasSubstr("download=\"settings.json\""));
}

TEST(Sections, OfAnEmptyReportAreEmpty) {
  const json none = json::object();
  EXPECT_TRUE(surfaces_section(none).is_empty());
  EXPECT_TRUE(scan_section(none).is_empty());
  EXPECT_TRUE(choices_section(none).is_empty());
  EXPECT_TRUE(passes_section(none).is_empty());
  EXPECT_TRUE(settings_section(none).is_empty());
}

}  // namespace
}  // namespace mesamis
