// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/chunk_array.h"

#include <gtest/gtest.h>

#include "support/throws.h"
#include "volume_files/chunk_bytes.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ChunkLayout small_layout() {
  ChunkLayout layout;
  layout.shape = {7, 6, 5};
  layout.chunk = {2, 4, 3};
  layout.order = {0, 1, 2};
  layout.type = NumberType::kInt16;
  return layout;
}

/// An array in memory that counts how often chunks are fetched.
struct Counted {
  std::shared_ptr<int> fetches = std::make_shared<int>(0);
  std::unique_ptr<ChunkedScan> scan;

  explicit Counted(ReadLimits limits = {.memory_gb = 0.1}) {
    OpenedArray array;
    array.path = ".";
    array.format = "test";
    array.layout = small_layout();
    array.grid.size = require_layout(array.path, array.layout);
    array.limits = limits;
    array.fetch = [n = fetches](const std::vector<std::uint64_t>& place, MemoryBudget&) {
      ++*n;
      return std::optional(StoredChunk{
          ".", ArrayBytes{}.chunk_bytes<std::int16_t>({place[0], place[1], place[2]}), {}});
    };
    scan = make_chunked_scan(std::move(array));
  }
};

TEST(ChunkArray, ReadsAnySlicesInAnyOrderAlike) {
  const Counted array;
  for (const Index first : {6, 0, 3, 2, 5, 1, 4}) {
    for (Index count = 7 - first; count >= 1; --count) {
      EXPECT_EQ(array.scan->read(first, count), expected_slices(static_cast<std::uint64_t>(first),
                                                                static_cast<std::uint64_t>(count)))
          << first << " " << count;
    }
  }
}

TEST(ChunkArray, FetchesOnlyTheChunksThatAreTouchedAndEachOnce) {
  const Counted array;
  array.scan->read(2, 2);
  EXPECT_EQ(*array.fetches, 4);  // a row of 2 x 2 chunks
  *array.fetches = 0;
  for (Index k = 0; k < 7; ++k) array.scan->read(k, 1);
  EXPECT_EQ(*array.fetches, 16);  // four rows: each is kept for its second slice
}

TEST(ChunkArray, DecodesAgainWhereARowMustNotBeKept) {
  // A row of chunks is 240 bytes: too much for a quarter of 800.
  const Counted array({.memory_gb = 8e-7});
  for (Index k = 0; k < 4; ++k) {
    EXPECT_EQ(array.scan->read(k, 1), expected_slices(static_cast<std::uint64_t>(k), 1));
  }
  EXPECT_EQ(*array.fetches, 16);
}

TEST(ChunkArray, RefusesSlicesThatThereAreNot) {
  const Counted array;
  EXPECT_REFUSED(array.scan->read(-1, 1), HasSubstr("expected slices of 0 to 6"));
  EXPECT_REFUSED(array.scan->read(0, 0), HasSubstr("found 0 from 0 on"));
  EXPECT_REFUSED(array.scan->read(5, 3), HasSubstr("found 3 from 5 on"));
  EXPECT_REFUSED(array.scan->read(2147483647, 2147483647), HasSubstr("expected slices"));
}

TEST(ChunkArray, AsksForMemoryBeforeItIsTaken) {
  EXPECT_REFUSED(Counted({.memory_gb = 1e-7}).scan->read(0, 7), HasSubstr("for slices"));
}

TEST(ChunkArray, RefusesLayoutsThatAreNoVolume) {
  const auto refused = [](std::vector<std::uint64_t> shape, std::vector<std::uint64_t> chunk,
                          const char* message) {
    ChunkLayout layout;
    layout.shape = std::move(shape);
    layout.chunk = std::move(chunk);
    EXPECT_REFUSED(require_layout("f", layout, {"t", "c"}), HasSubstr(message));
  };
  refused({4, 4}, {4, 4}, "expected an array of 3 axes, found 2");
  refused({2, 1, 4, 4, 4}, {1, 1, 4, 4, 4}, "2 volumes (--volume 0 to 1)");
  refused({1, 3, 4, 4, 4}, {1, 1, 4, 4, 4}, "3 channels (--channel 0 to 2)");
  refused({2, 3, 2, 4, 4, 4}, {1, 1, 1, 4, 4, 4}, "along axis 2 too");
  refused({4, 0, 4}, {4, 4, 4}, "found 0");
  refused({4, 4, 4}, {4, 0, 4}, "expected chunks of 1 to");
  refused({1u << 20, 1u << 20, 1u << 20}, {1, 1, 1}, "at most 2^40 elements");
  refused({4, 4, 4}, {1u << 20, 1u << 20, 1u << 20}, "at most 2^40 elements");
  refused({4, 4, std::uint64_t{1} << 63}, {4, 4, 4}, "found 9223372036854775808");
  ChunkLayout layout = small_layout();
  EXPECT_THAT(require_layout("f", layout), ElementsAre(5, 6, 7));
}

/// Two times of three channels, chunks of two channels: sample = 100 t + 10 c + i.
TEST(ChunkArray, TakesOneVolumeAndChannel) {
  for (Index t = 0; t < 2; ++t) {
    for (Index c = 0; c < 3; ++c) {
      OpenedArray array;
      array.path = ".";
      array.layout.shape = {2, 3, 1, 1, 4};
      array.layout.chunk = {1, 2, 1, 1, 4};
      array.layout.order = {0, 1, 2, 3, 4};
      array.limits = {.memory_gb = 0.1};
      array.grid.size = require_layout(".", array.layout, {"t", "c", "z", "y", "x"}, {t, c});
      array.fetch = [](const std::vector<std::uint64_t>& place, MemoryBudget&) {
        std::string bytes;
        for (std::uint64_t n = 0; n < 8; ++n) {
          bytes += static_cast<char>(100 * place[0] + 10 * (2 * place[1] + n / 4) + n % 4);
        }
        return std::optional(StoredChunk{".", bytes, {}});
      };
      const auto first = static_cast<float>(100 * t + 10 * c);
      EXPECT_THAT(make_chunked_scan(std::move(array))->read(0, 1),
                  ElementsAre(first, first + 1, first + 2, first + 3));
    }
  }
}

TEST(ChunkArray, SetsTheSpacingAndSaysWhereFrom) {
  const auto warnings = [](std::optional<Vec3> stated, std::optional<Vec3> asked) {
    OpenedArray array;
    array.format = "Zarr";
    set_spacing(array, stated, asked);
    EXPECT_EQ(array.grid.spacing, asked.value_or(stated.value_or(Vec3{1, 1, 1})));
    return array.warnings;
  };
  EXPECT_THAT(warnings({}, {}), ElementsAre("the Zarr array gives no spacing: 1 mm assumed"));
  EXPECT_THAT(warnings({}, Vec3{1, 2, 3}), IsEmpty());
  EXPECT_THAT(warnings(Vec3{1, 2, 3}, Vec3{1, 2, 3}), IsEmpty());
  EXPECT_THAT(warnings(Vec3{1, 2, 3}, Vec3{1, 2, 4}), ElementsAre(HasSubstr("is replaced")));
  EXPECT_REFUSED(warnings({}, Vec3{1, 0, 1}), HasSubstr("expected a positive spacing, found 0"));
}

TEST(ChunkArray, VisitsAllSamplesInTheirOrder) {
  for (const double memory_gb : {0.1, 8e-7}) {
    const Counted array({.memory_gb = memory_gb});
    std::vector<double> all;
    array.scan->visit_samples([&](std::span<const double> samples) {
      all.insert(all.end(), samples.begin(), samples.end());
    });
    const std::vector<float> slices = expected_slices(0, 7);
    EXPECT_EQ(all, std::vector<double>(slices.begin(), slices.end())) << memory_gb;
  }
}

TEST(ChunkArray, VisitsWholeNumbersThatSinglePrecisionRounds) {
  OpenedArray array;
  array.path = ".";
  array.layout.shape = array.layout.chunk = {1, 1, 2};
  array.layout.order = {0, 1, 2};
  array.layout.type = NumberType::kUint64;
  array.grid.size = require_layout(array.path, array.layout);
  array.limits = {.memory_gb = 0.1};
  const std::vector<std::uint64_t> values{16777217, 9007199254740991};
  array.fetch = [&](const std::vector<std::uint64_t>&, MemoryBudget&) {
    return std::optional(StoredChunk{".", bytes_of_all(values), {}});
  };
  const auto scan = make_chunked_scan(std::move(array));
  scan->visit_samples([](std::span<const double> samples) {
    EXPECT_THAT(samples, ElementsAre(16777217, 9007199254740991));
  });
  EXPECT_FALSE(scan->holds_labels());
  EXPECT_THAT(scan->named_numbers(), IsEmpty());
}

}  // namespace
}  // namespace mesamis
