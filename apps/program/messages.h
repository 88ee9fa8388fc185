// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>

namespace pcl_flashreg::program {

/** \brief What a program tells a person, on standard error, while it works. */
class Messages {
public:
  /** \param[in] name of the program
   * \param[in] quiet say nothing */
  Messages(std::string name, bool quiet);

  /** \brief One line: a slow stage has begun. Only where standard error is a terminal. */
  void
  say(const std::string& what) const;

  /** \brief One line that is worth reading in a log as well: no terminal is needed. */
  void
  note(const std::string& what) const;

  /** \brief One line that is no remark, but what was asked for. */
  void
  tell(const std::string& what) const;

private:
  std::string name_;
  bool notes_;
  bool stages_;
};

} // namespace pcl_flashreg::program
