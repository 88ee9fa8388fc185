// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "error.h"
#include "ply.h"
#include "ply_camera.h"

#include <locale>
#include <sstream>

namespace pcl_flashreg::io {
namespace {

const char*
plyType(const Field& field)
{
  switch (field.type) {
  case ScalarType::Int8:
    return "char";
  case ScalarType::Uint8:
    return "uchar";
  case ScalarType::Int16:
    return "short";
  case ScalarType::Uint16:
    return "ushort";
  case ScalarType::Int32:
    return "int";
  case ScalarType::Uint32:
    return "uint";
  case ScalarType::Float32:
    return "float";
  case ScalarType::Float64:
    return "double";
  default:
    throw InputError(
        "the field '" + field.name +
        "' holds 64-bit integers, which PLY does not have: write a .pcd file");
  }
}

} // namespace

std::string
formatPly(const Cloud& cloud)
{
  const Cloud named = toPlyFields(cloud);
  std::ostringstream header;
  header.imbue(std::locale::classic());
  header << "ply\nformat binary_little_endian 1.0\nelement vertex " << named.size()
         << '\n';
  for (const Field& field : named.fields)
    for (std::size_t k = 0; k < field.count; ++k) {
      header << "property " << plyType(field) << ' ' << field.name;
      if (field.count > 1)
        header << '_' << k;
      header << '\n';
    }
  const PlyCamera camera = cameraOf(cloud);
  header << camera.header << "end_header\n";
  std::string bytes = header.str();
  bytes.append(reinterpret_cast<const char*>(named.data.data()), named.data.size());
  bytes += camera.row;
  return bytes;
}

} // namespace pcl_flashreg::io
