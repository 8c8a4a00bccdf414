# SPDX-License-Identifier: Apache-2.0
set(ROOM_HEADERS
  flow_memberships.h
  label_block.h
  label_confidence.h
  label_image.h
  pair_levels.h
  probable_memberships.h)
set(ROOM_SOURCES
  flow_memberships.cpp
  label_block.cpp
  label_confidence.cpp
  label_flow.cpp
  label_image.cpp
  pair_levels.cpp
  probable_memberships.cpp)
