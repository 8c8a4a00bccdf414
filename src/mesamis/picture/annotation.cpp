// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/annotation.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstdio>

#include "mesamis/plot/ticks.h"

namespace mesamis::detail {
namespace {

constexpr Rgb kInk{40, 44, 52};

/// Axis-aligned coloured rectangles.
class Rectangles {
 public:
  Rectangles() { colors_->SetNumberOfComponents(3); }

  void add(std::array<double, 2> lo, std::array<double, 2> hi, const Rgb& color) {
    const vtkIdType corners[4] = {
        points_->InsertNextPoint(lo[0], lo[1], 0), points_->InsertNextPoint(hi[0], lo[1], 0),
        points_->InsertNextPoint(hi[0], hi[1], 0), points_->InsertNextPoint(lo[0], hi[1], 0)};
    cells_->InsertNextCell(4, corners);
    colors_->InsertNextTypedTuple(color.data());
  }

  void draw(Scene& scene) {
    const auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points_);
    data->SetPolys(cells_);
    data->GetCellData()->SetScalars(colors_);
    const auto mapper = vtkSmartPointer<vtkPolyDataMapper2D>::New();
    mapper->SetInputData(data);
    const auto actor = vtkSmartPointer<vtkActor2D>::New();
    actor->SetMapper(mapper);
    scene.renderer().AddActor2D(actor);
  }

 private:
  vtkSmartPointer<vtkPoints> points_ = vtkSmartPointer<vtkPoints>::New();
  vtkSmartPointer<vtkCellArray> cells_ = vtkSmartPointer<vtkCellArray>::New();
  vtkSmartPointer<vtkUnsignedCharArray> colors_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
};

/// The largest 1, 2 or 5 times a power of ten that is not above the length.
double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  double result = power;
  for (const double factor : {2.0, 5.0}) {
    if (factor * power <= length) result = factor * power;
  }
  return result;
}

}  // namespace

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", std::abs(value) < 1e-12 ? 0 : value);
  return text;
}

void add_label(Scene& scene, const Label& label) {
  const auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(label.text.c_str());
  actor->SetPosition(label.at[0], label.at[1]);
  vtkTextProperty& property = *actor->GetTextProperty();
  property.SetFontFamilyToArial();
  property.SetBold(label.bold);
  property.SetFontSize(static_cast<int>(std::lround(label.height * scene.unit())));
  property.SetColor(kInk[0] / 255.0, kInk[1] / 255.0, kInk[2] / 255.0);
  property.SetVerticalJustificationToCentered();
  if (label.align == Align::kLeft) property.SetJustificationToLeft();
  if (label.align == Align::kCenter) property.SetJustificationToCentered();
  if (label.align == Align::kRight) property.SetJustificationToRight();
  scene.renderer().AddActor2D(actor);
}

void add_corner_label(Scene& scene, const std::string& text) {
  add_label(scene, {text, {28 * scene.unit(), 24 * scene.unit()}});
}

void add_scale_bar(Scene& scene) {
  const double unit = scene.unit();
  const double length = round_length(0.22 * scene.rendered_size()[0] * scene.mm_per_pixel());
  const double right = scene.rendered_size()[0] - 28 * unit;
  const double left = right - length / scene.mm_per_pixel();
  const double bottom = 22 * unit;
  Rectangles bar;
  bar.add({left, bottom}, {right, bottom + 3 * unit}, kInk);
  for (const double end : {left, right - 3 * unit}) {
    bar.add({end, bottom - 4 * unit}, {end + 3 * unit, bottom + 7 * unit}, kInk);
  }
  bar.draw(scene);
  add_label(
      scene,
      {short_number(length) + " mm", {(left + right) / 2, bottom + 20 * unit}, Align::kCenter});
}

void add_tick(Scene& scene, const std::array<double, 2>& at, bool below, const std::string& text) {
  constexpr double kLength = 6, kHalfWidth = 0.75, kTextSize = 13;
  const double unit = scene.unit(), width = kHalfWidth * unit, length = kLength * unit;
  const auto [x, y] = at;
  Rectangles mark;
  if (below) {
    mark.add({x - width, y - length}, {x + width, y}, kInk);
    add_label(scene, {text, {x, y - 15 * unit}, Align::kCenter, kTextSize});
  } else {
    mark.add({x - length, y - width}, {x, y + width}, kInk);
    add_label(scene, {text, {x - 9 * unit, y}, Align::kRight, kTextSize});
  }
  mark.draw(scene);
}

void add_color_bar(Scene& scene, const ColorBar& bar) {
  const double unit = scene.unit();
  const double left = scene.rendered_size()[0] - 105 * unit, right = left + 22 * unit;
  const double bottom = 0.22 * scene.rendered_size()[1], top = 0.84 * scene.rendered_size()[1];
  constexpr int kSteps = 256;
  Rectangles strip;
  strip.add({left - unit, bottom - unit}, {right + unit, top + unit}, kInk);
  for (int i = 0; i < kSteps; ++i) {
    strip.add({left, bottom + (top - bottom) * i / kSteps},
              {right, bottom + (top - bottom) * (i + 1) / kSteps}, bar.color((i + 0.5) / kSteps));
  }
  const Ticks ticks = round_ticks(bar.range.lo, bar.range.hi, 6);
  for (int i = 0; i < ticks.count; ++i) {
    const double value = ticks.at(i);
    const double y =
        bottom + (top - bottom) * (value - bar.range.lo) / (bar.range.hi - bar.range.lo);
    strip.add({right, y - 0.75 * unit}, {right + 6 * unit, y + 0.75 * unit}, kInk);
    const bool zero = std::abs(value) < 1e-6 * ticks.step;
    add_label(scene, {short_number(zero ? 0 : value), {right + 11 * unit, y}});
  }
  strip.draw(scene);
  add_label(scene, {bar.title, {(left + right) / 2, top + 24 * unit}, Align::kCenter, 18, true});
}

}  // namespace mesamis::detail
