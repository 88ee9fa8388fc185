// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "data_set.h"

#include "../../io/error.h"
#include "correspondence_folders.h"
#include "kitti.h"
#include "pair_list.h"
#include "three_d_match.h"

#include <filesystem>

namespace pcl_flashreg::evaluate {
namespace {

namespace fs = std::filesystem;

DataSet
openFolder(const std::string& path, const DataSetOptions& options)
{
  if (isKitti(path))
    return readKitti(path, options.sequences);
  DataSet data = readThreeDMatch(path);
  if (data.pairs.empty())
    data = readCorrespondenceFolders(path);
  if (data.pairs.empty())
    throw io::InputError(
        path +
        ": holds none of gt.log (3DMatch), sequences/ and poses/ (KITTI), "
        "*_kpts_src.txt with *_trans.txt (TurboReg), *corr*.txt with *GTmat*.txt "
        "(MAC)");
  return data;
}

} // namespace

DataSet
openDataSet(const std::string& path, const DataSetOptions& options)
{
  if (!fs::exists(path))
    throw io::InputError(path + ": there is no such file or folder");
  DataSet data;
  if (fs::is_directory(path))
    data = openFolder(path, options);
  else {
    data.pairs = readPairList(path);
    data.root =
        options.root.empty() ? fs::path(path).parent_path().string() : options.root;
  }
  if (data.root.empty())
    data.root = ".";
  if (options.bin_fields != 0)
    data.bin_fields = options.bin_fields;
  return data;
}

} // namespace pcl_flashreg::evaluate
