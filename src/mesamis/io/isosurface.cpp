// SPDX-License-Identifier: Apache-2.0
#include "mesamis/io/isosurface.h"

#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageConstantPad.h>
#include <vtkImageData.h>
#include <vtkImageGaussianSmooth.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include <string>

#include "mesamis/base/error.h"

namespace mesamis {
namespace {

/// The voxels in the grid's own axes, samples shared with the volume.
vtkSmartPointer<vtkImageData> image_of(const Volume& volume) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(volume.size[0], volume.size[1], volume.size[2]);
  image->SetSpacing(volume.spacing.x, volume.spacing.y, volume.spacing.z);
  vtkNew<vtkFloatArray> samples;
  // VTK's interface takes a mutable pointer and with save = 1 neither writes nor frees it.
  samples->SetArray(const_cast<float*>(volume.samples.data()),
                    static_cast<vtkIdType>(volume.samples.size()), 1);
  image->GetPointData()->SetScalars(samples);
  return image;
}

vtkSmartPointer<vtkImageData> smoothed(vtkImageData* image, double voxels) {
  vtkNew<vtkImageGaussianSmooth> filter;
  filter->SetInputData(image);
  filter->SetDimensionality(3);
  filter->SetStandardDeviations(voxels, voxels, voxels);
  filter->SetRadiusFactors(4, 4, 4);
  filter->Update();
  return filter->GetOutput();
}

/// A layer around the volume that lies so far below the level that caps are on its box.
vtkSmartPointer<vtkImageData> padded(vtkImageData* image, double level) {
  constexpr double kSteepness = 1e4;
  const double highest = image->GetScalarRange()[1];
  int extent[6];
  image->GetExtent(extent);
  vtkNew<vtkImageConstantPad> filter;
  filter->SetInputData(image);
  filter->SetConstant(level - kSteepness * (highest - level));
  filter->SetOutputWholeExtent(extent[0] - 1, extent[1] + 1, extent[2] - 1, extent[3] + 1,
                               extent[4] - 1, extent[5] + 1);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> decimated(vtkPolyData* surface, std::size_t triangles) {
  const auto present = static_cast<double>(surface->GetNumberOfCells());
  if (static_cast<double>(triangles) >= present) return surface;
  vtkNew<vtkQuadricDecimation> filter;
  filter->SetInputData(surface);
  filter->SetTargetReduction(1 - static_cast<double>(triangles) / present);
  filter->Update();
  return filter->GetOutput();
}

TriMesh in_world(vtkPolyData& surface, const Volume& volume) {
  TriMesh result;
  for (vtkIdType n = 0; n < surface.GetNumberOfPoints(); ++n) {
    const double* p = surface.GetPoint(n);
    result.points.push_back(volume.to_world({p[0], p[1], p[2]}));
  }
  const bool mirrored = determinant(volume.direction) < 0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < surface.GetNumberOfCells(); ++t) {
    surface.GetCellPoints(t, ids);
    Triangle triangle{static_cast<Index>(ids->GetId(0)), static_cast<Index>(ids->GetId(1)),
                      static_cast<Index>(ids->GetId(2))};
    if (mirrored) std::swap(triangle[1], triangle[2]);
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace

TriMesh isosurface(const Volume& volume, double level, const IsosurfaceOptions& options) {
  if (!(options.smooth_voxels >= 0)) {
    throw InputError("smooth: expected 0 or more voxels, found " +
                     std::to_string(options.smooth_voxels));
  }
  vtkSmartPointer<vtkImageData> image = image_of(volume);
  if (options.smooth_voxels > 0) image = smoothed(image, options.smooth_voxels);
  const double* range = image->GetScalarRange();
  if (!(range[0] < level && level < range[1])) {
    throw InputError("isosurface: nothing crosses the level " + std::to_string(level));
  }
  if (options.close_at_box) image = padded(image, level);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, level);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  vtkSmartPointer<vtkPolyData> surface = contour->GetOutput();
  if (options.triangles > 0) surface = decimated(surface, options.triangles);
  return in_world(*surface, volume);
}

}  // namespace mesamis
