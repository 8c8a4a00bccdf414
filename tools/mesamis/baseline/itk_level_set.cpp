// SPDX-License-Identifier: Apache-2.0
#include "mesamis/baseline/itk_level_set.h"

#include <itkCommand.h>
#include <itkCurvatureAnisotropicDiffusionImageFilter.h>
#include <itkGeodesicActiveContourLevelSetFunction.h>
#include <itkGeodesicActiveContourLevelSetImageFilter.h>
#include <itkGradientMagnitudeRecursiveGaussianImageFilter.h>
#include <itkImage.h>
#include <itkReinitializeLevelSetImageFilter.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::baseline {
namespace {

using Image = itk::Image<float, 3>;

/// A filter that runs in as many threads as the library's own loops. ITK's only other setting is
/// the default of the whole process.
template <class FilterType>
typename FilterType::Pointer make_filter() {
  auto filter = FilterType::New();
  filter->SetNumberOfWorkUnits(static_cast<itk::ThreadIdType>(thread_count()));
  return filter;
}

/// An image that shares the volume's samples, in the axes of the grid.
/// @param unit  of its lengths, mm.
Image::Pointer image_of(const Volume& volume, double unit) {
  auto image = Image::New();
  Image::SizeType size;
  double spacing[3];
  for (unsigned a = 0; a < 3; ++a) {
    size[a] = static_cast<itk::SizeValueType>(volume.size[a]);
    spacing[a] = volume.spacing[static_cast<int>(a)] / unit;
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  // ITK's filters take an image that they neither write nor, with the last argument, free.
  image->GetPixelContainer()->SetImportPointer(const_cast<float*>(volume.samples.data()),
                                               volume.samples.size(), false);
  return image;
}

Image::Pointer image_in_voxels(const Volume& volume) {
  return image_of(volume, volume.shortest_side());
}

/// A volume on a known grid with the values of an image.
Volume on_grid_of(const Volume& grid, const Image& image) {
  Volume result;
  result.size = grid.size;
  result.spacing = grid.spacing;
  result.origin = grid.origin;
  result.direction = grid.direction;
  result.modality = grid.modality;
  const float* values = image.GetBufferPointer();
  result.samples.assign(values, values + grid.voxel_count());
  return result;
}

void report_progress(itk::ProcessObject& filter, std::string_view stage, const Progress& progress) {
  if (!progress) return;
  filter.AddObserver(itk::ProgressEvent(), [&filter, stage, &progress](const itk::EventObject&) {
    if (!progress(stage, filter.GetProgress())) filter.AbortGenerateDataOn();
  });
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Runs a filter and translates ITK's exceptions into those of the library.
void update(itk::ProcessObject& filter) {
  try {
    filter.Update();
  } catch (const itk::ProcessAborted&) {
    throw Cancelled();
  } catch (const itk::MemoryAllocationError&) {
    throw std::bad_alloc();
  } catch (const itk::ExceptionObject& error) {
    throw NumericalError("ITK: " + one_line(error.GetDescription()));
  }
}

/// The equation with an upper bound on the time step. ITK's step grows until the fastest point of
/// the contour moves by a sixth of a voxel, so that a contour near its rest oscillates.
class BoundedStepEquation : public itk::GeodesicActiveContourLevelSetFunction<Image, Image> {
 public:
  using Self = BoundedStepEquation;
  using Superclass = itk::GeodesicActiveContourLevelSetFunction<Image, Image>;
  using Pointer = itk::SmartPointer<Self>;
  static Pointer New() {
    Pointer made = new Self;
    made->UnRegister();  // a new object counts itself
    return made;
  }
  void set_largest_step(double step) { largest_step_ = step; }
  TimeStepType ComputeGlobalTimeStep(void* data) const override {
    return std::min(Superclass::ComputeGlobalTimeStep(data), largest_step_);
  }

 private:
  double largest_step_ = std::numeric_limits<double>::infinity();
};

using Filter = itk::GeodesicActiveContourLevelSetImageFilter<Image, Image>;

/// A time step that is stable everywhere: the speed is at most 1, its central differences a half.
double stable_step(const Evolution& e) {
  return 1 / (6 * (e.propagation + e.curvature + e.advection / 2));
}

/// Ends the evolution when the contour rests over an interval of iterations. ITK's own measure, the
/// change in one step, stays above zero where two fronts meet and single voxels change sides.
class ConvergenceMonitor {
 public:
  ConvergenceMonitor(const Volume& start, const Evolution& evolution)
      : previous_(start.samples), options_(evolution) {}

  void observe(Filter& filter) {
    const auto iterations = static_cast<int>(filter.GetElapsedIterations());
    const bool interval_ends = iterations % kInterval == 0;
    if (!interval_ends && iterations != options_.iterations) return;
    const float* values = filter.GetOutput()->GetBufferPointer();
    rms_change_ = rms_change_to(values);
    previous_.assign(values, values + previous_.size());
    converged_ = interval_ends && rms_change_ < options_.rms_change;
    if (converged_) filter.SetNumberOfIterations(filter.GetElapsedIterations());
  }
  double rms_change() const { return rms_change_; }
  bool converged() const { return converged_; }

 private:
  /// Over the voxels at the contour, before or now.
  double rms_change_to(const float* values) const {
    double sum = 0, count = 0;
    for (std::size_t n = 0; n < previous_.size(); ++n) {
      if (std::min(std::abs(previous_[n]), std::abs(values[n])) > 0.5f) continue;
      const double change = values[n] - previous_[n];
      sum += change * change;
      ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : 0;
  }

  static constexpr int kInterval = 20;  // iterations

  std::vector<float> previous_;
  Evolution options_;
  double rms_change_ = 0;
  bool converged_ = false;
};

}  // namespace

bool have_itk() { return true; }

Volume diffused(const Volume& volume, int steps, double conductance, const Progress& progress) {
  constexpr double kStableStep = 1.0 / 16;  // in three dimensions
  auto filter = make_filter<itk::CurvatureAnisotropicDiffusionImageFilter<Image, Image>>();
  filter->SetInput(image_in_voxels(volume));
  filter->SetNumberOfIterations(static_cast<itk::IdentifierType>(steps));
  filter->SetConductanceParameter(conductance);
  filter->SetTimeStep(kStableStep);
  report_progress(*filter, "denoise", progress);
  update(*filter);
  return on_grid_of(volume, *filter->GetOutput());
}

Volume gradient_magnitude(const Volume& volume, double sigma) {
  auto filter = make_filter<itk::GradientMagnitudeRecursiveGaussianImageFilter<Image, Image>>();
  filter->SetInput(image_of(volume, 1));
  filter->SetSigma(sigma);
  update(*filter);
  return on_grid_of(volume, *filter->GetOutput());
}

Volume signed_distance(const Volume& volume, double level, double band) {
  auto filter = make_filter<itk::ReinitializeLevelSetImageFilter<Image>>();
  filter->SetInput(image_in_voxels(volume));
  filter->SetLevelSetValue(level);
  filter->SetNarrowBanding(true);
  filter->SetNarrowBandwidth(2 * band);
  update(*filter);
  Volume result = on_grid_of(volume, *filter->GetOutput());
  const auto limit = static_cast<float>(band);
  for (float& value : result.samples) value = std::clamp(value, -limit, limit);
  return result;
}

EvolutionResult evolved(const Volume& start, const Volume& speed, const Evolution& evolution,
                        const Progress& progress) {
  auto equation = BoundedStepEquation::New();
  equation->set_largest_step(stable_step(evolution));
  equation->SetDerivativeSigma(0);  // the speed is smooth already
  auto filter = make_filter<Filter>();
  filter->SetSegmentationFunction(equation);
  filter->SetInput(image_in_voxels(start));
  filter->SetFeatureImage(image_in_voxels(speed));
  // ITK's level sets are negative inside, ours positive: this changes the sign of the growth alone.
  filter->SetPropagationScaling(static_cast<float>(-evolution.propagation));
  filter->SetCurvatureScaling(static_cast<float>(evolution.curvature));
  filter->SetAdvectionScaling(static_cast<float>(evolution.advection));
  filter->InterpolateSurfaceLocationOn();  // so that the contour can rest between voxels
  filter->SetNumberOfIterations(static_cast<itk::IdentifierType>(evolution.iterations));
  filter->SetMaximumRMSError(0);
  ConvergenceMonitor monitor(start, evolution);
  filter->AddObserver(itk::IterationEvent(),
                      [&](const itk::EventObject&) { monitor.observe(*filter); });
  report_progress(*filter, "evolve", progress);
  update(*filter);
  return {on_grid_of(start, *filter->GetOutput()), static_cast<int>(filter->GetElapsedIterations()),
          monitor.rms_change(), monitor.converged()};
}

}  // namespace mesamis::detail::baseline
