// SPDX-License-Identifier: Apache-2.0
// Surfaces in DICOM: Encapsulated STL and Encapsulated OBJ (PS3.3 A.85.1, A.85.2).
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/utf8.h"
#include "mesamis/base/version.h"
#include "mesamis/files/byte_source.h"
#include "mesamis/files/dicom_data.h"
#include "mesamis/files/dicom_writer.h"
#include "mesamis/files/refuse.h"
#include "mesamis/shape_files/surface_formats.h"

namespace mesamis::detail::shape_files {
namespace {

namespace fs = std::filesystem;

constexpr DicomTag kMimeType = 0x00420012, kDocument = 0x00420011, kDocumentLength = 0x00420015,
                   kDocumentTitle = 0x00420010, kUnits = 0x004008ea, kCodeValue = 0x00080100;

/// A kind of model that DICOM has a place for.
struct Model {
  const char* sop_class;
  const char* mime_type;
  std::string (*bytes)(const TriMesh&, const SurfaceWriteOptions&);
  SurfaceFile (*parse)(const fs::path&, std::string_view, MemoryBudget&);
};

constexpr std::array<Model, 2> kModels{
    {{"1.2.840.10008.5.1.4.1.1.104.3", "model/stl", stl_bytes, parse_stl},
     {"1.2.840.10008.5.1.4.1.1.104.4", "model/obj", obj_bytes, parse_obj}}};

const Model* model_of(const std::string& sop_class) {
  for (const Model& model : kModels) {
    if (sop_class == model.sop_class) return &model;
  }
  return nullptr;
}

void set_subject(DicomSetWriter& set, const DicomSubject& subject, const std::string& document) {
  set.set(0x00080005, "CS", "ISO_IR 192");
  set.set(0x00100010, "PN", subject.patient_name);
  set.set(0x00100020, "LO", subject.patient_id);
  set.set(0x00100030, "DA", subject.birth_date);
  set.set(0x00100040, "CS", subject.sex);
  const auto uid = [&](const std::string& known, const char* what) {
    return known.empty() ? dicom_uid_of(what + document) : known;
  };
  set.set(0x0020000d, "UI", uid(subject.study_uid, "study"));
  set.set(0x00080020, "DA", subject.study_date);
  set.set(0x00080030, "TM", subject.study_time);
  set.set(0x00200010, "SH", subject.study_id);
  set.set(0x00080050, "SH", subject.accession_number);
  set.set(0x00080090, "PN", subject.referring_physician);
  set.set(0x00200052, "UI", uid(subject.frame_of_reference, "frame of reference"));
  set.set(0x00201040, "LO", "");  // Position Reference Indicator
}

/// What the surface was made of: as a source, and as instances that the file refers to.
void set_sources(DicomSetWriter& set, const DicomSubject& subject) {
  if (subject.sources.empty()) return;
  std::vector<DicomSetWriter> sources;
  for (const auto& [sop_class, instance] : subject.sources) {
    DicomSetWriter& item = sources.emplace_back();
    item.set(0x00081150, "UI", sop_class);
    item.set(0x00081155, "UI", instance);
  }
  set.set_items(0x00420013, sources);
  DicomSetWriter series;
  series.set(dicom::kSeriesUid, "UI", subject.source_series);
  series.set_items(0x0008114a, sources);
  set.set_items(0x00081115, {series});
}

void set_equipment(DicomSetWriter& set) {
  set.set(0x00080070, "LO", "mesamis");
  set.set(0x00081090, "LO", "mesamis");
  set.set(0x00181000, "LO", "none");  // there is no device
  set.set(0x00181020, "LO", version());
}

/// Series, document and model modules.
void set_model(DicomSetWriter& set, const Model& model, const std::string& document,
               const SurfaceWriteOptions& options) {
  set.set(0x00080060, "CS", "M3D");
  set.set(0x0020000e, "UI", dicom_uid_of("series " + options.subject.study_uid + document));
  set.set(0x00200011, "IS", "1");
  set.set(0x00200013, "IS", "1");
  for (const auto& [tag, vr] :
       {std::pair(0x00080023u, "DA"), std::pair(0x00080033u, "TM"), std::pair(0x0008002au, "DT")}) {
    set.set(tag, vr, "");  // content and acquisition: the same surface gives the same bytes
  }
  set.set(0x00280301, "CS", "NO");  // no annotation burned in
  constexpr std::size_t kLongestTitle = 1024;
  set.set(kDocumentTitle, "ST", shortened(options.name, kLongestTitle));
  set.set_items(0x0040a043, {});  // Concept Name Code Sequence
  set.set(kMimeType, "LO", model.mime_type);
  set.set_items(kUnits, {dicom_code({"mm", "UCUM", "mm"})});
  set.set(kDocument, "OB", document);
  set.set_number(kDocumentLength, "UL", static_cast<std::uint32_t>(document.size()));
}

std::string encapsulated(const Model& model, const TriMesh& surface,
                         const SurfaceWriteOptions& options) {
  constexpr std::size_t kMost = 0xfffffffe;
  const std::string document = model.bytes(surface, options);
  if (document.size() > kMost) {
    throw InputError(message("surface: expected at most ", kMost, " bytes in a DICOM file, found ",
                             document.size()));
  }
  const std::string owner = options.subject.study_uid + " " + options.subject.patient_id;
  const std::array<std::string, 2> sop{model.sop_class,
                                       dicom_uid_of("instance " + owner + document)};
  DicomSetWriter set;
  set.set(dicom::kSopClass, "UI", sop[0]);
  set.set(0x00080018, "UI", sop[1]);
  set_subject(set, options.subject, document);
  set_sources(set, options.subject);
  set_equipment(set);
  set_model(set, model, document, options);
  return dicom_file_bytes(set, sop);
}

/// mm per unit of the coordinates.
double unit_of(const DicomFile& file) {
  const DicomSet* code = first_item(file.elements, kUnits);
  const std::string unit = code ? text_of(*code, kCodeValue) : "mm";
  constexpr std::pair<const char*, double> kKnown[] = {
      {"mm", 1}, {"um", 1e-3}, {"cm", 10}, {"m", 1000}, {"[in_i]", 25.4}};
  for (const auto& [name, mm] : kKnown) {
    if (unit == name) return mm;
  }
  refuse(file.path, "expected a Measurement Unit (0040,08ea) mm, um, cm, m or [in_i], found " +
                        in_quotes(unit));
}

}  // namespace

std::string encapsulated_stl_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  return encapsulated(kModels[0], surface, options);
}

std::string encapsulated_obj_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  return encapsulated(kModels[1], surface, options);
}

SurfaceFile parse_encapsulated(const fs::path& file, std::string_view bytes, MemoryBudget& budget) {
  const DicomFile dicom = parse_dicom(file, bytes, budget);
  if (!dicom.problem.empty()) refuse(file, "broken DICOM file: " + dicom.problem);
  const std::string sop_class = text_of(dicom.elements, dicom::kSopClass);
  const Model* model = model_of(sop_class);
  const auto document = dicom.elements.find(kDocument);
  if (model == nullptr || document == dicom.elements.end()) {
    refuse(file, "expected an Encapsulated STL or OBJ in DICOM, found the SOP class " +
                     in_quotes(sop_class));
  }
  Bytes value = document->second.value;
  const auto length = dicom.elements.find(kDocumentLength);
  if (length != dicom.elements.end() && length->second.value.size() == 4) {
    std::uint32_t stated = 0;  // without the byte that makes it even
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t at = dicom.big_endian ? 3 - n : n;
      stated |= std::uint32_t{length->second.value[at]} << (8 * n);
    }
    value = value.first(std::min<std::size_t>(value.size(), stated));
  }
  SurfaceFile surface =
      model->parse(file, {reinterpret_cast<const char*>(value.data()), value.size()}, budget);
  const double unit = unit_of(dicom);
  for (Vec3& p : surface.surface.points) p = unit * p;
  if (!surface.frame) surface.frame = Frame::kLps;
  return surface;
}

bool is_encapsulated(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::array<char, 4096> begin{};
  const std::size_t got = ByteSource(path, Packing::kPlain).read(begin.data(), begin.size());
  const std::string_view early(begin.data(), got);
  if (!begins_like_dicom(Bytes(reinterpret_cast<const unsigned char*>(early.data()), got))) {
    return false;
  }
  for (const Model& model : kModels) {
    if (early.find(model.sop_class) != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace mesamis::detail::shape_files
