// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_benchmark with an emulated device: every figure that it promises is there.
// Which values they have is nobody's business here.

#include "support/program.h"

namespace pcl_flashreg {
namespace {

class Benchmark : public ProgramTest {
protected:
  ProgramRun
  benchmark(const std::string& arguments) const
  {
    return runProgram(PCL_FLASHREG_BENCHMARK, arguments);
  }

  void
  expectFailure(const std::string& arguments, int status, const std::string& why) const
  {
    const ProgramRun run = benchmark(arguments);
    EXPECT_EQ(run.status, status) << arguments;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
  }
};

const std::string SMALL = "--sizes 60,130 --inlier-ratios 0.3 --runs 2 ";

TEST_F(Benchmark, TimesADevice)
{
  const ProgramRun run = benchmark(
      SMALL +
      "--backend cuda --side-by-side 1,3 --energy-seconds 0.01 --json out.json");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("emulated device"), std::string::npos) << run.out;
  const auto json = nlohmann::json::parse(read("out.json"));
  EXPECT_EQ(json.at("backend"), "cuda");
  EXPECT_EQ(json.at("device"), "emulated device");
  EXPECT_GT(json.at("ceilings").at("operations_per_second"), 0);
  EXPECT_GT(json.at("ceilings").at("cache_bytes_per_second"), 0);
  const auto& all = json.at("measurements");
  ASSERT_EQ(all.size(), 4u); // two sizes, exact and bounded
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& m = all[i];
    EXPECT_EQ(m.at("correspondences"), i < 2 ? 60 : 130);
    EXPECT_EQ(m.at("second_order"), i % 2 == 0 ? "exact" : "bounded");
    EXPECT_GT(m.at("inliers"), 10);
    EXPECT_GT(m.at("cold_ms"), 0);
    for (const char* stage : {"first_order_graph",
                              "second_order_graph",
                              "pivots",
                              "cliques",
                              "hypotheses",
                              "verification",
                              "refinement",
                              "total"})
      EXPECT_GT(m.at("timings_ms").at(stage).at("median"), 0) << stage;
    const auto& device = m.at("device");
    EXPECT_GT(device.at("resident_ms").at("median"), 0);
    EXPECT_LE(device.at("resident_ms").at("p10"), device.at("resident_ms").at("p90"));
    EXPECT_GT(device.at("memory_bytes"), 1000);
    ASSERT_EQ(m.at("throughput").size(), 2u);
    EXPECT_EQ(m.at("throughput")[1].at("side_by_side"), 3);
    EXPECT_GT(m.at("throughput")[1].at("pairs_per_second"), 0);
    EXPECT_TRUE(device.contains("energy_mj"));
    const auto& floor = device.at("work").at("floor_ms");
    EXPECT_GT(floor.at("first_order_graph"), 0);
    EXPECT_GT(floor.at("verification"), 0);
    EXPECT_EQ(floor.at("second_order_graph").is_null(), i % 2 == 1);
  }
}

TEST_F(Benchmark, TimesTheAblation)
{
  const ProgramRun run = benchmark("--sizes 90 --inlier-ratios 0.3 --runs 1 "
                                   "--backend cuda --ablation --json out.json");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("Dense reference"), std::string::npos) << run.out;
  const auto ablations = nlohmann::json::parse(read("out.json")).at("ablations");
  ASSERT_EQ(ablations.size(), 1u);
  EXPECT_EQ(ablations[0].at("correspondences"), 90);
  const auto& rows = ablations[0].at("rows");
  ASSERT_GT(rows.size(), 8u); // the paper's, and this project's own
  for (const auto& row : rows) {
    EXPECT_GT(row.at("timings_ms").at("total").at("median"), 0) << row;
    EXPECT_GT(row.at("memory_bytes"), 0) << row;
    EXPECT_EQ(row.at("inliers"), rows[0].at("inliers")) << row;
  }
}

TEST_F(Benchmark, TimesTheCpu)
{
  const ProgramRun run =
      benchmark(SMALL + "--backend cpu --side-by-side 2 --json out.json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(read("out.json"));
  EXPECT_EQ(json.at("device"), nullptr);
  ASSERT_EQ(json.at("measurements").size(), 2u);
  for (const auto& m : json.at("measurements")) {
    EXPECT_GT(m.at("timings_ms").at("total").at("median"), 0);
    EXPECT_FALSE(m.contains("device"));
    EXPECT_GT(m.at("throughput").at(0).at("pairs_per_second"), 0);
  }
}

/** \brief What was written is what was made. */
TEST_F(Benchmark, ExportsWhatItTimes)
{
  const ProgramRun exported = benchmark(SMALL + "--export .");
  ASSERT_EQ(exported.status, 0) << exported.err;
  const ProgramRun made =
      benchmark("--sizes 130 --inlier-ratios 0.3 --runs 1 --backend cpu --json a.json");
  const ProgramRun file =
      benchmark("--correspondences 1_130.txt --runs 1 --backend cpu --json b.json");
  ASSERT_EQ(made.status, 0) << made.err;
  ASSERT_EQ(file.status, 0) << file.err;
  const auto of = [&](const char* name) {
    return nlohmann::json::parse(read(name)).at("measurements")[0];
  };
  EXPECT_EQ(of("a.json").at("inliers"), of("b.json").at("inliers"));
  EXPECT_EQ(of("a.json").at("correspondences"), of("b.json").at("correspondences"));
}

TEST_F(Benchmark, SaysWhatIsWrong)
{
  expectFailure("--correspondences nowhere.txt --backend cpu", 3, "nowhere.txt");
  expectFailure("--backend gpu", 2, "--backend");
  write("bad.txt", "1 2 3\n");
  expectFailure("--correspondences bad.txt --backend cpu", 3, "bad.txt: ");
  write("indices.txt", "1 2\n");
  expectFailure("--correspondences indices.txt --backend cpu", 3, "sx sy sz");
}

} // namespace
} // namespace pcl_flashreg
