# SPDX-License-Identifier: Apache-2.0
# What the room baseline needs of VTK and ITK: asked for here and again by whoever uses the installed library.
set(MESAMIS_VTK_VERSION 9.1)
set(MESAMIS_VTK_COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel FiltersCore ImagingCore ImagingGeneral)
set(MESAMIS_ITK_VERSION 5.2)
set(MESAMIS_ITK_COMPONENTS ITKCommon ITKSmoothing ITKVNL)
