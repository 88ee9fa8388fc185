# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

import numpy as np
import pytest

import pcl_flashreg


def test_features_are_those_of_a_scan(pair):
    cloud = pcl_flashreg.compute_features(pair.source, pair.resolution)
    scan = pair.source_scan
    assert len(cloud) == len(scan)
    assert repr(cloud) == f"DescribedCloud({len(scan)} keypoints)"
    for name in ("points", "normals", "curvatures", "descriptors"):
        mine = getattr(cloud, name)
        assert np.array_equal(mine, getattr(scan, name)), name
        assert not mine.flags.writeable


def test_lengths(pair):
    def compute(*lengths, **more):
        return pcl_flashreg.compute_features(pair.source, *lengths, **more)

    coarse = compute(0.1)
    assert len(coarse) < len(pair.source_scan)
    explicit = compute(0.1, normal_radius=0.2, feature_radius=0.5, num_threads=1)
    assert np.array_equal(explicit.descriptors, coarse.descriptors)
    every = compute(0, normal_radius=0.1, feature_radius=0.2)
    assert len(coarse) < len(every) <= len(pair.source)
    for lengths in ((-1,), (float("nan"),), (0,)):
        with pytest.raises(ValueError):
            compute(*lengths)
    with pytest.raises(ValueError, match="feature_radius"):
        compute(0.1, normal_radius=0.5, feature_radius=0.2)


def test_matches_are_those_of_a_search(pair):
    queries = pair.source_scan.descriptors[:50]
    targets = pair.target_scan.descriptors
    pairs, squared = pcl_flashreg.match_features(queries, targets, 2)
    assert pairs.dtype == np.int32 and pairs.shape == (100, 2)
    assert squared.dtype == np.float32 and squared.shape == (100,)
    distances = (
        (queries[:, None, :].astype(float) - targets[None].astype(float)) ** 2
    ).sum(axis=2)
    order = np.argsort(distances, axis=1, kind="stable")[:, :2]
    assert np.array_equal(pairs[:, 0], np.repeat(np.arange(50), 2))
    assert np.array_equal(pairs[:, 1], order.ravel())
    assert np.allclose(squared, np.take_along_axis(distances, order, 1).ravel())


def test_mutual_matches(pair):
    a, b = pair.source_scan.descriptors, pair.target_scan.descriptors
    forward = {tuple(m) for m in pcl_flashreg.match_features(a, b)[0]}
    backward = {(t, q) for q, t in pcl_flashreg.match_features(b, a)[0]}
    mutual, squared = pcl_flashreg.match_features(a, b, mutual=True, num_threads=1)
    assert {tuple(m) for m in mutual} == forward & backward
    assert len(mutual) == len(squared) > 0


def test_matching_of_scans(pair):
    registration = pcl_flashreg.PairRegistration()
    pairs, squared = registration.match(pair.source_scan, pair.target_scan)
    assert np.array_equal(pairs, pair.result.matches)
    assert len(squared) == len(pairs)
    mutual, _ = registration.match(pair.source_scan, pair.target_scan, mutual=True)
    assert 0 < len(mutual) < len(pairs)
    with pytest.raises(ValueError, match="neighbors is 0"):
        registration.match(pair.source_scan, pair.target_scan, neighbors=0)


def test_matches_become_a_pose(pair):
    """What align() does, step by step."""
    source, target = pair.source_scan, pair.target_scan
    pairs, squared = pcl_flashreg.match_features(source.descriptors, target.descriptors)
    result = pcl_flashreg.estimate_pose(
        source.points[pairs[:, 0]],
        target.points[pairs[:, 1]],
        ranks=squared,
        source=source,
        target=target,
    )
    assert result.converged
    assert np.allclose(result.T_target_source, pair.result.T_target_source, atol=0.02)
    assert result.matches.shape == (0, 2) and result.correspondences == len(pairs)
    assert result.evidence.has_clouds


def test_clouds_of_correspondences(pair):
    points = (pair.source_scan.points, pair.target_scan.points)
    pairs = pair.result.matches
    rows = (points[0][pairs[:, 0]], points[1][pairs[:, 1]])
    by_arrays = pcl_flashreg.estimate_pose(
        *rows, 0.05, source=pair.source, target=pair.target
    )
    mixed = pcl_flashreg.estimate_pose(
        *rows, 0.05, source=pair.source_scan, target=pair.target
    )
    for result in (by_arrays, mixed):
        assert result.converged and result.evidence.has_clouds
    alone = pcl_flashreg.estimate_pose(*rows, 0.05)
    assert not alone.evidence.has_clouds
    with pytest.raises(ValueError, match="target: is None, and the other cloud is not"):
        pcl_flashreg.estimate_pose(*rows, source=pair.source)


def test_descriptors_have_the_same_dimension():
    a, b = np.zeros((4, 3), np.float32), np.zeros((4, 5), np.float32)
    with pytest.raises(ValueError):
        pcl_flashreg.match_features(a, b)
    with pytest.raises(ValueError):
        pcl_flashreg.match_features(a, a, 0)
    with pytest.raises(ValueError, match="targets: is of length 4, but has to be N x D"):
        pcl_flashreg.match_features(a, a[:, 0])
    with pytest.raises(TypeError, match="queries: is of int32"):
        pcl_flashreg.match_features(a.astype(np.int32), a)


def test_nothing_to_match():
    nothing = np.zeros((0, 33), np.float32)
    pairs, squared = pcl_flashreg.match_features(nothing, nothing)
    assert pairs.shape == (0, 2) and squared.shape == (0,)


def test_resolution(pair):
    assert 0.02 < pcl_flashreg.estimate_resolution(pair.source) < 0.2
    assert pcl_flashreg.estimate_resolution(pair.source_path) == (
        pcl_flashreg.estimate_resolution(pair.source)
    )
