// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/foreign_format.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

struct ForeignFormat {
  std::string_view extension, name, way_out;
};

constexpr std::string_view kOme = "save it as OME-TIFF (Fiji, bfconvert)",
                           kNrrd = "save it as NRRD or TIFF", kStl = "save it as STL",
                           kDicom = "export its images as DICOM",
                           kMesh = "meshes are read as .vtu and .mesh";

constexpr std::array kForeign{
    ForeignFormat{".czi", "a Zeiss CZI file", kOme},
    ForeignFormat{".lif", "a Leica LIF file", kOme},
    ForeignFormat{".oib", "an Olympus OIB file", kOme},
    ForeignFormat{".oif", "an Olympus OIF file", kOme},
    ForeignFormat{".oir", "an Olympus OIR file", kOme},
    ForeignFormat{".nd2", "a Nikon ND2 file", kOme},
    ForeignFormat{".dv", "a DeltaVision file", kOme},
    ForeignFormat{".ims", "an Imaris file", kOme},
    ForeignFormat{".mnc", "a MINC file", "convert it to NIfTI (mnc2nii)"},
    ForeignFormat{".head", "an AFNI file", "convert it to NIfTI (3dAFNItoNIFTI)"},
    ForeignFormat{".brik", "an AFNI file", "convert it to NIfTI (3dAFNItoNIFTI)"},
    ForeignFormat{".par", "a Philips PAR/REC file", "convert it to NIfTI (dcm2niix)"},
    ForeignFormat{".rec", "a Philips PAR/REC file", "convert it to NIfTI (dcm2niix)"},
    ForeignFormat{".v", "an ECAT file", "convert it to NIfTI (dcm2niix)"},
    ForeignFormat{".am", "an Amira file", kNrrd},
    ForeignFormat{".vff", "a VFF file", kNrrd},
    ForeignFormat{".gipl", "a GIPL file", kNrrd},
    ForeignFormat{".vti", "a VTK image", kNrrd},
    ForeignFormat{".mrc", "an MRC file", kNrrd},
    ForeignFormat{".npy", "a NumPy array", "save it as NRRD, or read it by --raw"},
    ForeignFormat{".txm", "a Zeiss (Xradia) TXM file", "export its slices as TIFF or DICOM"},
    ForeignFormat{".txrm", "projections of Zeiss (Xradia)", "export reconstructed slices as TIFF"},
    ForeignFormat{".rsq", "projections of Scanco", "take the reconstructed ISQ"},
    ForeignFormat{".rad", "a radiograph of Scanco", "take the reconstructed ISQ"},
    ForeignFormat{".mcs", "a Mimics project", kDicom},
    ForeignFormat{".mimics", "a Mimics project", kDicom},
    ForeignFormat{".sip", "a Simpleware project", kDicom},
    ForeignFormat{".vgl", "a VGSTUDIO project", "take its .vgi and .vol"},
    ForeignFormat{".hx", "an Amira project", kNrrd},
    ForeignFormat{".mrb", "a scene of 3D Slicer", "unpack it and take the volume inside"},
    ForeignFormat{".mrml", "a scene of 3D Slicer", "take the volume that it names"},
    ForeignFormat{".inp", "a mesh of Abaqus or CalculiX", kMesh},
    ForeignFormat{".feb", "a mesh of FEBio", kMesh},
    ForeignFormat{".msh", "a mesh of Gmsh", kMesh},
    ForeignFormat{".off", "a surface", kStl},
    ForeignFormat{".wrl", "a surface", kStl},
    ForeignFormat{".gii", "a surface", kStl}};

}  // namespace

std::string foreign_format(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  const auto* found = std::find_if(kForeign.begin(), kForeign.end(), [&](const ForeignFormat& f) {
    return f.extension == extension;
  });
  return found == kForeign.end() ? "" : message(found->name, ": ", found->way_out);
}

}  // namespace mesamis::detail::volume_files
