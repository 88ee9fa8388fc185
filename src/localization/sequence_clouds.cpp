// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "localization/sequence_clouds.h"

#include "judgement/cpu/plane_alignment.h"
#include "judgement/cpu/principal_motions.h"
#include "math/isometry.h"
#include "scan/scan_view.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief A viewpoint that the scan's own pose in the map says is wrong is no witness. */
CloudView<float>
believedView(const SequenceScan& scan)
{
  CloudView<float> view = viewOf(scan.scan);
  if (scan.alone.converged && scan.alone.evidence.overruled_viewpoints)
    view.viewpoint.reset();
  return view;
}

} // namespace

SequenceClouds::Member::Member(const SequenceScan& scan,
                               const ScanIndex::Data& map,
                               const Upright& upright,
                               float spacing)
    : pair{surface, map.surface, spacing, Belief::Viewpoints, upright, &vicinity}
{
  const CloudView<float> view = believedView(scan);
  const Vec3 middle = middleOf(view);
  surface.build(view, middle, spacing);
  vicinity.build(surface, map.surface);
  about.points = surface.points.size();
  about.middle = toEigen(middle + shiftOf(scan.scan));
  about.spacing = spacing;
}

SequenceClouds::SequenceClouds(const std::vector<SequenceScan>& scans,
                               const ScanIndex::Data& map,
                               const Upright& upright,
                               ThreadPool& pool)
    : spacing_(map.scan.spacing()), members_(scans.size())
{
  map_.middle = toEigen(map.middle);
  map_.spacing = spacing_;
  pool.forEach(scans.size(), [&](std::size_t i, std::size_t) {
    members_[i] =
        std::make_unique<Member>(scans[i], map, upright, static_cast<float>(spacing_));
  });
  for (std::size_t i = 0; i < scans.size(); ++i)
    T_sequence_scan_.push_back(
        betweenMiddles(scans[i].T_sequence_scan, MapScan(), about(i)));
}

MapPoses
SequenceClouds::around(std::size_t scan, const Eigen::Isometry3d& place) const
{
  const Eigen::Isometry3d T_map_sequence =
      place * T_sequence_scan_[scan].inverse(Eigen::Isometry);
  MapPoses places;
  for (const Eigen::Isometry3d& T : T_sequence_scan_)
    places.push_back(T_map_sequence * T);
  return places;
}

Eigen::Isometry3d
SequenceClouds::onto(std::size_t scan, const Eigen::Isometry3d& place) const
{
  const Eigen::Isometry3d moved = toIsometry(moveOntoTarget(pair(scan), toPose(place)));
  return samePlace(moved, place, spacing_) ? moved : place;
}

MapPoses
SequenceClouds::settled(std::size_t scan, const Eigen::Isometry3d& place) const
{
  MapPoses places(size());
  places[scan] = onto(scan, place);
  const auto follow = [&](std::size_t from, std::size_t to) {
    const Eigen::Isometry3d step =
        T_sequence_scan_[from].inverse(Eigen::Isometry) * T_sequence_scan_[to];
    places[to] = onto(to, places[from] * step);
  };
  for (std::size_t i = scan; i + 1 < size(); ++i)
    follow(i, i + 1);
  for (std::size_t i = scan; i > 0; --i)
    follow(i, i - 1);
  return places;
}

bool
SequenceClouds::same(const MapPoses& a, const MapPoses& b) const
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < size(); ++i)
    count += samePlace(a[i], b[i], spacing_) ? 1 : 0;
  return 2 * count > size();
}

std::vector<Contact>
SequenceClouds::contacts(const MapPoses& places) const
{
  std::vector<Contact> all;
  for (std::size_t i = 0; i < size(); ++i) {
    const std::vector<Contact> some = contactsForMotions(pair(i), toPose(places[i]));
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

bool
SequenceClouds::seeing() const
{
  return std::any_of(members_.begin(), members_.end(), [](const auto& member) {
    return member->pair.seeing();
  });
}

SequenceLook::SequenceLook(const SequenceClouds& clouds,
                           const LookSettings& look,
                           std::size_t most)
{
  const std::size_t count = std::min(most, clouds.size());
  looks_.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t scan = k * clouds.size() / count;
    asked_.push_back(scan);
    looks_.emplace_back(clouds.pair(scan), look);
    weights_.push_back(static_cast<double>(clouds.about(scan).points));
  }
}

std::vector<CloudAgreement>
SequenceLook::ofEach(const MapPoses& places) const
{
  std::vector<CloudAgreement> each;
  for (std::size_t k = 0; k < asked_.size(); ++k)
    each.push_back(looks_[k](toPose(places[asked_[k]])));
  return each;
}

CloudAgreement
SequenceLook::ofAll(const std::vector<CloudAgreement>& each) const
{
  CloudAgreement sum;
  double weights = 0;
  for (std::size_t k = 0; k < each.size(); ++k) {
    sum.matched += weights_[k] * each[k].matched;
    sum.contradicted += weights_[k] * each[k].contradicted;
    sum.residual += weights_[k] * each[k].residual * each[k].residual;
    weights += weights_[k];
  }
  if (!(weights > 0))
    return {};
  return {sum.matched / weights,
          sum.contradicted / weights,
          std::sqrt(sum.residual / weights)};
}

} // namespace pcl_flashreg
