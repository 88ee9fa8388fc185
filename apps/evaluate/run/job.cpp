// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "job.h"

#include "../../io/error.h"
#include "../../io/transform_io.h"
#include "../../batch/front_end.h"
#include "../../io/hash.h"
#include "../methods/registry.h"
#include "../../batch/split.h"

#include <pcl_flashreg/estimator.h>

#include <algorithm>
#include <numeric>

namespace pcl_flashreg::evaluate {
namespace {

std::vector<std::size_t>
selectPairs(const Options& options, const DataSet& data)
{
  std::vector<std::size_t> selected;
  std::size_t number = 0;
  for (std::size_t i = 0; i < data.pairs.size(); ++i) {
    const auto& wanted = options.datasets;
    if (!wanted.empty() &&
        std::find(wanted.begin(), wanted.end(), data.pairs[i].dataset) == wanted.end())
      continue;
    if (number++ % options.every == 0)
      selected.push_back(i);
  }
  if (selected.empty())
    throw io::InputError(options.data + ": holds no pair" +
                         (options.datasets.empty() ? "" : " of these data sets"));
  return selected;
}

void
checkClouds(const Options& options, const Job& job)
{
  for (const std::string& name : options.methods)
    for (const std::size_t i : job.pairs)
      if (findMethod(name)->needs_clouds && !job.data.pairs[i].correspondences.empty())
        throw UsageError("--method: " + name + " needs clouds, but " +
                         job.data.pairs[i].source +
                         " comes with correspondences (--dataset chooses others)");
}

/** \brief Changes with every pair, path and pose of the list. */
std::string
fingerprintOf(const Job& job)
{
  std::string bytes;
  for (const std::size_t i : job.pairs) {
    const Pair& pair = job.data.pairs[i];
    for (const std::string& text : {pair.dataset,
                                    pair.scene,
                                    pair.source,
                                    pair.target,
                                    pair.correspondences,
                                    io::formatTransform(pair.T_target_source),
                                    std::string(pair.refine_truth ? "refined" : "")})
      bytes += text + '\n';
  }
  return io::toHex(io::hashOf(bytes));
}

Config
makeConfig(const Options& options, const Job& job)
{
  Config config;
  config["program"] = std::string("pcl_flashreg_evaluate ") + version();
  config["methods"] = options.methods;
  config["leaf"] = job.data.leaf;
  config["neighbors"] = options.neighbors;
  config["score"] = options.score_name;
  if (options.descriptors != Descriptors::Native)
    config["features"] = options.descriptors_name;
  if (options.data_options.bin_fields != 0)
    config["bin_fields"] = options.data_options.bin_fields;
  config["max_rotation_deg"] = job.data.criterion.max_rotation;
  config["max_translation"] = job.data.criterion.max_translation;
  config["front_end"] = batch::frontEndFingerprint();
  config["pairs"] = job.pairs.size();
  config["pairs_fingerprint"] = fingerprintOf(job);
  if (options.shard.count > 1)
    config["shard"] =
        std::to_string(options.shard.index) + "/" + std::to_string(options.shard.count);
  return config;
}

} // namespace

Job
makeJob(const Options& options)
{
  Job job;
  job.data = openDataSet(options.data, options.data_options);
  job.data.leaf = options.leaf.value_or(job.data.leaf);
  Criterion& criterion = job.data.criterion;
  criterion.max_rotation = options.max_rotation.value_or(criterion.max_rotation);
  criterion.max_translation =
      options.max_translation.value_or(criterion.max_translation);
  job.pairs = selectPairs(options, job.data);
  checkClouds(options, job);
  std::vector<std::size_t> positions(job.pairs.size());
  std::iota(positions.begin(), positions.end(), std::size_t{0});
  job.shard = batch::partOf(positions, options.shard.index - 1, options.shard.count);
  job.parameters = Parameters::fromResolution(job.data.leaf);
  job.parameters.score_metric = options.score;
  job.config = makeConfig(options, job);
  return job;
}

} // namespace pcl_flashreg::evaluate
