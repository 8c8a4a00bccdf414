// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/run_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mesamis/files/atomic_file.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/page/base64.h"
#include "mesamis/page/charts.h"
#include "mesamis/page/figures.h"
#include "mesamis/page/html.h"
#include "mesamis/page/page_assets.h"
#include "mesamis/page/public_report.h"
#include "mesamis/page/scan_copy.h"
#include "mesamis/page/sections.h"
#include "mesamis/page/shown_run.h"
#include "mesamis/page/surface_copy.h"
#include "mesamis/page/surface_view.h"

namespace mesamis::detail::page {

namespace {

using nlohmann::json;

/// Nothing is fetched: neither what the program wrote nor what a text may hold leads out of the
/// file.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: "
    "blob:; "
    "connect-src data: blob:; font-src data:; base-uri 'none'; form-action 'none'";

std::string png_uri(const Raster& picture) {
  return "data:image/png;base64," + base64(png_bytes(picture));
}

Html figure(const std::string& inside, std::string_view caption) {
  Html made("figure");
  return made.raw(inside).add(element("figcaption", caption));
}

/// What a page has beside texts and tables.
enum class PageParts { kAll, kNoViewer, kNoPictures };

bool shows_viewer(const RunPage& page, PageParts parts) {
  return parts == PageParts::kAll && page.scan != nullptr;
}

/// A sentence for what the bound on its bytes keeps out of a page.
Html left_out_note(const RunPage& page, PageParts parts) {
  if (parts == PageParts::kAll) return Html();
  const std::string what = parts == PageParts::kNoViewer ? "The viewer is left out"
                           : page.scan != nullptr        ? "Viewer and pictures are left out"
                                                         : "The pictures are left out";
  const std::string with = parts == PageParts::kNoViewer ? "with it" : "with them";
  return of_class("p", "hint")
      .set("id", "left-out")
      .text(what + fmt::format(": {} the page would have more than {:.3g} MB.", with,
                               static_cast<double>(page.most) / 1e6));
}

// ---------------------------------------------------------------- the viewer

/// JSON within a script: a "<" could end it.
std::string script_json(const json& value) {
  std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  std::string safe;
  for (const char c : text) safe += c == '<' ? "\\u003c" : std::string(1, c);
  return safe;
}

Html data_block(const std::string& id, const std::string& kind, const std::string& text) {
  Html block("script");
  return block.set("type", kind).set("id", id).raw(text);
}

Html button(std::string_view words, const std::string& attribute, const std::string& value) {
  return element("button", words).set("type", "button").set(attribute, value);
}

Html layout_button(std::string_view words, const std::string& layout) {
  return button(words, "data-layout", layout)
      .set("aria-pressed", layout == "all" ? "true" : "false");
}

Html slider(const std::string& id, std::string_view name) {
  Html input("input"), label("label");
  input.set("type", "range").set("id", id);
  return label.set("for", id).add(element("span", name)).add(input);
}

Html check_box(const std::string& id, bool checked) {
  Html input("input");
  input.set("type", "checkbox").set("id", id);
  return checked ? input.flag("checked") : input;
}

Html labelled(const std::string& id, const Html& box, std::string_view words) {
  return of_class("label", "check").set("for", id).add(box).add(element("span", words));
}

Html surface_box(std::size_t number, const ShownSurface& surface) {
  const std::string id = "show-" + std::to_string(number);
  const auto& c = surface.outline;
  Html swatch = of_class("span", "swatch");
  swatch.set("style", fmt::format("background:rgb({},{},{})", c[0], c[1], c[2]));
  Html box;
  box.add(check_box(id, true).set("data-surface", std::to_string(number))).add(swatch);
  return labelled(id, box, surface.name.empty() ? "surface" : surface.name);
}

bool has_errors(const ShownRun& run) {
  return std::any_of(run.surfaces.begin(), run.surfaces.end(),
                     [](const ShownSurface& s) { return !s.error.empty(); });
}

/// From 0, blue, to the greatest, red.
Html error_scale() {
  Html scale = of_class("span", "error-scale");
  scale.set("id", "error-scale").flag("hidden").text("0 ");
  return scale.add(of_class("span", "ramp")).text(" ").add(Html("span").set("id", "error-most"));
}

/// Windows to look through; those of a CT have names.
Html window_buttons(const ShownRun& run, const json& report) {
  Html buttons = of_class("div", "buttons");
  buttons.set("role", "group").set("aria-label", "Window");
  buttons.add(
      button("Window of the run", "data-window", json({run.window.low, run.window.high}).dump()));
  if (native_unit(report) != "HU") return buttons;
  buttons.add(button("Bone", "data-window", "[-450,1050]"));
  return buttons.add(button("Soft tissue", "data-window", "[-160,240]"));
}

Html viewer_controls(const ShownRun& run, const json& report) {
  Html layouts = of_class("div", "buttons"), sliders = of_class("div", "sliders"),
       shown = of_class("div", "checks"), controls = of_class("div", "controls");
  layouts.set("role", "group").set("aria-label", "Layout");
  layouts.add(layout_button("All", "all")).add(layout_button("Axial", "axial"));
  layouts.add(layout_button("Coronal", "coronal")).add(layout_button("Sagittal", "sagittal"));
  if (!run.surfaces.empty()) layouts.add(layout_button("In space", "space"));
  sliders.add(slider("at-x", "right – left")).add(slider("at-y", "front – back"));
  sliders.add(slider("at-z", "foot – head")).add(slider("window-low", "black at"));
  sliders.add(slider("window-high", "white at"));
  for (std::size_t n = 0; n < run.surfaces.size(); ++n) shown.add(surface_box(n, run.surfaces[n]));
  shown.add(labelled("outlines", check_box("outlines", true), "outlines"));
  shown.add(labelled("cross", check_box("cross", true), "cross"));
  if (has_errors(run)) {
    shown.add(labelled("errors", check_box("errors", false), "expected error as colours"));
    shown.add(error_scale());
  }
  Html top = of_class("div", "top");
  top.add(layouts).add(window_buttons(run, report));
  top.add(Html("output").set("id", "readout"));
  return controls.add(top).add(shown).add(sliders);
}

Html canvas(const std::string& id) { return Html("canvas").set("id", id); }

Html slice_panel(const std::string& id, const std::string& name) {
  Html figure = of_class("figure", "panel " + id), drawn = canvas(id);
  drawn.set("tabindex", "0").set("role", "img");
  drawn.set("aria-label", name + " slice of the scan with the outline of the surface");
  return figure.add(drawn).add(element("figcaption", name));
}

Html space_panel() {
  Html figure = of_class("figure", "panel space"), frame = canvas("space-frame");
  frame.set("tabindex", "0").set("role", "img").set("aria-label", "The surface in space");
  return figure.add(canvas("space")).add(frame).add(element("figcaption", "In space"));
}

Html viewer_section(const ShownRun& run, const json& report) {
  Html section = page_part("viewer", "Look at it"), panels("div");
  section.flag("hidden");
  panels.set("id", "panels").set("data-layout", "all");
  panels.add(slice_panel("axial", "Axial")).add(slice_panel("coronal", "Coronal"));
  panels.add(slice_panel("sagittal", "Sagittal"));
  if (!run.surfaces.empty()) panels.add(space_panel());
  section.add(panels).add(viewer_controls(run, report));
  return section.add(of_class("p", "hint")
                         .text("Drag in a slice to move the cross, with shift to move the slice; "
                               "drag the surface to turn it. In what was clicked, the wheel and "
                               "the arrow keys go through the slices, + and - zoom, 0 goes back. "
                               "On a touch screen two fingers zoom and move."));
}

/// What 98 % of the points stay below, mm; 0 where nothing is known.
double greatest_error(const ShownRun& run) {
  constexpr double kShare = 0.98;
  std::vector<float> all;
  for (const ShownSurface& s : run.surfaces) all.insert(all.end(), s.error.begin(), s.error.end());
  if (all.empty()) return 0;
  const auto at =
      all.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), at, all.end());
  return *at;
}

json viewer_facts(const ShownRun& run, const json& report, const ScanCopy& scan) {
  constexpr double kSteps = 255;
  json facts{{"window", {run.window.low, run.window.high}},
             {"range", {scan.low, scan.high}},
             {"scale", {{"low", scan.low}, {"step", (scan.high - scan.low) / kSteps}}},
             {"unit", native_unit(report)},
             {"error_mm", greatest_error(run)}};
  facts["at"] = json::array();
  for (const std::size_t slice : {2, 1, 0}) facts["at"].push_back(run.slices[slice].plane.position);
  facts["surfaces"] = json::array();
  for (const ShownSurface& s : run.surfaces) {
    facts["surfaces"].push_back({{"rgb", s.colour}, {"outline", s.outline}});
  }
  return facts;
}

/// The surfaces as the viewer takes them.
Html surface_blocks(const ShownRun& run) {
  constexpr std::int64_t kMostTriangles = 200'000;
  std::int64_t all = 0;
  for (const ShownSurface& s : run.surfaces) all += std::ssize(s.surface->triangles);
  Html blocks;
  for (std::size_t n = 0; n < run.surfaces.size(); ++n) {
    const ShownSurface& shown = run.surfaces[n];
    const std::int64_t own = std::ssize(shown.surface->triangles);
    const std::int64_t most = std::max<std::int64_t>(
        100, all <= kMostTriangles
                 ? own
                 : static_cast<std::int64_t>(static_cast<double>(kMostTriangles) *
                                             static_cast<double>(own) / static_cast<double>(all)));
    const SurfaceCopy copy{*shown.surface, {shown.error.begin(), shown.error.end()}};
    blocks.add(data_block("surface-" + std::to_string(n), "text/plain",
                          base64(mz3_gz(coarse_surface(copy, most)))));
  }
  return blocks;
}

/// The scan, as large as the page permits.
/// @param so_far  bytes of the page without it.
ScanCopy fitting_copy(const RunPage& page, const ShownRun& run, std::size_t so_far) {
  constexpr std::size_t kMost = 3'000'000, kReserve = 20'000;
  const std::size_t room = page.most > so_far + kReserve ? page.most - so_far - kReserve : 0;
  return scan_copy(*page.scan, run.window, std::min(kMost, room / 4 * 3));
}

// ---------------------------------------------------------------- pictures and diagrams

Html slices_part(const ShownRun& run) {
  Html figures = of_class("div", "slices");
  for (const SliceView& slice : run.slices) {
    std::string name = slice.name;
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
    figures.add(figure(slice_svg(slice, run.surfaces),
                       fmt::format("{} slice at {:.1f} mm", name, slice.plane.position)));
  }
  return figures;
}

Html views_part(const ShownRun& run) {
  constexpr int kPixels = 420;
  Html figures = of_class("div", "views");
  for (const std::string& view : surface_views()) {
    Html img("img");
    img.set("alt", "The surface, view " + view)
        .set("src", png_uri(surface_view(run.surfaces, view, kPixels)));
    figures.add(figure(img.str(), "View: " + view));
  }
  return figures;
}

Html cut_part(const ShownRun& run, const json& report) {
  constexpr int kPixels = 1000;
  Html img("img");
  img.set("alt", "The tetrahedral mesh, cut open").set("src", png_uri(cut_picture(run, kPixels)));
  Html made = of_class("figure", "cut"), caption("figcaption");
  caption.text("The mesh cut along the axial slice, coloured by the denoised image: dark blue is ");
  caption.add(datum(report, "/grey/window_native/0", native_unit(report)))
      .text(" and less, yellow ");
  caption.add(datum(report, "/grey/window_native/1", native_unit(report)));
  return made.add(img).add(caption.text(" and more. Cells are flat along the edges of the image."));
}

Html pictures_section(const ShownRun& run, const json& report) {
  Html section = page_part("pictures", "Pictures");
  if (run.is_empty()) {
    return section.add(
        element("p", "Neither scan nor surface were at hand when this page was made."));
  }
  if (!run.slices.empty()) section.add(slices_part(run));
  if (!run.surfaces.empty()) section.add(views_part(run));
  if (run.mesh) section.add(cut_part(run, report));
  return section;
}

void add_diagram(Html& diagrams, const std::string& svg, std::string_view caption) {
  if (!svg.empty()) diagrams.add(figure(svg, caption));
}

Html scan_with_histogram(const RunPage& page, const json& report) {
  Html section = scan_section(report);
  if (page.scan == nullptr) return section;
  Html diagrams = of_class("div", "diagrams");
  add_diagram(diagrams, histogram_svg(*page.scan, report),
              "How many voxels have each value, on a logarithmic axis; the window maps to the grey "
              "values of "
              "the method, the level is where the surface lies.");
  return Html().add(section).add(diagrams);
}

Html loop_section(const json& report) {
  const Html table = passes_section(report);
  if (table.is_empty()) return table;
  Html section = page_part("loop", "Adaptations"), diagrams = of_class("div", "diagrams");
  add_diagram(diagrams, energy_svg(report), "The functional and its parts after each pass.");
  add_diagram(diagrams, cells_svg(report), "The tetrahedra of each mesh.");
  add_diagram(
      diagrams, movement_svg(report),
      "By how much each mesh moved the surface, in the mean; the loop ends below the bound.");
  return section.add(diagrams).add(table);
}

// ---------------------------------------------------------------- the page

Html head_of(const std::string& title) {
  Html head("head");
  head.add(Html("meta").set("charset", "utf-8"));
  head.add(Html("meta").set("http-equiv", "Content-Security-Policy").set("content", kPolicy));
  head.add(
      Html("meta").set("name", "viewport").set("content", "width=device-width, initial-scale=1"));
  head.add(Html("meta").set("name", "color-scheme").set("content", "light dark"));
  head.add(element("title", title));
  head.add(Html("link").set("rel", "icon").set("href", "data:,"));
  return head.add(Html("style").raw(page_style()));
}

std::string title_of(const RunPage& page) {
  std::string names;
  for (const PageSurface& s : page.surfaces) {
    if (!s.name.empty()) names += (names.empty() ? "" : ", ") + s.name;
  }
  constexpr std::size_t kLongest = 60;
  return names.empty() || names.size() > kLongest ? "Segmentation report"
                                                  : "Segmentation report: " + names;
}

Html navigation() {
  constexpr std::array<std::pair<const char*, const char*>, 8> kParts{{{"pictures", "Pictures"},
                                                                       {"surface", "Surface"},
                                                                       {"scan", "Scan"},
                                                                       {"choices", "Choices"},
                                                                       {"loop", "Adaptations"},
                                                                       {"settings", "Settings"},
                                                                       {"repeat", "Repeat"},
                                                                       {"methods", "Methods"}}};
  Html nav("nav");
  nav.set("aria-label", "Parts of this page");
  for (const auto& [id, name] : kParts) {
    nav.add(element("a", name).set("href", std::string("#") + id));
  }
  return nav;
}

SeenSurfaces seen_surfaces(const RunPage& page) {
  SeenSurfaces seen;
  std::vector<Vec3> points;
  for (const PageSurface& s : page.surfaces) {
    if (s.surface == nullptr) continue;
    points.insert(points.end(), s.surface->points.begin(), s.surface->points.end());
    seen.name = ++seen.count == 1 ? s.name : "";
  }
  if (!points.empty()) seen.size = bounding_box(points).extent();
  return seen;
}

Html header_of(const RunPage& page, const json& report) {
  Html header("header"), by = of_class("p", "by");
  header.add(element("h1", title_of(page)));
  by.text("mesamis ").add(datum(report, "/program/version")).text(", commit ");
  header.add(by.add(datum(report, "/program/commit"))).add(verdict_section(report));
  return header.add(headline_section(report, seen_surfaces(page))).add(navigation());
}

Html footer() {
  Html made("footer");
  return made.add(
      element("p",
              "Not a medical device: not for diagnosis or treatment. This page needs no network; "
              "nothing in it leaves your computer."));
}

Html main_of(const RunPage& page, const ShownRun& run, const json& report, PageParts parts) {
  Html main("main");
  main.set("id", "main").set("tabindex", "-1");
  if (shows_viewer(page, parts)) main.add(viewer_section(run, report));
  main.add(left_out_note(page, parts)).add(notes_section(report));
  if (parts != PageParts::kNoPictures) main.add(pictures_section(run, report));
  main.add(surfaces_section(report)).add(scan_with_histogram(page, report));
  main.add(choices_section(report)).add(loop_section(report)).add(settings_section(report));
  main.add(repeat_section(report, repeat_command(page.report, page.names)));
  return main.add(methods_section(report));
}

/// The viewer's data and scripts, at the end of the body.
void add_viewer(Html& body, const RunPage& page, const ShownRun& run, const json& report) {
  Html scripts;
  scripts.add(surface_blocks(run));
  scripts.add(Html("script").raw(page_script()));
  const std::size_t so_far = body.str().size() + scripts.str().size();
  const ScanCopy scan = fitting_copy(page, run, so_far);
  body.add(data_block("scan-copy", "text/plain", base64(scan.nifti_gz)));
  body.add(
      data_block("viewer-facts", "application/json", script_json(viewer_facts(run, report, scan))));
  body.add(scripts);
}

std::string page_of(const RunPage& page, const ShownRun& run, const json& report, PageParts parts) {
  Html body("body"), html("html");
  body.add(element("a", "Skip to the content").set("class", "skip").set("href", "#main"));
  body.add(header_of(page, report)).add(main_of(page, run, report, parts)).add(footer());
  if (shows_viewer(page, parts)) add_viewer(body, page, run, report);
  html.set("lang", "en").add(head_of(title_of(page))).add(body);
  return "<!DOCTYPE html>\n" + html.str() + "\n";
}

}  // namespace

std::string run_page(const RunPage& page) {
  json report = public_report(page.report, page.names);
  const ShownRun run = shown_run(page);
  if (page.scan != nullptr && is_hounsfield(*page.scan)) report["page"]["unit"] = "HU";
  std::string text = page_of(page, run, report, PageParts::kAll);
  if (text.size() > page.most) text = page_of(page, run, report, PageParts::kNoViewer);
  if (text.size() > page.most) text = page_of(page, run, report, PageParts::kNoPictures);
  return text;
}

void write_run_page(const OutputPath& file, const RunPage& page) {
  write_file(file, run_page(page));
}

}  // namespace mesamis::detail::page
