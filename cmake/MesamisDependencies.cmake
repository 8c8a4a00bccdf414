# SPDX-License-Identifier: Apache-2.0
# What the io library needs of VTK and ITK: asked for here and again by whoever uses the installed one.
set(MESAMIS_VTK_VERSION 9.1)
set(MESAMIS_VTK_COMPONENTS
  CommonCore CommonDataModel IOCore IOXML IOPLY IOLegacy IOGeometry IOImage FiltersCore
  FiltersGeometry FiltersExtraction ImagingGeneral RenderingCore RenderingAnnotation RenderingFreeType
  RenderingOpenGL2 RenderingContext2D RenderingContextOpenGL2 ChartsCore)
set(MESAMIS_ITK_VERSION 5.2)
set(MESAMIS_ITK_COMPONENTS ITKCommon ITKSmoothing ITKVNL)
