// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Model/COM/NMR_DLLInterfaces.h>

#include <string>

#include "mesamis/base/error.h"
#include "mesamis/rooms.h"

/// What reading and writing 3MF share.
namespace mesamis::detail::shape_files {

/// Something of lib3mf's, released at the end.
class Handle {
 public:
  Handle() = default;
  ~Handle() {
    if (pointer_ != nullptr) NMR::lib3mf_release(pointer_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  NMR::PLib3MFBase* get() const { return pointer_; }
  /// Where a function of lib3mf puts what it makes.
  NMR::PLib3MFBase** put() { return &pointer_; }

  std::string last_error() const {
    DWORD code = 0;
    LPCSTR message = nullptr;
    NMR::lib3mf_getlasterror(pointer_, &code, &message);
    return message == nullptr ? "error " + std::to_string(code) : message;
  }

 private:
  NMR::PLib3MFBase* pointer_ = nullptr;
};

/// A call that fails only for want of memory, or by a mistake of ours.
inline void require_done(LIB3MFRESULT result) {
  if (result == LIB3MF_OK) return;
  throw InputError("surface: lib3mf could not format it: error " + std::to_string(result));
}

}  // namespace mesamis::detail::shape_files
