# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

import numpy as np
import pytest
from conftest import error_of

import pcl_flashreg


@pytest.fixture(scope="module")
def scans(pair):
    """The pair, and parts of it."""
    source, target = pair.source_scan, pair.target_scan
    middle = target.points.mean(axis=0)
    return [target, source, target.within(middle, 2.5)]


def test_map(pair, scans):
    steps = []
    registration = pcl_flashreg.MultiviewRegistration()
    result = registration.align(scans, progress=lambda *step: steps.append(step))
    assert steps and all(1 <= done <= all for done, all in steps)
    assert result.placed == 3 and result.groups == [[0, 1, 2]]
    assert repr(result) == "MultiviewResult(3 of 3 scans placed, 1 groups)"
    assert np.array_equal(result.scans[0].T_group_scan, np.eye(4))
    degrees, length = error_of(result.scans[1].T_group_scan, pair.T_target_source)
    assert degrees < 1 and length < 0.1
    assert all(place.confidence > 0.8 and place.edges > 0 for place in result.scans)
    assert repr(result.scans[1]).startswith("ScanPlace(group 0, confidence ")
    edge = result.edges[0]
    assert (edge.target, edge.source, edge.fate) == (0, 1, "used")
    assert edge.information.shape == (6, 6) and edge.agreement.matched > 0.3
    assert repr(edge).startswith("MapEdge(1 to 0, used, ")
    assert result.timings_ms["total"] > 0
    again = pcl_flashreg.MultiviewRegistration(num_threads=1).align(tuple(scans))
    for place, other in zip(result.scans, again.scans):
        assert np.array_equal(place.T_group_scan, other.T_group_scan)


def test_no_scans():
    result = pcl_flashreg.MultiviewRegistration().align([])
    assert result.placed == 0 and result.scans == [] and result.groups == []


def test_scans_of_two_places(pair, scans):
    noise = np.random.default_rng(5).uniform(-2, 2, (20_000, 3))
    other = pcl_flashreg.PairRegistration().make_scan(noise, 0.05)
    result = pcl_flashreg.MultiviewRegistration().align(
        [scans[0], other, scans[1]], give_up_early=True, sequence=True
    )
    assert result.groups == [[0, 2], [1]] and result.placed == 2


def test_options(scans):
    registration = pcl_flashreg.MultiviewRegistration()
    with pytest.raises(ValueError, match="min_confidence"):
        registration.align(scans, min_confidence=1)
    with pytest.raises(ValueError, match="alike"):
        registration.align(scans, alike=0)
    with pytest.raises(ValueError, match="pivots"):
        registration.align(scans, parameters=pcl_flashreg.Parameters(pivots=0))
    with pytest.raises(TypeError, match="progress: has to be a function"):
        registration.align(scans, progress=3)
    with pytest.raises(TypeError):
        registration.align([scans[0], "scan"])
    with pytest.raises(ValueError, match="backend is 'gpu'"):
        pcl_flashreg.MultiviewRegistration(backend="gpu")


def test_what_progress_raises_ends_the_call(scans):
    class Enough(Exception):
        pass

    def progress(done, all):
        raise Enough(done)

    registration = pcl_flashreg.MultiviewRegistration()
    with pytest.raises(Enough):
        registration.align(scans, progress=progress)
    assert registration.align(scans).placed == 3


def test_a_call_within_a_call(scans):
    registration = pcl_flashreg.MultiviewRegistration()
    with pytest.raises(RuntimeError, match="this MultiviewRegistration is in a call"):
        registration.align(scans, progress=lambda *_: registration.align(scans))
