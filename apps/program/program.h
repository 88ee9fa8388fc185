// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <new>
#include <stdexcept>
#include <string>

namespace pcl_flashreg::program {

/** \brief The command line asks for something that can't be. */
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief The core names its parameters as in "min_inliers = 1 is ..."; so do programs, but
 * as the option that sets them. */
inline std::string
asOption(std::string message)
{
  const auto name_end =
      message.begin() +
      static_cast<std::ptrdiff_t>(std::min(message.find(' '), message.size()));
  std::replace(message.begin(), name_end, '_', '-');
  return "--" + message;
}

/** rief How every program ends where it can't do what it was asked for. */
enum ExitStatus { USAGE = 2, FAILURE = 3 };

/** \brief What a program's main() does: an error is one line on standard error.
 * \param[in] name of the program
 * \param[in] body returns the exit status
 * \return the body's, or USAGE after a UsageError, or FAILURE after any other exception
 */
template <typename Body>
int
run(const char* name, const Body& body)
{
  const auto fail = [name](ExitStatus status, const char* message) {
    std::fprintf(stderr, "%s: error: %s\n", name, message);
    return status;
  };
  try {
    return body();
  }
  catch (const UsageError& error) {
    return fail(USAGE, error.what());
  }
  catch (const std::bad_alloc&) {
    return fail(FAILURE, "not enough memory");
  }
  catch (const std::exception& error) {
    return fail(FAILURE, error.what());
  }
}

} // namespace pcl_flashreg::program
