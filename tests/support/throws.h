// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include <functional>
#include <string>

#include "mesamis/base/error.h"

namespace mesamis {

/// Whether an error's message is one line and matches.
inline testing::AssertionResult message_fits(const std::string& message,
                                             const testing::Matcher<const std::string&>& expected) {
  if (expected.Matches(message) && message.find('\n') == std::string::npos) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure()
         << "expected an InputError of one line that "
         << testing::DescribeMatcher<const std::string&>(expected) << ", found: " << message;
}

/// Not a template, as gmock's ThrowsMessage() is: hundreds of uses would each be compiled.
inline testing::AssertionResult is_refused(const std::function<void()>& statement,
                                           const testing::Matcher<const std::string&>& expected) {
  try {
    statement();
  } catch (const InputError& error) {
    return message_fits(error.what(), expected);
  } catch (const std::exception& error) {
    return testing::AssertionFailure() << "expected an InputError, found: " << error.what();
  }
  return testing::AssertionFailure() << "expected an InputError, and nothing was thrown";
}

}  // namespace mesamis

/// An InputError of one line whose message matches.
#define EXPECT_REFUSED(statement, matcher) \
  EXPECT_TRUE(mesamis::is_refused([&] { statement; }, matcher))
