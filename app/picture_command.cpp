// SPDX-License-Identifier: Apache-2.0
// mesamis picture: a PNG of a surface, a mesh or a slice of a volume.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "arguments.h"
#include "commands.h"
#include "log.h"
#include "mesamis/base/available_memory.h"
#include "mesamis/base/error.h"
#include "mesamis/picture/picture.h"
#include "mesamis/shape_files/file_kind.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/volume_files/read_volume.h"
#include "outputs.h"
#include "ranges.h"
#include "scan.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct PictureCommand {
  fs::path input, output, outline;
  ReadOptions read;
  PictureOptions picture;
  bool turned = false;  // --view was given
};

Clip parse_clip(const std::string& text) {
  const std::string axes = "xyz";
  const auto axis = text.size() > 2 && text[1] == ',' ? axes.find(text[0]) : std::string::npos;
  if (axis == std::string::npos) {
    throw CLI::ValidationError("--clip",
                               "expected x, y or z, a comma and mm, found '" + text + "'");
  }
  return {static_cast<int>(axis), parse_numbers(text.substr(2), 1, "--clip")[0]};
}

/// "LOW:HIGH", or "LOW,HIGH" as segment has it.
Window parse_window(std::string text) {
  std::replace(text.begin(), text.end(), ':', ',');
  const auto ends = parse_numbers(text, 2, "--window");
  if (!(ends[0] < ends[1])) {
    throw CLI::ValidationError("--window", "expected low below high, found '" + text + "'");
  }
  return {ends[0], ends[1]};
}

/// What does not fit into memory is refused before it is drawn.
void require_memory_to_draw(const PictureCommand& command, std::size_t cells) {
  constexpr double kGigabyte = 1e9;
  const auto limit = memory_limit(command.read.limits.memory_gb);
  const double needed = drawing_memory(cells, command.picture);
  if (!limit || needed <= *limit) return;
  throw InputError(
      fmt::format("{}: memory: expected about {:.1f} GB to draw it, found {:.1f} GB; a smaller "
                  "--size needs less",
                  command.input.string(), needed / kGigabyte, *limit / kGigabyte));
}

void draw_volume(const PictureCommand& command) {
  if (!command.picture.color.empty() || command.picture.edges) {
    throw InputError(command.input.string() + ": --color and --edges are for surfaces and meshes");
  }
  if (command.turned || command.picture.zoom != 1 || command.picture.focus) {
    throw InputError(command.input.string() +
                     ": --view, --zoom and --focus are for surfaces and meshes");
  }
  const VolumeFile file = read_any_volume(command.input, command.read);
  for (const std::string& warning : file.warnings) log_warning(warning);
  std::optional<TriMesh> outline;
  if (!command.outline.empty())
    outline = in_lps(read_surface_file(command.outline, command.read.limits));
  require_memory_to_draw(command, outline ? outline->triangles.size() : 0);
  draw_slice(command.output, file.volume, outline ? &*outline : nullptr, command.picture);
}

/// Views are named in LPS: a surface that says it is in RAS is turned.
void draw_in_one_piece(const PictureCommand& command, const TriMesh& surface) {
  std::vector<double> values;
  if (!command.picture.color.empty()) {
    values = read_point_array(command.input, command.picture.color, command.read.limits);
  }
  require_memory_to_draw(command, surface.triangles.size());
  draw_surface(command.output, surface, command.picture, values);
}

void draw_surface_file(const PictureCommand& command) {
  if (!command.picture.color.empty()) {
    return draw_in_one_piece(command,
                             in_lps(read_surface_file(command.input, command.read.limits)));
  }
  ObjectFile file = read_object_file(command.input, command.read.limits);
  const bool coloured = file.coloured;
  const std::vector<NamedSurface> objects = in_lps(std::move(file));
  if (objects.size() == 1) return draw_in_one_piece(command, objects[0].surface);
  // Parts without colours are drawn as one: shared points have one normal.
  if (!coloured)
    return draw_in_one_piece(command,
                             in_lps(read_surface_file(command.input, command.read.limits)));
  std::size_t triangles = 0;
  for (const NamedSurface& object : objects) triangles += object.surface.triangles.size();
  require_memory_to_draw(command, triangles);
  draw_objects(command.output, objects, command.picture);
}

void draw_mesh_file(const PictureCommand& command) {
  const MeshWithArrays mesh = read_mesh(command.input, command.read.limits);
  require_memory_to_draw(command, mesh.mesh.cells.size());
  draw_mesh(command.output, mesh, command.picture);
}

int run_picture(const PictureCommand& command) {
  require_writable(command.output);
  require_distinct_files({command.output}, {command.input, command.outline});
  const FileKind kind = command.read.raw ? FileKind::kVolume : kind_of(command.input);
  if (kind != FileKind::kVolume) require_no_read_options(command.input, command.read);
  if (kind != FileKind::kVolume && !command.outline.empty()) {
    throw InputError(command.input.string() + ": --outline is for slices of a volume");
  }
  if (kind != FileKind::kVolume && command.picture.window) {
    throw InputError(command.input.string() + ": --window is for slices of a volume");
  }
  switch (kind) {
    case FileKind::kSurface:
      draw_surface_file(command);
      break;
    case FileKind::kMesh:
      draw_mesh_file(command);
      break;
    case FileKind::kVolume:
      draw_volume(command);
      break;
  }
  return kExitDone;
}

std::string check_png(const std::string& path) {
  return fs::path(path).extension() == ".png" ? "" : "expected a name that ends with .png";
}

}  // namespace

void add_picture_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<PictureCommand>();
  CLI::App* command = app.add_subcommand("picture", "Draw a surface, a mesh or a slice as PNG");
  command->add_option("input", options->input, "Surface, mesh or volume")->required();
  command->add_option("-o,--output", options->output, "Picture: .png")
      ->required()
      ->check(CLI::Validator(check_png, "PNG"));
  command->add_option("--view", options->picture.view, "Direction of view (not for volumes)")
      ->check(CLI::IsMember({"front", "back", "left", "right", "top", "bottom", "oblique"}))
      ->each([options](const std::string&) { options->turned = true; });
  command->add_option("--zoom", options->picture.zoom, "Magnification (not for volumes)")
      ->check(above_zero());
  command
      ->add_option_function<std::string>(
          "--focus",
          [options](const std::string& text) {
            const auto p = parse_numbers(text, 3, "--focus");
            options->picture.focus = Vec3{p[0], p[1], p[2]};
          },
          "X,Y,Z: centre of the picture, mm (default: the object's centre)")
      ->type_name("X,Y,Z");
  command->add_flag("--edges", options->picture.edges, "Draw the edges of triangles or cells");
  command
      ->add_option_function<std::string>(
          "--clip",
          [options](const std::string& text) { options->picture.clip = parse_clip(text); },
          "AXIS,MM: cut the object open there; of a volume, the slice (default: the middle along "
          "z)")
      ->type_name("AXIS,MM");
  command
      ->add_option("--color", options->picture.color,
                   "Array to colour by, of a mesh, a .vtp or a .ply")
      ->type_name("NAME");
  command
      ->add_option_function<std::string>(
          "--size",
          [options](const std::string& text) {
            const auto size = parse_integers(text, 2, "--size");
            options->picture.pixels = {size[0], size[1]};
          },
          "WIDTH,HEIGHT in pixels (default 1000,800)")
      ->type_name("WIDTH,HEIGHT");
  command
      ->add_option_function<std::string>(
          "--window",
          [options](const std::string& text) { options->picture.window = parse_window(text); },
          "LOW:HIGH: native values that are black and white in a volume's slice (default: nearly "
          "all samples, without padding)")
      ->type_name("LOW:HIGH");
  command->add_option("--outline", options->outline, "Surface to draw over a volume's slice");
  add_read_options(*command, options->read);
  command->callback([options, &common, &action] {
    action = [options, &common] {
      options->read.limits = common.limits;
      return run_picture(*options);
    };
  });
}

}  // namespace mesamis
