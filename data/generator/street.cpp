// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "houses.h"
#include "scenes.h"
#include "vegetation.h"

#include <cmath>

namespace pcl_flashreg::generator {
namespace {

constexpr double half_length = 90.0;
/** \brief From the middle of the street to the kerb, and to the house fronts. */
constexpr double kerb_y = 5.2;
constexpr double front_y = 8.6;

using Eigen::Vector3d;

/** \brief Road, kerbs and pavements; the frame's x axis follows the slope. */
void
addGround(const Placer& street)
{
  street.box({0, 0, -0.5}, {4 * half_length, 4 * half_length, 1.0});
  for (const double side : {-1.0, 1.0})
    street.box({0, side * (kerb_y + 6.0), 0.0}, {2 * half_length, 12.0, 0.28});
}

/** \brief A low wall with posts, along x. */
void
addGardenWall(const Placer& wall, double length)
{
  wall.box({length / 2, 0, 0.3}, {length, 0.25, 0.6});
  for (double x = 0.0; x <= length; x += 2.1)
    wall.box({x, 0, 0.55}, {0.35, 0.35, 1.1});
}

/** \brief Houses along x, some apart. A house that stands back has a front garden. */
void
addHouseRow(const Placer& row, double largest_setback, Random& random)
{
  double x = -half_length;
  while (x < half_length) {
    const double setback = largest_setback * random.uniform();
    const double width = addHouse(row.at(x, setback, 0.1), random);
    if (setback > 2.0) {
      addGardenWall(row.at(x, 0.2, 0.14), random.uniform(0.5, 0.9) * width);
      for (int i = 0; i < 3; ++i) {
        const double along = random.uniform() * width;
        const double inward = random.uniform(0.8, setback - 0.6);
        addBush(row.at(x + along, inward, 0.14), random);
      }
    }
    x += width;
    const double pick = random.uniform();
    x += pick < 0.25 ? random.uniform(4.0, 9.0) : pick < 0.6 ? 1.2 : 0.0;
  }
}

/** \brief A car with its front towards +x. */
void
addCar(const Placer& car, Random& random)
{
  const double scale = random.uniform(0.92, 1.1);
  const double body = 4.3 * scale;
  const double wide = 1.75;
  const double roof = random.uniform(1.4, 1.75);
  const bool van = random.uniform() < 0.2;
  car.box({0, 0, 0.55}, {body, wide, 0.6});
  car.box({0, 0, 0.35}, {body - 0.3, wide - 0.06, 0.3});
  car.box({-0.15 * body, 0, (0.85 + roof) / 2},
          {(van ? 0.68 : 0.4) * body, wide - 0.2, roof - 0.85});
  if (van)
    car.box({-0.2 * body, 0, 1.5}, {0.6 * body, wide, 1.2});
  car.seenWith(0.5)
      .at(0.12 * body, 0, 0.5 * (0.8 + roof))
      .turned(52 * degree, Vector3d::UnitY())
      .box(Vector3d::Zero(), {1.1, wide - 0.25, 0.05});
  car.seenWith(0.5)
      .at(-0.38 * body, 0, 0.5 * (0.8 + roof))
      .turned(-55 * degree, Vector3d::UnitY())
      .box(Vector3d::Zero(), {0.95, wide - 0.25, 0.05});
  for (const double y : {-0.5 * wide, 0.5 * wide}) {
    car.box({0.2 * body, 1.1 * y, 0.98}, {0.12, 0.18, 0.14});
    for (const double x : {-0.31 * body, 0.31 * body})
      car.at(x, 0.92 * y, 0.31)
          .turned(90 * degree, Vector3d::UnitX())
          .cylinder(Vector3d::Zero(), 0.31, 0.22);
  }
}

void
addStreetLamp(const Placer& lamp)
{
  lamp.cylinder({0, 0, 3.0}, 0.08, 6.0);
  lamp.box({0, 0, 0.5}, {0.24, 0.24, 1.0});
  lamp.box({0, -0.7, 5.95}, {0.08, 1.5, 0.08});
  lamp.box({0, -1.35, 5.85}, {0.25, 0.6, 0.14});
}

void
addSign(const Placer& sign, Random& random)
{
  sign.cylinder({0, 0, 1.2}, 0.04, 2.4);
  sign.at(0, 0, 2.2, random.uniform(0.0, 180.0) * degree)
      .box({0, 0, 0}, {0.6, 0.03, 0.6});
}

/** \brief An open shelter 3.5 m long. */
void
addBusShelter(const Placer& shelter)
{
  shelter.box({0, 0, 2.4}, {3.5, 1.6, 0.12});
  for (const double x : {-1.65, 1.65})
    for (const double y : {-0.7, 0.7})
      shelter.box({x, y, 1.2}, {0.08, 0.08, 2.4});
  shelter.seenWith(0.4).box({0, 0.72, 1.3}, {3.3, 0.03, 1.7});
  shelter.box({1.68, 0, 1.2}, {0.06, 1.3, 1.6});
  shelter.box({-0.4, 0.45, 0.5}, {2.0, 0.35, 0.06});
}

void
addBin(const Placer& bin, Random& random)
{
  const double tall = random.uniform(0.9, 1.2);
  bin.at(0, 0, 0, random.uniform(-0.3, 0.3)).box({0, 0, tall / 2}, {0.58, 0.7, tall});
}

/** \brief Cars along one kerb, with gaps. The frame's +y points to the houses. */
void
addParkedCars(const Placer& side, double share, Random& random)
{
  for (double x = -half_length; x < half_length; x += random.uniform(5.2, 6.5)) {
    const double y = kerb_y - 1.1 + random.uniform(-0.15, 0.15);
    const double heading = random.uniform() < 0.5 ? 0.0 : 180.0;
    const double yaw = heading * degree + random.uniform(-0.05, 0.05);
    if (random.uniform() < share)
      addCar(side.at(x, y, 0, yaw), random);
  }
}

/** \brief Trees, lamps, signs, bins and bushes on one pavement. */
void
addPavementObjects(const Placer& side, Random& random)
{
  for (double x = -half_length; x < half_length; x += random.uniform(3.0, 6.5)) {
    const double pick = random.uniform();
    const Placer spot = side.at(x, kerb_y + random.uniform(0.5, 0.9), 0.14);
    if (pick < 0.4)
      addTree(spot, random);
    else if (pick < 0.55)
      addStreetLamp(spot);
    else if (pick < 0.7)
      addSign(spot, random);
    else if (pick < 0.85)
      addBin(side.at(x, front_y - random.uniform(0.4, 0.9), 0.14), random);
    else
      addBush(spot, random);
  }
}

} // namespace

Scene
makeStreet(Random& random)
{
  Scene scene;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(-std::atan(street_slope), Vector3d::UnitY()));
  const Placer street(scene, pose);
  addGround(street);
  const Placer left = street;
  const Placer right = street.at(0, 0, 0, 180 * degree);
  // The two sides differ: alike, the street would fit itself turned by half a turn.
  addHouseRow(left.at(0, front_y, 0), 1.5, random);
  addHouseRow(right.at(0, front_y, 0), 6.0, random);
  addParkedCars(left, 0.65, random);
  addParkedCars(right, 0.3, random);
  addPavementObjects(left, random);
  addPavementObjects(right, random);
  addBusShelter(street.at(random.uniform(6.0, 12.0), kerb_y + 1.4, 0.14));
  const Placer column = street.at(random.uniform(-8.0, -3.0), -kerb_y - 1.0, 0.14);
  column.cylinder({0, 0, 1.5}, 0.65, 3.0);
  column.ellipsoid({0, 0, 3.0}, {0.75, 0.75, 0.4});
  scene.build();
  return scene;
}

} // namespace pcl_flashreg::generator
