// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What the tests of the readers and writers of clouds share.

#include "io/cloud.h"
#include "io/error.h"
#include "support/made_correspondences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace pcl_flashreg::io {

/** \brief Runs a parser and returns its complaint; empty if it has none. */
template <typename Parser>
std::string
complaintOf(Parser parser, const std::string& bytes)
{
  try {
    parser(bytes);
  }
  catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline bool
contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

inline double
valueOf(const Cloud& cloud, std::size_t i, const std::string& name, std::size_t k = 0)
{
  const Field* field = cloud.find(name);
  if (field == nullptr)
    throw std::runtime_error("no field " + name);
  return loadValue(cloud.point(i), *field, k);
}

template <typename T>
void
append(std::string& bytes, T value, bool big_endian = false)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big_endian)
    std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

/** \brief One of each type, a histogram, and coordinates in doubles. */
inline Cloud
richCloud(std::size_t size)
{
  Cloud cloud;
  cloud.addField("x", ScalarType::Float64);
  cloud.addField("y", ScalarType::Float64);
  cloud.addField("z", ScalarType::Float64);
  cloud.addField("i1", ScalarType::Int8);
  cloud.addField("u1", ScalarType::Uint8);
  cloud.addField("i2", ScalarType::Int16);
  cloud.addField("u2", ScalarType::Uint16);
  cloud.addField("i4", ScalarType::Int32);
  cloud.addField("u4", ScalarType::Uint32);
  cloud.addField("histogram", ScalarType::Float32, 5);
  cloud.width = size;
  cloud.viewpoint = {1.5, -2, 3, 0.5, 0.5, 0.5, 0.5};
  made::Random random(7);
  cloud.data.resize(size * cloud.point_size);
  for (std::size_t i = 0; i < size; ++i)
    for (const Field& field : cloud.fields)
      for (std::size_t k = 0; k < field.count; ++k)
        storeValue(cloud.point(i), field, random.uniform(-100, 200), k);
  return cloud;
}

inline void
expectEqual(const Cloud& a, const Cloud& b)
{
  ASSERT_EQ(a.fields.size(), b.fields.size());
  for (std::size_t f = 0; f < a.fields.size(); ++f) {
    EXPECT_EQ(a.fields[f].name, b.fields[f].name);
    EXPECT_EQ(a.fields[f].type, b.fields[f].type);
    EXPECT_EQ(a.fields[f].count, b.fields[f].count);
  }
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.viewpoint, b.viewpoint);
  EXPECT_EQ(a.data, b.data);
}

} // namespace pcl_flashreg::io
