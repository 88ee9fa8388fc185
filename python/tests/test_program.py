# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

"""Python, C++ and the program say the same, to the last bit."""

import os
import subprocess

import numpy as np
import pytest
from conftest import DATA

import pcl_flashreg

PAIRS = [("indoor", 0.05), ("street", 0.3), ("indoor", None)]


def program(variable):
    path = os.environ.get(variable)
    if not path:
        pytest.skip(f"{variable} names no program")
    return path


def paths(folder):
    return [str(DATA / folder / f"{side}.pcd") for side in ("source", "target")]


@pytest.mark.parametrize(("folder", "resolution"), PAIRS)
def test_program(folder, resolution, tmp_path):
    pose = tmp_path / "pose.txt"
    leaf = [] if resolution is None else ["--leaf", str(resolution)]
    command = [program("PCL_FLASHREG_ALIGN"), *paths(folder), "--quiet"]
    subprocess.run([*command, *leaf, "--transform", str(pose)], check=True)
    result = pcl_flashreg.align(*paths(folder), resolution)
    assert np.array_equal(np.loadtxt(pose), result.T_target_source)


@pytest.mark.parametrize(("folder", "resolution"), PAIRS)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_core(folder, resolution, dtype, tmp_path):
    """A program in C++ gets the arrays as they are in memory."""
    command = [program("PCL_FLASHREG_PYTHON_REFERENCE"), np.dtype(dtype).name]
    clouds = [pcl_flashreg.read_cloud(path).points.astype(dtype) for path in paths(folder)]
    for side, points in zip(("source", "target"), clouds):
        points.tofile(tmp_path / side)
        command.append(str(tmp_path / side))
    command.append(str(resolution or 0))
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout
    expected = np.frombuffer(output, np.float64)
    result = pcl_flashreg.align(*clouds, resolution)
    found = np.concatenate(
        [
            result.T_target_source.ravel(),
            [result.confidence, result.resolution, result.score],
            result.information.ravel(),
            result.inliers.astype(np.float64),
        ]
    )
    assert np.array_equal(found, expected)
