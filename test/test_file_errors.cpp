// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Files of the library and of the programs, with one call of the system after the other
// failing.

#include "evaluate/results/results_file.h"
#include "io/file.h"
#include "support/failing_calls.h"
#include "support/program.h"

#include <pcl_flashreg/pair_registration.h>

#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <iterator>

namespace pcl_flashreg {
namespace {

namespace fs = std::filesystem;
using failing_calls::Call;
using failing_calls::SHORT;

/** \brief Runs something with one call of the system failing.
 * \param[out] complaint what it threw; empty if nothing
 * \return whether there was such a call */
bool
runWith(Call call,
        int failure,
        std::size_t skip,
        const std::function<void()>& something,
        std::string& complaint)
{
  complaint.clear();
  failing_calls::begin(call, failure, skip);
  try {
    something();
  }
  catch (const std::exception& error) {
    failing_calls::end();
    complaint = error.what();
    return true;
  }
  return failing_calls::end();
}

class FileErrors : public ProgramTest {
protected:
  /** \brief For every call of each kind: interrupted or short, a writer goes on; where the
   * call fails there is an error that names file and reason, what was there is there, and
   * nothing beside it.
   * \param[in] write puts into "file" what it is told, by a single character */
  void
  expectSoundWriter(const std::function<void(char)>& write,
                    const std::function<std::string()>& read)
  {
    write('a');
    const std::string before = read();
    write('b');
    const std::string after = read();
    ASSERT_NE(before, after);
    const std::pair<Call, std::vector<int>> failures[] = {
        {Call::Open, {EINTR, EACCES, ENOSPC}},
        {Call::Write, {EINTR, SHORT, EIO, ENOSPC}},
        {Call::Sync, {EINTR, EIO, ENOSPC}},
        {Call::Rename, {EACCES, EIO}}};
    for (const auto& [call, errors] : failures)
      for (const int error : errors) {
        const bool harmless = error == EINTR || error == SHORT;
        for (std::size_t skip = 0;; ++skip) {
          write('a');
          std::string complaint;
          const bool failed = runWith(
              call, error, skip, [&] { write('b'); }, complaint);
          EXPECT_EQ(read(), failed && !harmless ? before : after)
              << static_cast<int>(call) << ' ' << error << ' ' << skip;
          EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
          if (!failed) {
            EXPECT_GT(skip, 0u) << "was never called";
            break;
          }
          if (harmless)
            EXPECT_EQ(complaint, "");
          else
            EXPECT_EQ(complaint,
                      path("file") + ": cannot be written: " + std::strerror(error));
        }
      }
  }

  /** \brief The same of a reader, which gives all there is, or an error. */
  void
  expectSoundReader(const std::function<std::string()>& read)
  {
    const std::string expected = read();
    const std::pair<Call, std::vector<int>> failures[] = {
        {Call::Open, {EINTR, EACCES, EMFILE}}, {Call::Read, {EINTR, SHORT, EIO}}};
    for (const auto& [call, errors] : failures)
      for (const int error : errors)
        for (std::size_t skip = 0;; ++skip) {
          std::string found, complaint;
          const bool failed = runWith(
              call, error, skip, [&] { found = read(); }, complaint);
          const bool harmless = error == EINTR || error == SHORT || !failed;
          EXPECT_EQ(found, harmless ? expected : "")
              << static_cast<int>(call) << ' ' << error << ' ' << skip;
          if (harmless)
            EXPECT_EQ(complaint, "");
          else
            EXPECT_EQ(complaint,
                      path("file") + ": cannot be read: " + std::strerror(error));
          if (!failed) {
            EXPECT_GT(skip, 0u) << "was never called";
            break;
          }
        }
  }

  /** \brief More than any buffer holds. */
  static std::string
  text(char letter)
  {
    return std::string(300000, letter) + '.';
  }

  static Scan
  scan(char letter)
  {
    std::vector<float> xyz;
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 40; ++j)
        for (const float value : {0.1f * static_cast<float>(i),
                                  0.1f * static_cast<float>(j),
                                  static_cast<float>(letter)})
          xyz.push_back(value);
    ScanInput<float> input;
    input.points.data = xyz.data();
    input.points.size = xyz.size() / 3;
    return PairRegistration(BackendKind::Cpu, 1).makeScan(input, 0.1);
  }
};

TEST_F(FileErrors, OfAFileOfThePrograms)
{
  expectSoundWriter([&](char letter) { io::writeFile(path("file"), text(letter)); },
                    [&] { return io::readFile(path("file")); });
  expectSoundReader([&] { return io::readFile(path("file")); });
}

TEST_F(FileErrors, OfAScan)
{
  const auto load = [&] { return Scan::load(path("file")).serialize(); };
  const Scan a = scan('a'), b = scan('b');
  expectSoundWriter([&](char letter) { (letter == 'a' ? a : b).save(path("file")); },
                    load);
  expectSoundReader(load);
}

TEST_F(FileErrors, OfADeviceThatIsFull)
{
  std::string complaint;
  for (const auto& write :
       {std::function<void()>([] { io::writeFile("/dev/full", "x"); }),
        std::function<void()>([] { scan('a').save("/dev/full"); })}) {
    runWith(Call::Rename, EIO, 0, write, complaint);
    EXPECT_EQ(complaint,
              std::string("/dev/full: cannot be written: ") + std::strerror(ENOSPC));
  }
}

class ResultsErrors : public FileErrors {
protected:
  static std::vector<evaluate::Record>
  pairNumber(std::size_t pair)
  {
    evaluate::Record record;
    record.pair = pair;
    record.method = "fast";
    record.dataset = std::string(5000, 'x'); // rows are longer than half a buffer
    return {record};
  }

  std::size_t
  recordsOf(const std::string& name) const
  {
    return evaluate::readResults(path(name)).records.size();
  }
};

TEST_F(ResultsErrors, LoseNoRowThatWasThere)
{
  const evaluate::Results none{{{"methods", {"fast"}}, {"pairs", 3}}, {}};
  for (const int error : {EINTR, SHORT, EIO, ENOSPC})
    for (std::size_t skip = 0;; ++skip) {
      evaluate::writeResults(path("r.csv"), none);
      std::string complaint;
      bool failed = false;
      {
        evaluate::ResultsAppender appender(path("r.csv"));
        appender.append(pairNumber(0));
        failed = runWith(
            Call::Write,
            error,
            skip,
            [&] { appender.append(pairNumber(1)); },
            complaint);
      }
      const bool lost = failed && error != EINTR && error != SHORT;
      EXPECT_EQ(complaint.empty(), !lost) << complaint << error << " " << skip;
      EXPECT_EQ(complaint.find('\n'), std::string::npos);
      if (lost) {
        EXPECT_EQ(complaint.find(path("r.csv") + ": cannot be written"), 0u);
        EXPECT_GE(recordsOf("r.csv"), 1u);
      }
      else {
        EXPECT_EQ(recordsOf("r.csv"), 2u) << error << ' ' << skip;
      }
      if (!failed) {
        EXPECT_GT(skip, 1u) << "was hardly ever called";
        break;
      }
    }
}

/** \brief Two files are written, one after the other. */
TEST_F(ResultsErrors, LeaveResultsThatFitTheirTimes)
{
  evaluate::Results results{{{"methods", {"fast"}}, {"pairs", 3}}, pairNumber(0)};
  for (const Call call : {Call::Open, Call::Write, Call::Sync, Call::Rename})
    for (std::size_t skip = 0; skip < 2; ++skip) {
      results.records = pairNumber(0);
      evaluate::writeResults(path("r.csv"), results);
      results.records.push_back(pairNumber(1).front());
      std::string complaint;
      EXPECT_TRUE(runWith(
          call,
          ENOSPC,
          skip,
          [&] { evaluate::writeResults(path("r.csv"), results); },
          complaint));
      EXPECT_NE(complaint.find("cannot be written: "), std::string::npos) << complaint;
      EXPECT_EQ(recordsOf("r.csv"), 1u);
      EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2);
    }
}

} // namespace
} // namespace pcl_flashreg
