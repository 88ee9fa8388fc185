// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Results: rows, files, sums and what a killed run leaves.

#include "io/csv.h"
#include "evaluate/results/report.h"
#include "evaluate/run/parts.h"
#include "batch/parts.h"
#include "batch/progress.h"
#include "batch/split.h"
#include "evaluate_support.h"
#include "support/foreign_locale.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_flashreg::evaluate {
namespace {

class EvaluateResults : public EvaluateTest {
protected:
  void
  SetUp() override
  {
    EvaluateTest::SetUp();
    config_ = {{"methods", {"fast", "slow"}}, {"leaf", 0.05}, {"pairs", 3}};
  }

  /** \brief Two records a pair; pair k takes the fast method k ms, and the slow ten times
   * as long. */
  std::vector<Record>
  records(std::size_t pair) const
  {
    Record r;
    r.pair = pair;
    r.dataset = "Rooms, large";
    r.scene = pair < 2 ? "kitchen" : "the \"den\"";
    r.source = "a.ply";
    r.target = "b.ply";
    r.correspondences = 100 * (pair + 1);
    r.inlier_ratio = 0.1 * static_cast<double>(pair);
    r.inliers = 7;
    r.confidence = std::numeric_limits<double>::infinity();
    r.rotation_error = 1.0 / 3;
    r.translation_error = 0.1 * static_cast<double>(pair);
    r.found = r.success = true;
    r.trusted = pair == 0;
    r.method = "fast";
    r.times.features = 5;
    r.times.estimation = static_cast<double>(pair);
    r.times.stages.emplace();
    r.times.stages->refinement = 0.25;
    r.times.stages->cloud_check = 0.5;
    Record slow = r;
    slow.method = "slow";
    slow.success = pair == 0;
    slow.trusted = true;
    slow.times.estimation *= 10;
    slow.times.stages.reset();
    return {r, slow};
  }

  Results
  results(std::size_t from, std::size_t to) const
  {
    Results some{config_, {}};
    for (std::size_t pair = from; pair < to; ++pair)
      for (const Record& record : records(pair))
        some.records.push_back(record);
    return some;
  }

  std::string
  mergeComplaint(const std::vector<std::string>& names) const
  {
    std::vector<std::string> files;
    for (const std::string& name : names)
      files.push_back(path(name));
    return complaintOf([&] { mergeShards(files); });
  }

  Config config_;
};

TEST_F(EvaluateResults, cellsSurviveACsvLine)
{
  const std::vector<std::string> cells = {"", "a,b", "say \"x\"", "plain", ""};
  EXPECT_EQ(io::splitCsv(io::joinCsv(cells)), cells);
  EXPECT_EQ(io::joinCsv({"1", "x"}), "1,x");
  EXPECT_EQ(io::toText(0.1), "0.1");
  EXPECT_EQ(std::stod(io::toText(1.0 / 3)), 1.0 / 3);
}

TEST_F(EvaluateResults, filesHoldEverything)
{
  writeResults(path("r.csv"), results(0, 3));
  const Results read = readResults(path("r.csv"));
  EXPECT_EQ(read.config, config_);
  ASSERT_EQ(read.records.size(), 6u);
  const Record& r = read.records[5];
  EXPECT_EQ(r.pair, 2u);
  EXPECT_EQ(r.dataset, "Rooms, large");
  EXPECT_EQ(r.scene, "the \"den\"");
  EXPECT_EQ(r.method, "slow");
  EXPECT_EQ(r.correspondences, 300u);
  EXPECT_EQ(r.inlier_ratio, 0.2);
  EXPECT_EQ(r.rotation_error, 1.0 / 3);
  EXPECT_TRUE(r.found && r.trusted && !r.success);
  EXPECT_TRUE(std::isinf(r.confidence));
  EXPECT_EQ(r.times.features, 5);
  EXPECT_EQ(r.times.estimation, 20);
  EXPECT_FALSE(r.times.stages);
  ASSERT_TRUE(read.records[4].times.stages);
  EXPECT_EQ(read.records[4].times.stages->refinement, 0.25);
  EXPECT_EQ(read.records[4].times.stages->cloud_check, 0.5);
  writeResults(path("again.csv"), read);
  EXPECT_EQ(this->read("again.csv"), this->read("r.csv"));
  EXPECT_EQ(this->read("again.times.csv"), this->read("r.times.csv"));
}

TEST_F(EvaluateResults, timesStandInAFileOfTheirOwn)
{
  EXPECT_EQ(timesPath("a/b.csv"), "a/b.times.csv");
  Results slower = results(0, 3);
  for (Record& record : slower.records)
    record.times.estimation += 1;
  writeResults(path("a.csv"), results(0, 3));
  writeResults(path("b.csv"), slower);
  EXPECT_EQ(read("a.csv"), read("b.csv"));
  EXPECT_NE(read("a.times.csv"), read("b.times.csv"));
}

TEST_F(EvaluateResults, appendedRowsAreTheSameBytes)
{
  writeResults(path("whole.csv"), results(0, 3));
  writeResults(path("r.csv"), results(0, 1));
  ResultsAppender appender(path("r.csv"));
  appender.append(records(1));
  appender.append(records(2));
  EXPECT_EQ(read("r.csv"), read("whole.csv"));
  EXPECT_EQ(read("r.times.csv"), read("whole.times.csv"));
}

TEST_F(EvaluateResults, whereverAFileBreaksOffWholePairsAreLeft)
{
  writeResults(path("r.csv"), results(0, 3));
  const std::string rows = read("r.csv"), times = read("r.times.csv");
  std::size_t header = rows.find('\n') + 1;
  header = rows.find('\n', header) + 1;
  for (std::size_t size = header; size <= rows.size(); ++size) {
    write("r.csv", rows.substr(0, size));
    const Results left = readResults(path("r.csv"));
    const auto lines = static_cast<std::size_t>(
        std::count(rows.begin(), rows.begin() + static_cast<long>(size), '\n') - 2);
    ASSERT_EQ(left.records.size(), lines / 2 * 2) << size;
  }
  write("r.csv", rows);
  write("r.times.csv", times.substr(0, times.size() - 3));
  EXPECT_EQ(readResults(path("r.csv")).records.size(), 4u);
}

TEST_F(EvaluateResults, badRowsNameFileAndLine)
{
  writeResults(path("r.csv"), results(0, 3));
  const std::string good = read("r.csv");
  const auto complaintAfter = [&](const std::string& from, const std::string& to) {
    std::string bad = good;
    bad.replace(bad.find(from), from.size(), to);
    write("r.csv", bad);
    return complaintOf([&] { readResults(path("r.csv")); });
  };
  const std::string file = path("r.csv") + ": ";
  EXPECT_EQ(complaintAfter(",fast,100,", ",fast,many,"),
            file + "line 3: column correspondences: 'many' is not a count");
  EXPECT_EQ(complaintAfter(",fast,100,0,1,1,", ",fast,100,0,1,2,"),
            file + "line 3: column success: '2' is not 0 or 1");
  EXPECT_EQ(complaintAfter(",fast,100,", ",fast,"),
            file + "line 3: found 33 columns, expected 34");
  EXPECT_EQ(complaintAfter("pair,dataset", "dataset").find(file + "line 2: "), 0u);
  EXPECT_EQ(complaintAfter("# {", "{"),
            file + "line 1: is not the configuration of an evaluation");
}

TEST_F(EvaluateResults, partsOfRanksAreFoundWhateverTheirNumber)
{
  writeResults(path("r.csv"), results(0, 1));
  writeResults(batch::partPath(path("r.csv"), RANK, 0), results(2, 3));
  writeResults(batch::partPath(path("r.csv"), RANK, 17), results(1, 2));
  write("r.csv.rank17.bak", "not ours");
  const Results all = readWithParts(path("r.csv"), config_);
  writeResults(path("all.csv"), all);
  writeResults(path("whole.csv"), results(0, 3));
  EXPECT_EQ(read("all.csv"), read("whole.csv"));
  removeParts(path("r.csv"));
  EXPECT_FALSE(fs::exists(batch::partPath(path("r.csv"), RANK, 17)));
  EXPECT_FALSE(fs::exists(timesPath(batch::partPath(path("r.csv"), RANK, 17))));
  EXPECT_TRUE(fs::exists(path("r.csv.rank17.bak")));
  EXPECT_EQ(readWithParts(path("r.csv"), config_).records.size(), 2u);
}

TEST_F(EvaluateResults, otherSettingsAreNotGoneOnWith)
{
  writeResults(path("r.csv"), results(0, 1));
  config_["leaf"] = 0.06;
  EXPECT_EQ(complaintOf([&] { readWithParts(path("r.csv"), config_); }),
            path("r.csv") + ": was made with other settings: leaf was 0.05, is 0.06");
  config_["leaf"] = 0.05;
  config_["more"] = 1;
  EXPECT_EQ(batch::difference(results(0, 1).config, config_), "");
  EXPECT_EQ(batch::difference({{"a", 1}}, {{"a", 1}, {"b", 2}}), "b was not set, is 2");
  EXPECT_EQ(batch::difference({{"a", 1}, {"b", 2}}, {{"a", 1}}), "b was 2, is not set");
}

TEST_F(EvaluateResults, shardsMakeTheWhole)
{
  writeResults(path("whole.csv"), results(0, 3));
  Results first = results(0, 2), second = results(2, 3);
  first.config["shard"] = "1/2";
  second.config["shard"] = "2/2";
  writeResults(path("1.csv"), first);
  writeResults(path("2.csv"), second);
  writeResults(path("merged.csv"), mergeShards({path("2.csv"), path("1.csv")}));
  EXPECT_EQ(read("merged.csv"), read("whole.csv"));

  EXPECT_EQ(
      mergeComplaint({"1.csv"}),
      "1 of 3 pairs are in no file, first pair 2: finish the shards with --resume");
  EXPECT_EQ(mergeComplaint({"1.csv", "2.csv", "whole.csv"}),
            path("whole.csv") + ": has pairs that another file has, too");
  second.config["leaf"] = 0.1;
  writeResults(path("2.csv"), second);
  EXPECT_EQ(mergeComplaint({"1.csv", "2.csv"}),
            path("2.csv") + ": was made with other settings than " + path("1.csv") +
                ": leaf was 0.05, is 0.1");
}

TEST_F(EvaluateResults, sumsAreRight)
{
  const std::vector<GroupSummary> groups = summarize(results(0, 3));
  ASSERT_EQ(groups.size(), 3u); // kitchen, den, both
  EXPECT_EQ(groups[0].scene, "kitchen");
  EXPECT_EQ(groups[0].pairs, 2u);
  EXPECT_EQ(groups[2].scene, "");
  const GroupSummary& all = groups[2];
  EXPECT_EQ(all.pairs, 3u);
  EXPECT_NEAR(all.inlier_ratio.mean, 0.1, 1e-12);
  EXPECT_EQ(all.correspondences.median, 200);
  const MethodSummary &fast = all.methods[0], &slow = all.methods[1];
  EXPECT_EQ(fast.recall, 1);
  EXPECT_EQ(fast.precision, 1);
  EXPECT_NEAR(fast.verdict_recall, 1.0 / 3, 1e-12);
  EXPECT_NEAR(fast.translation_error.mean, 0.1, 1e-12);
  EXPECT_NEAR(fast.translation_error.median, 0.1, 1e-12);
  EXPECT_EQ(fast.estimation_ms.median, 1);
  EXPECT_NEAR(fast.estimation_ms.p95, 1.9, 1e-12);
  ASSERT_EQ(fast.stages_ms.size(), STAGES.size());
  EXPECT_EQ(fast.stages_ms[7].name, "refinement");
  EXPECT_EQ(fast.stages_ms[7].spread.median, 0.25);
  EXPECT_EQ(fast.stages_ms[8].name, "cloud_check");
  EXPECT_EQ(fast.stages_ms[8].spread.median, 0.5);
  EXPECT_NEAR(slow.recall, 1.0 / 3, 1e-12);
  EXPECT_NEAR(slow.precision, 1.0 / 3, 1e-12);
  EXPECT_NEAR(slow.recall_difference, -2.0 / 3, 1e-12);
  EXPECT_EQ(slow.time_ratio, 10);
  EXPECT_TRUE(slow.stages_ms.empty());
  // Nobody trusted anything in the den.
  EXPECT_TRUE(std::isnan(groups[1].methods[0].precision));
}

TEST_F(EvaluateResults, jsonSaysTheSame)
{
  const Results some = results(0, 3);
  const auto json = nlohmann::json::parse(formatJson(some.config, summarize(some)));
  EXPECT_EQ(json["config"]["leaf"], 0.05);
  ASSERT_EQ(json["groups"].size(), 3u);
  const auto& den = json["groups"][1];
  EXPECT_EQ(den["scene"], "the \"den\"");
  EXPECT_TRUE(den["methods"][0]["verdict"]["precision"].is_null());
  const auto& all = json["groups"][2];
  EXPECT_TRUE(all["scene"].is_null());
  EXPECT_EQ(all["pairs"], 3);
  const auto& slow = all["methods"][1];
  EXPECT_EQ(slow["method"], "slow");
  EXPECT_EQ(slow["successes"], 1);
  EXPECT_EQ(slow["verdict"]["trusted"], 3);
  EXPECT_EQ(slow["time_ratio"], 10);
  EXPECT_EQ(slow["times_ms"]["estimation"]["median"], 10);
  EXPECT_FALSE(slow["times_ms"].contains("refinement"));
  EXPECT_EQ(all["methods"][0]["times_ms"]["refinement"]["p95"], 0.25);
}

TEST_F(EvaluateResults, tablesNameEveryGroupAndMethod)
{
  const std::string table = formatTable(summarize(results(0, 3)));
  for (const char* text :
       {"Rooms, large / kitchen: 2 pairs", "Rooms, large: 3 pairs", "  fast", "  slow"})
    EXPECT_NE(table.find(text), std::string::npos) << text << '\n' << table;
}

TEST_F(EvaluateResults, areTheSameInEveryLocale)
{
  Results some = results(0, 3);
  for (Record& record : some.records)
    record.times.estimation += 1234.5;
  writeResults(path("home.csv"), some);
  const std::string json = formatJson(some.config, summarize(some));
  const test::ForeignLocale abroad;
  writeResults(path("abroad.csv"), readResults(path("home.csv")));
  EXPECT_EQ(read("abroad.csv"), read("home.csv"));
  EXPECT_EQ(read("abroad.times.csv"), read("home.times.csv"));
  EXPECT_EQ(formatJson(some.config, summarize(some)), json);
}

TEST(EvaluateProgress, tellsRateAndTimeLeft)
{
  EXPECT_EQ(batch::progressText(40, 100, 20, false, "pairs"),
            "40/100 pairs  2/s  0:30 left");
  EXPECT_EQ(batch::progressText(1, 7201, 1, false, "pairs"),
            "1/7201 pairs  1/s  2:00:00 left");
  EXPECT_EQ(batch::progressText(0, 100, 0, false, "pairs"), "0/100 pairs");
  EXPECT_EQ(batch::progressText(50, 100, 50, true, "pairs"),
            "[###############...............]  50/100 pairs  1/s  0:50 left");
}

TEST(EvaluateSplit, partsAreTheWholeInOrder)
{
  std::vector<int> items(17), joined;
  for (int i = 0; i < 17; ++i)
    items[static_cast<std::size_t>(i)] = i;
  for (std::size_t part = 0; part < 5; ++part) {
    const auto some = batch::partOf(items, part, 5);
    EXPECT_GE(some.size(), 3u);
    joined.insert(joined.end(), some.begin(), some.end());
  }
  EXPECT_EQ(joined, items);
  EXPECT_TRUE(batch::partOf(std::vector<int>{1}, 0, 2).empty());
}

} // namespace
} // namespace pcl_flashreg::evaluate
