// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "outputs.h"

#include "../io/file.h"
#include "../program/output_paths.h"
#include "graph.h"
#include "map_picture.h"
#include "merged_cloud.h"
#include "poses.h"
#include "report.h"

#include <algorithm>
#include <filesystem>

namespace fs = std::filesystem;

namespace pcl_flashreg::map {
namespace {

using program::Messages;

bool
isPosesFileOfOneMap(const Options& options)
{
  return !options.poses.empty() && program::isOfOneGroup(options.pose_format);
}

/** \brief Outputs of which there is a file a map. */
std::vector<std::string>
outputsOfMaps(const Options& options)
{
  std::vector<std::string> paths;
  if (!options.output.empty())
    paths.push_back(options.output);
  if (isPosesFileOfOneMap(options))
    paths.push_back(options.poses);
  return paths;
}

void
checkFolders(const Options& options)
{
  if (options.output.empty())
    return;
  const fs::path folder = fs::absolute(options.output).parent_path();
  for (const std::string& path : options.scans) {
    std::error_code error;
    if (fs::is_directory(path) && fs::equivalent(path, folder, error))
      throw UsageError(options.output +
                       ": lies in the folder of the scans, and would be "
                       "one of them the next time: choose another one");
  }
}

WrittenCloud
writeCloudOf(const Options& options,
             const MapRun& run,
             std::size_t map,
             const Messages& messages)
{
  const std::string path = pathOfMap(options.output, map);
  messages.say("writing " + path);
  std::vector<MapInput> inputs;
  for (const std::size_t scan : run.result.groups[map])
    inputs.push_back({run.scans[scan].path, run.result.scans[scan].T_group_scan});
  return {
      path,
      writeMergedCloud(
          inputs, options.map_leaf.value_or(run.resolution), path, options.bin_fields)};
}

void
writePoses(const Options& options, const MapRun& run, std::size_t maps)
{
  if (options.pose_format == PoseFormat::Csv)
    io::writeFile(options.poses, formatCsv(run));
  else if (options.pose_format == PoseFormat::AsJson)
    io::writeFile(options.poses, formatJson(run, WithTimes::No));
  else
    for (std::size_t map = 0; map < maps; ++map)
      io::writeFile(pathOfMap(options.poses, map),
                    options.pose_format == PoseFormat::Tum ? formatTum(run, map)
                                                           : formatKitti(run, map));
}

/** \brief What is not there, or not of this run, and might be thought to be. */
void
noteMissing(const Options& options, std::size_t maps, const Messages& messages)
{
  for (const std::string& path : outputsOfMaps(options)) {
    if (maps == 0)
      messages.note(path +
                    " is not written, since nothing ties any two scans together");
    const std::string next = pathOfMap(path, std::max<std::size_t>(maps, 1));
    if (fs::exists(next))
      messages.note(next + " was there before, and is not of this run");
  }
}

} // namespace

std::string
pathOfMap(const std::string& path, std::size_t map)
{
  if (map == 0)
    return path;
  const fs::path file(path);
  return (file.parent_path() / (file.stem().string() + '_' + std::to_string(map + 1) +
                                file.extension().string()))
      .string();
}

void
checkOutputs(const Options& options, const std::vector<ScanFile>& files)
{
  std::vector<std::string> inputs{options.list};
  for (const ScanFile& file : files)
    inputs.push_back(file.path);
  std::vector<std::string> outputs{options.output,
                                   options.poses,
                                   options.graph,
                                   options.picture,
                                   options.page,
                                   options.json,
                                   options.pairs};
  // Only what is there can be a scan.
  for (const std::string& path : outputsOfMaps(options))
    for (std::size_t map = 1; map < files.size() / 2; ++map)
      if (fs::exists(pathOfMap(path, map)))
        outputs.push_back(pathOfMap(path, map));
  program::checkOutputPaths(outputs, inputs);
  checkFolders(options);
}

std::vector<WrittenCloud>
writeOutputs(const Options& options,
             const MapRun& run,
             const MultiviewRegistration::ScanSource& source,
             const Messages& messages)
{
  std::size_t maps = numberOfMaps(run.result);
  if (options.largest_only)
    maps = std::min<std::size_t>(maps, 1);
  if (!options.poses.empty())
    writePoses(options, run, maps);
  if (!options.graph.empty())
    io::writeFile(options.graph, formatG2o(run.result));
  if (!options.picture.empty())
    writeMapPicture(options.picture, namesOf(run), run.result, source);
  std::vector<WrittenCloud> clouds;
  if (!options.output.empty())
    for (std::size_t map = 0; map < maps; ++map)
      clouds.push_back(writeCloudOf(options, run, map, messages));
  noteMissing(options, maps, messages);
  return clouds;
}

} // namespace pcl_flashreg::map
