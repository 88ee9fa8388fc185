// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scenes.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::generator {
namespace {

constexpr double length_x = 6.0;
constexpr double length_y = 5.0;
constexpr double height = 2.7;

using Eigen::Vector3d;

/** \brief Walls with a window niche and a door frame, skirting boards, floor, ceiling.
 */
void
addShell(const Placer& room)
{
  const double wall = 0.2;
  room.box({length_x / 2, length_y / 2, -wall / 2},
           {length_x + 1.0, length_y + 1.0, wall});
  room.box({length_x / 2, length_y / 2, height + wall / 2},
           {length_x + 1.0, length_y + 1.0, wall});
  room.box({-wall / 2, length_y / 2, height / 2}, {wall, length_y, height});
  room.box({length_x / 2, -wall / 2, height / 2}, {length_x, wall, height});
  room.box({length_x + wall / 2, length_y / 2, height / 2}, {wall, length_y, height});

  // The wall at y = length_y has a window niche from x = 3.3 to 4.7.
  const Placer far = room.at(0, length_y, 0);
  far.box({1.65, 0.1, height / 2}, {3.3, wall, height});
  far.box({5.35, 0.1, height / 2}, {1.3, wall, height});
  far.box({4.0, 0.1, 0.45}, {1.4, wall, 0.9});
  far.box({4.0, 0.1, 2.5}, {1.4, wall, 0.4});
  far.seenWith(0.3).box({4.0, 0.25, 1.6}, {1.5, 0.04, 1.5});
  far.box({4.0, 0.18, 1.6}, {0.07, 0.1, 1.4});
  far.box({4.0, -0.08, 0.88}, {1.5, 0.2, 0.04});

  // Door with its frame in the wall at x = length_x.
  const Placer door = room.at(length_x, 1.1, 0);
  door.box({-0.02, -0.5, 1.05}, {0.08, 0.1, 2.1});
  door.box({-0.02, 0.5, 1.05}, {0.08, 0.1, 2.1});
  door.box({-0.02, 0.0, 2.12}, {0.08, 1.1, 0.1});
  door.box({-0.06, 0.38, 1.0}, {0.12, 0.03, 0.03});

  room.box({length_x / 2, length_y - 0.01, 0.04}, {length_x, 0.02, 0.08});
  room.box({length_x - 0.01, length_y / 2 + 1.0, 0.04}, {0.02, length_y - 2.0, 0.08});
}

void
addTable(const Placer& table, Random& random)
{
  table.box({0, 0, 0.74}, {1.6, 0.8, 0.04});
  for (const double x : {-0.74, 0.74})
    for (const double y : {-0.34, 0.34})
      table.box({x, y, 0.36}, {0.06, 0.06, 0.72});
  const Placer top = table.at(0, 0, 0.76);
  const Placer screen = top.at(-0.35, 0.15, 0, 12 * degree);
  screen.box({0, 0, 0.01}, {0.24, 0.2, 0.02});
  screen.box({0, 0.03, 0.12}, {0.05, 0.03, 0.24});
  screen.box({0, 0, 0.34}, {0.56, 0.035, 0.34});
  top.at(-0.3, -0.2, 0, 5 * degree).box({0, 0, 0.012}, {0.42, 0.14, 0.025});
  top.cylinder({0.12, -0.22, 0.05}, 0.04, 0.10);
  top.cylinder({0.68, 0.22, 0.12}, 0.038, 0.24);
  top.cylinder({0.68, 0.22, 0.27}, 0.014, 0.08);
  top.ellipsoid({0.18, 0.2, 0.07}, {0.13, 0.13, 0.07});
  double base = 0.0;
  for (int i = 0; i < 5; ++i) {
    const double thickness = random.uniform(0.02, 0.05);
    top.at(0.45, -0.1, base, random.uniform(-0.4, 0.4))
        .box({0, 0, thickness / 2}, {0.22, 0.16, thickness});
    base += thickness;
  }
}

void
addChair(const Placer& chair)
{
  chair.box({0, 0, 0.45}, {0.44, 0.44, 0.04});
  for (const double x : {-0.19, 0.19})
    for (const double y : {-0.19, 0.19})
      chair.cylinder({x, y, 0.22}, 0.02, 0.44);
  chair.box({-0.19, 0.2, 0.68}, {0.04, 0.04, 0.44});
  chair.box({0.19, 0.2, 0.68}, {0.04, 0.04, 0.44});
  for (const double z : {0.62, 0.74, 0.87})
    chair.box({0, 0.2, z}, {0.38, 0.025, 0.08});
}

/** \brief A bookcase 1.2 m wide with its back at y = 0 and its front towards -y. */
void
addBookcase(const Placer& bookcase, Random& random)
{
  const double depth = 0.3;
  bookcase.box({0, -0.01, 1.0}, {1.2, 0.02, 2.0});
  for (const double x : {-0.6, 0.6})
    bookcase.box({x, -depth / 2, 1.0}, {0.03, depth, 2.0});
  for (int board = 0; board <= 5; ++board)
    bookcase.box({0, -depth / 2, 0.02 + board * 0.39}, {1.2, depth, 0.03});
  for (int board = 0; board < 5; ++board) {
    const Placer shelf = bookcase.at(0, 0, 0.035 + board * 0.39);
    for (double x = -0.56; x < 0.5;) {
      const double width = random.uniform(0.02, 0.07);
      const double tall = random.uniform(0.18, 0.33);
      const double deep = random.uniform(0.14, 0.26);
      const double pick = random.uniform();
      if (pick < 0.75)
        shelf.box({x + width / 2, -deep / 2 - 0.02, tall / 2}, {width, deep, tall});
      else if (pick < 0.82)
        shelf.ellipsoid({x + 0.09, -0.16, 0.09}, {0.08, 0.08, 0.09});
      x += pick < 0.75 ? width : random.uniform(0.12, 0.2);
    }
  }
}

void
addSofa(const Placer& sofa)
{
  sofa.box({0, 0, 0.2}, {1.9, 0.85, 0.3});
  sofa.box({0, 0.34, 0.55}, {1.9, 0.2, 0.55});
  for (const double x : {-0.88, 0.88}) {
    sofa.box({x, 0, 0.3}, {0.2, 0.85, 0.5});
    sofa.at(x, 0, 0.55)
        .turned(90 * degree, Vector3d::UnitX())
        .cylinder(Vector3d::Zero(), 0.12, 0.85);
  }
  for (const double x : {-0.39, 0.39})
    sofa.box({x, -0.05, 0.42}, {0.74, 0.68, 0.14});
  sofa.at(-0.55, 0.12, 0.62, 20 * degree)
      .turned(-25 * degree, Vector3d::UnitX())
      .ellipsoid(Vector3d::Zero(), {0.22, 0.08, 0.2});
  sofa.at(0.5, 0.1, 0.62, -15 * degree)
      .turned(-20 * degree, Vector3d::UnitX())
      .ellipsoid(Vector3d::Zero(), {0.25, 0.09, 0.18});
}

void
addFloorLamp(const Placer& lamp)
{
  lamp.cylinder({0, 0, 0.015}, 0.15, 0.03);
  lamp.cylinder({0, 0, 0.75}, 0.015, 1.5);
  lamp.cylinder({0, 0, 1.6}, 0.19, 0.28);
}

/** \brief A pot with long leaves that bend outward. */
void
addPlant(const Placer& plant, Random& random, double tall, int leaves)
{
  plant.cylinder({0, 0, 0.17}, 0.17, 0.34);
  plant.cylinder({0, 0, 0.25 + tall / 4}, 0.03, tall / 2);
  for (int i = 0; i < leaves; ++i) {
    const double yaw = random.uniform(0.0, 360.0) * degree;
    const double tilt = random.uniform(15.0, 75.0) * degree;
    const double reach = random.uniform(0.2, 0.42);
    plant.at(0, 0, 0.34 + random.uniform(0.3, 1.0) * tall / 2, yaw)
        .turned(tilt, Vector3d::UnitY())
        .ellipsoid({0, 0, reach / 2}, {0.012, random.uniform(0.03, 0.06), reach / 2});
  }
}

/** \brief A sideboard 1.4 m wide with its back at y = 0 and its front towards -y. */
void
addSideboard(const Placer& sideboard)
{
  sideboard.box({0, -0.22, 0.42}, {1.4, 0.44, 0.72});
  for (const double x : {-0.35, 0.35}) {
    sideboard.box({x, -0.45, 0.42}, {0.66, 0.02, 0.66});
    sideboard.box({x * 0.25, -0.475, 0.5}, {0.02, 0.03, 0.14});
  }
  sideboard.box({0, -0.24, 0.795}, {1.46, 0.5, 0.03});
  sideboard.cylinder({-0.5, -0.22, 0.95}, 0.07, 0.28);
  sideboard.ellipsoid({-0.5, -0.22, 1.12}, {0.11, 0.11, 0.09});
  sideboard.at(0.3, -0.25, 0.81, 18 * degree).box({0, 0, 0.1}, {0.36, 0.2, 0.2});
  sideboard.ellipsoid({0.0, -0.3, 0.89}, {0.07, 0.07, 0.08});
}

/** \brief Ribs under the window, a curtain's folds, pictures and a clock on the walls.
 */
void
addWallObjects(const Placer& room, Random& random)
{
  for (int rib = 0; rib < 12; ++rib)
    room.box({3.45 + rib * 0.1, length_y - 0.12, 0.42}, {0.06, 0.1, 0.6});
  for (int fold = 0; fold < 7; ++fold) {
    const double radius = random.uniform(0.035, 0.055);
    room.cylinder({4.78 + fold * 0.075, length_y - 0.1, 1.3}, radius, 2.3);
  }
  room.box({4.1, length_y - 0.1, 2.47}, {2.4, 0.03, 0.03});
  room.box({2.75, length_y - 0.02, 1.6}, {0.5, 0.04, 0.7});
  room.box({length_x - 0.02, 3.3, 1.65}, {0.04, 1.0, 0.65});
  room.box({length_x - 0.05, 3.3, 1.65}, {0.06, 0.9, 0.02});
  room.at(length_x - 0.02, 2.2, 2.0)
      .turned(90 * degree, Vector3d::UnitY())
      .cylinder(Vector3d::Zero(), 0.16, 0.05);
  room.box({0.03, 2.6, 1.5}, {0.06, 0.9, 0.6});
}

/** \brief Small things on the floor, where a grid of walls alone says little. */
void
addFloorObjects(const Placer& room, Random& random)
{
  room.ellipsoid({2.55, 2.1, 0.12}, {0.12, 0.12, 0.12});
  room.cylinder({5.6, 2.1, 0.17}, 0.14, 0.34);
  for (int i = 0; i < 4; ++i) {
    const double width = random.uniform(0.2, 0.45);
    const double depth = random.uniform(0.2, 0.4);
    const double tall = random.uniform(0.15, 0.35);
    const double x = random.uniform(4.7, 5.3);
    room.at(x, 2.3 + i * 0.42, 0, random.uniform(-0.6, 0.6))
        .box({0, 0, tall / 2}, {width, depth, tall});
  }
  const Placer stool = room.at(1.55, 3.0, 0, 0.3);
  stool.cylinder({0, 0, 0.43}, 0.18, 0.05);
  for (int leg = 0; leg < 3; ++leg)
    stool.at(0, 0, 0, leg * 120 * degree).cylinder({0.13, 0, 0.2}, 0.02, 0.42);
}

} // namespace

Scene
makeRoom(Random& random)
{
  Scene scene;
  const Placer room(scene, Eigen::Isometry3d::Identity());
  // About where each thing stands: within `play` metres, and `turn` radians.
  const auto spot = [&](double x, double y, double yaw, double play, double turn) {
    const double dx = random.uniform(-play, play);
    const double dy = random.uniform(-play, play);
    return room.at(x + dx, y + dy, 0, yaw + random.uniform(-turn, turn));
  };
  // Along a wall.
  const auto shift = [&random] { return random.uniform(-0.15, 0.15); };
  addShell(room);
  addTable(spot(3.3, 3.2, 0, 0.15, 0.25), random);
  addChair(spot(2.9, 2.5, 3.4, 0.1, 0.3));
  addChair(spot(3.9, 3.9, -0.4, 0.1, 0.3));
  addChair(spot(4.5, 3.0, -1.3, 0.1, 0.3));
  addBookcase(room.at(1.3 + shift(), length_y, 0), random);
  addSofa(room.at(0.5, 2.7 + shift(), 0, 90 * degree));
  addSideboard(room.at(length_x, 4.0 + shift(), 0, -90 * degree));
  addFloorLamp(spot(2.25, 4.5, 0, 0.1, 0));
  addPlant(room.at(5.25, 4.65, 0), random, 1.3, 40);
  addPlant(spot(2.0, 3.7, 0, 0.1, 0), random, 0.9, 28);
  addWallObjects(room, random);
  addFloorObjects(room, random);
  scene.build();
  return scene;
}

} // namespace pcl_flashreg::generator
