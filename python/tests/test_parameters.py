# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

import copy
import dataclasses
import pickle

import numpy as np
import pytest
from conftest import error_of, made_points, moved, same_result, some_pose

import pcl_flashreg
from pcl_flashreg import Parameters

SOURCE = made_points()
TARGET = moved(SOURCE, some_pose())


def estimate(parameters, resolution=0.05):
    return pcl_flashreg.estimate_pose(SOURCE, TARGET, resolution, parameters=parameters)


def test_defaults_are_those_of_the_core():
    of_core = dataclasses.asdict(Parameters.from_resolution(0.05))
    mine = dataclasses.asdict(Parameters())
    lengths = {"length_tolerance": 0.012, "min_length_sum": 0.15, "inlier_distance": 0.1}
    for name, value in lengths.items():
        assert of_core.pop(name) == pytest.approx(value)
        assert mine.pop(name) is None
    assert of_core.pop("min_confidence") == pytest.approx(mine.pop("min_confidence"))
    assert of_core == mine


def test_lengths_follow_the_resolution():
    expected = estimate(None)
    assert same_result(estimate(Parameters()), expected)
    assert same_result(estimate(Parameters.from_resolution(0.05)), expected)
    assert same_result(estimate(Parameters.from_resolution(0.05), 0.3), estimate(
        Parameters.from_resolution(0.05), 0.3
    ))
    noisy = TARGET + np.random.default_rng(3).normal(0, 0.05, TARGET.shape)
    found = [
        len(
            pcl_flashreg.estimate_pose(
                SOURCE, noisy, 0.1, parameters=Parameters(inlier_distance=distance)
            ).inliers
        )
        for distance in (0.02, 0.5)
    ]
    assert found[0] < found[1]


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("length_tolerance", 0.0),
        ("min_length_sum", -1.0),
        ("inlier_distance", float("nan")),
        ("max_correspondences", 2),
        ("pivots", 0),
        ("cliques_per_pivot", 17),
        ("row_capacity", 0),
        ("pool_capacity", 129),
        ("refinement_iterations", -1),
        ("max_hypotheses", 65),
        ("max_tilt", 31.0),
        ("source_gravity", (0, 0, 0)),
        ("min_confidence", 1.5),
        ("second_order", "dense"),
        ("score_metric", "MAE"),
        ("motion", "planar"),
    ],
)
def test_values_out_of_range(field, value):
    motion = {} if field == "motion" else {"motion": "upright"}
    with pytest.raises(ValueError, match=field):
        estimate(Parameters(**{field: value}, **motion))


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("pivots", 3.5, "pivots is 3.5, but has to be an integer"),
        ("pivots", "many", "pivots is 'many', but has to be an integer"),
        ("pivots", 2**40, "pivots is 1099511627776, but has to be an integer of 32 bits"),
        ("max_tilt", None, "max_tilt is None, but has to be a number"),
        ("motion", 3, "motion is 3, but has to be a word"),
        ("source_gravity", "down", "source_gravity: is a str"),
    ],
)
def test_values_of_other_types(field, value, message):
    with pytest.raises(TypeError, match=message):
        estimate(Parameters(**{field: value}))


def test_other_things_are_no_parameters():
    with pytest.raises(TypeError, match="parameters: is 3, but has to be a Parameters"):
        estimate(3)
    with pytest.raises(TypeError, match="colour"):
        Parameters(colour=3)
    with pytest.raises(ValueError, match="resolution"):
        Parameters.from_resolution(0)


def test_upright():
    result = estimate(Parameters(motion="upright", max_tilt=1))
    assert result.converged  # some_pose() turns about z
    degrees, length = error_of(result.T_target_source, some_pose())
    assert degrees < 0.1 and length < 0.01
    sideways = estimate(Parameters(motion="upright", source_gravity=(1, 0, 0)))
    assert not sideways.converged


def test_one_hypothesis():
    assert len(estimate(Parameters(max_hypotheses=1)).hypotheses) == 1


def test_trust():
    assert estimate(Parameters(min_confidence=0)).converged
    assert not estimate(Parameters(min_confidence=1)).converged


def test_copies():
    parameters = Parameters(pivots=7, motion="upright")
    for other in (copy.deepcopy(parameters), pickle.loads(pickle.dumps(parameters))):
        assert other == parameters
    assert dataclasses.replace(parameters, pivots=2000) == Parameters(motion="upright")
    with pytest.raises(dataclasses.FrozenInstanceError):
        parameters.pivots = 3
    assert "pivots=7" in repr(parameters)
