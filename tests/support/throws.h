// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include "mesamis/base/error.h"

/// An InputError of one line whose message matches.
#define EXPECT_REFUSED(statement, matcher)                                                        \
  EXPECT_THAT([&] { statement; }, ::testing::ThrowsMessage<mesamis::InputError>(::testing::AllOf( \
                                      matcher, ::testing::Not(::testing::HasSubstr("\n")))))
