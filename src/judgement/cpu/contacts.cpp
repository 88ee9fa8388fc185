// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/contacts.h"

#include <Eigen/Geometry>

namespace pcl_flashreg {

namespace {

/** \brief What some of the source's points touch. */
void
findContactsOf(const PointRanges& numbers,
               const SurfacePair& clouds,
               const RigidFloat& pose,
               const Reach& reach,
               std::vector<Contact>& contacts)
{
  const Surface &source = clouds.source, &target = clouds.target;
  const bool oriented = clouds.oriented();
  const float limit = reach.radius * clouds.spacing;
  numbers.forSome(reach.points, [&](std::size_t i) {
    const Eigen::Vector3f place = pose * source.points[i];
    const int neighbor = target.nearest.find(place);
    if (neighbor < 0)
      return;
    const Eigen::Vector3f offset = place - target.points[neighbor];
    const Eigen::Vector3f& normal = target.normals[neighbor];
    const float cosine =
        alignmentOf(pose.rotation * source.normals[i], normal, oriented);
    if (offset.squaredNorm() <= limit * limit && cosine >= reach.min_cosine)
      contacts.push_back({place, normal, normal.dot(offset)});
  });
}

} // namespace

void
findContacts(const SurfacePair& clouds,
             const RigidFloat& pose,
             const Reach& reach,
             std::vector<Contact>& contacts)
{
  findContactsOf(
      PointRanges(clouds.source.points.size()), clouds, pose, reach, contacts);
}

std::vector<Contact>
contactsOfBoth(const SurfacePair& clouds, const RigidFloat& pose, const Reach& reach)
{
  std::vector<Contact> contacts, back;
  findContacts(clouds, pose, reach, contacts);
  findContactsOf(clouds.targetUnder(pose),
                 {clouds.target, clouds.source, clouds.spacing},
                 inverse(pose),
                 reach,
                 back);
  for (const Contact& contact : back)
    contacts.push_back(
        {pose * contact.place, pose.rotation * contact.normal, contact.residual});
  return contacts;
}

Eigen::Vector3d
middleOf(const std::vector<Contact>& contacts)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Contact& contact : contacts)
    sum += contact.place.cast<double>();
  return sum / static_cast<double>(contacts.size());
}

Eigen::Matrix<double, 6, 1>
jacobianOf(const Contact& contact, const Eigen::Vector3d& arm)
{
  const Eigen::Vector3d normal = contact.normal.cast<double>();
  Eigen::Matrix<double, 6, 1> jacobian;
  jacobian << arm.cross(normal), normal;
  return jacobian;
}

} // namespace pcl_flashreg
