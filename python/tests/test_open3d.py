# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

"""Open3D's clouds and tensors are taken, and poses are what it takes."""

import numpy as np
import pytest
from conftest import error_of, same_result

import pcl_flashreg

open3d = pytest.importorskip("open3d", reason="Open3D is not installed")


@pytest.fixture(scope="module")
def clouds(pair):
    return [open3d.io.read_point_cloud(str(p)) for p in (pair.source_path, pair.target_path)]


def test_point_clouds(pair, clouds):
    result = pcl_flashreg.align(*clouds, pair.resolution)
    assert same_result(result, pair.result)
    source, target = clouds
    evaluation = open3d.pipelines.registration.evaluate_registration(
        source, target, 0.1, result.T_target_source
    )
    assert evaluation.fitness > 0.5
    # The known motion of a cloud comes back.
    moved = open3d.geometry.PointCloud(source).transform(pair.T_target_source)
    known = pcl_flashreg.align(source, moved, pair.resolution)
    degrees, length = error_of(known.T_target_source, pair.T_target_source)
    assert known.converged and degrees < 0.5 and length < 0.02


def test_vectors_are_not_copied(pair, clouds):
    points = clouds[0].points
    cloud = pcl_flashreg.Cloud(points)
    assert np.shares_memory(cloud.points, np.asarray(points))
    result = pcl_flashreg.align(points, clouds[1].points, pair.resolution)
    assert same_result(result, pair.result)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_tensors(pair, dtype):
    arrays = [points.astype(dtype) for points in (pair.source, pair.target)]
    tensors = [open3d.core.Tensor(points) for points in arrays]
    assert np.shares_memory(pcl_flashreg.Cloud(tensors[0]).points, tensors[0].numpy())
    result = pcl_flashreg.align(*tensors, pair.resolution)
    assert same_result(result, pcl_flashreg.align(*arrays, pair.resolution))


def test_features(pair, clouds):
    """Descriptors of Open3D's are columns of float64."""
    search = open3d.geometry.KDTreeSearchParamHybrid(radius=0.25, max_nn=100)
    described = []
    for cloud in clouds:
        thin = cloud.voxel_down_sample(pair.resolution)
        thin.estimate_normals(open3d.geometry.KDTreeSearchParamHybrid(0.1, 30))
        thin.orient_normals_towards_camera_location()
        fpfh = open3d.pipelines.registration.compute_fpfh_feature(thin, search)
        described.append(
            pcl_flashreg.Cloud(
                thin.points, normals=thin.normals, features=np.asarray(fpfh.data).T
            )
        )
    result = pcl_flashreg.align(*described, pair.resolution)
    degrees, length = error_of(result.T_target_source, pair.T_target_source)
    assert result.converged and degrees < 2 and length < 0.1
