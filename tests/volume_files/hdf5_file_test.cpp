// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <hdf5.h>

#include "mesamis/volume_files/chunked_scan.h"
#include "support/throws.h"
#include "volume_files/chunk_bytes.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Makes a file with the C library.
class FileBytes {
 public:
  explicit FileBytes(const fs::path& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
  ~FileBytes() { H5Fclose(file_); }
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  /// A dataset of the small array; `set` chooses how it is laid out.
  hid_t add(const char* name, hid_t type, const std::function<void(hid_t)>& set = {},
            const std::vector<hsize_t>& shape = {7, 6, 5}, bool filled = true) const {
    const hid_t links = H5Pcreate(H5P_LINK_CREATE), how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    if (set) set(how);
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t dataset = H5Dcreate2(file_, name, type, space, links, how, H5P_DEFAULT);
    const std::vector<float> samples = expected_slices(0, 7);
    if (filled) H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, samples.data());
    H5Sclose(space), H5Pclose(how), H5Pclose(links), H5Dclose(dataset);
    return file_;
  }
  void add_spacing(const char* name, const std::vector<float>& um) const {
    const hsize_t count = um.size();
    const hid_t dataset = H5Dopen2(file_, name, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t attribute =
        H5Acreate2(dataset, "element_size_um", H5T_IEEE_F32LE, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_FLOAT, um.data());
    H5Aclose(attribute), H5Sclose(space), H5Dclose(dataset);
  }
  hid_t id() const { return file_; }

 private:
  hid_t file_;
};

void in_chunks(hid_t how) {
  const hsize_t chunk[]{2, 4, 3};
  H5Pset_chunk(how, 3, chunk);
}

void expect_whole(const fs::path& path, const ChunkOptions& options = {}) {
  const auto scan = open_hdf5(path, options);
  EXPECT_EQ(scan->grid().size, (std::array<Index, 3>{5, 6, 7}));
  EXPECT_EQ(scan->read(3, 1), expected_slices(3, 1));
  EXPECT_EQ(scan->read(0, 7), expected_slices(0, 7));
  EXPECT_EQ(scan->read(1, 4), expected_slices(1, 4));
}

TEST(Hdf5File, ReadsNumbersOfEitherByteOrder) {
  const TempFolder folder;
  for (const hid_t type : {H5T_STD_I16LE, H5T_STD_I16BE, H5T_STD_I32LE, H5T_STD_I64BE,
                           H5T_IEEE_F32LE, H5T_IEEE_F32BE, H5T_IEEE_F64LE, H5T_IEEE_F64BE}) {
    FileBytes(folder / "a.h5").add("data", type);
    expect_whole(folder / "a.h5");
    FileBytes(folder / "a.h5").add("data", type, in_chunks);
    expect_whole(folder / "a.h5");
  }
}

/// h5py stores booleans so.
TEST(Hdf5File, ReadsNamedNumbers) {
  const TempFolder folder;
  const hid_t type = H5Tenum_create(H5T_STD_I16BE);
  std::int16_t value = 0;
  H5Tenum_insert(type, "FALSE", &value);
  FileBytes(folder / "numbers.h5").add("data", H5T_STD_I16BE, in_chunks);
  std::vector<std::int16_t> stored(7 * 6 * 5);
  {
    const FileBytes numbers(folder / "names.h5");
    numbers.add("data", type, in_chunks, {7, 6, 5}, false);
    const hid_t from = H5Fopen((folder / "numbers.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                source = H5Dopen2(from, "data", H5P_DEFAULT),
                target = H5Dopen2(numbers.id(), "data", H5P_DEFAULT);
    H5Dread(source, H5T_STD_I16BE, H5S_ALL, H5S_ALL, H5P_DEFAULT, stored.data());
    H5Dwrite(target, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, stored.data());
    H5Dclose(source), H5Dclose(target), H5Fclose(from);
  }
  H5Tclose(type);
  expect_whole(folder / "names.h5");
}

TEST(Hdf5File, ReadsEachFilterOfTheLibrary) {
  const TempFolder folder;
  const std::function<void(hid_t)> filters[]{
      [](hid_t how) { H5Pset_deflate(how, 4); }, [](hid_t how) { H5Pset_shuffle(how); },
      [](hid_t how) { H5Pset_fletcher32(how); },
      [](hid_t how) { H5Pset_shuffle(how), H5Pset_deflate(how, 4), H5Pset_fletcher32(how); }};
  for (const auto& filter : filters) {
    FileBytes(folder / "a.h5").add("data", H5T_STD_I16LE, [&](hid_t how) {
      in_chunks(how);
      filter(how);
    });
    expect_whole(folder / "a.h5");
  }
}

/// Writes chunks that were packed by others, as plugins would.
void write_packed(const fs::path& path, H5Z_filter_t id,
                  const std::function<std::string(const std::string&)>& pack) {
  const FileBytes file(path);
  file.add(
      "data", H5T_STD_I16LE,
      [&](hid_t how) {
        in_chunks(how);
        H5Pset_filter(how, id, H5Z_FLAG_OPTIONAL, 0, nullptr);
      },
      {7, 6, 5}, false);
  const hid_t dataset = H5Dopen2(file.id(), "data", H5P_DEFAULT);
  for (std::uint64_t k = 0; k < 4; ++k) {
    for (std::uint64_t j = 0; j < 2; ++j) {
      for (std::uint64_t i = 0; i < 2; ++i) {
        const std::string bytes = pack(ArrayBytes{}.chunk_bytes<std::int16_t>({k, j, i}));
        const hsize_t offset[]{2 * k, 4 * j, 3 * i};
        H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, offset, bytes.size(), bytes.data());
      }
    }
  }
  H5Dclose(dataset);
}

TEST(Hdf5File, ReadsBloscAndZstandardWithoutPlugins) {
  const TempFolder folder;
  write_packed(folder / "a.h5", 32001, [](const std::string& s) { return with_blosc(s); });
  expect_whole(folder / "a.h5");
  write_packed(folder / "a.h5", 32015, with_zstd);
  expect_whole(folder / "a.h5");
}

TEST(Hdf5File, RefusesFiltersThatItDoesNotKnow) {
  const TempFolder folder;
  write_packed(folder / "a.h5", 32000, with_zstd);
  EXPECT_REFUSED(open_hdf5(folder / "a.h5"), HasSubstr("(32000)"));
}

TEST(Hdf5File, RefusesDamagedChunks) {
  const TempFolder folder;
  write_packed(folder / "a.h5", H5Z_FILTER_DEFLATE,
               [](const std::string& s) { return packed(s, 15).substr(0, 20); });
  EXPECT_REFUSED(open_hdf5(folder / "a.h5")->read(0, 1), HasSubstr("expected a chunk"));
  write_packed(folder / "a.h5", H5Z_FILTER_DEFLATE,
               [](const std::string&) { return packed(std::string(1 << 20, 'x'), 15); });
  EXPECT_REFUSED(open_hdf5(folder / "a.h5")->read(0, 1),
                 HasSubstr("expected a chunk of 48 bytes, found more"));
  write_packed(folder / "a.h5", H5Z_FILTER_FLETCHER32,
               [](const std::string& s) { return s + bytes_of(std::uint32_t{12345}); });
  EXPECT_REFUSED(open_hdf5(folder / "a.h5")->read(0, 1), HasSubstr("checksum"));
}

TEST(Hdf5File, TakesTheSpacingOfItsAttribute) {
  const TempFolder folder;
  {
    const FileBytes file(folder / "a.h5");
    file.add("raw", H5T_STD_I16LE);
    file.add_spacing("raw", {4, 2, 1});
  }
  const auto scan = open_hdf5(folder / "a.h5");
  EXPECT_EQ(scan->format(), "HDF5");
  EXPECT_EQ(scan->grid().spacing, (Vec3{1e-3, 2e-3, 4e-3}));
  EXPECT_THAT(scan->warnings(), IsEmpty());
  EXPECT_EQ(open_hdf5(folder / "a.h5", {.spacing = Vec3{1, 1, 1}})->grid().spacing,
            (Vec3{1, 1, 1}));
  {
    const FileBytes file(folder / "b.h5");
    file.add("raw", H5T_STD_I16LE);
    file.add_spacing("raw", {4, 2});
  }
  EXPECT_REFUSED(open_hdf5(folder / "b.h5"), HasSubstr("three numbers as element_size_um"));
}

TEST(Hdf5File, FindsTheOnlyVolumeOrTheOneThatIsNamed) {
  const TempFolder folder;
  {
    const FileBytes file(folder / "a.h5");
    file.add("entry/data", H5T_STD_I16LE);
    file.add("line", H5T_STD_I16LE, {}, {210});
  }
  expect_whole(folder / "a.h5");
  EXPECT_THAT(open_hdf5(folder / "a.h5")->warnings(), ElementsAre(HasSubstr(": 1 mm assumed")));
  expect_whole(folder / "a.h5/entry/data");
  expect_whole(folder / "a.h5", {.dataset = "/entry/data"});
  EXPECT_REFUSED(open_hdf5(folder / "a.h5/nothing"), HasSubstr("dataset \"nothing\": expected"));
  EXPECT_REFUSED(open_hdf5(folder / "a.h5/line"), HasSubstr("an array of 3 axes, found 1"));
  {
    const FileBytes file(folder / "b.h5");
    file.add("a", H5T_STD_I16LE);
    file.add("b", H5T_STD_I16LE, {}, {1, 1, 7, 6, 5});
  }
  EXPECT_REFUSED(open_hdf5(folder / "b.h5"), HasSubstr("found 2: a, b"));
  expect_whole(folder / "b.h5/b");
}

/// Its values are scaled slice by slice, and its axes placed by attributes of its own.
TEST(Hdf5File, RefusesMinc) {
  const TempFolder folder;
  FileBytes(folder / "a.mnc").add("minc-2.0/image/0/image", H5T_STD_I16LE);
  EXPECT_REFUSED(open_hdf5(folder / "a.mnc"), HasSubstr("found a MINC file"));
}

TEST(Hdf5File, FillsWhatWasNeverWritten) {
  const TempFolder folder;
  for (const bool chunked : {false, true}) {
    FileBytes(folder / "a.h5")
        .add(
            "data", H5T_STD_I16LE,
            [&](hid_t how) {
              if (chunked) in_chunks(how);
              const int fill = 7;
              H5Pset_fill_value(how, H5T_NATIVE_INT, &fill);
            },
            {7, 6, 5}, false);
    EXPECT_EQ(open_hdf5(folder / "a.h5")->read(2, 1), std::vector<float>(30, 7));
  }
}

TEST(Hdf5File, RefusesSamplesInOtherFiles) {
  const TempFolder folder;
  FileBytes(folder / "target.h5").add("data", H5T_STD_I16LE);
  {
    const FileBytes file(folder / "link.h5");
    H5Lcreate_external((folder / "target.h5").c_str(), "data", file.id(), "data", H5P_DEFAULT,
                       H5P_DEFAULT);
  }
  EXPECT_REFUSED(open_hdf5(folder / "link.h5/data"), HasSubstr("in the file itself"));
  write_bytes(folder / "secret", std::string(420, 'x'));
  FileBytes(folder / "external.h5")
      .add(
          "data", H5T_STD_I16LE,
          [&](hid_t how) { H5Pset_external(how, (folder / "secret").c_str(), 0, 420); }, {7, 6, 5},
          false);
  EXPECT_REFUSED(open_hdf5(folder / "external.h5"), HasSubstr("found external storage"));
}

TEST(Hdf5File, RefusesTypesThatAreNoNumbers) {
  const TempFolder folder;
  FileBytes(folder / "a.h5").add("data", H5T_STD_B8LE, {}, {7, 6, 5}, false);
  EXPECT_REFUSED(open_hdf5(folder / "a.h5/data"), HasSubstr("found another type"));
}

TEST(Hdf5File, SurvivesFilesThatAreCutOff) {
  const TempFolder folder;
  FileBytes(folder / "a.h5").add("data", H5T_STD_I16LE, in_chunks);
  const std::string whole = read_bytes(folder / "a.h5");
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    write_bytes(folder / "b.h5", whole.substr(0, size));
    EXPECT_REFUSED(open_hdf5(folder / "b.h5")->read(0, 7), HasSubstr("b.h5: "));
  }
}

TEST(Hdf5File, IsKnownByItsSignature) {
  const TempFolder folder;
  FileBytes(folder / "a.h5").add("data", H5T_STD_I16LE);
  write_bytes(folder / "b.h5", std::string(512, '\0') + read_bytes(folder / "a.h5"));
  write_bytes(folder / "c.h5", "no such file");
  EXPECT_TRUE(is_hdf5(folder / "a.h5"));
  EXPECT_TRUE(is_hdf5(folder / "a.h5/data"));
  EXPECT_TRUE(is_hdf5(folder / "b.h5"));
  EXPECT_FALSE(is_hdf5(folder / "c.h5"));
  EXPECT_FALSE(is_hdf5(folder / "nothing.h5"));
  EXPECT_FALSE(is_hdf5(folder.path()));
  EXPECT_REFUSED(open_hdf5(folder / "c.h5"), HasSubstr("expected an HDF5 file"));
}

TEST(Hdf5File, AsksForMemoryBeforeItIsTaken) {
  const TempFolder folder;
  FileBytes(folder / "a.h5").add("data", H5T_STD_I16LE, {}, {1000, 1000, 1000}, false);
  EXPECT_REFUSED(open_hdf5(folder / "a.h5", {.limits = {.memory_gb = 0.001}})->read(0, 1),
                 HasSubstr("memory"));
}

}  // namespace
}  // namespace mesamis
