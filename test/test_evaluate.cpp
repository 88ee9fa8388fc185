// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_evaluate as a user runs it: answers, exit codes, runs that are killed,
// shards and ranks.

#include "evaluate_support.h"
#include "support/ranks.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace pcl_flashreg::evaluate {
namespace {

/** \brief Of other libraries: there only where CMake found those. */
constexpr const char* OPTIONAL_METHODS[] = {
    "open3d_ransac", "open3d_fgr", "teaser", "kiss_matcher"};

class Evaluate : public EvaluateTest {
protected:
  /** \param[in] arguments as they are typed into a shell */
  ProgramRun
  evaluate(const std::string& arguments, const std::string& launcher = "") const
  {
    return runProgram(PCL_FLASHREG_EVALUATE, arguments, launcher);
  }

  void
  expectFailure(const std::string& arguments, int status, const std::string& why) const
  {
    const ProgramRun run = evaluate(arguments);
    EXPECT_EQ(run.status, status) << arguments;
    EXPECT_EQ(run.err.find("pcl_flashreg_evaluate: error: "), 0u) << run.err;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }

  /** \brief --help lists the method. */
  bool
  offers(const std::string& method) const
  {
    return evaluate("--help").out.find("\n  " + method + " ") != std::string::npos;
  }

  std::size_t
  lines(const std::string& name) const
  {
    const std::string text = read(name);
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  /** \brief Starts the program in the folder and kills it, with no chance to tidy up, as
   * soon as a file has that many lines.
   * \return whether it was still running
   */
  bool
  killAfter(std::vector<std::string> arguments,
            const std::string& file,
            std::size_t enough) const
  {
    arguments.insert(arguments.begin(), PCL_FLASHREG_EVALUATE);
    const ::pid_t child = ::fork();
    if (child == 0) {
      std::vector<char*> argv;
      for (std::string& argument : arguments)
        argv.push_back(argument.data());
      argv.push_back(nullptr);
      const int nowhere = ::open("/dev/null", O_WRONLY);
      ::dup2(nowhere, STDOUT_FILENO);
      if (::chdir(folder_.c_str()) == 0)
        ::execv(argv[0], argv.data());
      ::_exit(127);
    }
    while (lines(file) < enough && ::waitpid(child, nullptr, WNOHANG) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const bool was_running = ::kill(child, SIGKILL) == 0;
    int status = 0;
    ::waitpid(child, &status, 0);
    return was_running && WIFSIGNALED(status);
  }
};

TEST_F(Evaluate, registersAThreeDMatchTree)
{
  writeFragments("kitchen");
  write("kitchen/gt.log", "0 1 2\n" + bundledPose());
  const ProgramRun run =
      evaluate(". --leaf 0.1 --method flashreg,flashreg_exact,flashreg_bounded,"
               "dense_reference --json - --csv r.csv --cache cache");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  const auto& group = json["groups"][0];
  EXPECT_EQ(group["pairs"], 1);
  EXPECT_GT(group["inlier_ratio"]["mean"], 0.05);
  ASSERT_EQ(group["methods"].size(), 4u);
  for (const auto& method : group["methods"]) {
    EXPECT_EQ(method["recall"], 1) << method;
    EXPECT_LT(method["translation_error"]["mean"], 0.15) << method;
    EXPECT_EQ(method["recall_difference"], 0);
    EXPECT_GT(method["times_ms"]["estimation"]["median"], 0);
    EXPECT_GT(method["times_ms"]["features"]["median"], 0);
  }
  EXPECT_EQ(lines("r.csv"), 2u + 4u);
  EXPECT_FALSE(fs::is_empty(path("cache")));
  // From the cache, and summed up from the file: the same.
  EXPECT_EQ(evaluate(". --leaf 0.1 --method flashreg,flashreg_exact,flashreg_bounded,"
                     "dense_reference --csv cached.csv --cache cache")
                .status,
            0);
  EXPECT_EQ(read("cached.csv"), read("r.csv"));
  EXPECT_EQ(evaluate("--merge r.csv --json -").out, run.out);
}

TEST_F(Evaluate, scenesAreRegisteredAsAWhole)
{
  writeFragments("kitchen");
  write("benchmarks/near/kitchen/gt.log", "0 1 2\n" + bundledPose());
  write("benchmarks/low/kitchen/gt.log", "0 1 2\n" + bundledPose());
  const std::string arguments = ". --leaf 0.1 --method flashreg,flashreg_map ";
  const ProgramRun run = evaluate(arguments + "--json - --csv r.csv");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  ASSERT_EQ(json["groups"].size(), 3u);
  for (const auto& group : json["groups"]) {
    const auto& map = group["methods"][1];
    EXPECT_EQ(map["method"], "flashreg_map");
    EXPECT_EQ(map["recall"], 1) << map;
    EXPECT_EQ(map["verdict"]["precision"], 1) << map;
    EXPECT_LT(map["translation_error"]["mean"], 0.15) << map;
    EXPECT_GT(map["times_ms"]["estimation"]["median"], 0);
  }
  ASSERT_EQ(json["maps"].size(), 1u) << "both data sets have the same clouds";
  const auto& map = json["maps"][0];
  EXPECT_EQ(map["name"], "kitchen");
  EXPECT_EQ(map["scans"], 2);
  EXPECT_EQ(map["placed"], 2);
  EXPECT_EQ(map["groups"], 1);
  EXPECT_GE(map["tried"], 1);
  EXPECT_EQ(map["used_edges"], 1);
  EXPECT_EQ(map["wrong_edges"], 0);
  EXPECT_EQ(map["unknown_edges"], 0);
  EXPECT_GT(map["seconds"], 0);
  EXPECT_NE(evaluate(arguments).out.find("  kitchen "), std::string::npos);
  expectFailure(arguments + "--shard 1/2", 2, "flashreg_map takes whole scenes");
}

TEST_F(Evaluate, wrongMapsAreCounted)
{
  writeFragments("kitchen");
  // Nobody's pose: the map is right, and the list isn't.
  write("kitchen/gt.log", "0 1 2\n1 0 0 5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const ProgramRun run = evaluate(". --leaf 0.1 --method flashreg_map --json -");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["groups"][0]["methods"][0]["recall"], 0);
  EXPECT_EQ(json["groups"][0]["methods"][0]["verdict"]["trusted"], 1);
  EXPECT_EQ(json["maps"][0]["wrong_edges"], 1);
}

TEST_F(Evaluate, exactIsTheDenseReference)
{
  writeMacFolder("scene", 6, 700, 2);
  const ProgramRun run =
      evaluate(". --method flashreg_exact,dense_reference --csv r.csv --json -");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto methods = nlohmann::json::parse(run.out)["groups"][0]["methods"];
  EXPECT_EQ(methods[0]["successes"], 4);
  EXPECT_EQ(methods[1]["successes"], 4);
  EXPECT_NEAR(methods[0]["rotation_error_deg"]["mean"].get<double>(),
              methods[1]["rotation_error_deg"]["mean"].get<double>(),
              1e-3);
}

TEST_F(Evaluate, everyMethodThatNeedsNoCloudsAnswers)
{
  writeMacFolder("scene", 1, 400);
  std::string methods = "flashreg,pcl_ransac_10k,pcl_ransac_50k";
  std::size_t count = 3;
  for (const char* name : OPTIONAL_METHODS)
    if (offers(name)) {
      methods += std::string(",") + name;
      ++count;
    }
  const ProgramRun run = evaluate(". --threads 1 --json - --method " + methods);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto group = nlohmann::json::parse(run.out)["groups"][0];
  ASSERT_EQ(group["methods"].size(), count);
  for (const auto& method : group["methods"]) {
    EXPECT_GT(method["times_ms"]["estimation"]["median"], 0) << method;
    // With one right correspondence in ten all but FGR find the pose.
    if (method["method"] != "open3d_fgr") {
      EXPECT_EQ(method["recall"], 1) << method;
    }
  }
}

TEST_F(Evaluate, methodsThatThisBuildLacksAreUnknown)
{
  writeMacFolder("scene", 1, 50);
  std::size_t lacking = 0;
  for (const char* name : OPTIONAL_METHODS)
    if (!offers(name)) {
      ++lacking;
      expectFailure(std::string("scene --method ") + name,
                    2,
                    std::string("'") + name + "' is unknown, or not in this build");
    }
  if (lacking == 0)
    GTEST_SKIP() << "it has them all";
}

TEST_F(Evaluate, prerejectiveTakesClouds)
{
  writeFragments("kitchen");
  write("kitchen/gt.log", "0 1 2\n" + bundledPose());
  const ProgramRun run =
      evaluate(". --leaf 0.15 --method pcl_prerejective,flashreg --json - --csv r.csv");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto methods = nlohmann::json::parse(run.out)["groups"][0]["methods"];
  EXPECT_GT(methods[0]["times_ms"]["estimation"]["median"], 0);
  writeMacFolder("scene", 1, 10);
  expectFailure("scene --method pcl_prerejective", 2, "needs clouds");
}

TEST_F(Evaluate, resultsCanBeDrawn)
{
  if (std::system("python3 -c 'import matplotlib' 2>/dev/null") != 0)
    GTEST_SKIP() << "no python3 with matplotlib";
  writeMacFolder("scene", 12, 300, 4);
  ASSERT_EQ(evaluate("scene --csv r.csv --method flashreg,dense_reference").status, 0);
  const std::string draw = "cd '" + folder_.string() +
                           "' && python3 '" PCL_FLASHREG_SOURCE_DIR
                           "/scripts/plot_evaluation.py' ";
  ASSERT_EQ(std::system((draw + "r.csv r.png && " + draw + "r.csv r.svg").c_str()), 0);
  EXPECT_EQ(read("r.png").substr(1, 3), "PNG");
  const std::string svg = read("r.svg");
  for (const char* text : {"Recall over the inlier ratio", "dense_reference"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  write("bad.csv", "nonsense\n1\n");
  EXPECT_NE(std::system((draw + "bad.csv bad.png 2>/dev/null").c_str()), 0);
}

TEST_F(Evaluate, errorsAreOneLineAndACode)
{
  writeMacFolder("scene", 2, 50);
  expectFailure("", 2, "--merge is needed");
  expectFailure("scene --method nonsense", 2, "'nonsense' is unknown");
  expectFailure("scene --method flashreg,flashreg", 2, "named twice");
  expectFailure("scene --leaf -1", 2, "--leaf");
  expectFailure("scene --shard 3/2", 2, "--shard: expected i/n");
  expectFailure("scene --resume", 2, "--resume needs the --csv");
  expectFailure("scene --merge a.csv", 2, "either data to evaluate or --merge");
  expectFailure("nowhere", 3, "nowhere: there is no such file or folder");
  expectFailure("scene --dataset other", 3, "holds no pair of these data sets");
  expectFailure("scene --csv none/r.csv", 3, "none/r.times.csv: cannot be written");
  expectFailure("--merge nowhere.csv", 3, "nowhere.csv: no such file");
  write("scene/cloud_bin_101+cloud_bin_102@corr.txt", "1 2 3 4 5 6\n1 2 three 4 5 6\n");
  expectFailure("scene --quiet --csv r.csv", 3, "@corr.txt: line 2: ");
  EXPECT_EQ(lines("r.csv"), 3u) << "the pair before is lost";
  expectFailure("scene --csv r.csv", 2, "r.csv is there already");
}

TEST_F(Evaluate, pairsWithoutCorrespondencesToGoByCountAsNotFound)
{
  writeMacFolder("scene", 1, 2);
  const ProgramRun run =
      evaluate(". --method flashreg,pcl_ransac_10k,dense_reference --json -");
  ASSERT_EQ(run.status, 0) << run.err;
  for (const auto& method : nlohmann::json::parse(run.out)["groups"][0]["methods"])
    EXPECT_EQ(method["recall"], 0);
}

TEST_F(Evaluate, aKilledRunGoesOnToTheSameFile)
{
  writeMacFolder("scene", 24, 1500, 3);
  const std::string settings = "scene --method flashreg,dense_reference --quiet";
  ASSERT_EQ(evaluate(settings + " --csv whole.csv").status, 0);
  ASSERT_TRUE(killAfter(
      {"scene", "--method", "flashreg,dense_reference", "--quiet", "--csv", "r.csv"},
      "r.csv",
      2 + 5))
      << "the run was over before it could be killed";
  ASSERT_LT(lines("r.csv"), lines("whole.csv"));
  // As if the last row had been cut in the middle.
  const std::string left = read("r.csv");
  write("r.csv", left.substr(0, left.size() - 7));

  expectFailure(settings + " --leaf 0.06 --csv r.csv --resume",
                3,
                "r.csv: was made with other settings: leaf was 0.05, is 0.06");
  const ProgramRun resumed = evaluate(settings + " --csv r.csv --resume");
  ASSERT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_EQ(read("r.csv"), read("whole.csv"));
  EXPECT_EQ(lines("r.times.csv"), lines("whole.times.csv"));
  // Nothing is left to do; the rows found stay as they are.
  const std::string times = read("r.times.csv");
  ASSERT_EQ(evaluate(settings + " --csv r.csv --resume").status, 0);
  EXPECT_EQ(read("r.csv"), read("whole.csv"));
  EXPECT_EQ(read("r.times.csv"), times);
}

TEST_F(Evaluate, shardsMergeToTheSameFile)
{
  writeMacFolder("a", 5, 300);
  writeMacFolder("b", 4, 300, 1);
  ASSERT_EQ(evaluate(". --csv whole.csv").status, 0);
  for (const char* i : {"1", "2", "3"})
    ASSERT_EQ(
        evaluate(std::string(". --shard ") + i + "/3 --csv s" + i + ".csv").status, 0);
  EXPECT_EQ(lines("s1.csv"), 2u + 3u);
  expectFailure(". --shard 2/3 --csv s1.csv --resume", 3, "shard was \"1/3\"");
  expectFailure("--merge s1.csv s2.csv --csv merged.csv", 3, "3 of 9 pairs");
  const ProgramRun run = evaluate("--merge s3.csv s1.csv s2.csv --csv merged.csv");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read("merged.csv"), read("whole.csv"));
  ASSERT_EQ(evaluate(". --every 2 --csv half.csv").status, 0);
  EXPECT_EQ(lines("half.csv"), 2u + 5u);
  EXPECT_NE(run.out.find("9 pairs"), std::string::npos) << run.out;
}

class EvaluateRanks : public Evaluate {
protected:
  void
  SetUp() override
  {
    Evaluate::SetUp();
#ifndef PCL_FLASHREG_MPIEXEC
    GTEST_SKIP() << "built without MPI, or there is no mpirun";
#endif
    writeMacFolder("a", 7, 300, 2);
    writeMacFolder("b", 4, 300);
    ASSERT_EQ(evaluate(". --csv whole.csv --threads 1").status, 0);
  }
};

TEST_F(EvaluateRanks, makeTheSameFile)
{
  const ProgramRun run =
      evaluate(". --csv r.csv --threads 1 --json r.json", onRanks(4));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read("r.csv"), read("whole.csv"));
  EXPECT_EQ(lines("r.times.csv"), lines("whole.times.csv"));
  EXPECT_EQ(nlohmann::json::parse(read("r.json"))["groups"][0]["pairs"], 7);
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_EQ(entry.path().string().find(".rank"), std::string::npos) << entry.path();
}

TEST_F(EvaluateRanks, goOnFromTheirParts)
{
  // What three ranks had done when they were killed: rows 0, 4 and 5 to 6.
  const std::string whole = read("whole.csv"), times = read("whole.times.csv");
  const auto part = [](const std::string& text,
                       std::size_t header,
                       std::size_t from,
                       std::size_t to) {
    std::istringstream lines(text);
    std::string kept, line;
    for (std::size_t i = 0; std::getline(lines, line); ++i)
      if (i < header || (i >= header + from && i < header + to))
        kept += line + '\n';
    return kept;
  };
  const auto writePart = [&](const std::string& name,
                             const std::string& times_name,
                             std::size_t from,
                             std::size_t to) {
    write(name, part(whole, 2, from, to));
    write(times_name, part(times, 1, from, to));
  };
  writePart("r.csv", "r.times.csv", 0, 1);
  writePart("r.csv.rank0", "r.csv.times.rank0", 4, 5);
  writePart("r.csv.rank2", "r.csv.times.rank2", 5, 7);
  const ProgramRun run = evaluate(". --csv r.csv --threads 1 --resume", onRanks(2));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read("r.csv"), whole);
  // The rows that were there have not been computed again: their times are the same.
  EXPECT_EQ(part(read("r.times.csv"), 1, 4, 7), part(times, 1, 4, 7));
}

TEST_F(EvaluateRanks, failTogether)
{
  EXPECT_NE(evaluate(".", onRanks(2)).status, 0) << "without --csv";
  EXPECT_NE(read(".err").find("several ranks need --csv"), std::string::npos);
  write("b/cloud_bin_102+cloud_bin_103@corr.txt", "nonsense\n");
  EXPECT_NE(evaluate(". --csv r.csv", onRanks(2)).status, 0);
  EXPECT_NE(read(".err").find("@corr.txt: line 1: "), std::string::npos);
}

} // namespace
} // namespace pcl_flashreg::evaluate
