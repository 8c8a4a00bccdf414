// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/value_axes.h"

#include <utility>

#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

/// "5 volumes (--volume 0 to 4)"
std::string offer(const char* name, std::int64_t count) {
  return message(count, " ", name, "s (--", name, " 0 to ", count - 1, ")");
}

std::string offers(const ValueAxes& axes) {
  const bool channels = axes.channels > 1;
  if (axes.volumes == 1) return channels ? offer("channel", axes.channels) : "one value per voxel";
  return message("a ", channels ? 5 : 4, "-D one: ", offer("volume", axes.volumes),
                 channels ? " of " + offer("channel", axes.channels) : "");
}

}  // namespace

TakenValue take_value(const std::filesystem::path& file, const ValueAxes& axes,
                      const ValueChoice& choice) {
  auto [volume, channel] = choice;
  if (axes.volumes == 1 && axes.channels > 1 && volume && !channel) std::swap(volume, channel);
  if (axes.channels == 1 && axes.volumes > 1 && channel && !volume) std::swap(volume, channel);
  const bool open = (axes.volumes > 1 && !volume) || (axes.channels > 1 && !channel);
  if (open) refuse(file, "expected a 3-D image, found " + offers(axes));
  const TakenValue taken{volume.value_or(0), channel.value_or(0)};
  const auto require_there = [&](const char* name, std::int64_t number, std::int64_t count) {
    if (number >= 0 && number < count) return;
    refuse(file, message("expected ", name, " 0", count > 1 ? message(" to ", count - 1) : "",
                         ", found ", number, " (the file is ", offers(axes), ")"));
  };
  require_there("volume", taken.volume, axes.volumes);
  require_there("channel", taken.channel, axes.channels);
  return taken;
}

}  // namespace mesamis::detail::files
