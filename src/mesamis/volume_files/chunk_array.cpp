// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/chunk_array.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "mesamis/files/given_spacing.h"
#include "mesamis/files/in_one_line.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/rounding_record.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostVoxels = std::uint64_t{1} << 40;
constexpr std::uint64_t kMostAlong = std::numeric_limits<Index>::max();
constexpr std::size_t kMostAxes = 8;

/// The product of counts; refused beyond 2^40.
void require_product(const fs::path& file, const std::vector<std::uint64_t>& counts,
                     const char* what) {
  std::uint64_t product = 1;
  for (const std::uint64_t count : counts) {
    if (count < 1 || count > kMostAlong) {
      refuse(file, message("expected ", what, " of 1 to ", kMostAlong,
                           " elements along each axis, found ", count));
    }
    product *= count;  // below 2^40 times 2^31
    if (product > kMostVoxels) {
      refuse(file, message("expected ", what, " of at most 2^40 elements, found more"));
    }
  }
}

std::string axis_name(const std::vector<std::string>& axes, std::size_t axis) {
  return axis < axes.size() ? message("axis ", axis, " (", shown(axes[axis]), ")")
                            : message("axis ", axis);
}

/// Slices of constant k from `first` on.
struct SliceRange {
  std::uint64_t first = 0, count = 0;
  std::uint64_t end() const { return first + count; }
};

/// A box of voxels in the scan and where it begins in a chunk: k, j, i.
struct ChunkPart {
  std::array<std::uint64_t, 3> from{}, size{}, in_chunk{};
};

/// The part of a chunk that lies in some slices.
ChunkPart part_of(const ChunkLayout& layout, const std::array<std::uint64_t, 3>& chunk,
                  const SliceRange& slices) {
  const std::size_t lead = layout.shape.size() - 3;
  ChunkPart part;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::uint64_t length = layout.chunk[lead + a], begin = chunk[a] * length;
    const std::uint64_t end = std::min(begin + length, layout.shape[lead + a]);
    part.from[a] = a == 0 ? std::max(begin, slices.first) : begin;
    part.size[a] = (a == 0 ? std::min(end, slices.end()) : end) - part.from[a];
    part.in_chunk[a] = part.from[a] - begin;
  }
  return part;
}

/// Elements of a chunk between neighbours along each axis.
std::vector<std::size_t> strides_of(const ChunkLayout& layout) {
  std::vector<std::size_t> strides(layout.shape.size());
  std::size_t stride = 1;
  for (std::size_t n = layout.order.size(); n-- > 0;) {
    strides[layout.order[n]] = stride;
    stride *= layout.chunk[layout.order[n]];
  }
  return strides;
}

/// The element of a chunk that the leading axes begin at.
std::size_t lead_element(const ChunkLayout& layout, const std::vector<std::size_t>& strides) {
  std::size_t element = 0;
  for (std::size_t a = 0; a < layout.lead.size(); ++a) {
    element += layout.lead[a] % layout.chunk[a] * strides[a];
  }
  return element;
}

/// Which of the leading axes hold volumes and channels; those of length 1 hold nothing.
struct LeadAxes {
  std::optional<std::size_t> volume, channel;
};

LeadAxes lead_axes(const fs::path& file, const ChunkLayout& layout,
                   const std::vector<std::string>& names) {
  const auto is = [&](std::size_t axis, const char* name) {
    return axis < names.size() && lower(names[axis]) == name;
  };
  LeadAxes lead;
  for (std::size_t a = 0; a + 3 < layout.shape.size(); ++a) {
    if (layout.shape[a] == 1) continue;
    auto& place = is(a, "c") || (lead.volume && !is(a, "t")) ? lead.channel : lead.volume;
    if (place) {
      refuse(file, message("expected volumes and channels along two axes at most, found ",
                           layout.shape[a], " along ", axis_name(names, a), " too"));
    }
    place = a;
  }
  return lead;
}

template <class Stored, class Number>
void convert_line(const char* bytes, std::size_t stride, ByteOrder order, std::span<Number> out) {
  constexpr bool kRounds = std::same_as<Number, float> && kMayBeRounded<Stored>;
  RoundedSamples rounded;
  for (std::size_t n = 0; n < out.size(); ++n) {
    const auto stored = load<Stored>(bytes + n * stride * sizeof(Stored), order);
    out[n] = static_cast<Number>(stored);
    if constexpr (kRounds) rounded.note(static_cast<Exact>(stored), out[n]);
  }
  if constexpr (kRounds) note_rounded(rounded);
}

class ChunkArray : public ChunkedScan {
 public:
  explicit ChunkArray(OpenedArray array) : array_(std::move(array)) {
    const std::size_t lead = array_.layout.shape.size() - 3;
    const std::vector<std::size_t> strides = strides_of(array_.layout);
    first_element_ = lead_element(array_.layout, strides);
    for (std::size_t a = 0; a < 3; ++a) {
      length_[a] = array_.layout.chunk[lead + a];
      strides_[a] = strides[lead + a];
    }
  }

  const VoxelGrid& grid() const override { return array_.grid; }
  const std::string& format() const override { return array_.format; }
  const std::vector<std::string>& warnings() const override { return array_.warnings; }
  bool holds_labels() const override { return array_.labels != nullptr; }
  const std::vector<NamedNumber>& named_numbers() const override {
    static const std::vector<NamedNumber> kNone;
    return array_.labels ? *array_.labels : kNone;
  }
  std::vector<float> read(Index first, Index count) const override;
  void visit_samples(const std::function<void(std::span<const double>)>& visit) const override;

 private:
  std::uint64_t slice_voxels() const {
    return static_cast<std::uint64_t>(array_.grid.size[0]) *
           static_cast<std::uint64_t>(array_.grid.size[1]);
  }
  /// The slices of a row of chunks.
  SliceRange row_slices(std::uint64_t row) const {
    const std::uint64_t first = row * length_[0];
    const auto all = static_cast<std::uint64_t>(array_.grid.size[2]);
    return {first, std::min(length_[0], all - first)};
  }
  void read_row(std::uint64_t row, const SliceRange& wanted, MemoryBudget& budget,
                std::span<float> out) const;
  bool keep_row(std::uint64_t row, MemoryBudget& budget) const;
  void drop_row(MemoryBudget& budget) const {
    kept_row_.reset();
    free_within(budget, kept_);
  }
  /// What an earlier call has kept counts, or goes where there is no room.
  void claim_kept(MemoryBudget& budget) const {
    if (kept_.capacity() * sizeof(float) > budget.left()) {
      kept_row_.reset();
      kept_ = {};
    }
    budget.claim(kept_.capacity(), sizeof(float), "a row of chunks");
  }
  // Number is float or double.
  template <class Number>
  void decode(std::uint64_t row, const SliceRange& slices, MemoryBudget& budget,
              std::span<Number> out) const;
  template <class Number>
  void decode_chunk(const std::array<std::uint64_t, 3>& place, const SliceRange& slices,
                    MemoryBudget& budget, std::span<Number> out) const;
  template <class Number>
  void put(const ChunkPart& part, const std::string* bytes, const SliceRange& slices,
           std::span<Number> out) const;

  OpenedArray array_;
  std::array<std::size_t, 3> strides_{};
  std::size_t first_element_ = 0;          // of a chunk, in the volume and channel that are read
  std::array<std::uint64_t, 3> length_{};  // of a chunk along k, j, i
  mutable std::mutex mutex_;
  mutable std::optional<std::uint64_t> kept_row_;
  mutable std::vector<float> kept_;
};

/// Writes a part to its place in the slices; without bytes the fill value.
template <class Number>
void ChunkArray::put(const ChunkPart& part, const std::string* bytes, const SliceRange& slices,
                     std::span<Number> out) const {
  const ChunkLayout& layout = array_.layout;
  const auto nx = static_cast<std::uint64_t>(array_.grid.size[0]);
  const auto ny = static_cast<std::uint64_t>(array_.grid.size[1]);
  const auto& [from, size, in_chunk] = part;
  for (std::uint64_t k = 0; k < size[0]; ++k) {
    for (std::uint64_t j = 0; j < size[1]; ++j) {
      const std::uint64_t line = ((from[0] + k - slices.first) * ny + from[1] + j) * nx + from[2];
      const std::span<Number> target = out.subspan(line, size[2]);
      if (bytes == nullptr) {
        std::fill(target.begin(), target.end(), static_cast<Number>(layout.fill));
        continue;
      }
      const std::size_t element = first_element_ + (in_chunk[0] + k) * strides_[0] +
                                  (in_chunk[1] + j) * strides_[1] + in_chunk[2] * strides_[2];
      const char* first = bytes->data() + element * byte_size(layout.type);
      with_number_type(layout.type, [&](auto zero) {
        convert_line<decltype(zero)>(first, strides_[2], layout.byte_order, target);
      });
    }
  }
}

template <class Number>
void ChunkArray::decode_chunk(const std::array<std::uint64_t, 3>& place, const SliceRange& slices,
                              MemoryBudget& budget, std::span<Number> out) const {
  const ChunkPart part = part_of(array_.layout, place, slices);
  std::vector<std::uint64_t> index;
  for (std::size_t a = 0; a < array_.layout.lead.size(); ++a) {
    index.push_back(array_.layout.lead[a] / array_.layout.chunk[a]);
  }
  index.insert(index.end(), place.begin(), place.end());
  const ScopedFile scope(budget, array_.path);
  std::optional<StoredChunk> chunk = array_.fetch(index, budget);
  if (!chunk) return put(part, nullptr, slices, out);
  const std::size_t size = chunk_bytes(array_.layout);
  budget.claim(chunk->codecs.empty() ? 0 : 2, size, "a chunk");
  const std::string bytes = unpack_chunk(chunk->file, std::move(chunk->bytes), chunk->codecs, size);
  put(part, &bytes, slices, out);
}

template <class Number>
void ChunkArray::decode(std::uint64_t row, const SliceRange& slices, MemoryBudget& budget,
                        std::span<Number> out) const {
  const auto chunks = [&](std::size_t axis) {
    const auto all = static_cast<std::uint64_t>(array_.grid.size[2 - axis]);
    return (all + length_[axis] - 1) / length_[axis];
  };
  for (std::uint64_t j = 0; j < chunks(1); ++j) {
    for (std::uint64_t i = 0; i < chunks(2); ++i) {
      decode_chunk({row, j, i}, slices, budget, out);
    }
  }
}

/// Decodes a whole row of chunks to be kept, unless that takes too much.
bool ChunkArray::keep_row(std::uint64_t row, MemoryBudget& budget) const {
  constexpr std::uint64_t kShare = 4;  // of the memory that is allowed
  if (kept_row_ == row) return true;
  drop_row(budget);
  const SliceRange slices = row_slices(row);
  const std::uint64_t voxels = slices.count * slice_voxels();
  if (voxels > budget.limit() / (kShare * sizeof(float)) ||
      voxels > budget.left() / sizeof(float)) {
    return false;
  }
  reserve_within(budget, kept_, voxels, "a row of chunks");
  kept_.resize(voxels);
  decode(row, slices, budget, std::span(kept_));
  kept_row_ = row;
  return true;
}

void ChunkArray::read_row(std::uint64_t row, const SliceRange& wanted, MemoryBudget& budget,
                          std::span<float> out) const {
  const SliceRange slices = row_slices(row);
  if (wanted.count == slices.count || !keep_row(row, budget)) {
    return decode(row, wanted, budget, out);
  }
  const std::uint64_t from = (wanted.first - slices.first) * slice_voxels();
  std::copy_n(kept_.begin() + static_cast<std::ptrdiff_t>(from), out.size(), out.begin());
}

std::vector<float> ChunkArray::read(Index first, Index count) const {
  const std::scoped_lock lock(mutex_);
  return in_one_line(array_.path, [&] {
    const auto last = array_.grid.size[2];
    if (first < 0 || count < 1 || first > last - count) {
      refuse(array_.path, message("expected slices of 0 to ", last - 1, ", found ", count, " from ",
                                  first, " on"));
    }
    MemoryBudget budget(array_.path, array_.limits);
    const SliceRange all{static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(count)};
    std::vector<float> out;
    reserve_within(budget, out, all.count * slice_voxels(), "slices");
    out.resize(all.count * slice_voxels());
    claim_kept(budget);
    for (std::uint64_t k = all.first; k < all.end();) {
      const std::uint64_t row = k / length_[0];
      const SliceRange wanted{k, std::min(row_slices(row).end(), all.end()) - k};
      read_row(
          row, wanted, budget,
          std::span(out).subspan((k - all.first) * slice_voxels(), wanted.count * slice_voxels()));
      k = wanted.end();
    }
    return out;
  });
}

void ChunkArray::visit_samples(const std::function<void(std::span<const double>)>& visit) const {
  constexpr std::uint64_t kShare = 4;  // of the memory that is allowed
  const std::scoped_lock lock(mutex_);
  in_one_line(array_.path, [&] {
    MemoryBudget budget(array_.path, array_.limits);
    claim_kept(budget);
    const std::uint64_t most = budget.left() / (kShare * sizeof(double) * slice_voxels());
    const std::uint64_t rows =
        (static_cast<std::uint64_t>(array_.grid.size[2]) + length_[0] - 1) / length_[0];
    std::vector<double> samples;
    for (std::uint64_t row = 0; row < rows; ++row) {
      const SliceRange all = row_slices(row);
      for (std::uint64_t k = all.first; k < all.end();) {
        const SliceRange slices{k, std::min(std::max<std::uint64_t>(most, 1), all.end() - k)};
        reserve_within(budget, samples, slices.count * slice_voxels(), "slices");
        samples.resize(slices.count * slice_voxels());
        decode(row, slices, budget, std::span(samples));
        visit(samples);
        k = slices.end();
      }
    }
  });
}

}  // namespace

std::array<Index, 3> require_layout(const fs::path& file, ChunkLayout& layout,
                                    const std::vector<std::string>& axes,
                                    const ValueChoice& choice) {
  const std::size_t count = layout.shape.size();
  if (count < 3 || count > kMostAxes) {
    refuse(file, message("expected an array of 3 axes, found ", count));
  }
  require_product(file, layout.shape, "an array");
  require_product(file, layout.chunk, "chunks");
  const LeadAxes lead = lead_axes(file, layout, axes);
  const auto length = [&](const std::optional<std::size_t>& axis) {
    return axis ? static_cast<std::int64_t>(layout.shape[*axis]) : 1;
  };
  const TakenValue taken = take_value(file, {length(lead.volume), length(lead.channel)}, choice);
  layout.lead.assign(count - 3, 0);
  if (lead.volume) layout.lead[*lead.volume] = static_cast<std::uint64_t>(taken.volume);
  if (lead.channel) layout.lead[*lead.channel] = static_cast<std::uint64_t>(taken.channel);
  const auto voxels = [&](std::size_t a) {
    return static_cast<Index>(layout.shape[count - 1 - a]);
  };
  return {voxels(0), voxels(1), voxels(2)};
}

std::string first_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 8;
  std::string list;
  for (std::size_t n = 0; n < std::min(kMost, names.size()); ++n) {
    list += (n > 0 ? ", " : "") + names[n];
  }
  return list + (names.size() > kMost ? ", ..." : "");
}

std::size_t chunk_bytes(const ChunkLayout& layout) {
  std::size_t bytes = byte_size(layout.type);
  for (const std::uint64_t n : layout.chunk) bytes *= n;
  return bytes;
}

void set_spacing(OpenedArray& array, const std::optional<Vec3>& stated,
                 const std::optional<Vec3>& asked) {
  if (asked) require_positive_spacing(array.path, *asked);
  if (!asked && !stated) {
    array.warnings.push_back("the " + array.format + " array gives no spacing: 1 mm assumed");
  } else if (asked && stated && *asked != *stated) {
    array.warnings.push_back(spacing_is_replaced(*stated));
  }
  array.grid.spacing = asked.value_or(stated.value_or(Vec3{1, 1, 1}));
}

std::unique_ptr<ChunkedScan> make_chunked_scan(OpenedArray array) {
  for (int a = 0; a < 3; ++a) {
    const double spacing = array.grid.spacing[a], origin = array.grid.origin[a];
    if (!(spacing > 0) || !std::isfinite(spacing) || !std::isfinite(origin)) {
      refuse(array.path, message("expected a positive spacing and a finite origin, found ", spacing,
                                 " mm at ", origin, " mm"));
    }
  }
  return std::make_unique<ChunkArray>(std::move(array));
}

}  // namespace mesamis::detail::volume_files
