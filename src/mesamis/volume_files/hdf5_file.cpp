// SPDX-License-Identifier: Apache-2.0
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <mutex>
#include <numeric>
#include <system_error>
#include <utility>

#include "mesamis/files/file_list.h"
#include "mesamis/files/in_one_line.h"
#include "mesamis/files/read_record.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/chunk_array.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

/// One thread at a time calls the library, which does not print meanwhile.
class LibraryCall {
 public:
  LibraryCall() : lock_(mutex()) {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~LibraryCall() {
    H5Eclear2(H5E_DEFAULT);
    H5Eset_auto2(H5E_DEFAULT, print_, data_);
  }
  LibraryCall(const LibraryCall&) = delete;
  LibraryCall& operator=(const LibraryCall&) = delete;

 private:
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex only;
    return only;
  }
  std::scoped_lock<std::recursive_mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// An identifier of the library.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ < 0) return;
    const LibraryCall call;
    close_(id_);
  }
  // NOLINTNEXTLINE(google-explicit-constructor): it stands for the number in each call
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  herr_t (*close_)(hid_t) = nullptr;
};

/// A file, and the way into it that a path goes on with.
struct Place {
  fs::path file;
  std::string dataset;
};

Place place_of(const fs::path& path) {
  std::error_code ignored;
  Place place{path, {}};
  while (!fs::exists(place.file, ignored) && place.file.has_relative_path()) {
    const std::string name = place.file.filename().string();
    place.dataset = place.dataset.empty() ? name : name + "/" + place.dataset;
    place.file = place.file.parent_path();
  }
  return place;
}

/// The signature lies at 0, 512, 1024, 2048, ...
bool has_signature(const fs::path& file) {
  constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
  constexpr std::streamoff kFirst = 512, kLast = 1 << 24;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  std::ifstream in(file, std::ios::binary);
  for (std::streamoff at = 0; in && at <= kLast; at = at == 0 ? kFirst : 2 * at) {
    std::array<char, kSignature.size()> bytes{};
    in.seekg(at);
    if (in.read(bytes.data(), bytes.size()) &&
        std::string_view(bytes.data(), bytes.size()) == kSignature) {
      return true;
    }
  }
  return false;
}

Handle open_file(const fs::path& path) {
  const FileState before = state_of(path);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access, false, true);
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!file.valid()) refuse(path, "expected an HDF5 file, found one that is broken or too new");
  note_read(path, before);
  return file;
}

// NOLINTNEXTLINE(readability-function-size): the library calls it with these
herr_t refuse_link(const char*, const char*, const char*, const char*, unsigned*, hid_t, void*) {
  return -1;
}

/// Links do not lead into other files.
Handle open_dataset(hid_t file, const std::string& name) {
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_elink_cb(access, refuse_link, nullptr);
  return {H5Dopen2(file, name.c_str(), access), H5Dclose};
}

std::vector<std::uint64_t> shape_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  if (H5Sget_simple_extent_type(space) != H5S_SIMPLE) return {};
  std::array<hsize_t, H5S_MAX_RANK> lengths{};
  const int rank = H5Sget_simple_extent_dims(space, lengths.data(), nullptr);
  return {lengths.begin(), lengths.begin() + std::max(rank, 0)};
}

/// Of the samples; booleans are stored as a list of named whole numbers.
Handle number_type(hid_t dataset) {
  Handle type(H5Dget_type(dataset), H5Tclose);
  if (H5Tget_class(type) != H5T_ENUM) return type;
  return Handle(H5Tget_super(type), H5Tclose);
}

bool is_numeric(hid_t dataset) {
  const Handle type = number_type(dataset);
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

struct Names {
  std::vector<std::string> found;
  bool too_many = false;
};

herr_t collect(hid_t, const char* name, const H5O_info_t* info, void* data) noexcept {
  constexpr std::size_t kMost = 10'000;
  auto& names = *static_cast<Names*>(data);
  if (info->type == H5O_TYPE_DATASET) names.found.emplace_back(name);
  names.too_many = names.found.size() > kMost;
  return names.too_many ? -1 : 0;
}

std::string find_dataset(const fs::path& path, hid_t file) {
  Names names;
  const herr_t status =
      H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, collect, &names, H5O_INFO_BASIC);
  if (names.too_many) refuse(path, "expected at most 10000 datasets, found more");
  if (status < 0) refuse(path, "expected an HDF5 file, found one that is broken");
  std::vector<std::string> volumes;
  for (const std::string& name : names.found) {
    const Handle dataset = open_dataset(file, name);
    if (dataset.valid() && is_numeric(dataset) && shape_of(dataset).size() >= 3) {
      volumes.push_back(name);
    }
  }
  if (volumes.size() == 1) return volumes.front();
  if (volumes.empty()) refuse(path, "expected a dataset of 3 axes, found none");
  refuse(path, message("expected one dataset of 3 axes, or a path to one inside, found ",
                       volumes.size(), ": ", first_of(volumes)));
}

/// Opens a dataset for what follows, with the way to refuse it.
struct Dataset {
  fs::path path;
  std::string name;
  Handle file, id, properties;

  [[noreturn]] void refuse_it(const std::string& what) const {
    refuse(path, "dataset " + in_quotes(name) + ": " + what);
  }
};

NumberType whole_type(std::size_t size, bool with_sign) {
  switch (size) {
    case 1:
      return with_sign ? NumberType::kInt8 : NumberType::kUint8;
    case 2:
      return with_sign ? NumberType::kInt16 : NumberType::kUint16;
    case 4:
      return with_sign ? NumberType::kInt32 : NumberType::kUint32;
    default:
      return with_sign ? NumberType::kInt64 : NumberType::kUint64;
  }
}

void set_type(const Dataset& dataset, ChunkLayout& layout) {
  const Handle type = number_type(dataset.id);
  const std::size_t size = H5Tget_size(type);
  const auto is = [&](hid_t other) { return H5Tequal(type, other) > 0; };
  layout.byte_order = H5Tget_order(type) == H5T_ORDER_BE ? ByteOrder::kBig : ByteOrder::kLittle;
  const bool whole = H5Tget_class(type) == H5T_INTEGER && size <= 8 && (size & (size - 1)) == 0 &&
                     H5Tget_precision(type) == 8 * size;
  if (whole) {
    layout.type = whole_type(size, H5Tget_sign(type) == H5T_SGN_2);
  } else if (is(H5T_IEEE_F32LE) || is(H5T_IEEE_F32BE)) {
    layout.type = NumberType::kFloat32;
  } else if (is(H5T_IEEE_F64LE) || is(H5T_IEEE_F64BE)) {
    layout.type = NumberType::kFloat64;
  } else {
    dataset.refuse_it(
        "expected whole numbers of 8 to 64 bits or floating point of 32 or 64, found another type");
  }
}

ChunkCodec codec_of(const Dataset& dataset, unsigned n) {
  constexpr H5Z_filter_t kBlosc = 32001, kZstd = 32015;  // as registered with The HDF Group
  constexpr std::size_t kMostName = 64;
  std::array<unsigned, 16> values{};
  std::size_t count = values.size();
  unsigned flags = 0, config = 0;
  std::array<char, kMostName> name{};
  const H5Z_filter_t id = H5Pget_filter2(dataset.properties, n, &flags, &count, values.data(),
                                         name.size() - 1, name.data(), &config);
  switch (id) {
    case H5Z_FILTER_DEFLATE:
      return {ChunkCodec::Kind::kDeflate};
    case H5Z_FILTER_SHUFFLE:
      return {ChunkCodec::Kind::kShuffle, count > 0 ? values[0] : 1};
    case H5Z_FILTER_FLETCHER32:
      return {ChunkCodec::Kind::kFletcher32};
    case kBlosc:
      return {ChunkCodec::Kind::kBlosc};
    case kZstd:
      return {ChunkCodec::Kind::kZstd};
    default:
      dataset.refuse_it(
          message("expected the filters deflate, shuffle, fletcher32, blosc or zstd, found ",
                  in_quotes(name.data()), " (", id, ")"));
  }
}

void set_fill(const Dataset& dataset, ChunkLayout& layout) {
  H5D_fill_value_t defined = H5D_FILL_VALUE_UNDEFINED;
  if (H5Pfill_value_defined(dataset.properties, &defined) < 0 ||
      defined == H5D_FILL_VALUE_UNDEFINED) {
    return;
  }
  double value = 0;
  if (H5Pget_fill_value(dataset.properties, H5T_NATIVE_DOUBLE, &value) >= 0) layout.fill = value;
}

/// A dataset in one piece is read slice by slice.
void set_chunks(const Dataset& dataset, ChunkLayout& layout) {
  const std::size_t rank = layout.shape.size();
  if (H5Pget_external_count(dataset.properties) != 0) {
    dataset.refuse_it("expected samples in the file itself, found external storage");
  }
  const H5D_layout_t kind = H5Pget_layout(dataset.properties);
  if (kind == H5D_CHUNKED) {
    std::vector<hsize_t> chunk(rank);
    if (H5Pget_chunk(dataset.properties, static_cast<int>(rank), chunk.data()) !=
        static_cast<int>(rank)) {
      dataset.refuse_it("expected chunks of as many axes, found another number");
    }
    layout.chunk.assign(chunk.begin(), chunk.end());
    const int filters = H5Pget_nfilters(dataset.properties);
    for (int n = 0; n < filters; ++n) {
      layout.codecs.push_back(codec_of(dataset, static_cast<unsigned>(n)));
    }
  } else if (kind == H5D_CONTIGUOUS || kind == H5D_COMPACT) {
    layout.chunk = layout.shape;
    std::fill(layout.chunk.begin(), layout.chunk.end() - 2, 1);
  } else {
    dataset.refuse_it("expected samples in the file itself, found a virtual dataset");
  }
}

ChunkLayout layout_of(const Dataset& dataset) {
  ChunkLayout layout;
  layout.shape = shape_of(dataset.id);
  if (layout.shape.size() < 3) {
    dataset.refuse_it(message("expected an array of 3 axes, found ", layout.shape.size()));
  }
  layout.order.resize(layout.shape.size());
  std::iota(layout.order.begin(), layout.order.end(), std::size_t{0});
  set_type(dataset, layout);
  set_chunks(dataset, layout);
  set_fill(dataset, layout);
  return layout;
}

/// The attribute that ilastik and others write: micrometres, slowest axis first.
std::optional<Vec3> spacing_of(const Dataset& dataset) {
  constexpr const char* kName = "element_size_um";
  constexpr double kMmPerUm = 1e-3;
  if (H5Aexists(dataset.id, kName) <= 0) return {};
  const Handle attribute(H5Aopen(dataset.id, kName, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type);
  std::array<double, 3> um{};
  if (H5Sget_simple_extent_npoints(space) != 3 || (kind != H5T_FLOAT && kind != H5T_INTEGER) ||
      H5Aread(attribute, H5T_NATIVE_DOUBLE, um.data()) < 0) {
    dataset.refuse_it("expected three numbers as element_size_um, found something else");
  }
  return Vec3{kMmPerUm * um[2], kMmPerUm * um[1], kMmPerUm * um[0]};
}

std::vector<hsize_t> first_element(const ChunkLayout& layout,
                                   const std::vector<std::uint64_t>& place) {
  std::vector<hsize_t> first;
  for (std::size_t a = 0; a < place.size(); ++a) first.push_back(place[a] * layout.chunk[a]);
  return first;
}

std::optional<StoredChunk> read_slice(const Dataset& dataset, const ChunkLayout& layout,
                                      const std::vector<std::uint64_t>& place,
                                      MemoryBudget& budget) {
  const std::vector<hsize_t> first = first_element(layout, place);
  const std::vector<hsize_t> count(layout.chunk.begin(), layout.chunk.end());
  const std::size_t size = chunk_bytes(layout);
  budget.claim(size, 1, "a slice");
  StoredChunk chunk{dataset.path, std::string(size, '\0'), {}};
  const Handle type(H5Dget_type(dataset.id), H5Tclose);
  const Handle space(H5Dget_space(dataset.id), H5Sclose);
  const Handle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                      H5Sclose);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr);
  if (H5Dread(dataset.id, type, memory, space, H5P_DEFAULT, chunk.bytes.data()) < 0) {
    dataset.refuse_it(message("expected ", size, " bytes of slice ", first[first.size() - 3],
                              ", found a file that is broken or cut off"));
  }
  return chunk;
}

/// The steps that were taken for one chunk: some may be left out.
std::vector<ChunkCodec> codecs_of(const ChunkLayout& layout, std::uint32_t left_out) {
  std::vector<ChunkCodec> codecs;
  for (std::size_t n = 0; n < layout.codecs.size(); ++n) {
    if ((left_out >> n & 1u) == 0) codecs.push_back(layout.codecs[n]);
  }
  return codecs;
}

std::optional<StoredChunk> read_chunk(const Dataset& dataset, const ChunkLayout& layout,
                                      const std::vector<std::uint64_t>& place,
                                      MemoryBudget& budget) {
  const std::vector<hsize_t> first = first_element(layout, place);
  unsigned left_out = 0;
  haddr_t address = HADDR_UNDEF;
  hsize_t size = 0;
  const auto refuse_chunk = [&] {
    dataset.refuse_it(message("expected a chunk at slice ", first[first.size() - 3],
                              ", found a file that is broken or cut off"));
  };
  if (H5Dget_chunk_info_by_coord(dataset.id, first.data(), &left_out, &address, &size) < 0) {
    refuse_chunk();
  }
  if (address == HADDR_UNDEF) return {};
  if (size > size_of(dataset.path)) refuse_chunk();
  budget.claim(size, 1, "a chunk as stored");
  StoredChunk chunk{dataset.path, std::string(size, '\0'), {}};
  std::uint32_t mask = 0;
  if (H5Dread_chunk(dataset.id, H5P_DEFAULT, first.data(), &mask, chunk.bytes.data()) < 0) {
    refuse_chunk();
  }
  chunk.codecs = codecs_of(layout, mask);
  return chunk;
}

OpenedArray opened(Dataset dataset, const ChunkOptions& options) {
  OpenedArray out;
  out.path = dataset.path;
  out.format = "HDF5";
  out.layout = layout_of(dataset);
  out.grid.size = require_layout(dataset.path, out.layout, {}, {options.volume, options.channel});
  for (const char* name : {"scale_factor", "add_offset"}) {
    if (H5Aexists(dataset.id, name) <= 0) continue;
    out.warnings.push_back(
        message("the attribute ", name, " is not applied: values are kept as stored"));
  }
  require_chain(dataset.path, out.layout.codecs);
  set_spacing(out, spacing_of(dataset), options.spacing);
  out.limits = options.limits;
  const auto read = H5Pget_layout(dataset.properties) == H5D_CHUNKED ? read_chunk : read_slice;
  out.fetch = [read, layout = out.layout, held = std::make_shared<Dataset>(std::move(dataset))](
                  const std::vector<std::uint64_t>& place, MemoryBudget& budget) {
    const LibraryCall call;
    return read(*held, layout, place, budget);
  };
  return out;
}

Dataset open_place(const Place& place, const std::string& asked) {
  Dataset dataset;
  dataset.path = place.file;
  if (!has_signature(place.file)) refuse(place.file, "expected an HDF5 file, found another one");
  dataset.file = open_file(place.file);
  if (H5Lexists(dataset.file, "minc-2.0", H5P_DEFAULT) > 0) {
    refuse(place.file,
           "expected an array with its values, found a MINC file, which scales and places them by "
           "rules of its own: convert it to NIfTI (mnc2nii)");
  }
  dataset.name = asked.empty() ? place.dataset : place.dataset + "/" + asked;
  if (dataset.name.empty()) dataset.name = find_dataset(place.file, dataset.file);
  dataset.id = open_dataset(dataset.file, dataset.name);
  if (!dataset.id.valid()) {
    dataset.refuse_it("expected a dataset of this name in the file itself, found none");
  }
  dataset.properties = Handle(H5Dget_create_plist(dataset.id), H5Pclose);
  return dataset;
}

}  // namespace

bool is_hdf5(const fs::path& path) noexcept {
  try {
    return has_signature(place_of(path).file);
  } catch (const std::exception&) {
    return false;
  }
}

std::unique_ptr<ChunkedScan> open_hdf5(const fs::path& path, const ChunkOptions& options) {
  const Place place = place_of(path);
  return in_one_line(place.file, [&] {
    const LibraryCall call;
    return make_chunked_scan(opened(open_place(place, options.dataset), options));
  });
}

}  // namespace mesamis::detail::volume_files
