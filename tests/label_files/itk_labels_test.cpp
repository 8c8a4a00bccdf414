// SPDX-License-Identifier: Apache-2.0
// Another reader's opinion of the label maps that we write: labels, places and fields of Slicer.
#include <gtest/gtest.h>
#include <itkImageFileReader.h>
#include <itkMetaDataObject.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkVectorImage.h>

#include <cmath>

#include "mesamis/label_files/write_labels.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

/// Labels that tell their voxel, on an oblique grid; a second layer has twice of them.
LabelMap counted_map(std::size_t layers, bool left_handed = false) {
  const double c = std::cos(0.3), s = std::sin(0.3), d = std::cos(2.0), e = std::sin(2.0);
  const double f = left_handed ? -1 : 1;
  LabelMap map;
  map.size = {5, 4, 3};
  map.spacing = {0.5, 1.25, 2};
  map.origin = {-12.5, 7, 101};
  map.direction = Mat3{{Vec3{c, -s * d, f * s * e}, Vec3{s, c * d, -f * c * e}, Vec3{0, e, f * d}}};
  map.layers.resize(layers, std::vector<std::uint16_t>(map.voxel_count()));
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    for (std::size_t layer = 0; layer < layers; ++layer) {
      map.layers[layer][n] = static_cast<std::uint16_t>(n * 7 * (layer + 1));
    }
  }
  map.segments = {{"left: \"hip\"", 7, 0, {255, 128, 0}}};
  return with_all_segments(map);
}

template <class Image>
typename Image::Pointer read_by_itk(const std::filesystem::path& path, itk::ImageIOBase* io) {
  auto reader = itk::ImageFileReader<Image>::New();
  reader->SetImageIO(io);
  reader->SetFileName(path.string());
  reader->Update();
  return reader->GetOutput();
}

template <class Image>
void expect_same_places(const LabelMap& map, const Image& image, double tolerance) {
  for (const std::array<Index, 3>& voxel :
       {std::array<Index, 3>{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 2}, {4, 3, 2}}) {
    typename Image::PointType p;
    image.TransformIndexToPhysicalPoint({{voxel[0], voxel[1], voxel[2]}}, p);
    const Vec3 at = map.to_world(
        {voxel[0] * map.spacing.x, voxel[1] * map.spacing.y, voxel[2] * map.spacing.z});
    EXPECT_LT(norm(at - Vec3{p[0], p[1], p[2]}), tolerance);
  }
}

TEST(ItkLabels, NiftiFilesHaveTheirLabelsInTheirPlaces) {
  using Image = itk::Image<std::uint16_t, 3>;
  for (const char* name : {"a.nii", "a.nii.gz"}) {
    for (const bool left_handed : {false, true}) {
      const TempFolder folder;
      const LabelMap map = counted_map(1, left_handed);
      write_label_map(folder / name, map);
      const auto image = read_by_itk<Image>(folder / name, itk::NiftiImageIO::New());
      expect_same_places(map, *image, 1e-4);
      for (std::size_t n = 0; n < map.voxel_count(); ++n) {
        ASSERT_EQ(image->GetBufferPointer()[n], map.layers[0][n]);
      }
    }
  }
}

std::string key_of(const itk::Object& image, const char* key) {
  std::string value;
  itk::ExposeMetaData<std::string>(image.GetMetaDataDictionary(), key, value);
  return value;
}

TEST(ItkLabels, NrrdFilesHaveTheirLayersAndTheKeysOfSlicer) {
  using Image = itk::VectorImage<std::uint16_t, 3>;  // a list axis that comes first is a vector
  for (const std::size_t layers : {1, 2}) {
    const TempFolder folder;
    const LabelMap map = counted_map(layers, true);
    write_label_map(folder / "a.seg.nrrd", map);
    const auto image = read_by_itk<Image>(folder / "a.seg.nrrd", itk::NrrdImageIO::New());
    ASSERT_EQ(image->GetNumberOfComponentsPerPixel(), layers);
    expect_same_places(map, *image, 1e-9);
    for (std::size_t n = 0; n < map.voxel_count(); ++n) {
      for (std::size_t layer = 0; layer < layers; ++layer) {
        ASSERT_EQ(image->GetBufferPointer()[n * layers + layer], map.layers[layer][n]);
      }
    }
    EXPECT_EQ(key_of(*image, "Segment0_Name"), "left: \"hip\"");
    EXPECT_EQ(key_of(*image, "Segment0_LabelValue"), "7");
    EXPECT_EQ(key_of(*image, "Segment0_Layer"), "0");
    EXPECT_EQ(key_of(*image, "Segment0_Extent"), "1 1 0 0 0 0");
    EXPECT_EQ(key_of(*image, "Segmentation_MasterRepresentation"), "Binary labelmap");
  }
}

}  // namespace
}  // namespace mesamis
