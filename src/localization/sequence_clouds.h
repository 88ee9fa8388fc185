// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"
#include "judgement/cpu/contacts.h"
#include "localization/scan_index_data.h"
#include "multiview/map_scan.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/sequence_localization.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace pcl_flashreg {

/** \brief The clouds of a sequence of scans, each about its own middle, and that of the map
 * about its. Where the sequence lies are the poses of all its scans in the map, which are those
 * of their middles. */
class SequenceClouds {
public:
  /** \param[in] map must outlive this */
  SequenceClouds(const std::vector<SequenceScan>& scans,
                 const ScanIndex::Data& map,
                 const Upright& upright,
                 ThreadPool& pool);

  std::size_t
  size() const
  {
    return members_.size();
  }

  double
  spacing() const
  {
    return spacing_;
  }

  /** \brief Of the map alone its middle counts. */
  const MapScan&
  map() const
  {
    return map_;
  }

  const MapScan&
  about(std::size_t scan) const
  {
    return members_[scan]->about;
  }

  const SurfacePair&
  pair(std::size_t scan) const
  {
    return members_[scan]->pair;
  }

  /** \brief Of the scans' middles. */
  const MapPoses&
  T_sequence_scan() const
  {
    return T_sequence_scan_;
  }

  /** \brief Where all scans are if one of them is there, by the sequence's poses. */
  MapPoses
  around(std::size_t scan, const Eigen::Isometry3d& place) const;

  /** \brief The same, each moved onto the map's surfaces: from that scan on to either end, each
   * from where its neighbour puts it, so that drift does not add up. */
  MapPoses
  settled(std::size_t scan, const Eigen::Isometry3d& place) const;

  /** \brief Whether most scans are in the same place. */
  bool
  same(const MapPoses& a, const MapPoses& b) const;

  /** \brief What all scans and the map touch. */
  std::vector<Contact>
  contacts(const MapPoses& places) const;

  /** \brief Whether the viewpoint of some scan is known. */
  bool
  seeing() const;

private:
  struct Member {
    Member(const SequenceScan& scan,
           const ScanIndex::Data& map,
           const Upright& upright,
           float spacing);
    Member(const Member&) = delete;
    Member&
    operator=(const Member&) = delete;

    MapScan about;
    Surface surface;
    Vicinity vicinity;
    SurfacePair pair;
  };

  Eigen::Isometry3d
  onto(std::size_t scan, const Eigen::Isometry3d& place) const;

  double spacing_;
  MapScan map_;
  std::vector<std::unique_ptr<const Member>> members_;
  MapPoses T_sequence_scan_;
};

/** \brief How the scans of a sequence, or some of them, get on with the map: all their points
 * together, as if one scan had seen it all. */
class SequenceLook {
public:
  /** \param[in] clouds that outlive this
   * \param[in] look see Look
   * \param[in] most scans that are asked, spread evenly */
  SequenceLook(const SequenceClouds& clouds,
               const LookSettings& look,
               std::size_t most = ~std::size_t{0});

  /** \brief Of each scan that is asked. */
  std::vector<CloudAgreement>
  ofEach(const MapPoses& places) const;

  CloudAgreement
  ofAll(const std::vector<CloudAgreement>& each) const;

  CloudAgreement
  operator()(const MapPoses& places) const
  {
    return ofAll(ofEach(places));
  }

private:
  std::vector<std::size_t> asked_;
  std::vector<Look> looks_;
  std::vector<double> weights_;
};

} // namespace pcl_flashreg
