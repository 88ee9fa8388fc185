// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "modules.h"

#include "../io/pcl_cloud.h"

#include <pcl/visualization/pcl_visualizer.h>

namespace pcl_flashreg::align {
namespace {

using Color = pcl::visualization::PointCloudColorHandlerCustom<pcl::PointXYZ>;

/** \brief Adds one half of the window; both clouds are shown relative to one place. */
void
addHalf(pcl::visualization::PCLVisualizer& viewer,
        const Eigen::Matrix3Xd& source,
        const Eigen::Matrix3Xd& target,
        const std::string& title,
        double left)
{
  int viewport = 0;
  viewer.createViewPort(left, 0, left + 0.5, 1, viewport);
  viewer.setBackgroundColor(0.08, 0.09, 0.11, viewport);
  viewer.addText(title, 12, 12, 18, 1, 1, 1, title, viewport);
  const io::ShiftedCloud shown = io::toPclCloud(target);
  const Eigen::Matrix3Xd moved = source.colwise() - shown.shift;
  pcl::PointCloud<pcl::PointXYZ>::Ptr other(new pcl::PointCloud<pcl::PointXYZ>);
  for (Eigen::Index i = 0; i < moved.cols(); ++i)
    other->push_back(pcl::PointXYZ(static_cast<float>(moved(0, i)),
                                   static_cast<float>(moved(1, i)),
                                   static_cast<float>(moved(2, i))));
  other->is_dense = false;
  viewer.addPointCloud(
      shown.points, Color(shown.points, 77, 148, 230), "target " + title, viewport);
  viewer.addPointCloud(other, Color(other, 245, 150, 40), "source " + title, viewport);
}

} // namespace

} // namespace pcl_flashreg::align

void
pcl_flashreg_show_clouds(const pcl_flashreg::align::ShownClouds& clouds)
{
  using namespace pcl_flashreg::align;
  using Points = Eigen::Map<const Eigen::Matrix3Xd>;
  const Points source(clouds.source, 3, clouds.source_size);
  const Points moved(clouds.moved_source, 3, clouds.source_size);
  const Points target(clouds.target, 3, clouds.target_size);
  pcl::visualization::PCLVisualizer viewer("pcl_flashreg_align");
  addHalf(viewer, source, target, "before", 0.0);
  addHalf(viewer, moved, target, "after", 0.5);
  viewer.resetCamera();
  viewer.spin();
}
