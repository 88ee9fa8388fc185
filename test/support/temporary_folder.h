// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <string>

namespace pcl_flashreg {

/** \brief A folder of its own for every test. */
class FolderTest : public testing::Test {
protected:
  void
  SetUp() override
  {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("pcl_flashreg_" + std::string(test->test_suite_name()) + "_" +
               test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }

  void
  TearDown() override
  {
    std::filesystem::remove_all(folder_);
  }

  /** \brief Of a file in the folder; without a name, the folder's own. */
  std::string
  path(const std::string& name = "") const
  {
    return (name.empty() ? folder_ : folder_ / name).string();
  }

  std::filesystem::path folder_;
};

} // namespace pcl_flashreg
