// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cli_support.h"

#include <algorithm>

namespace pcl_flashreg::cli {
namespace {

class CliBadInput : public CliTest {
protected:
  void
  SetUp() override
  {
    CliTest::SetUp();
    writeRoom("source.pcd", "target.pcd");
  }

  /** \brief One line on standard error that holds what it should, and nothing else
   * said. */
  void
  expectError(const std::string& arguments, int status, const std::string& part) const
  {
    const ProgramRun run = align(arguments);
    EXPECT_EQ(run.status, status) << arguments << '\n' << run.err;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_EQ(run.err.compare(0, 27, "pcl_flashreg_align: error: "), 0) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << arguments << '\n' << run.err;
  }

  static std::string
  asciiPcd(const std::string& points,
           const std::string& rows,
           const char* fields = "x y z")
  {
    return std::string("VERSION 0.7\nFIELDS ") + fields + "\nWIDTH " + points +
           "\nHEIGHT 1\nPOINTS " + points + "\nDATA ascii\n" + rows;
  }

  static std::string
  repeated(const std::string& row, int times)
  {
    std::string rows;
    for (int i = 0; i < times; ++i)
      rows += row;
    return rows;
  }
};

TEST_F(CliBadInput, cloudsThatAreNone)
{
  const std::string whole = read("source.pcd");
  fs::create_directory(path("folder.pcd"));
  write("empty.pcd", "");
  write("text.pcd", "To whom it may concern\n");
  write("text.ply", "To whom it may concern\n");
  write("text.bin", "To whom it may concern\n");
  write("cloud.xyz", "1 2 3\n");
  write("half.pcd", whole.substr(0, whole.size() / 2));
  write("header.pcd", whole.substr(0, whole.find("POINTS")));
  write("no_xyz.pcd", asciiPcd("2", "1 2\n3 4\n", "a b"));
  write("none.pcd", asciiPcd("0", ""));
  write("huge.pcd", asciiPcd("1000000000000", "1 2 3\n"));
  write("word.pcd", asciiPcd("2", "1 2 3\n1 2 three\n"));
  write("huge.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000000\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n0123");
  write("nan.pcd", asciiPcd("50", repeated("nan nan nan\n", 50)));
  write("two.pcd", asciiPcd("2", "0 0 0\n1 1 1\n"));
  write("same.pcd", asciiPcd("500", repeated("1 2 3\n", 500)));
  const std::vector<std::pair<std::string, std::string>> table = {
      {"missing.pcd", "missing.pcd: no such file"},
      {"folder.pcd", "is a directory"},
      {"empty.pcd", "empty.pcd: is empty"},
      {"text.pcd", "not a PCD header"},
      {"text.ply", "not a PLY file"},
      {"text.bin", "is text"},
      {"cloud.xyz", "not a point cloud that can be read"},
      {"half.pcd", "cut off"},
      {"header.pcd", "cut off"},
      {"no_xyz.pcd", "no field 'x'"},
      {"none.pcd", "holds no points"},
      {"huge.pcd", "cut off"},
      {"huge.ply", "cut off"},
      {"word.pcd", "'three' is no value"},
      {"nan.pcd", "none of its 50 points"},
      {"two.pcd", "only 2 of its 2 points"},
      {"same.pcd", "one place"}};
  for (const auto& [file, part] : table) {
    expectError(file + " target.pcd", 3, part);
    expectError("source.pcd " + file, 3, part);
  }
}

TEST_F(CliBadInput, cloudsWithNothingToHoldOnTo)
{
  std::string line;
  for (int i = 0; i < 1000; ++i)
    line += std::to_string(0.01 * i) + " 0 0\n";
  write("line.pcd", asciiPcd("1000", line));
  write("five.pcd", asciiPcd("5", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n"));
  expectError("line.pcd target.pcd", 3, "can be described");
  expectError("five.pcd target.pcd", 3, "can be described");
}

TEST_F(CliBadInput, leavesThatDoNotSuit)
{
  expectError("source.pcd target.pcd --leaf -1", 2, "must be a length > 0");
  expectError("source.pcd target.pcd --leaf 0", 2, "must be a length > 0");
  expectError("source.pcd target.pcd --leaf nan", 2, "must be a length > 0");
  expectError("source.pcd target.pcd --leaf inf", 2, "must be a length > 0");
  expectError("source.pcd target.pcd --leaf wide", 2, "--leaf");
  expectError("source.pcd target.pcd --leaf 1e-12", 2, "would suit");
  expectError("source.pcd target.pcd --leaf 1e-4", 2, "would suit");
  expectError("source.pcd target.pcd --leaf 50", 2, "would suit");
  expectError("source.pcd target.pcd --leaf 1e30", 2, "would suit");
}

TEST_F(CliBadInput, commandLinesThatMakeNoSense)
{
  const std::string pair = "source.pcd target.pcd ";
  expectError("", 2, "a source and a target cloud are needed");
  expectError("source.pcd", 2, "a source and a target cloud are needed");
  expectError(pair + "--nonsense", 2, "--nonsense");
  expectError(pair + "a.pcd b.pcd", 2, "b.pcd");
  expectError(pair + "--score beauty", 2, "beauty");
  expectError(pair + "--backend abacus", 2, "abacus");
  expectError(pair + "--second-order third", 2, "third");
  expectError(pair + "--pivots 0", 2, "--pivots = 0 is out of range");
  expectError(pair + "--min-confidence 2", 2, "--min-confidence = 2");
  expectError(pair + "--inlier-distance -1", 2, "--inlier-distance");
  expectError(pair + "--threads -1", 2, "--threads");
  expectError(pair + "--bin-fields 2", 2, "--bin-fields");
  expectError(pair + "--neighbors 0", 2, "--neighbors");
  expectError(pair + "--features only_one.pcd", 2, "expected two files");
  expectError(pair + "--features a,b,c", 2, "expected two files");
  expectError(pair + "--features a,b --correspondences c", 2, "exclude");
  expectError("--correspondences c.txt --snapshot a.png", 2, "need the source");
}

TEST_F(CliBadInput, gravityThatIsNone)
{
  const std::string pair = "source.pcd target.pcd ";
  for (const char* given : {"--gravity 0,0,1",
                            "--gravity-source 0,0,1",
                            "--gravity-target 0,0,1",
                            "--max-tilt 3"})
    expectError(pair + given,
                2,
                std::string(given).substr(0, std::string(given).find(' ')) +
                    ": says nothing without --upright");
  for (const char* direction :
       {"0,0", "0,0,1,0", "0,0,0", "up", "1,2,", "0;0;1", "nan,0,1", "0,inf,1", ""})
    for (const char* option : {"--gravity", "--gravity-source", "--gravity-target"})
      expectError(pair + "--upright " + option + " '" + direction + "'",
                  2,
                  std::string(option) + ": expected a direction, X,Y,Z, found '");
  for (const char* tilt : {"0", "-1", "31", "nan"})
    expectError(pair + "--upright --max-tilt " + tilt, 2, "--max-tilt = ");
}

TEST_F(CliBadInput, outputsThatWouldDoHarm)
{
  const std::string before = read("source.pcd");
  fs::create_symlink("source.pcd", path("link.pcd"));
  write("guess.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const std::string pair = "source.pcd target.pcd ";
  expectError(pair + "source.pcd", 2, "is an input");
  expectError(pair + "./target.pcd", 2, "is an input");
  expectError(pair + "link.pcd", 2, "is an input");
  expectError(pair + "--json source.pcd", 2, "is an input");
  expectError(pair + "--guess guess.txt --transform guess.txt", 2, "is an input");
  expectError(pair + "--json both --transform ./both", 2, "same file");
  expectError(pair + "aligned.xyz", 2, "written as .pcd or .ply");
  expectError(pair + "no/such/folder.pcd", 2, "does not exist");
  expectError(pair + "--transform .", 2, "is a directory");
  EXPECT_EQ(read("source.pcd"), before);
}

TEST_F(CliBadInput, correspondencesAndGuessesThatAreNone)
{
  write("short.txt", "1 2 3 4 5 6\n1 2 3 4 5\n");
  write("word.txt", "# head\n1 2 3 4 5 six\n");
  write("four.txt", "1 2 3 4\n");
  write("index.txt", "0 0\n0 12000\n");
  write("nothing.txt", "# nothing\n");
  write("three.txt", "1 2 3\n4 5 6\n");
  write("one.txt", "1 2 3\n");
  write("scaled.txt", "2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n");
  const std::string pair = "source.pcd target.pcd ";
  expectError("--correspondences missing.txt", 3, "no such file");
  expectError("--correspondences short.txt", 3, "short.txt: line 2: expected 6");
  expectError("--correspondences word.txt", 3, "word.txt: line 2: 'six'");
  expectError("--correspondences four.txt", 3, "found 4 numbers");
  expectError("--correspondences nothing.txt", 3, "no rows");
  expectError("--correspondences three.txt,one.txt", 3, "2 rows");
  expectError("--correspondences three.txt,missing.txt", 3, "missing.txt");
  expectError(pair + "--correspondences index.txt", 3, "line 2: 12000");
  expectError(pair + "--guess scaled.txt", 3, "no rigid transform");
  expectError(pair + "--guess one.txt", 3, "4 x 4");
}

TEST_F(CliBadInput, tooFewCorrespondencesAreNoError)
{
  write("two.txt", "1 2 3 4 5 6\n2 3 4 5 6 7\n");
  write("same.txt", repeated("1 2 3 4 5 6\n", 100));
  for (const char* file : {"two.txt", "same.txt"}) {
    const ProgramRun run = align(std::string("--json - --correspondences ") + file);
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_EQ(run.json().at("converged"), false);
    EXPECT_NE(run.json().at("status"), "ok");
  }
}

TEST_F(CliBadInput, aWriteThatFailsIsReported)
{
  if (!fs::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full on this system";
  const ProgramRun run = align("source.pcd target.pcd --quiet --json /dev/full");
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("cannot be written"), std::string::npos) << run.err;
}

} // namespace
} // namespace pcl_flashreg::cli
