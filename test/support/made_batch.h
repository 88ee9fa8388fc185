// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/made_correspondences.h"

#include <limits>
#include <vector>

namespace pcl_flashreg {
namespace made {

/** \brief Problems of mixed sizes, some of which have no pose. */
class Batch {
public:
  Batch()
  {
    for (const std::size_t size : {600, 0, 130, 2, 900, 64, 300}) {
      Recipe recipe;
      recipe.size = size;
      recipe.inlier_ratio = 0.3;
      recipe.seed = size + 1;
      problems_.push_back(make(recipe));
    }
    // One that is not finite, and one of a single place.
    problems_.push_back(problems_.front());
    for (double& x : problems_.back().source)
      x = std::numeric_limits<double>::quiet_NaN();
    problems_.push_back(problems_.front());
    for (std::vector<double>* side :
         {&problems_.back().source, &problems_.back().target})
      side->assign(side->size(), 1.0);
  }

  std::vector<CorrespondenceView<double>>
  views() const
  {
    std::vector<CorrespondenceView<double>> views;
    for (const Correspondences& problem : problems_)
      views.push_back(problem.view());
    return views;
  }

private:
  std::vector<Correspondences> problems_;
};

} // namespace made
} // namespace pcl_flashreg
