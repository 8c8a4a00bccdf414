// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "fuzz_seeds.h"
#include "mesamis/volume_files/write_volume.h"
#include "support/jpeg_bytes.h"
#include "support/matlab_bytes.h"
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
  TiffPage colours{3, 1, 4, 1, 1, 3, 0, "", "\x12\x30"};
  colours.colours = std::vector<std::uint16_t>(48);
  seeds.add("tiff", "palette", tiff_bytes({colours, colours}));
  seeds.add("tiff", "bits", tiff_bytes({{9, 1, 1, 1, 1, 1, 0, "", "\xa1\x80"}}));
  seeds.add("bmp", "bits",
            BmpBytes{.width = 9,
                     .height = 1,
                     .bits = 1,
                     .palette = std::string("\0\0\0\0\xff\xff\xff\0", 8),
                     .pixels = std::string("\xa0\x80\0\0", 4)}
                .bytes());
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
  seeds.add("zarr", "labels", "a{" + image + R"(, "image-label": {"colors": [{"label-value": 1,
      "rgba": [255, 0, 0, 255]}], "properties": [{"label-value": 1, "name": "bone"}]}})");
  seeds.add("zarr", "group",
            R"(3{"zarr_format": 3, "node_type": "group", "attributes": {"ome": {)" + image + "}}}");
}

/// Formats whose samples follow a header of fixed places.
void write_binary_headers(const SeedFolder& seeds) {
  NiftiBytes pair;
  pair.magic = std::string("ni1\0", 4);
  pair.vox_offset = 0;
  seeds.add("hdr", "pair", pair.header());
  pair.magic = std::string(4, '\0');
  seeds.add("hdr", "analyze", pair.header());
  const MatlabVariable m{"M", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1}};
  seeds.add("spm", "level_4", matlab_4_bytes({{"x", {1, 2}, 2, 1}, m}));
  seeds.add("spm", "level_4_big", matlab_4_bytes({m}, true));
  seeds.add("spm", "level_5", matlab_5_bytes({{"x", {1, 2}, 2, 1}, {"mat", m.values}}, false));
  seeds.add("spm", "level_5_packed", matlab_5_bytes({m, {"mat", m.values}}, true));
  std::string mgh;
  for (const std::int32_t n : {1, 4, 3, 5, 1, 4, 0}) mgh += bytes_of(n, true);
  mgh += bytes_of(std::int16_t{1}, true);
  for (const float x :
       {0.5F, 1.25F, 2.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 9.F, 8.F, 7.F}) {
    mgh += bytes_of(x, true);
  }
  mgh.resize(284);
  seeds.add("mgh", "short", mgh + kSwapped);
  seeds.add("mgh", "gzip", packed(mgh + kSwapped));
  std::string isq = "CTDATA-HEADER_V1" + bytes_of(std::int32_t{3});
  isq.resize(44);
  for (const std::int32_t n : {4, 3, 5, 2000, 3750, 10000}) isq += bytes_of(n);
  isq.resize(512);
  seeds.add("isq", "short", isq + kSamples);
  std::string aim;
  for (const std::int32_t n : {20, 140, 8, 120, 0, 16, 0, 0, 0, 0, 0x20002, 1, 2, 3, 4, 3, 5}) {
    aim += bytes_of(n);
  }
  aim.resize(20 + 24 + 21 * 4);
  for (int n = 0; n < 3; ++n) aim += std::string("\x80\x40\0\0", 4);  // 1, as VAX has it
  aim.resize(160);
  seeds.add("aim", "v020", aim + "Site  4\n" + kSamples);
  std::string wide = std::string("AIMDATA_V030   \0", 16);
  for (const std::int64_t n : {40, 224, 8, 120, 0}) wide += bytes_of(n);
  wide += std::string(12, '\0') + bytes_of(std::int32_t{0x20002});
  for (const std::int64_t n : {1, 2, 3, 4, 3, 5}) wide += bytes_of(n);
  wide += std::string(120, '\0');
  for (int n = 0; n < 3; ++n) wide += bytes_of(std::int64_t{1000000});
  wide.resize(16 + 40 + 224);
  seeds.add("aim", "v030", wide + "Site  4\n" + kSamples);
}

void write_texts(const SeedFolder& seeds) {
  seeds.add("vgi", "one",
            "{volume1}\n[representation]\nsize = 4 3 5\n[file1]\nFileFormat = raw\nSize = 4 3 5\n"
            "Name = data.raw\nDatatype = signed integer\nBitsPerElement = 16\nSkipHeader = 0\n"
            "[geometry]\nresolution = 0.5 1.25 2\nunit = mm\n");
  seeds.add("jpeg", "flat", flat_jpeg(8, 77));
  seeds.add("jpeg", "lossless", lossless_jpeg(12, 4, {1, 2, 3, 4, 5, 6, 7, 8}));
  seeds.add("beside", "log", "[Reconstruction]\nPixel Size (um)=17,5\nSection to Section Step=2\n");
  seeds.add("beside", "json", R"({"Modality": "CT", "KVP": 120})");
  seeds.add(
      "nrrd", "list",
      nrrd_bytes("endian: little\nencoding: raw\ndata file: LIST\ns1.raw\ns2.raw\ns3.raw\n", ""));
  seeds.add("nrrd", "pattern",
            nrrd_bytes("endian: little\nencoding: raw\ndata file: s%d.raw 1 3 1 2\n", ""));
  seeds.add("meta", "list", meta_bytes("", "LIST\ns1.raw\ns2.raw\ns3.raw"));
  seeds.add("meta", "pattern", meta_bytes("DistanceUnits = um\n", "s%d.raw 1 3 1"));
  seeds.add("meta", "channels",
            "NDims = 4\nDimSize = 2 2 1 5\nElementNumberOfChannels = 3\nElementType = MET_SHORT\n"
            "ElementSpacing = 1 1 1 1\nElementDataFile = LOCAL\n" +
                kSamples);
}

void write_descriptions(const SeedFolder& seeds) {
  const std::string page = kSamples.substr(0, 24);
  for (const auto& [name, text] : std::initializer_list<std::pair<const char*, const char*>>{
           {"hyperstack",
            "ImageJ=1.53\nimages=4\nchannels=2\nslices=2\nunit=um\ncf=0\nc0=1\nc1=2\n"},
           {"ome",
            "<?xml version=\"1.0\"?><OME><Image><Pixels SizeZ=\"2\" SizeC=\"2\" SizeT=\"1\" "
            "DimensionOrder=\"XYCZT\" PhysicalSizeX=\"2\" PhysicalSizeXUnit=\"nm\">"
            "<Channel SamplesPerPixel=\"1\"/><TiffData IFD=\"0\" FirstZ=\"1\" PlaneCount=\"2\">"
            "<UUID FileName=\"scan.tif\">u</UUID></TiffData></Pixels></Image></OME>"},
           {"shape", "{\"shape\": [2, 2, 3, 4]}"}}) {
    std::vector<TiffPage> pages(4, TiffPage{.pixels = page});
    pages[0].description = text;
    seeds.add("tiff", name, tiff_bytes(pages));
  }
  TiffPage all{.description = "ImageJ=1.53\nimages=5\nslices=5\n", .pixels = kSamples};
  seeds.add("tiff", "behind_one", tiff_bytes({all}));
}

}  // namespace

void write_scan_seeds(const SeedFolder& seeds) {
  write_zarr(seeds);
  write_nifti(seeds);
  write_nrrd_and_meta(seeds);
  write_pictures(seeds);
  write_binary_headers(seeds);
  write_texts(seeds);
  write_descriptions(seeds);
  const std::string project = inv3_bytes(4, 3, 5, kSamples);
  seeds.add("inv3", "tar", project);
  seeds.add("inv3", "gzip", packed(project));
  seeds.add("raw", "int16", "4,3,5,int16\n" + kSamples);
  seeds.add("raw", "header", "4,3,5,int16be,8\n12345678" + kSwapped);
  seeds.add("raw", "float32", "4,3,5,float32le\n" + bytes_of_all(ramp<float>(60)));
}

}  // namespace mesamis
