# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

"""What is taken as an array, and what of it is copied."""

import gc

import numpy as np
import pytest
from conftest import made_points, moved, same_result, some_pose

import pcl_flashreg

SOURCE = made_points()
TARGET = moved(SOURCE, some_pose())


def estimate(source, target=TARGET, **options):
    return pcl_flashreg.estimate_pose(source, target, 0.05, **options)


EXPECTED = estimate(SOURCE)


def column_slice(points):
    wide = np.full((len(points), 5), np.nan, points.dtype)
    wide[:, 1:4] = points
    return wide[:, 1:4]


def every_other(points):
    return np.repeat(points, 2, axis=0)[::2]


def read_only(points):
    points = points.copy()
    points.setflags(write=False)
    return points


def reversed_twice(points):
    return points[::-1].copy()[::-1]


def mirrored_columns(points):
    return points[:, ::-1].copy()[:, ::-1]


def unaligned(points):
    packed = np.zeros(len(points), np.dtype([("tag", "u1"), ("xyz", points.dtype, 3)]))
    packed["xyz"] = points
    return packed["xyz"]


def swapped(points):
    return points.astype(points.dtype.newbyteorder())


def as_lists(points):
    return points.tolist()


class ArrayMethod:
    def __init__(self, points):
        self.points_of_mine = points

    def __array__(self, dtype=None, copy=None):
        return self.points_of_mine


class ArrayInterface:
    def __init__(self, points):
        self.kept = points
        self.__array_interface__ = points.__array_interface__


class Dlpack:
    def __init__(self, points):
        self.kept = points

    def __dlpack__(self, **arguments):
        return self.kept.__dlpack__(**arguments)

    def __dlpack_device__(self):
        return self.kept.__dlpack_device__()


class NumpyMethod:
    def __init__(self, points):
        self.kept = points

    def numpy(self):
        return self.kept


class HasPoints:
    def __init__(self, points):
        self.points = points


FORMS = [
    np.asfortranarray,
    column_slice,
    every_other,
    read_only,
    reversed_twice,
    mirrored_columns,
    unaligned,
    swapped,
    memoryview,
    ArrayMethod,
    ArrayInterface,
    Dlpack,
    NumpyMethod,
]


@pytest.mark.parametrize("form", FORMS + [as_lists], ids=lambda form: form.__name__)
def test_forms_of_the_same_points(form):
    assert EXPECTED.converged
    assert same_result(estimate(form(SOURCE)), EXPECTED)
    assert same_result(estimate(SOURCE, form(TARGET)), EXPECTED)


@pytest.mark.parametrize("form", FORMS, ids=lambda form: form.__name__)
def test_forms_of_single_precision(form):
    source, target = SOURCE.astype(np.float32), TARGET.astype(np.float32)
    expected = estimate(source, target)
    assert same_result(estimate(form(source), form(target)), expected)


@pytest.mark.parametrize("form", FORMS + [HasPoints], ids=lambda form: form.__name__)
def test_forms_of_clouds(form):
    points = np.tile(SOURCE, (1, 1))
    registration = pcl_flashreg.PairRegistration(1)
    expected = registration.make_scan(points, 0.2, descriptors=False)
    scan = registration.make_scan(form(points), 0.2, descriptors=False)
    assert np.array_equal(scan.points, expected.points)
    assert np.array_equal(scan.normals, expected.normals, equal_nan=True)


@pytest.mark.parametrize(
    "form", [column_slice, every_other, read_only, Dlpack, memoryview, NumpyMethod]
)
def test_clouds_look_at_the_callers_memory(form):
    points = form(SOURCE)
    cloud = pcl_flashreg.Cloud(points)
    if isinstance(points, np.ndarray):
        assert np.shares_memory(cloud.points, points)
    assert np.array_equal(cloud.points, SOURCE)


def test_arrays_that_get_another_shape():
    points = SOURCE.copy()
    cloud = pcl_flashreg.Cloud(points)
    points.shape = (100, 6)
    cloud.points.shape = (600, 1)
    assert cloud.points.shape == (200, 3) and len(cloud) == 200
    scan = pcl_flashreg.PairRegistration(1).make_scan(cloud, 0.2, descriptors=False)
    assert np.array_equal(scan.points, pcl_flashreg.compute_features(SOURCE, 0.2).points)


def test_large_arrays_are_not_copied():
    import tracemalloc

    points = np.random.default_rng(2).uniform(size=(400_000, 4)).astype(np.float32)
    registration = pcl_flashreg.PairRegistration(1)
    tracemalloc.start()  # knows numpy's memory
    registration.make_scan(points[:, :3], 0.2, descriptors=False)
    without = tracemalloc.get_traced_memory()[1]
    tracemalloc.reset_peak()
    registration.make_scan(np.asfortranarray(points[:, :3]), 0.2, descriptors=False)
    with_copy = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert without < 100_000
    assert with_copy > 4_000_000


def test_input_is_not_written_to():
    source, target = SOURCE.copy(), TARGET.copy()
    estimate(source, target)
    assert np.array_equal(source, SOURCE) and np.array_equal(target, TARGET)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (np.zeros((5, 3), np.int64), "is of int64.*astype"),
        (np.zeros((5, 3), np.float16), "is of float16.*astype"),
        (np.zeros((5, 3), np.longdouble), "is of float128|is of longdouble"),
        (np.zeros((5, 3), complex), "is of complex128"),
        (np.zeros((5, 3), object), "is of object"),
        (np.zeros((5, 3), bool), "is of bool"),
        (np.array([["a", "b", "c"]]), "is of <U1"),
        (np.zeros(5, [("x", "f4"), ("y", "f4"), ("z", "f4")]), "is of \\[\\('x'"),
        (np.ma.masked_array(SOURCE, SOURCE > 0), "is a masked array"),
        (None, "is a NoneType, but has to be an array"),
        (3.5, "is a float, but has to be an array"),
        ({1, 2}, "is a set, but has to be an array"),
    ],
    ids=lambda value: None if not isinstance(value, str) else value[:12],
)
def test_other_types(points, message):
    with pytest.raises(TypeError, match="source_points: " + message):
        estimate(points)
    with pytest.raises(TypeError, match="target_points: " + message):
        estimate(SOURCE, points)
    if not isinstance(points, type(None)):
        with pytest.raises(TypeError, match="points: " + message):
            pcl_flashreg.Cloud(points)


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        ((5, 4), r"is 5 x 4, but has to be N x 3; take \[:, :3\]"),
        ((5, 6), r"is 5 x 6, but has to be N x 3; take \[:, :3\]"),
        ((3, 2), r"is 3 x 2, but has to be N x 3; take its transpose"),
        ((5, 2), "is 5 x 2, but has to be N x 3$"),
        ((15,), "is of length 15, but has to be N x 3$"),
        ((5, 3, 1), "is 5 x 3 x 1, but has to be N x 3$"),
        ((), "is one number, but has to be N x 3$"),
    ],
)
def test_other_shapes(shape, message):
    points = np.zeros(shape)
    with pytest.raises(ValueError, match="source_points: " + message):
        estimate(points)
    with pytest.raises(ValueError, match="source: " + message):
        pcl_flashreg.align(points, SOURCE, 0.1)


def test_numbers_of_rows_that_differ():
    with pytest.raises(ValueError, match="target_points: are 200, but source_points are 7"):
        estimate(SOURCE[:7])
    with pytest.raises(ValueError, match="ranks: are 3, but correspondences are 200"):
        estimate(SOURCE, ranks=np.zeros(3, np.float32))
    with pytest.raises(ValueError, match="ranks: is 200 x 1"):
        estimate(SOURCE, ranks=np.zeros((200, 1), np.float32))


def test_empty_clouds():
    nothing = np.empty((0, 3))
    result = estimate(nothing, nothing)
    assert result.status == "too_few_correspondences" and result.correspondences == 0
    result = pcl_flashreg.align(nothing, nothing, 0.1)
    assert result.status == "too_few_correspondences"
    assert result.matches.shape == (0, 2)
    assert result.source.points.shape == (0, 3)
    with pytest.raises(ValueError, match="fewer than two"):
        pcl_flashreg.align(nothing, nothing)
    with pytest.raises(ValueError, match="fewer than two"):
        pcl_flashreg.estimate_resolution(nothing)


def test_points_that_are_not_finite():
    source = SOURCE.copy()
    source[3] = np.nan
    source[4, 1] = np.inf
    result = estimate(source)
    assert result.converged
    assert 3 not in result.inliers and 4 not in result.inliers
    nothing = np.full((50, 3), np.nan)
    assert estimate(nothing, nothing).status == "too_few_correspondences"
    with pytest.raises(ValueError, match="fewer than two"):
        pcl_flashreg.align(nothing, nothing)


def test_one_row():
    result = estimate(SOURCE[:1], TARGET[:1])
    assert result.status == "too_few_correspondences"


def test_views_outlive_their_object(pair):
    registration = pcl_flashreg.PairRegistration()
    result = registration.align(pair.source_scan, pair.target_scan)
    inliers, matches, scan = result.inliers, result.matches, result.source
    kept = [array.copy() for array in (inliers, matches, scan.points)]
    points = scan.points
    del result, scan, registration
    gc.collect()
    junk = [np.full(100_000, 7) for _ in range(50)]
    for array, copy in zip((inliers, matches, points), kept):
        assert np.array_equal(array, copy)
    del junk


def test_views_are_read_only(pair):
    for array in (
        pair.result.inliers,
        pair.result.matches,
        pair.source_scan.points,
        pair.source_scan.descriptors,
    ):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    # What is handed out as a copy is the caller's.
    pose = pair.result.T_target_source
    pose[0, 0] = 7
    assert pair.result.T_target_source[0, 0] != 7


def test_geo_referenced_coordinates(pair):
    far = np.array([4.5e6, 5.2e6, 300.0])
    result = pcl_flashreg.align(pair.source + far, pair.target + far, pair.resolution)
    assert np.any(result.source.shift != 0)
    pose = result.T_target_source
    middle = pair.source.mean(axis=0)
    there = pose[:3, :3] @ (middle + far) + pose[:3, 3] - far
    expected = pair.T_target_source[:3, :3] @ middle + pair.T_target_source[:3, 3]
    assert np.linalg.norm(there - expected) < 0.1
    assert pcl_flashreg.estimate_resolution(pair.source + far) == (
        pcl_flashreg.estimate_resolution(pair.source)
    )
    with pytest.raises(ValueError, match="too large for single precision"):
        pcl_flashreg.compute_features(pair.source + far, pair.resolution)
