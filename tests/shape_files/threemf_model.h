// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Model/COM/NMR_DLLInterfaces.h>
#include <gtest/gtest.h>

#include <deque>
#include <filesystem>

namespace mesamis {

/// lib3mf's objects of one test, released together.
class Model {
 public:
  Model() { EXPECT_EQ(NMR::lib3mf_createmodel(add()), LIB3MF_OK); }
  ~Model() {
    for (NMR::PLib3MFBase* object : objects_) NMR::lib3mf_release(object);
  }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  NMR::PLib3MFBase* get() const { return objects_.front(); }
  NMR::PLib3MFBase* last() const { return objects_.back(); }
  NMR::PLib3MFBase** add() { return &objects_.emplace_back(nullptr); }

 private:
  std::deque<NMR::PLib3MFBase*> objects_;
};

inline void read(Model& model, const std::filesystem::path& file) {
  ASSERT_EQ(NMR::lib3mf_model_queryreader(model.get(), "3mf", model.add()), LIB3MF_OK);
  NMR::PLib3MFBase* reader = model.last();
  NMR::lib3mf_reader_setstrictmodeactive(reader, 1);
  ASSERT_EQ(NMR::lib3mf_reader_readfromfileutf8(reader, file.c_str()), LIB3MF_OK);
  DWORD warnings = 99;
  NMR::lib3mf_reader_getwarningcount(reader, &warnings);
  EXPECT_EQ(warnings, 0u);
}

}  // namespace mesamis
