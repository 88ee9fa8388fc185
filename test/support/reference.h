// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// A slow and obvious form of stages 1 to 4, after TurboReg's: dense matrices, all edges
// sorted, rows scanned. It shares no code with the library; the tests compare with it, and
// pcl_flashreg_evaluate has it as a method (dense_reference).

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <thread>
#include <vector>

namespace pcl_flashreg {
namespace reference {

struct ScoredEdge {
  std::size_t u, v;
  int score;
};

struct Triple {
  std::size_t u, v, w;
  int score;
};

/** \brief N x N, row-major. */
template <typename Value>
struct Matrix {
  std::size_t n;
  std::vector<Value> values;

  explicit Matrix(std::size_t size, Value value = Value{})
      : n(size), values(n * n, value)
  {
  }
  Value&
  at(std::size_t i, std::size_t j)
  {
    return values[i * n + j];
  }
  Value
  at(std::size_t i, std::size_t j) const
  {
    return values[i * n + j];
  }
};

/** \brief Calls body(i) for every row, each thread every n-th of them. */
template <typename Body>
void
forRows(std::size_t rows, unsigned threads, const Body& body)
{
  std::vector<std::thread> workers;
  for (unsigned first = 0; first < threads; ++first)
    workers.emplace_back([=, &body] {
      for (std::size_t i = first; i < rows; i += threads)
        body(i);
    });
  for (std::thread& worker : workers)
    worker.join();
}

/** \brief |a - b|^2 of rows i and j of N x 3 floats, an operation at a time: the volatile
 * keeps the compiler from contracting or widening any of them. */
inline float
squaredDistance(const std::vector<float>& xyz, std::size_t i, std::size_t j)
{
  volatile float squared[3];
  for (int k = 0; k < 3; ++k) {
    volatile float difference = xyz[3 * i + k] - xyz[3 * j + k];
    squared[k] = difference * difference;
  }
  volatile float sum = squared[0] + squared[1];
  sum = sum + squared[2];
  return sum;
}

inline float
distance(const std::vector<float>& xyz, std::size_t i, std::size_t j)
{
  return std::sqrt(squaredDistance(xyz, i, j));
}

/** \brief Eq. (fog). */
inline Matrix<char>
firstOrderGraph(const std::vector<float>& source,
                const std::vector<float>& target,
                float tau,
                float r,
                unsigned threads = 1)
{
  Matrix<char> graph(source.size() / 3);
  forRows(graph.n, threads, [&](std::size_t i) {
    for (std::size_t j = 0; j < graph.n; ++j) {
      const float ls = distance(source, i, j), lt = distance(target, i, j);
      volatile float difference = ls - lt;
      volatile float sum = ls + lt;
      graph.at(i, j) = i != j && std::abs(difference) < tau && sum > r;
    }
  });
  return graph;
}

/** \brief Takes out the edges that an upright motion does not have.
 * \param[in] rise how much higher each target point is than its source point
 * \param[in] max_tilt in degrees */
inline void
keepHeights(const std::vector<float>& source,
            const std::vector<float>& rise,
            float tau,
            float max_tilt,
            Matrix<char>& graph)
{
  const double chord = 2 * std::sin(max_tilt * (3.14159265358979323846 / 180) / 2);
  const float slope = static_cast<float>(chord * chord);
  for (std::size_t i = 0; i < graph.n; ++i)
    for (std::size_t j = 0; j < graph.n; ++j) {
      volatile float difference = rise[i] - rise[j];
      volatile float excess = std::abs(difference) - tau;
      volatile float squared_excess = excess * excess;
      volatile float allowed = slope * squaredDistance(source, i, j);
      if (!(excess < 0 || squared_excess < allowed))
        graph.at(i, j) = 0;
    }
}

/** \brief Eq. (sog), whole matrix. */
inline Matrix<int>
exactScores(const Matrix<char>& graph, unsigned threads = 1)
{
  Matrix<int> scores(graph.n);
  forRows(graph.n, threads, [&](std::size_t i) {
    for (std::size_t j = 0; j < graph.n; ++j) {
      if (!graph.at(i, j))
        continue;
      int common = 0;
      for (std::size_t k = 0; k < graph.n; ++k)
        common += graph.at(i, k) & graph.at(j, k); // the graph is symmetric
      scores.at(i, j) = common;
    }
  });
  return scores;
}

/** \brief Eq. (sog_trunc) and (ell_sog): the first L neighbours vote; the first L positive
 * entries of the upper triangle of a row are kept. */
inline Matrix<int>
boundedScores(const Matrix<char>& graph, std::size_t L)
{
  Matrix<int> scores(graph.n);
  for (std::size_t i = 0; i < graph.n; ++i) {
    std::vector<std::size_t> voters;
    for (std::size_t k = 0; k < graph.n && voters.size() < L; ++k)
      if (graph.at(i, k))
        voters.push_back(k);
    std::size_t kept = 0;
    for (std::size_t j = i + 1; j < graph.n && kept < L; ++j) {
      if (!graph.at(i, j))
        continue;
      for (const std::size_t k : voters)
        scores.at(i, j) += graph.at(k, j);
      kept += scores.at(i, j) > 0;
    }
  }
  return scores;
}

/** \brief Score descending, then u, then v. */
inline void
sortEdges(std::vector<ScoredEdge>& edges)
{
  std::sort(edges.begin(), edges.end(), [](const ScoredEdge& a, const ScoredEdge& b) {
    if (a.score != b.score)
      return a.score > b.score;
    return a.u != b.u ? a.u < b.u : a.v < b.v;
  });
}

/** \brief Eq. (pivot): the K best; `pool` limits how many a row may enter. */
inline std::vector<ScoredEdge>
pivots(const Matrix<int>& scores,
       std::size_t K,
       std::size_t pool = std::numeric_limits<std::size_t>::max())
{
  std::vector<ScoredEdge> all;
  for (std::size_t u = 0; u < scores.n; ++u) {
    std::vector<ScoredEdge> row;
    for (std::size_t v = u + 1; v < scores.n; ++v)
      if (scores.at(u, v) > 0)
        row.push_back({u, v, scores.at(u, v)});
    sortEdges(row);
    row.resize(std::min(row.size(), pool));
    all.insert(all.end(), row.begin(), row.end());
  }
  sortEdges(all);
  all.resize(std::min(all.size(), K));
  return all;
}

/** \brief Eq. (common) and (clique): the T best third vertices of every pivot. */
inline std::vector<Triple>
cliques(const Matrix<int>& scores, const std::vector<ScoredEdge>& pivots, std::size_t T)
{
  std::vector<Triple> all;
  for (const ScoredEdge& p : pivots) {
    std::vector<Triple> of_pivot;
    for (std::size_t w = p.v + 1; w < scores.n; ++w)
      if (scores.at(p.u, w) > 0 && scores.at(p.v, w) > 0)
        of_pivot.push_back(
            {p.u, p.v, w, p.score + scores.at(p.u, w) + scores.at(p.v, w)});
    std::sort(of_pivot.begin(), of_pivot.end(), [](const Triple& a, const Triple& b) {
      return a.score != b.score ? a.score > b.score : a.w < b.w;
    });
    of_pivot.resize(std::min(of_pivot.size(), T));
    all.insert(all.end(), of_pivot.begin(), of_pivot.end());
  }
  return all;
}

} // namespace reference
} // namespace pcl_flashreg
