// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "fuzz_seeds.h"
#include "mesamis/scan_files/write_volume.h"
#include "support/picture_bytes.h"
#include "support/scan_bytes.h"

namespace mesamis {
namespace {

const std::string kSamples = bytes_of_all(ramp<std::int16_t>(60));
const std::string kSwapped = bytes_of_all(ramp<std::int16_t>(60), true);

std::string decimals() {
  std::string text;
  for (int n = -40; n < 20; ++n) text += std::to_string(n) + (n % 4 == 3 ? "\n" : " ");
  return text;
}

Volume small_volume() {
  Volume volume;
  volume.size = {4, 3, 5};
  volume.spacing = {0.5, 1.25, 2};
  volume.origin = {1, 2, 3};
  const double c = std::cos(0.4), s = std::sin(0.4);
  volume.direction.rows = {Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}};
  for (int n = 0; n < 60; ++n) volume.samples.push_back(static_cast<float>(n) - 40.5f);
  return volume;
}

/// NIfTI-2: the fields of the first version in other places and widths.
std::string nifti2_header() {
  std::string h(544, '\0');
  const auto put = [&h](std::size_t at, auto value) {
    h.replace(at, sizeof(value), bytes_of(value));
  };
  put(0, std::int32_t{540});
  h.replace(4, 8, std::string("n+2\0\r\n\032\n", 8));
  put(12, std::int16_t{4}), put(14, std::int16_t{16});
  const std::int64_t size[]{3, 4, 3, 5, 1, 1, 1, 1};
  const double step[]{1, 0.5, 1.25, 2, 1, 1, 1, 1};
  for (std::size_t n = 0; n < 8; ++n) put(16 + 8 * n, size[n]), put(104 + 8 * n, step[n]);
  put(168, std::int64_t{544}), put(176, 1.0);
  put(344, std::int32_t{1});  // qform
  put(500, std::int32_t{2});  // mm
  return h;
}

void write_nifti(const SeedFolder& seeds) {
  NiftiBytes header;
  seeds.add("nifti", "sform", header.header() + kSamples);
  seeds.add("nifti", "gzip", packed(header.header() + kSamples));
  seeds.add("nifti", "nifti2", nifti2_header() + kSamples);
  header.sform_code = 0, header.qform_code = 1;
  header.quatern = {0.1f, 0.2f, 0.3f, 1, 2, 3};
  header.slope = 2, header.intercept = -1;
  seeds.add("nifti", "qform", header.header() + kSamples);
  header.qform_code = 0, header.big_endian = true;
  seeds.add("nifti", "bigendian", header.header() + kSwapped);
  header = {};
  header.datatype = 16, header.bitpix = 32;
  seeds.add("nifti", "float", header.header() + bytes_of_all(ramp<float>(60)));
}

void write_nrrd_and_meta(const SeedFolder& seeds) {
  write_nrrd(seeds.file("nrrd", "float.nrrd"), small_volume());
  write_nrrd(seeds.file("nrrd", "short_gzip.nrrd"), small_volume(),
             {.type = SampleType::kShort, .gzip = true});
  seeds.add("nrrd", "raw", nrrd_bytes("endian: little\nencoding: raw\n", kSamples));
  seeds.add("nrrd", "bigendian", nrrd_bytes("endian: big\nencoding: raw\n", kSwapped));
  seeds.add("nrrd", "ascii", nrrd_bytes("encoding: ascii\n", decimals()));
  seeds.add("nrrd", "gzip", nrrd_bytes("endian: little\nencoding: gz\n", packed(kSamples)));
  const std::string little = "endian: little\n";
  seeds.add("nrrd", "detached", nrrd_bytes(little + "encoding: raw\ndata file: data.raw\n", ""));
  seeds.add("nrrd", "detached_gzip",
            nrrd_bytes(little + "encoding: gzip\nbyte skip: 0\ndata file: data.raw.gz\n", ""));
  seeds.add("nrrd", "spacings",
            "NRRD0001\ntype: int16\ndimension: 3\nsizes: 4 3 5\nspacings: 0.5 1.25 2\n"
            "endian: little\nencoding: raw\nline skip: 0\nbyte skip: -1\n\n" +
                kSamples);
  seeds.add("meta", "raw", meta_bytes("") + kSamples);
  seeds.add("meta", "bigendian", meta_bytes("BinaryDataByteOrderMSB = True\n") + kSwapped);
  seeds.add("meta", "zlib", meta_bytes("CompressedData = True\n") + packed(kSamples, 15));
  seeds.add("meta", "ascii", meta_bytes("BinaryData = False\n") + decimals());
  seeds.add("meta", "turned", meta_bytes("TransformMatrix = 0 1 0 1 0 0 0 0 1\n") + kSamples);
  seeds.add("meta", "detached", meta_bytes("HeaderSize = -1\n", "data.raw"));
}

void write_pictures(const SeedFolder& seeds) {
  const std::string page = kSamples.substr(0, 24);
  std::vector<TiffPage> pages(
      3, {.description = "ImageJ=1.53\nunit=mm\nspacing=2.0\n", .pixels = page});
  seeds.add("tiff", "imagej", tiff_bytes(pages));
  pages[0].description.clear();
  seeds.add("tiff", "plain", tiff_bytes({pages[0]}));
  seeds.add("tiff", "bytes", tiff_bytes({{.bits = 8, .format = 1, .pixels = "abcdefghijkl"}}));
  seeds.add("bmp", "grey",
            BmpBytes{.palette = grey_palette(), .pixels = std::string("abc\0def\0", 8)}.bytes());
  seeds.add("bmp", "colours",
            BmpBytes{.height = -2,
                     .bits = 24,
                     .pixels_per_metre = 2000,
                     .pixels = std::string("aaabbbccc\0\0\0dddeeefff\0\0\0", 24)}
                .bytes());
  seeds.add("png", "grey", png_bytes(4, 3, "abcdefghijkl"));
  const std::string line(8, 'a');
  PngBytes words{.bits = 16, .pixels_per_metre = 2000};
  words.lines = {'\1' + line, '\2' + line, '\4' + line};
  seeds.add("png", "words", words.bytes());
  PngBytes palette{.bits = 4, .color = 3, .palette = grey_palette().substr(0, 48)};
  palette.lines = {std::string("\0\x12\x34", 3), "\3\x12\x34", "\4\x12\x34"};
  seeds.add("png", "palette", palette.bytes());
}

void write_zarr(const SeedFolder& seeds) {
  const std::string end(1, '\0'), second = R"({"zarr_format": 2, "shape": [5, 3, 4],
      "chunks": [5, 3, 4], "dtype": "<i2", "fill_value": 0, "order": "F", "filters": null,
      "dimension_separator": ".", "compressor": )";
  seeds.add("zarr", "plain", "2" + second + "null}" + end + kSamples);
  seeds.add("zarr", "gzip", "2" + second + R"({"id": "gzip"}})" + end + packed(kSamples));
  const std::string third = R"({"zarr_format": 3, "node_type": "array", "shape": [1, 5, 3, 4],
      "data_type": "int16", "chunk_grid": {"name": "regular", "configuration":
      {"chunk_shape": [1, 5, 3, 4]}}, "chunk_key_encoding": {"name": "v2"}, "fill_value": "NaN",
      "codecs": [{"name": "transpose", "configuration": {"order": [0, 3, 2, 1]}},
      {"name": "bytes", "configuration": {"endian": "big"}}]})";
  seeds.add("zarr", "third", "3" + third + end + kSwapped);
  const std::string image = R"("multiscales": [{"axes": [{"name": "z", "unit": "micrometer"},
      {"name": "y"}, {"name": "x"}], "datasets": [{"path": "0", "coordinateTransformations":
      [{"type": "scale", "scale": [4, 2, 1]}, {"type": "translation", "translation": [1, 2, 3]}
      ]}]}])";
  seeds.add("zarr", "image", "a{" + image + "}");
  seeds.add("zarr", "group",
            R"(3{"zarr_format": 3, "node_type": "group", "attributes": {"ome": {)" + image + "}}}");
}

}  // namespace

void write_scan_seeds(const SeedFolder& seeds) {
  write_zarr(seeds);
  write_nifti(seeds);
  write_nrrd_and_meta(seeds);
  write_pictures(seeds);
  const std::string project = inv3_bytes(4, 3, 5, kSamples);
  seeds.add("inv3", "tar", project);
  seeds.add("inv3", "gzip", packed(project));
  seeds.add("raw", "int16", "4,3,5,int16\n" + kSamples);
  seeds.add("raw", "header", "4,3,5,int16be,8\n12345678" + kSwapped);
  seeds.add("raw", "float32", "4,3,5,float32le\n" + bytes_of_all(ramp<float>(60)));
}

}  // namespace mesamis
