// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The fuzz targets on mutations of their seeds: the same ones in every run, so that
// they need neither libFuzzer nor luck, and run under the sanitizers with everything
// else.

#include "support/made_correspondences.h"
#include "targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace pcl_flashreg::fuzz {
namespace {

/** \brief Numbers at which programs stumble. */
constexpr std::array<const char*, 12> kNumbers = {"0",
                                                  "-1",
                                                  "1",
                                                  "65536",
                                                  "2147483648",
                                                  "4294967295",
                                                  "4294967297",
                                                  "9223372036854775807",
                                                  "18446744073709551615",
                                                  "1e400",
                                                  "nan",
                                                  "-"};

class Mutator {
public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::string
  mutate(std::string bytes, const std::vector<std::string>& seeds)
  {
    for (std::size_t n = 1 + below(4); n > 0; --n)
      mutateOnce(bytes, seeds);
    return bytes;
  }

private:
  std::size_t
  below(std::size_t limit)
  {
    return limit == 0 ? 0 : static_cast<std::size_t>(random_.next() % limit);
  }

  void
  mutateOnce(std::string& bytes, const std::vector<std::string>& seeds)
  {
    const std::size_t at = below(bytes.size());
    switch (below(8)) {
    case 0:
      if (!bytes.empty())
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 1:
      if (!bytes.empty())
        bytes[at] = static_cast<char>(random_.next());
      break;
    case 2:
      bytes.resize(at);
      break;
    case 3:
      bytes.erase(at, below(20));
      break;
    case 4:
      bytes.insert(at, bytes.substr(below(bytes.size()), below(40)));
      break;
    case 5: {
      const std::string& other = seeds[below(seeds.size())];
      bytes = bytes.substr(0, at) + other.substr(below(other.size()));
      break;
    }
    case 6:
      for (std::size_t i = at; i < std::min(bytes.size(), at + 4); ++i)
        bytes[i] = static_cast<char>(below(2) == 0 ? 0xff : 0x00);
      break;
    default:
      replaceNumber(bytes, at);
    }
  }

  /** \brief Puts one of kNumbers where the next digits are. */
  void
  replaceNumber(std::string& bytes, std::size_t at)
  {
    constexpr const char* digits = "0123456789";
    const std::size_t begin = bytes.find_first_of(digits, at);
    if (begin == std::string::npos)
      return;
    const std::size_t end = bytes.find_first_not_of(digits, begin);
    bytes.replace(begin, end - begin, kNumbers[below(kNumbers.size())]);
  }

  made::Random random_;
};

class Fuzz : public ::testing::TestWithParam<NamedTarget> {};

TEST_P(Fuzz, takesAnyBytes)
{
  const NamedTarget& target = GetParam();
  for (std::size_t s = 0; s < target.seeds.size(); ++s) {
    ASSERT_NO_THROW(target.target(target.seeds[s]));
    Mutator mutator(1000 * s + 1);
    for (int round = 0; round < target.rounds; ++round) {
      const std::string bytes = mutator.mutate(target.seeds[s], target.seeds);
      ASSERT_NO_THROW(target.target(bytes)) << "seed " << s << ", round " << round;
    }
  }
}

TEST_P(Fuzz, takesEveryTruncation)
{
  const NamedTarget& target = GetParam();
  for (const std::string& seed : target.seeds)
    for (std::size_t size = 0; size < seed.size(); size += target.truncation)
      ASSERT_NO_THROW(target.target(std::string_view(seed).substr(0, size)))
          << size << " bytes";
}

INSTANTIATE_TEST_SUITE_P(All,
                         Fuzz,
                         ::testing::ValuesIn(allTargets()),
                         [](const auto& instance) { return instance.param.name; });

} // namespace
} // namespace pcl_flashreg::fuzz
