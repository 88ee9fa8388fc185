# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

import numpy as np
import pytest
from conftest import Pair, error_of, same_result

import pcl_flashreg


def test_pose_is_right_and_trusted(pair):
    result = pair.result
    degrees, length = error_of(result.T_target_source, pair.T_target_source)
    assert degrees < 1 and length < 0.05
    assert result.converged and result.confidence > 0.9
    assert result.status == "ok"
    assert result.resolution == pair.resolution


def test_paths_arrays_clouds_and_scans_give_the_same(pair):
    for source, target in (
        (pair.source_path, pair.target_path),
        (str(pair.source_path), pair.target),
        (pcl_flashreg.Cloud(pair.source), pcl_flashreg.read_cloud(pair.target_path)),
        (pair.source_scan, pair.target_scan),
        (pair.source, pair.target_scan),
        (pair.source_scan, pair.target),
    ):
        result = pcl_flashreg.align(source, target, pair.resolution)
        assert same_result(result, pair.result), (type(source), type(target))


def test_a_cloud_beside_a_scan_has_its_resolution(pair):
    result = pcl_flashreg.align(pair.source, pair.target_scan)
    assert same_result(result, pair.result)


def test_resolution_is_estimated(pair):
    result = pcl_flashreg.align(pair.source, pair.target)
    assert 0.02 < result.resolution < 0.2
    assert result.converged
    degrees, length = error_of(result.T_target_source, pair.T_target_source)
    assert degrees < 3 and length < 0.1


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_same_bits_on_any_number_of_threads(pair, threads):
    result = pcl_flashreg.align(
        pair.source, pair.target, pair.resolution, num_threads=threads
    )
    assert same_result(result, pair.result)


def test_single_precision_is_taken_as_it_is(pair):
    source, target = pair.source.astype(np.float32), pair.target.astype(np.float32)
    # The files hold float32: nothing was lost.
    assert np.array_equal(source, pair.source)
    result = pcl_flashreg.align(source, target, pair.resolution)
    assert result.converged
    mixed = pcl_flashreg.align(source, pair.target, pair.resolution)
    assert same_result(mixed, pair.result)


def test_result_arrays(pair):
    result = pair.result
    assert result.T_target_source.shape == (4, 4)
    assert result.T_target_source.dtype == np.float64
    assert np.array_equal(result.T_target_source[3], [0, 0, 0, 1])
    assert result.information.shape == (6, 6) and result.information.dtype == np.float64
    assert np.array_equal(result.information, result.information.T)
    assert np.all(np.linalg.eigvalsh(result.information) > 0)
    assert result.inliers.dtype == np.int32 and result.inliers.ndim == 1
    assert np.all(np.diff(result.inliers) > 0)
    assert result.matches.dtype == np.int32
    assert result.matches.shape == (result.correspondences, 2)
    # Each row is what the core calls a match.
    agreeing = result.matches[result.inliers]
    source = result.source.points[agreeing[:, 0]] + result.source.shift
    target = result.target.points[agreeing[:, 1]] + result.target.shift
    pose = result.T_target_source
    apart = np.linalg.norm(source @ pose[:3, :3].T + pose[:3, 3] - target, axis=1)
    assert np.all(apart < 2 * pair.resolution * 1.001)


def test_result_reads_well(pair):
    text = repr(pair.result)
    assert text.startswith("Result(converged, confidence 1.00, ")
    assert "deg" in text and "correspondences agree" in text
    nothing = pcl_flashreg.estimate_pose(np.zeros((2, 3)), np.zeros((2, 3)))
    assert repr(nothing).startswith("Result(no pose: ")
    assert nothing.status == "too_few_correspondences"
    assert np.array_equal(nothing.T_target_source, np.eye(4))
    assert not nothing.converged and nothing.inliers.shape == (0,)


def test_result_says_why(pair):
    result = pair.result
    assert result.evidence.has_clouds and result.evidence.has_viewpoints
    assert result.evidence.agreement.matched > 0.3
    best = result.hypotheses[0]
    assert np.array_equal(best.T_target_source, result.T_target_source)
    assert best.agreement.matched > 0.3
    assert repr(best).startswith(f"Hypothesis({best.inlier_count} correspondences agree")
    assert len(result.hypotheses) > 1 and result.distinctness > 1
    assert result.free_motions == []
    assert repr(result.evidence).startswith("Evidence(inliers ")
    timings = result.timings_ms
    assert timings["total"] > 0 and set(timings) >= {"matching", "cloud_check", "cliques"}


def test_a_corridor_says_along_what_it_is_free():
    y, z = np.meshgrid(np.arange(-1, 1, 0.02), np.arange(-1, 1, 0.02))
    x = np.arange(0, 6, 0.02)
    walls = [
        np.c_[np.repeat(x, 100), np.tile(z[:, 0], x.size), np.full(x.size * 100, side)]
        for side in (-1.0, 1.0)
    ] + [
        np.c_[np.repeat(x, 100), np.full(x.size * 100, side), np.tile(z[:, 0], x.size)]
        for side in (-1.0, 1.0)
    ]
    tunnel = np.vstack(walls) + np.random.default_rng(1).normal(0, 0.002, (120000, 3))
    result = pcl_flashreg.align(tunnel, tunnel[::-1], 0.05)
    assert not result.converged
    assert "slide" in [motion.kind for motion in result.free_motions]
    slide = next(m for m in result.free_motions if m.kind == "slide")
    assert abs(slide.direction[0]) > 0.99
    assert repr(slide).startswith("FreeMotion(slide along [")


def test_guess_is_tried(pair):
    result = pcl_flashreg.align(
        pair.source, pair.target, pair.resolution, guess=pair.T_target_source
    )
    assert result.converged
    with pytest.raises(ValueError, match="guess: is no rigid transform"):
        pcl_flashreg.align(pair.source, pair.target, 0.05, guess=2 * np.eye(4))
    with pytest.raises(ValueError, match="guess: is 3 x 4, but has to be 4 x 4"):
        pcl_flashreg.align(pair.source, pair.target, 0.05, guess=np.eye(4)[:3])


def test_options_reach_the_core(pair):
    both_ways = pcl_flashreg.align(
        pair.source_scan, pair.target_scan, mutual=True, second_look=False
    )
    assert 0 < both_ways.correspondences < pair.result.correspondences
    many = pcl_flashreg.align(pair.source_scan, pair.target_scan, neighbors=2)
    assert many.correspondences == 2 * len(pair.source_scan)
    alone = pcl_flashreg.align(pair.source_scan, pair.target_scan, cloud_check=False)
    assert not alone.evidence.has_clouds
    with pytest.raises(ValueError, match="neighbors"):
        pcl_flashreg.align(pair.source_scan, pair.target_scan, neighbors=0)


def test_viewpoints(pair):
    unknown = [pcl_flashreg.Cloud(p, viewpoint=None) for p in (pair.source, pair.target)]
    result = pcl_flashreg.align(*unknown, pair.resolution)
    assert not result.evidence.has_viewpoints
    assert result.source.viewpoint is None
    assert result.source.viewpoint_source == "unknown"
    assert pair.result.source.viewpoint_source == "stated"
    assert np.array_equal(pair.result.source.viewpoint, [0, 0, 0])


def test_features_of_the_callers(pair):
    clouds = [
        pcl_flashreg.Cloud(s.points, normals=s.normals, features=s.descriptors)
        for s in (pair.source_scan, pair.target_scan)
    ]
    result = pcl_flashreg.align(*clouds, pair.resolution)
    assert result.converged
    assert np.array_equal(result.source.origins, np.arange(len(pair.source_scan)))
    with pytest.raises(ValueError, match="descriptors were given of the source alone"):
        pcl_flashreg.align(clouds[0], pair.target, pair.resolution)
    with pytest.raises(ValueError, match="features: are 5, but there are"):
        pcl_flashreg.Cloud(pair.source, features=np.zeros((5, 33), np.float32))
    with pytest.raises(ValueError, match="normals: are 5, but there are"):
        pcl_flashreg.Cloud(pair.source, normals=np.zeros((5, 3)))


def test_unknown_words_and_types(pair):
    with pytest.raises(ValueError, match="backend is 'gpu', but must be one of 'auto'"):
        pcl_flashreg.align(pair.source, pair.target, backend="gpu")
    with pytest.raises(TypeError):
        pcl_flashreg.align(pair.source, pair.target, colour=3)
    with pytest.raises(TypeError, match="source: is a ScanIndex"):
        index = pcl_flashreg.PairRegistration().make_index(pair.target_scan)
        pcl_flashreg.align(index, pair.target)
    for resolution in (0, -1, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="resolution"):
            pcl_flashreg.align(pair.source, pair.target, resolution)
    with pytest.raises(TypeError):
        pcl_flashreg.align(pair.source, pair.target, "0.05")


def test_backends():
    names = pcl_flashreg.available_backends()
    assert "cpu-scalar" in names
    assert pcl_flashreg.PairRegistration(1, "cpu").backend in names
    assert pcl_flashreg.PairRegistration(1).backend == names[0]
    if "cuda" not in names:
        with pytest.raises(pcl_flashreg.BackendError):
            pcl_flashreg.PairRegistration(backend="cuda")
    assert issubclass(pcl_flashreg.BackendError, RuntimeError)


def test_bundled_pair_is_there():
    assert Pair.source_path.exists() and Pair.target_path.exists()
