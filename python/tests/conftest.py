# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

import pathlib

import numpy as np
import pytest

import pcl_flashreg

DATA = pathlib.Path(__file__).parents[2] / "data"


class Pair:
    """The bundled indoor scans, and what is known of them."""

    folder = DATA / "indoor"
    source_path = folder / "source.pcd"
    target_path = folder / "target.pcd"
    resolution = 0.05
    T_target_source = np.loadtxt(folder / "T_target_source.txt")

    def __init__(self):
        self.source = pcl_flashreg.read_cloud(self.source_path).points
        self.target = pcl_flashreg.read_cloud(self.target_path).points
        registration = pcl_flashreg.PairRegistration()
        self.source_scan = registration.make_scan(self.source, self.resolution)
        self.target_scan = registration.make_scan(self.target, self.resolution)
        self.result = registration.align(self.source, self.target, self.resolution)


@pytest.fixture(scope="session")
def pair():
    return Pair()


def made_points(count=200, seed=1):
    return np.random.default_rng(seed).uniform(-1, 1, (count, 3))


def some_pose():
    angle = 0.7
    pose = np.eye(4)
    pose[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    pose[:3, 3] = [0.3, -0.2, 0.5]
    return pose


def moved(points, pose):
    return points @ pose[:3, :3].T + pose[:3, 3]


def error_of(found, true):
    """Degrees and length."""
    turn = found[:3, :3] @ true[:3, :3].T
    angle = np.degrees(np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1)))
    return angle, np.linalg.norm(found[:3, 3] - true[:3, 3])


def same_result(a, b):
    """To the last bit."""
    return (
        np.array_equal(a.T_target_source, b.T_target_source)
        and a.confidence == b.confidence
        and np.array_equal(a.inliers, b.inliers)
        and np.array_equal(a.information, b.information)
        and [h.score for h in a.hypotheses] == [h.score for h in b.hypotheses]
    )
