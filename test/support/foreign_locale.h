// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <clocale>
#include <locale>
#include <string>

namespace pcl_flashreg {
namespace test {

/** \brief As long as it lives, streams and, where the system has such a language, C's
 * functions write 1234.5 as 1.234,5: what a program does to a library. */
class ForeignLocale {
public:
  ForeignLocale()
      : streams_before_(
            std::locale::global(std::locale(std::locale::classic(), new Numbers))),
        c_before_(std::setlocale(LC_ALL, nullptr))
  {
    for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "ru_RU.UTF-8"})
      if (std::setlocale(LC_ALL, name))
        return;
  }
  ~ForeignLocale()
  {
    std::locale::global(streams_before_);
    std::setlocale(LC_ALL, c_before_.c_str());
  }
  ForeignLocale(const ForeignLocale&) = delete;
  ForeignLocale&
  operator=(const ForeignLocale&) = delete;

private:
  struct Numbers : std::numpunct<char> {
    char
    do_decimal_point() const override
    {
      return ',';
    }
    char
    do_thousands_sep() const override
    {
      return '.';
    }
    std::string
    do_grouping() const override
    {
      return "\3";
    }
  };

  const std::locale streams_before_;
  const std::string c_before_;
};

} // namespace test
} // namespace pcl_flashreg
