// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>

namespace pcl_flashreg::align {

/** \brief Tells a person at a terminal, on standard error, which slow stage has begun.
 */
class Progress {
public:
  /** \param[in] quiet say nothing; neither does it where standard error is no terminal
   */
  explicit Progress(bool quiet);

  /** \brief One line. */
  void
  say(const std::string& what) const;

  /** \brief One line that is worth reading in a log as well: no terminal is needed. */
  void
  note(const std::string& what) const;

private:
  bool notes_;
  bool stages_;
};

} // namespace pcl_flashreg::align
