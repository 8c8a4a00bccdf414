// SPDX-License-Identifier: Apache-2.0
// Another reader's opinion: files that ITK writes, and where ITK puts their voxels.
#include <gtest/gtest.h>
#include <itkImageFileReader.h>
#include <itkImageFileWriter.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <cmath>

#include "mesamis/volume_files/read_volume.h"
#include "support/temp_folder.h"
#include "support/test_data.h"

namespace mesamis {
namespace {

using Image = itk::Image<float, 3>;

itk::ImageIOBase::Pointer reader_of(const std::string& name) {
  if (name.find(".nii") != std::string::npos) return itk::NiftiImageIO::New().GetPointer();
  if (name.find(".n") != std::string::npos) return itk::NrrdImageIO::New().GetPointer();
  return itk::MetaImageIO::New().GetPointer();
}

Image::Pointer oblique_image() {
  auto image = Image::New();
  image->SetRegions(Image::SizeType{{5, 4, 3}});
  const double spacing[] = {0.5, 1.25, 2}, origin[] = {-12.5, 7, 101};
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  // A turn about z after one about x, with the second axis reversed.
  const double c = std::cos(0.3), s = std::sin(0.3), d = std::cos(0.7), e = std::sin(0.7);
  const double rows[3][3] = {{c, s * d, s * e}, {s, -c * d, -c * e}, {0, -e, d}};
  Image::DirectionType direction;
  for (unsigned r = 0; r < 3; ++r) {
    for (unsigned a = 0; a < 3; ++a) direction(r, a) = rows[r][a];
  }
  image->SetDirection(direction);
  image->Allocate();
  for (itk::SizeValueType n = 0; n < 60; ++n) {
    image->GetBufferPointer()[n] = static_cast<float>(n) * 1.5f - 20;
  }
  return image;
}

void expect_same(const Volume& volume, const Image& image) {
  const auto size = image.GetBufferedRegion().GetSize();
  for (unsigned a = 0; a < 3; ++a) {
    ASSERT_EQ(volume.size[a], static_cast<Index>(size[a]));
  }
  const Image::IndexType corners[] = {
      {{0, 0, 0}}, {{4, 0, 0}}, {{0, 3, 0}}, {{0, 0, 2}}, {{4, 3, 2}}};
  for (const auto& corner : corners) {
    Image::PointType p;
    image.TransformIndexToPhysicalPoint(corner, p);
    const Vec3 at = volume.to_world({static_cast<double>(corner[0]) * volume.spacing.x,
                                     static_cast<double>(corner[1]) * volume.spacing.y,
                                     static_cast<double>(corner[2]) * volume.spacing.z});
    EXPECT_LT(norm(at - Vec3{p[0], p[1], p[2]}), 1e-4);
  }
  for (std::size_t n = 0; n < volume.samples.size(); ++n) {
    ASSERT_EQ(volume.samples[n], image.GetBufferPointer()[n]);
  }
}

TEST(ItkOracle, PutsEveryVoxelWhereItkWroteIt) {
  for (const std::string name : {"a.nii", "a.nii.gz", "a.nrrd", "a.nhdr", "a.mha", "a.mhd"}) {
    for (const bool compress : {false, true}) {
      SCOPED_TRACE(name);
      const TempFolder folder;
      auto writer = itk::ImageFileWriter<Image>::New();
      writer->SetImageIO(reader_of(name));
      writer->SetFileName((folder / name).string());
      writer->SetInput(oblique_image());
      writer->SetUseCompression(compress);
      writer->Update();
      const VolumeFile file = read_volume(folder / name);
      expect_same(file.volume, *oblique_image());
      EXPECT_TRUE(file.warnings.empty());
    }
  }
}

TEST(ItkOracle, ReadsRealScansAsItkDoes) {
  for (const char* name : {"mouse_skull/ct_A_J.nii.gz", "head_aniso/ct.nii.gz",
                           "trabecular_microct/ct.nrrd", "bad/nibabel/anatomical.nii"}) {
    const auto path = test_data("data") / name;
    MESAMIS_REQUIRE_DATA(path);
    SCOPED_TRACE(name);
    auto reader = itk::ImageFileReader<Image>::New();
    reader->SetImageIO(reader_of(path.filename().string()));
    reader->SetFileName(path.string());
    reader->Update();
    expect_same(read_volume(path).volume, *reader->GetOutput());
  }
}

}  // namespace
}  // namespace mesamis
