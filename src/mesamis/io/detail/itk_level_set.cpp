// SPDX-License-Identifier: Apache-2.0
#include "mesamis/io/detail/itk_level_set.h"

#include <itkCommand.h>
#include <itkCurvatureAnisotropicDiffusionImageFilter.h>
#include <itkGeodesicActiveContourLevelSetFunction.h>
#include <itkGeodesicActiveContourLevelSetImageFilter.h>
#include <itkGradientMagnitudeRecursiveGaussianImageFilter.h>
#include <itkImage.h>
#include <itkMultiThreaderBase.h>
#include <itkReinitializeLevelSetImageFilter.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail {
namespace {

using Image = itk::Image<float, 3>;

/// While it lives, ITK prints nothing and uses as many threads as everything else.
class ItkManners {
 public:
  ItkManners() {
    itk::Object::GlobalWarningDisplayOff();
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(
        static_cast<itk::ThreadIdType>(thread_count()));
  }
  ~ItkManners() {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads_);
    itk::Object::SetGlobalWarningDisplay(warnings_);
  }
  ItkManners(const ItkManners&) = delete;
  ItkManners& operator=(const ItkManners&) = delete;

 private:
  bool warnings_ = itk::Object::GetGlobalWarningDisplay();
  itk::ThreadIdType threads_ = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
};

/// The samples, shared with the volume; the grid's own axes, lengths in the unit (mm).
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

/// The image's values on the grid.
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

/// Runs the filter; what ITK throws becomes what we throw.
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

/// The equation, with steps in time that stay short. ITK's grow until the fastest point of the
/// contour moves by a sixth of a voxel, so that a contour at rest would go on trembling.
class ShortSteps : public itk::GeodesicActiveContourLevelSetFunction<Image, Image> {
 public:
  using Self = ShortSteps;
  using Superclass = itk::GeodesicActiveContourLevelSetFunction<Image, Image>;
  using Pointer = itk::SmartPointer<Self>;
  static Pointer New() {
    Pointer made = new Self;
    made->UnRegister();  // a new object counts itself
    return made;
  }
  void set_longest(double step) { longest_ = step; }
  TimeStepType ComputeGlobalTimeStep(void* data) const override {
    return std::min(Superclass::ComputeGlobalTimeStep(data), longest_);
  }

 private:
  double longest_ = std::numeric_limits<double>::infinity();
};

using Filter = itk::GeodesicActiveContourLevelSetImageFilter<Image, Image>;

/// Stable wherever the contour is: the speed is 1 at most, its central differences a half.
double longest_step(const Evolution& e) {
  return 1 / (6 * (e.propagation + e.curvature + e.advection / 2));
}

/// Ends the evolution when the contour stands still. ITK's own measure, the change in one step,
/// does not come to rest where two fronts meet and single voxels go to and fro.
class Watch {
 public:
  Watch(const Volume& start, const Evolution& evolution)
      : before_(start.samples), iterations_(evolution.iterations), least_(evolution.rms_change) {}

  void look(Filter& filter) {
    const auto done = static_cast<int>(filter.GetElapsedIterations());
    if (done % kStillFor != 0 && done != iterations_) return;
    const float* values = filter.GetOutput()->GetBufferPointer();
    moved_ = moved(values);
    before_.assign(values, values + before_.size());
    still_ = done % kStillFor == 0 && moved_ < least_;
    if (still_) filter.SetNumberOfIterations(filter.GetElapsedIterations());
  }
  double rms_change() const { return moved_; }
  bool converged() const { return still_; }

 private:
  /// Rms of the change where the contour is or was.
  double moved(const float* values) const {
    double sum = 0, count = 0;
    for (std::size_t n = 0; n < before_.size(); ++n) {
      if (std::min(std::abs(before_[n]), std::abs(values[n])) > 0.5f) continue;
      const double change = values[n] - before_[n];
      sum += change * change;
      ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : 0;
  }

  static constexpr int kStillFor = 20;  // iterations

  std::vector<float> before_;
  int iterations_;
  double least_, moved_ = 0;
  bool still_ = false;
};

}  // namespace

bool have_itk() { return true; }

Volume diffused(const Volume& volume, int steps, double conductance, const Progress& progress) {
  constexpr double kStableStep = 1.0 / 16;  // in three dimensions
  const ItkManners manners;
  auto filter = itk::CurvatureAnisotropicDiffusionImageFilter<Image, Image>::New();
  filter->SetInput(image_in_voxels(volume));
  filter->SetNumberOfIterations(static_cast<itk::IdentifierType>(steps));
  filter->SetConductanceParameter(conductance);
  filter->SetTimeStep(kStableStep);
  report_progress(*filter, "denoise", progress);
  update(*filter);
  return on_grid_of(volume, *filter->GetOutput());
}

Volume gradient_magnitude(const Volume& volume, double sigma) {
  const ItkManners manners;
  auto filter = itk::GradientMagnitudeRecursiveGaussianImageFilter<Image, Image>::New();
  filter->SetInput(image_of(volume, 1));
  filter->SetSigma(sigma);
  update(*filter);
  return on_grid_of(volume, *filter->GetOutput());
}

Volume signed_distance(const Volume& volume, double level, double band) {
  const ItkManners manners;
  auto filter = itk::ReinitializeLevelSetImageFilter<Image>::New();
  filter->SetInput(image_in_voxels(volume));
  filter->SetLevelSetValue(level);
  filter->SetNarrowBanding(true);
  filter->SetNarrowBandwidth(2 * band);
  update(*filter);
  Volume result = on_grid_of(volume, *filter->GetOutput());
  const auto most = static_cast<float>(band);
  for (float& value : result.samples) value = std::clamp(value, -most, most);
  return result;
}

EvolutionEnd evolved(const Volume& start, const Volume& speed, const Evolution& evolution,
                     const Progress& progress) {
  const ItkManners manners;
  auto equation = ShortSteps::New();
  equation->set_longest(longest_step(evolution));
  equation->SetDerivativeSigma(0);  // the speed is smooth already
  auto filter = Filter::New();
  filter->SetSegmentationFunction(equation);
  filter->SetInput(image_in_voxels(start));
  filter->SetFeatureImage(image_in_voxels(speed));
  // ITK's contours are negative inside, ours positive: of the three terms this turns the growth.
  filter->SetPropagationScaling(static_cast<float>(-evolution.propagation));
  filter->SetCurvatureScaling(static_cast<float>(evolution.curvature));
  filter->SetAdvectionScaling(static_cast<float>(evolution.advection));
  filter->InterpolateSurfaceLocationOn();  // the contour comes to rest between voxels, too
  filter->SetNumberOfIterations(static_cast<itk::IdentifierType>(evolution.iterations));
  filter->SetMaximumRMSError(0);
  Watch watch(start, evolution);
  filter->AddObserver(itk::IterationEvent(), [&](const itk::EventObject&) { watch.look(*filter); });
  report_progress(*filter, "evolve", progress);
  update(*filter);
  return {on_grid_of(start, *filter->GetOutput()), static_cast<int>(filter->GetElapsedIterations()),
          watch.rms_change(), watch.converged()};
}

}  // namespace mesamis::detail
