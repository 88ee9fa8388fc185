// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "results_file.h"

#include "../../batch/rows.h"
#include "../../io/csv.h"
#include "../../io/error.h"
#include "../../io/file.h"
#include "../../io/text.h"
#include "record_rows.h"

#include <algorithm>
#include <filesystem>
#include <map>

namespace pcl_flashreg::evaluate {
namespace {

using batch::readRows, batch::wholeLines;

Config
parseConfig(std::string_view line)
{
  const auto config =
      Config::parse(line.substr(std::min<std::size_t>(2, line.size())), nullptr, false);
  if (line.substr(0, 2) != "# " || !config.is_object() || !config.contains("methods") ||
      !config.contains("pairs"))
    throw io::InputError("line 1: is not the configuration of an evaluation");
  return config;
}

Results
parseResults(const std::string& bytes)
{
  Results results;
  io::LineReader lines(wholeLines(bytes));
  std::string_view line;
  lines.next(line);
  results.config = parseConfig(line);
  readRows(lines, resultColumns(), [&](const batch::Cells& cells) {
    results.records.push_back(recordFromCells(cells));
  });
  return results;
}

using TimesByRow = std::map<std::pair<std::size_t, std::string>, Times>;

TimesByRow
parseTimes(const std::string& bytes)
{
  TimesByRow times;
  io::LineReader lines(wholeLines(bytes));
  readRows(lines, timeColumns(), [&](const batch::Cells& cells) {
    std::pair<std::size_t, std::string> row;
    const Times of_row = timesFromCells(cells, row.first, row.second);
    times[row] = of_row;
  });
  return times;
}

/** \brief Leaves pairs that have a record for every method. */
void
keepCompletePairs(Results& results)
{
  std::map<std::size_t, std::size_t> methods;
  for (const Record& record : results.records)
    ++methods[record.pair];
  auto& records = results.records;
  records.erase(std::remove_if(records.begin(),
                               records.end(),
                               [&](const Record& record) {
                                 return methods[record.pair] !=
                                        results.config["methods"].size();
                               }),
                records.end());
}

} // namespace

std::string
timesPath(const std::string& path)
{
  const std::filesystem::path file(path);
  return (file.parent_path() /
          (file.stem().string() + ".times" + file.extension().string()))
      .string();
}

Results
readResults(const std::string& path)
{
  Results results = io::parseFile(path, parseResults);
  const TimesByRow times = io::parseFile(timesPath(path), parseTimes);
  std::vector<Record> timed;
  for (Record& record : results.records) {
    const auto found = times.find({record.pair, record.method});
    if (found == times.end())
      continue;
    record.times = found->second;
    timed.push_back(std::move(record));
  }
  results.records = std::move(timed);
  keepCompletePairs(results);
  sortRecords(results.config, results.records);
  return results;
}

void
writeResults(const std::string& path, const Results& results)
{
  std::string rows = "# " + results.config.dump() + '\n' +
                     io::joinCsv(resultColumns()) + '\n',
              times = io::joinCsv(timeColumns()) + '\n';
  for (const Record& record : results.records) {
    rows += io::joinCsv(resultCells(record)) + '\n';
    times += io::joinCsv(timeCells(record)) + '\n';
  }
  io::writeFile(timesPath(path), times);
  io::writeFile(path, rows);
}

void
sortRecords(const Config& config, std::vector<Record>& records)
{
  std::map<std::string, std::size_t> order;
  for (const auto& method : config["methods"])
    order.emplace(method.get<std::string>(), order.size());
  std::stable_sort(
      records.begin(), records.end(), [&](const Record& a, const Record& b) {
        return a.pair != b.pair ? a.pair < b.pair : order[a.method] < order[b.method];
      });
}

ResultsAppender::ResultsAppender(const std::string& path)
    : path_(path), results_(path, std::ios::app), times_(timesPath(path), std::ios::app)
{
  if (!results_ || !times_)
    throw io::InputError(path + ": cannot be written");
}

void
ResultsAppender::append(const std::vector<Record>& records)
{
  // Times first: a pair whose row of results is there has its times, too.
  for (const Record& record : records)
    times_ << io::joinCsv(timeCells(record)) << '\n';
  times_.flush();
  for (const Record& record : records)
    results_ << io::joinCsv(resultCells(record)) << '\n';
  results_.flush();
  if (!results_ || !times_)
    throw io::InputError(path_ + ": cannot be written");
}

} // namespace pcl_flashreg::evaluate
