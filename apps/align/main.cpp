// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "../io/cloud_io.h"
#include "../io/file.h"
#include "../io/pcl_cloud.h"
#include "../io/transform_io.h"
#include "../program/program.h"
#include "inputs.h"
#include "options.h"
#include "pipeline.h"
#include "report.h"
#include "snapshot.h"
#include "viewer.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <pcl/console/print.h>

#include <iostream>

namespace pcl_flashreg::align {
namespace {

/** \brief Exit statuses beside those of program::run(). */
enum Verdict { TRUSTED = 0, NOT_TRUSTED = 1 };

/** \brief The source in the target's frame, with all its fields. */
io::Cloud
alignedCloud(const Inputs& inputs, const RigidTransform& pose, const Messages& messages)
{
  io::Cloud cloud = inputs.source->cloud;
  const bool is_double = cloud.find("x")->type == io::ScalarType::Float64;
  const Eigen::Matrix3Xd& xyz = inputs.source->xyz;
  const Eigen::Matrix3Xd moved = (pose.rotation * xyz).colwise() + pose.translation;
  if (!is_double && io::needsDoublePrecision(moved) && !io::needsDoublePrecision(xyz)) {
    messages.note(
        "the aligned cloud lies too far from the origin for float32: its x, y, "
        "z are written as doubles");
    io::promoteCoordinates(cloud);
  }
  io::transformCloud(cloud, pose);
  return cloud;
}

void
writeOutputs(const Options& options,
             const Inputs& inputs,
             const Outcome& outcome,
             const Messages& messages)
{
  const RigidTransform& pose = outcome.pair.pose.T_target_source;
  if (!options.json.empty()) {
    const std::string json = formatJson(options, outcome);
    if (options.json == "-")
      std::cout << json << std::flush;
    else
      io::writeFile(options.json, json);
  }
  const bool found = outcome.pair.pose.status == Status::Ok;
  if (outcome.pair.pose.converged || (found && options.write_untrusted)) {
    if (!options.transform.empty())
      io::writeFile(options.transform, io::formatTransform(pose));
    if (!options.output.empty())
      io::writeCloud(options.output, alignedCloud(inputs, pose, messages));
  }
  else {
    for (const std::string& path : {options.output, options.transform})
      if (!path.empty())
        messages.note(path + " is not written, since no pose is trusted" +
                      (found ? " (--write-untrusted does)" : ""));
  }
  if (!options.snapshot.empty())
    writeSnapshot(options.snapshot, inputs.source->xyz, inputs.target->xyz, pose);
  if (options.view)
    showClouds(inputs.source->xyz, inputs.target->xyz, pose);
}

Verdict
run(const Options& options)
{
  const Messages messages("pcl_flashreg_align", options.quiet);
  const detail::Stopwatch total;
  const Inputs inputs = readInputs(options, messages);
  const double reading_ms = total.milliseconds();
  Outcome outcome = alignInputs(options, inputs, messages);
  outcome.reading_ms = reading_ms;
  outcome.total_ms = total.milliseconds();
  if (!options.quiet && options.json != "-")
    std::cout << formatReport(options, outcome) << std::flush;
  writeOutputs(options, inputs, outcome, messages);
  return outcome.pair.pose.converged ? TRUSTED : NOT_TRUSTED;
}

} // namespace
} // namespace pcl_flashreg::align

int
main(int argc, char** argv)
{
  using namespace pcl_flashreg;
  // PCL's own messages would stand between the user and ours.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  return program::run("pcl_flashreg_align", [&] {
    const std::optional<align::Options> options = align::parseOptions(argc, argv);
    return options ? align::run(*options) : align::TRUSTED;
  });
}
