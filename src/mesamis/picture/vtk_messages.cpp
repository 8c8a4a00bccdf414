// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/vtk_messages.h"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>

namespace mesamis::detail {
namespace {

class Collector : public vtkOutputWindow {
 public:
  static Collector* New();
  vtkTypeMacro(Collector, vtkOutputWindow) void DisplayText(const char*) override {}
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    if (first_error_.empty() && text != nullptr) first_error_ = text;
  }
  std::string first_error_;
};
vtkStandardNewMacro(Collector)

}  // namespace

VtkMessages::VtkMessages()
    : before_(vtkOutputWindow::GetInstance()), collector_(vtkSmartPointer<Collector>::New()) {
  vtkOutputWindow::SetInstance(collector_);
  verbosity_before_ = vtkLogger::GetCurrentVerbosityCutoff();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkLogger::SetStderrVerbosity(static_cast<vtkLogger::Verbosity>(verbosity_before_));
  vtkOutputWindow::SetInstance(before_);
}

std::string VtkMessages::first_error() const {
  // "ERROR: In file, line 12\nvtkClass (0x1234): what happened\n\n"
  std::string text = static_cast<const Collector*>(collector_.Get())->first_error_;
  if (const auto start = text.find("): "); start != std::string::npos) text.erase(0, start + 3);
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return text;
}

}  // namespace mesamis::detail
