// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "houses.h"

#include <cstddef>
#include <numeric>
#include <vector>

namespace pcl_flashreg::generator {
namespace {

using Eigen::Vector3d;

/** \brief A window set back into the front, with its sill and cross; the frame's x runs
 * along the front and -y is outward. */
void
addWindow(const Placer& window, double width, double tall)
{
  window.seenWith(0.25).box({0, 0.22, 0}, {width, 0.04, tall});
  window.box({0, 0.19, 0}, {0.08, 0.06, tall});
  window.box({0, 0.19, tall * 0.18}, {width, 0.06, 0.08});
  window.box({0, -0.08, -tall / 2 - 0.05}, {width + 0.2, 0.3, 0.1});
}

/** \brief How a front is divided: widths of its bays, and heights of a storey. */
struct Front {
  std::vector<double> bays;
  double opening_share;
  double tall;
  double sill;
  double lintel;
};

Front
makeFront(Random& random)
{
  Front front;
  const int bays = 3 + static_cast<int>(random.uniform() * 4.0);
  for (int i = 0; i < bays; ++i)
    front.bays.push_back(random.uniform(1.8, 3.8));
  front.opening_share = random.uniform(0.35, 0.6);
  front.tall = random.uniform(2.8, 3.7);
  front.sill = random.uniform(0.22, 0.36) * front.tall;
  front.lintel = random.uniform(0.75, 0.86) * front.tall;
  return front;
}

/** \brief One storey: piers between the openings, and the bands above and below them.
 * The ground floor has its door in the given bay. */
void
addStorey(const Placer& storey, const Front& front, int door_bay)
{
  double x = 0.0;
  for (std::size_t i = 0; i < front.bays.size(); ++i) {
    const double bay = front.bays[i];
    const double width = front.opening_share * bay;
    const double pier = 0.5 * (bay - width);
    const Placer at = storey.at(x + bay / 2, 0, 0);
    x += bay;
    at.box({0, 0.15, (front.lintel + front.tall) / 2},
           {bay, 0.3, front.tall - front.lintel});
    for (const double side : {-0.5, 0.5})
      at.box({side * (bay - pier), 0.15, front.lintel / 2}, {pier, 0.3, front.lintel});
    if (static_cast<int>(i) == door_bay) {
      at.box({0, 0.45, front.lintel / 2}, {width, 0.1, front.lintel});
      at.box({0, -0.25, 0.08}, {width + 0.4, 0.5, 0.16});
      at.box({0, -0.35, front.lintel + 0.2}, {width + 0.8, 0.7, 0.12});
      continue;
    }
    at.box({0, 0.15, front.sill / 2}, {width, 0.3, front.sill});
    addWindow(
        at.at(0, 0, (front.sill + front.lintel) / 2), width, front.lintel - front.sill);
  }
}

void
addBalcony(const Placer& balcony, double width)
{
  balcony.box({0, -0.6, 0}, {width, 1.2, 0.15});
  balcony.box({0, -1.18, 1.0}, {width, 0.05, 0.06});
  const int bars = static_cast<int>(width / 0.25);
  for (int i = 0; i <= bars; ++i)
    balcony.box({-width / 2 + i * width / bars, -1.18, 0.5}, {0.04, 0.04, 1.0});
}

} // namespace

double
addHouse(const Placer& house, Random& random)
{
  const Front front = makeFront(random);
  const double width = std::accumulate(front.bays.begin(), front.bays.end(), 0.0);
  const int storeys = 2 + static_cast<int>(random.uniform() * 3.0);
  const double eaves = storeys * front.tall;
  const int door_bay =
      static_cast<int>(random.uniform() * static_cast<double>(front.bays.size()));
  for (int i = 0; i < storeys; ++i) {
    addStorey(house.at(0, 0, i * front.tall), front, i == 0 ? door_bay : -1);
    if (i > 0 && random.uniform() < 0.4) {
      const double x = random.uniform(0.2, 0.8) * width;
      addBalcony(house.at(x, 0, i * front.tall + 0.1), random.uniform(1.8, 2.4));
    }
  }
  // Side walls and back as one block behind the openings; then the roof.
  house.box({width / 2, 5.5, eaves / 2}, {width, 10.0, eaves});
  house.box({width / 2, -0.2, eaves + 0.1}, {width + 0.3, 1.0, 0.2});
  house.at(width / 2, 3.0, eaves + 1.6)
      .turned(40 * degree, Vector3d::UnitX())
      .box(Vector3d::Zero(), {width, 8.0, 0.3});
  house.cylinder({0.15, -0.08, eaves / 2}, 0.06, eaves);
  if (random.uniform() < 0.4)
    house.box({random.uniform(0.3, 0.7) * width, -0.45, eaves / 2}, {2.2, 0.9, eaves});
  return width;
}

} // namespace pcl_flashreg::generator
