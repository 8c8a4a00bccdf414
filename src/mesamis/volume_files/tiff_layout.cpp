// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/tiff_layout.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mesamis/files/length_unit.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/files/xml.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostPlanes = 1 << 20;  // of an image in several files

/// A file, and how many planes it has or can have.
struct Pages {
  const fs::path& file;
  std::int64_t found = 0;  ///< directories
  std::int64_t most = 0;   ///< planes
};

/// Steps of the plane number along each axis.
struct Steps {
  std::int64_t slice = 1, volume = 1, channel = 1;
};

std::int64_t plane_count(const TiffLayout& layout) {
  return layout.slices * layout.axes.volumes * layout.axes.channels;
}

/// @throws InputError  unless the counts are positive and the planes fit into the file.
void require_planes(const Pages& pages, const TiffLayout& layout, const char* source) {
  const auto [volumes, channels] = layout.axes;
  const std::int64_t slices = layout.slices;
  const bool positive = slices > 0 && volumes > 0 && channels > 0;
  if (positive && slices <= pages.most && volumes <= pages.most / slices &&
      channels <= pages.most / (slices * volumes)) {
    return;
  }
  refuse(pages.file,
         message(source, ": expected as many planes as the file has pages, ", pages.found,
                 ", found ", slices, " slices, ", volumes, " volumes, ", channels, " channels"));
}

void number_planes(TiffLayout& layout, const Steps& steps) {
  layout.planes.reserve(static_cast<std::size_t>(plane_count(layout)));
  for (std::int64_t c = 0; c < layout.axes.channels; ++c) {
    for (std::int64_t v = 0; v < layout.axes.volumes; ++v) {
      for (std::int64_t z = 0; z < layout.slices; ++z) {
        layout.planes.push_back(c * steps.channel + v * steps.volume + z * steps.slice);
      }
    }
  }
}

/// Single images at many times, or of more channels than ImageJ shows together, are mostly slices
/// that were named wrongly: tifffile calls the first of three axes channels.
void take_as_slices(TiffLayout& layout) {
  constexpr std::int64_t kMostChannels = 7;
  auto& [volumes, channels] = layout.axes;
  const bool times = volumes > 1;
  if (layout.slices != 1 || !(times || channels > kMostChannels)) return;
  layout.warnings.push_back(message("the file has ", times ? volumes : channels,
                                    times ? " times" : " channels",
                                    " of one slice each: they are taken as slices"));
  std::swap(layout.slices, times ? volumes : channels);
}

/// All pages are slices of one volume.
void take_all_pages(const Pages& pages, TiffLayout& layout) {
  layout.axes = {};
  layout.slices = pages.found;
  number_planes(layout, {});
}

// --- ImageJ: lines of "key=value"
// -----------------------------------------------------------------

class ImageJ {
 public:
  explicit ImageJ(std::string_view text) : text_(text) {}

  std::string_view value(std::string_view key) const {
    std::string_view rest = text_, line;
    while (take_line(rest, line)) {
      if (line.size() > key.size() && line.starts_with(key) && line[key.size()] == '=') {
        return trimmed(line.substr(key.size() + 1));
      }
    }
    return {};
  }
  std::optional<double> number(std::string_view key) const {
    double found = 0;
    return parse_number(value(key), found) && std::isfinite(found) ? std::optional(found)
                                                                   : std::nullopt;
  }
  /// 1 where it is not stated.
  std::int64_t count(std::string_view key) const {
    std::int64_t found = 1;
    return parse_number(value(key), found) ? found : 1;
  }

 private:
  std::string_view text_;
};

/// Of a calibration function only the straight line is known.
void set_calibration(const ImageJ& text, TiffLayout& layout) {
  if (text.value("cf").empty()) return;
  const auto offset = text.number("c0"), slope = text.number("c1");
  if (text.count("cf") == 0 && offset && slope && *slope != 0) {
    layout.intercept = *offset;
    layout.slope = *slope;
    return;
  }
  layout.warnings.push_back(message("the calibration of the values (cf=", shown(text.value("cf")),
                                    ") is no straight line: they are kept as stored"));
}

/// Sets the numbers of the planes.
/// @throws InputError  if there are channels or volumes, but not that many pages.
void set_planes(const Pages& pages, const ImageJ& text, TiffLayout& layout) {
  const std::int64_t images = text.count("images");
  const bool behind_one = pages.found == 1 && images > 1 && images <= pages.most;
  const std::int64_t planes = behind_one ? images : pages.found;
  if (images > 1 && images != planes) {
    layout.warnings.push_back(
        message("the description states ", images, " images, found ", planes, " pages"));
  }
  layout.axes = {text.count("frames"), text.count("channels")};
  layout.slices = text.count("slices");
  if (planes == 1 || (layout.axes.volumes == 1 && layout.axes.channels == 1)) {
    layout.axes = {};
    layout.slices = planes;
  }
  require_planes(pages, layout, "ImageJ's description");
  if (plane_count(layout) != planes) {
    refuse(pages.file, message("ImageJ's description: expected slices, frames and channels for ",
                               planes, " images, found ", plane_count(layout)));
  }
  const std::int64_t channels = layout.axes.channels;
  number_planes(layout, {channels, channels * layout.slices, 1});
  take_as_slices(layout);
}

TiffLayout read_imagej(const Pages& pages, std::string_view description) {
  const ImageJ text(description);
  TiffLayout layout;
  layout.one_directory = true;
  set_planes(pages, text, layout);
  layout.unit = text.value("unit");
  layout.unit_of_tag_alone = true;
  layout.unit_y = text.value("yunit");
  layout.unit_z = text.value("zunit");
  layout.between = std::abs(text.number("spacing").value_or(0));
  layout.zero_pixel = {text.number("xorigin").value_or(0), text.number("yorigin").value_or(0),
                       text.number("zorigin").value_or(0)};
  set_calibration(text, layout);
  return layout;
}

// --- OME-XML
// --------------------------------------------------------------------------------------

/// The name without its namespace.
std::string_view local_name(const XmlElement& element) {
  const std::string_view name = element.name;
  return name.substr(name.find(':') == std::string_view::npos ? 0 : name.find(':') + 1);
}

std::vector<const XmlElement*> children_of(const XmlElement& element, std::string_view name) {
  std::vector<const XmlElement*> found;
  for (const XmlElement& child : element.children) {
    if (local_name(child) == name) found.push_back(&child);
  }
  return found;
}

std::int64_t whole(const Pages& pages, const XmlElement& element, const char* key,
                   std::int64_t otherwise) {
  const std::string text = element.attribute(key);
  std::int64_t number = otherwise;
  if (!text.empty() && !parse_number(std::string_view(text), number)) {
    refuse(pages.file,
           message("OME-XML: expected a whole number as ", key, ", found ", in_quotes(text)));
  }
  return number;
}

/// PhysicalSizeX, Y and Z, in micrometres unless they name another unit.
void set_physical_size(const XmlElement& pixels, TiffLayout& layout) {
  for (int a = 0; a < 3; ++a) {
    const std::string key = std::string("PhysicalSize") + "XYZ"[a];
    const std::string text = pixels.attribute(key), named = pixels.attribute(key + "Unit");
    double size = 0;
    if (text.empty() || !parse_number(std::string_view(text), size)) continue;
    const auto mm = mm_per_unit(named.empty() ? "um" : std::string_view(named));
    if (mm && size > 0) {
      layout.spacing[a] = size * *mm;
    } else {
      layout.warnings.push_back(message(key, " = ", in_quotes(text), " ", shown(named),
                                        " is no length: it does not count"));
    }
  }
}

/// Plane numbers in the order of the dimensions, "XYZCT" and the like.
Steps steps_of(const Pages& pages, const TiffLayout& layout, const std::string& order) {
  Steps steps;
  std::int64_t step = 1;
  std::string letters = order.size() == 5 && order.starts_with("XY") ? order.substr(2) : "";
  std::sort(letters.begin(), letters.end());
  if (letters != "CTZ") {
    refuse(pages.file,
           message("OME-XML: expected a DimensionOrder such as XYZCT, found ", in_quotes(order)));
  }
  for (const char axis : order.substr(2)) {
    (axis == 'Z' ? steps.slice : axis == 'T' ? steps.volume : steps.channel) = step;
    step *= axis == 'Z' ? layout.slices : axis == 'T' ? layout.axes.volumes : layout.axes.channels;
  }
  return steps;
}

/// Whether the planes of a TiffData lie in this file; else the other file's name.
bool is_here(const Pages& pages, const XmlElement& data, std::string& elsewhere) {
  for (const XmlElement* uuid : children_of(data, "UUID")) {
    const std::string name = uuid->attribute("FileName");
    if (name.empty() || name == pages.file.filename().string()) continue;
    elsewhere = name;
    return false;
  }
  return true;
}

/// The places that TiffData elements give the planes; empty if there are none that do.
class PlaneMap {
 public:
  PlaneMap(const Pages& pages, const TiffLayout& layout, const Steps& steps)
      : pages_(pages), layout_(layout), steps_(steps) {
    const auto count = static_cast<std::size_t>(plane_count(layout));
    places_.assign(count, -1);
  }

  /// Planes follow one another in the order of the dimensions.
  void add(const XmlElement& data) {
    const bool one = !data.attribute("IFD").empty();
    const std::int64_t all = plane_count(layout_);
    std::int64_t at = steps_.slice * index(data, "FirstZ", layout_.slices) +
                      steps_.channel * index(data, "FirstC", layout_.axes.channels) +
                      steps_.volume * index(data, "FirstT", layout_.axes.volumes);
    std::int64_t count = whole(pages_, data, "PlaneCount", one ? 1 : all);
    std::int64_t page = whole(pages_, data, "IFD", 0);
    const bool here = is_here(pages_, data, elsewhere_);
    for (; count > 0 && at < all; --count, ++at, ++page) {
      places_[static_cast<std::size_t>(at)] = here ? page : -1;
    }
    any_ = true;
  }

  bool any() const { return any_; }
  const std::string& elsewhere() const { return elsewhere_; }
  std::int64_t page_of(std::int64_t plane) const {
    return places_[static_cast<std::size_t>(plane)];
  }

 private:
  std::int64_t index(const XmlElement& data, const char* key, std::int64_t count) const {
    const std::int64_t found = whole(pages_, data, key, 0);
    if (found >= 0 && found < count) return found;
    refuse(pages_.file,
           message("OME-XML: expected ", key, " of 0 to ", count - 1, ", found ", found));
  }

  const Pages& pages_;
  const TiffLayout& layout_;
  Steps steps_;
  std::vector<std::int64_t> places_;
  std::string elsewhere_;
  bool any_ = false;
};

void map_planes(const Pages& pages, const XmlElement& pixels, const Steps& steps,
                TiffLayout& layout) {
  PlaneMap map(pages, layout, steps);
  for (const XmlElement* data : children_of(pixels, "TiffData")) map.add(*data);
  number_planes(layout, steps);
  if (!map.any()) return;
  for (std::int64_t& plane : layout.planes) plane = map.page_of(plane);
  if (!map.elsewhere().empty()) {
    layout.warnings.push_back(message("some planes of the image lie in other files, such as ",
                                      in_quotes(map.elsewhere())));
  }
}

TiffLayout read_ome(const Pages& pages, std::string_view text, MemoryBudget& budget) {
  const XmlDocument document = parse_xml(pages.file, text, budget);
  const auto images = children_of(document.root, "Image");
  TiffLayout layout;
  const auto found =
      images.empty() ? std::vector<const XmlElement*>{} : children_of(*images.front(), "Pixels");
  if (found.empty()) {  // BinaryOnly: the metadata lie in another file
    layout.warnings.push_back("OME-XML without an image: all pages are taken as slices");
    take_all_pages(pages, layout);
    return layout;
  }
  if (images.size() > 1) {
    layout.warnings.push_back(
        message("the file holds ", images.size(), " images: the first is taken"));
  }
  const XmlElement& pixels = *found.front();
  layout.slices = whole(pages, pixels, "SizeZ", 1);
  layout.axes = {whole(pages, pixels, "SizeT", 1), whole(pages, pixels, "SizeC", 1)};
  std::int64_t samples = 0;
  for (const XmlElement* channel : children_of(pixels, "Channel")) {
    samples = std::max(samples, whole(pages, *channel, "SamplesPerPixel", 1));
  }
  if (samples > 1) layout.axes.channels = std::max<std::int64_t>(1, layout.axes.channels / samples);
  layout.with_thumbnails = !children_of(pixels, "TiffData").empty();
  // Planes may lie in other files.
  const Pages bound{pages.file, pages.found, std::max<std::int64_t>(pages.most, kMostPlanes)};
  require_planes(children_of(pixels, "TiffData").empty() ? pages : bound, layout, "OME-XML");
  map_planes(pages, pixels, steps_of(pages, layout, pixels.attribute("DimensionOrder")), layout);
  set_physical_size(pixels, layout);
  take_as_slices(layout);
  return layout;
}

// --- tifffile: {"shape": [2, 30, 36, 40]} --------------------------------------------------------

/// The numbers of the list behind "shape"; empty if there is none.
std::vector<std::int64_t> shape_in(std::string_view text) {
  std::vector<std::int64_t> shape;
  const auto key = text.find("\"shape\"");
  const auto begin = text.find('[', key), end = text.find(']', key);
  if (key == std::string_view::npos || begin == std::string_view::npos ||
      end == std::string_view::npos || end < begin) {
    return {};
  }
  std::string_view list = text.substr(begin + 1, end - begin - 1);
  while (!list.empty()) {
    const std::string_view item = trimmed(list.substr(0, list.find(',')));
    std::int64_t count = 0;
    if (!parse_number(item, count) || count < 1) return {};
    shape.push_back(count);
    list.remove_prefix(std::min(list.find(','), list.size() - 1) + 1);
  }
  return shape;
}

/// What follows a key and its colon; empty if there is none.
std::string_view value_behind(std::string_view text, const std::string& key) {
  const auto at = text.find(in_quotes(key));
  const auto colon = text.find(':', at);
  if (at == std::string_view::npos || colon == std::string_view::npos) return {};
  return trimmed(text.substr(colon + 1));
}

std::string text_in(std::string_view text, const std::string& key) {
  const std::string_view value = value_behind(text, key);
  const auto end = value.find('"', 1);
  if (!value.starts_with('"') || end == std::string_view::npos) return {};
  return std::string(value.substr(1, end - 1));
}

/// The distance of slices, in the unit that is named, or in that of the resolution.
void take_distance(std::string_view text, TiffLayout& layout) {
  const std::string_view value = value_behind(text, "spacing");
  double distance = 0;
  if (!parse_number(trimmed(value.substr(0, value.find_first_of(",}"))), distance) ||
      !std::isfinite(distance) || distance == 0) {
    return;
  }
  const std::string unit = text_in(text, "unit");
  const auto mm = mm_per_unit(unit);
  if (mm) {
    layout.spacing.z = *mm * std::abs(distance);
  } else if (unit.empty()) {
    layout.between = std::abs(distance);
  } else {
    layout.warnings.push_back(message("the unit ", in_quotes(unit),
                                      " of the spacing is no length: it "
                                      "does not count"));
  }
}

/// Which axes before the last two hold slices, volumes and channels, by their letters; without
/// letters the last of them holds slices, the others volumes.
/// @return none if two axes hold the same.
std::optional<Steps> take_axes(const std::vector<std::int64_t>& shape, const std::string& axes,
                               TiffLayout& layout) {
  const std::size_t leading = shape.size() - 2;
  if (axes.size() != shape.size()) return std::nullopt;
  Steps steps;
  std::int64_t step = 1;
  layout.slices = 1;
  for (std::size_t a = leading; a-- > 0; step *= shape[a]) {
    if (shape[a] == 1) continue;
    const bool channel = axes[a] == 'C', time = axes[a] == 'T';
    auto& count = channel ? layout.axes.channels : time ? layout.axes.volumes : layout.slices;
    if (count != 1) return std::nullopt;
    count = shape[a];
    (channel ? steps.channel : time ? steps.volume : steps.slice) = step;
  }
  return steps;
}

/// The last two axes are those of a page.
TiffLayout read_shape(const Pages& pages, std::string_view text) {
  TiffLayout layout;
  layout.one_directory = true;
  take_distance(text, layout);
  const std::vector<std::int64_t> shape = shape_in(text);
  std::int64_t planes = 1;
  for (std::size_t a = 0; a + 2 < shape.size(); ++a) {
    if (shape[a] > pages.most / planes) break;
    planes *= shape[a];
  }
  const bool fits = shape.size() > 2 && (planes == pages.found || pages.found == 1);
  if (!fits || planes == 1) {
    take_all_pages(pages, layout);
    return layout;
  }
  auto steps = take_axes(shape, text_in(text, "axes"), layout);
  if (!steps) {
    layout.slices = shape[shape.size() - 3];
    layout.axes = {std::max<std::int64_t>(1, planes / layout.slices), 1};
    steps = {1, layout.slices, planes};
  }
  require_planes(pages, layout, "the shape in the description");
  number_planes(layout, *steps);
  take_as_slices(layout);
  return layout;
}

}  // namespace

TiffLayout read_tiff_layout(const fs::path& file, std::string_view text, std::int64_t pages,
                            std::int64_t most, MemoryBudget& budget) {
  const Pages all{file, pages, std::max(pages, most)};
  const std::string_view begin = trimmed(text);
  if (begin.starts_with("ImageJ=")) return read_imagej(all, begin);
  const bool is_ome = begin.starts_with("<") && begin.find("OME") != std::string_view::npos &&
                      begin.find("Pixels") != std::string_view::npos;
  if (is_ome) return read_ome(all, begin, budget);
  if (begin.starts_with("{\"shape\"")) return read_shape(all, begin);
  TiffLayout layout;
  take_all_pages(all, layout);
  return layout;
}

}  // namespace mesamis::detail::volume_files
