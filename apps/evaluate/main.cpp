// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_evaluate: registers the pairs of a list and compares with their poses.

#include "../io/cloud_io.h"
#include "../io/correspondence_io.h"
#include "../io/error.h"
#include "../io/file.h"
#include "../io/number_table.h"
#include "../io/pcl_cloud.h"
#include "pairs.h"

#include <pcl_flashreg/estimator.h>
#include <pcl_flashreg/feature_matching.h>
#include <pcl_flashreg/fpfh_features.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>

namespace pcl_flashreg::evaluate {
namespace {

constexpr double DEGREES = 180 / 3.14159265358979323846;

struct Options {
  std::string pairs_file;
  std::string root;
  std::vector<std::string> datasets;
  double leaf = 0.05;
  double max_rotation = 15;
  double max_translation = 0.3;
  std::size_t neighbors = 1;
  unsigned threads = 0;
  std::string csv;
  Parameters parameters;
};

/** \brief How one pair came out. */
struct Outcome {
  Result result;
  std::size_t correspondences = 0;
  /** \brief Share of the correspondences that agree with the true pose. */
  double inlier_ratio = 0;
  double matching_ms = 0;
  double rotation_error = 180;
  double translation_error = 0;
  bool success = false;
};

struct Input {
  std::vector<double> source, target;
  std::vector<float> ranks;
};

double
millisecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() -
                                                   start)
      .count();
}

void
append(std::vector<double>& xyz, const Eigen::Vector3d& point)
{
  xyz.insert(xyz.end(), point.data(), point.data() + 3);
}

/** \brief Features of the clouds seen so far: a cloud belongs to many pairs. */
class FeatureStore {
public:
  FeatureStore(std::string root, double leaf, unsigned threads)
      : root_(std::move(root)), leaf_(leaf), threads_(threads)
  {
  }

  struct Entry {
    FpfhCloud keypoints;
    Eigen::Vector3d shift;
  };

  const Entry&
  get(const std::string& path)
  {
    const auto found = entries_.find(path);
    if (found != entries_.end())
      return found->second;
    const io::ShiftedCloud cloud =
        io::toPclCloud(io::coordinates(io::readCloud(root_ + "/" + path)));
    return entries_
        .emplace(path,
                 Entry{computeFpfh(*cloud.points, {}, leaf_, threads_), cloud.shift})
        .first->second;
  }

private:
  std::string root_;
  double leaf_;
  unsigned threads_;
  std::map<std::string, Entry> entries_;
};

FeatureView
viewOf(const FpfhCloud& cloud)
{
  const auto& features = *cloud.features;
  return {features.empty() ? nullptr : features[0].histogram,
          features.size(),
          33,
          sizeof(pcl::FPFHSignature33) / sizeof(float)};
}

Input
matchClouds(FeatureStore& store, const Pair& pair, const Options& options)
{
  const FeatureStore::Entry& source = store.get(pair.source);
  const FeatureStore::Entry& target = store.get(pair.target);
  Input input;
  for (const FeatureMatch& match : matchFeatures(viewOf(source.keypoints),
                                                 viewOf(target.keypoints),
                                                 options.neighbors,
                                                 options.threads)) {
    append(input.source,
           (*source.keypoints.points)[match.query].getVector3fMap().cast<double>() +
               source.shift);
    append(input.target,
           (*target.keypoints.points)[match.match].getVector3fMap().cast<double>() +
               target.shift);
    input.ranks.push_back(match.squared_distance);
  }
  return input;
}

Input
readCorrespondences(const std::string& path)
{
  const std::string mark = "{src,dst}";
  const std::size_t at = path.find(mark);
  const auto table = [](const std::string& file) {
    return io::parseNumberTable(io::readFile(file));
  };
  io::Correspondences points;
  if (at == std::string::npos)
    points = io::fromCoordinates(table(path));
  else {
    const std::string before = path.substr(0, at),
                      after = path.substr(at + mark.size());
    points = io::fromPointTables(table(before + "src" + after),
                                 table(before + "dst" + after));
  }
  Input input;
  input.source.assign(points.source.data(),
                      points.source.data() + points.source.size());
  input.target.assign(points.target.data(),
                      points.target.data() + points.target.size());
  return input;
}

double
inlierRatio(const Input& input, const RigidTransform& T, double inlier_distance)
{
  const std::size_t n = input.source.size() / 3;
  std::size_t inliers = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Map<const Eigen::Vector3d> s(&input.source[3 * i]),
        t(&input.target[3 * i]);
    inliers += (T.rotation * s + T.translation - t).norm() < inlier_distance;
  }
  return n == 0 ? 0 : static_cast<double>(inliers) / static_cast<double>(n);
}

Outcome
registerPair(FeatureStore& store,
             Estimator& estimator,
             const Pair& pair,
             const Options& options)
{
  Outcome outcome;
  const auto start = std::chrono::steady_clock::now();
  const Input input =
      pair.correspondences.empty()
          ? matchClouds(store, pair, options)
          : readCorrespondences(options.root + "/" + pair.correspondences);
  outcome.matching_ms = millisecondsSince(start);
  outcome.correspondences = input.source.size() / 3;
  outcome.inlier_ratio =
      inlierRatio(input, pair.T_target_source, options.parameters.inlier_distance);
  const CorrespondenceView<double> view{input.source.data(),
                                        input.target.data(),
                                        outcome.correspondences,
                                        input.ranks.empty() ? nullptr
                                                            : input.ranks.data()};
  outcome.result = estimator.estimate(view, options.parameters);
  const RigidTransform& found = outcome.result.T_target_source;
  outcome.rotation_error = DEGREES * Eigen::AngleAxisd(found.rotation.transpose() *
                                                       pair.T_target_source.rotation)
                                         .angle();
  outcome.translation_error =
      (found.translation - pair.T_target_source.translation).norm();
  outcome.success = outcome.result.status == Status::Ok &&
                    outcome.rotation_error < options.max_rotation &&
                    outcome.translation_error < options.max_translation;
  return outcome;
}

double
median(std::vector<double> values)
{
  if (values.empty())
    return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** \brief One line a data set: recall, errors of the successes, the verdict, the time. */
void
printSummary(const std::string& dataset, const std::vector<Outcome>& outcomes)
{
  std::size_t successes = 0, accepted = 0, rightly = 0;
  double rotation = 0, translation = 0;
  std::vector<double> estimate_ms;
  for (const Outcome& outcome : outcomes) {
    successes += outcome.success;
    accepted += outcome.result.converged;
    rightly += outcome.result.converged && outcome.success;
    if (outcome.success) {
      rotation += outcome.rotation_error;
      translation += outcome.translation_error;
    }
    estimate_ms.push_back(outcome.result.timings_ms.total);
  }
  const auto percent = [](std::size_t part, std::size_t whole) {
    return whole == 0 ? 0.0
                      : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  };
  const double n = static_cast<double>(std::max<std::size_t>(1, successes));
  std::printf("%-16s %5zu pairs  recall %6.2f %%  RE %.2f deg  TE %.3f  "
              "verdict: precision %6.2f %% recall %6.2f %%  estimation %.2f ms\n",
              dataset.c_str(),
              outcomes.size(),
              percent(successes, outcomes.size()),
              rotation / n,
              translation / n,
              percent(rightly, accepted),
              percent(rightly, successes),
              median(estimate_ms));
  std::fflush(stdout);
}

void
writeRow(std::ostream& csv, const Pair& pair, const Outcome& o)
{
  csv << pair.dataset << ',' << pair.source << ',' << pair.target << ',' << o.success
      << ',' << o.result.converged << ',' << o.rotation_error << ','
      << o.translation_error << ',' << o.correspondences << ',' << o.inlier_ratio << ','
      << o.result.inliers.size() << ',' << o.result.distinctness << ',' << o.matching_ms
      << ',' << o.result.timings_ms.total << std::endl;
}

int
run(const Options& options)
{
  const std::vector<Pair> pairs = readPairs(options.pairs_file);
  std::ofstream csv;
  if (!options.csv.empty()) {
    csv.open(options.csv);
    csv << "dataset,source,target,success,converged,rotation_error_deg,translation_"
           "error,"
           "correspondences,inlier_ratio,inliers,distinctness,matching_ms,estimation_"
           "ms\n";
    if (!csv)
      throw io::InputError(options.csv + ": cannot be written");
  }
  FeatureStore store(options.root, options.leaf, options.threads);
  Estimator estimator(BackendKind::Auto, options.threads);
  std::map<std::string, std::vector<Outcome>> outcomes;
  for (const Pair& pair : pairs) {
    const auto& wanted = options.datasets;
    if (!wanted.empty() &&
        std::find(wanted.begin(), wanted.end(), pair.dataset) == wanted.end())
      continue;
    outcomes[pair.dataset].push_back(registerPair(store, estimator, pair, options));
    if (csv.is_open())
      writeRow(csv, pair, outcomes[pair.dataset].back());
  }
  for (const auto& [dataset, results] : outcomes)
    printSummary(dataset, results);
  return outcomes.empty() ? 1 : 0;
}

void
declareOptions(CLI::App& app, Options& options)
{
  app.add_option("pairs", options.pairs_file, "list of pairs (pairs.tsv)")->required();
  app.add_option("--root", options.root, "folder of the clouds; default: of the list");
  app.add_option("--dataset", options.datasets, "only these data sets");
  app.add_option("--leaf", options.leaf, "resolution")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--max-rotation", options.max_rotation, "success: degrees")
      ->capture_default_str();
  app.add_option("--max-translation", options.max_translation, "success: length")
      ->capture_default_str();
  app.add_option("--neighbors", options.neighbors, "matches a feature")
      ->capture_default_str();
  app.add_option("--threads", options.threads, "CPU threads; 0: all");
  app.add_option("--csv", options.csv, "a row a pair");
}

} // namespace
} // namespace pcl_flashreg::evaluate

int
main(int argc, char** argv)
{
  using namespace pcl_flashreg;
  CLI::App app{"Registers the pairs of a list and compares with their true poses"};
  evaluate::Options options;
  evaluate::declareOptions(app, options);
  std::string second_order = "auto", score = "inliers";
  app.add_option("--second-order", second_order)
      ->check(CLI::IsMember({"auto", "exact", "bounded"}));
  app.add_option("--score", score)->check(CLI::IsMember({"inliers", "mae", "mse"}));
  CLI11_PARSE(app, argc, argv);
  try {
    options.parameters = Parameters::fromResolution(options.leaf);
    options.parameters.second_order = second_order == "exact"     ? SecondOrder::Exact
                                      : second_order == "bounded" ? SecondOrder::Bounded
                                                                  : SecondOrder::Auto;
    options.parameters.score_metric = score == "mae"   ? ScoreMetric::Mae
                                      : score == "mse" ? ScoreMetric::Mse
                                                       : ScoreMetric::Inliers;
    if (options.root.empty()) {
      const std::size_t slash = options.pairs_file.rfind('/');
      options.root =
          slash == std::string::npos ? "." : options.pairs_file.substr(0, slash);
    }
    return evaluate::run(options);
  }
  catch (const std::exception& error) {
    std::fprintf(stderr, "pcl_flashreg_evaluate: error: %s\n", error.what());
    return 3;
  }
}
