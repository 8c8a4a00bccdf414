// SPDX-License-Identifier: Apache-2.0
#include "mesamis/baseline/vtk_isosurface.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageConstantPad.h>
#include <vtkImageData.h>
#include <vtkImageGaussianSmooth.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include <algorithm>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::baseline {
namespace {

/// Keeps the first error of a filter. VTK prints no message that an observer receives.
class ErrorObserver {
 public:
  void note(vtkObject*, unsigned long event, void* text) {
    if (event == vtkCommand::ErrorEvent && error_.empty()) error_ = static_cast<const char*>(text);
  }
  const std::string& error() const { return error_; }

 private:
  std::string error_;
};

/// Runs a filter.
void update(vtkAlgorithm& filter) {
  ErrorObserver observer;
  filter.AddObserver(vtkCommand::ErrorEvent, &observer, &ErrorObserver::note);
  filter.AddObserver(vtkCommand::WarningEvent, &observer, &ErrorObserver::note);
  filter.Update();
  filter.RemoveAllObservers();
  if (observer.error().empty()) return;
  std::string line = observer.error();
  std::replace(line.begin(), line.end(), '\n', ' ');
  throw NumericalError("VTK: " + line);
}

/// An image that shares the volume's samples, in the axes of the grid.
vtkSmartPointer<vtkImageData> image_of(const Volume& volume) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(volume.size[0], volume.size[1], volume.size[2]);
  image->SetSpacing(volume.spacing.x, volume.spacing.y, volume.spacing.z);
  vtkNew<vtkFloatArray> samples;
  // VTK takes a mutable pointer; with save = 1 it neither writes to nor frees it.
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
  filter->SetNumberOfThreads(thread_count());
  update(*filter);
  return filter->GetOutput();
}

/// Adds a layer of voxels so far below the level that the surface is closed at the volume's box.
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
  filter->SetNumberOfThreads(thread_count());
  update(*filter);
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> decimated(vtkPolyData* surface, std::size_t triangles) {
  const auto present = static_cast<double>(surface->GetNumberOfCells());
  if (static_cast<double>(triangles) >= present) return surface;
  vtkNew<vtkQuadricDecimation> filter;
  filter->SetInputData(surface);
  filter->SetTargetReduction(1 - static_cast<double>(triangles) / present);
  update(*filter);
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

bool have_vtk() { return true; }

TriMesh vtk_isosurface(const Volume& volume, double level, const IsosurfaceOptions& options) {
  vtkSmartPointer<vtkImageData> image = image_of(volume);
  if (options.smooth_voxels > 0) image = smoothed(image, options.smooth_voxels);
  const double* range = image->GetScalarRange();
  if (!(range[0] < level && level < range[1])) {
    throw InputError("isosurface: nothing crosses the level " + std::to_string(level) +
                     ", found values from " + std::to_string(range[0]) + " to " +
                     std::to_string(range[1]));
  }
  if (options.close_at_box) image = padded(image, level);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, level);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  update(*contour);
  vtkSmartPointer<vtkPolyData> surface = contour->GetOutput();
  if (options.triangles > 0) surface = decimated(surface, options.triangles);
  return in_world(*surface, volume);
}

}  // namespace mesamis::detail::baseline
