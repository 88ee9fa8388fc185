# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

import copy
import os
import pickle

import numpy as np
import pytest
from conftest import same_result

import pcl_flashreg


def test_arrays_of_a_scan(pair):
    scan = pair.source_scan
    count = len(scan)
    assert repr(scan) == (
        f"Scan({count} keypoints, resolution 0.05, descriptors of 33 values)"
    )
    assert scan.points.shape == (count, 3) and scan.points.dtype == np.float32
    assert scan.normals.shape == (count, 3)
    assert np.allclose(np.linalg.norm(scan.normals, axis=1), 1, atol=1e-5)
    assert scan.curvatures.shape == (count,)
    assert scan.descriptors.shape == (count, 33)
    assert np.allclose(scan.descriptors.sum(axis=1), 300, atol=0.1)
    assert scan.origins is None
    assert np.array_equal(scan.shift, [0, 0, 0])
    assert scan.resolution == pair.resolution
    # Normals look back at the sensor.
    towards = np.einsum("ij,ij->i", scan.normals, -scan.points)
    assert np.mean(towards > 0) > 0.99


def test_surface_alone(pair):
    registration = pcl_flashreg.PairRegistration()
    scan = registration.make_scan(pair.source, 0.05, descriptors=False)
    assert scan.descriptors.shape[1] == 0
    assert repr(scan).endswith("no descriptors)")
    with pytest.raises(ValueError, match="source: is a scan without descriptors"):
        registration.align(scan, pair.target_scan)
    with pytest.raises(ValueError, match="descriptors"):
        registration.make_index(scan)


def test_resolution_of_a_scan(pair):
    registration = pcl_flashreg.PairRegistration()
    for resolution in (0, -1, float("nan")):
        with pytest.raises(ValueError):
            registration.make_scan(pair.source, resolution)
    with pytest.raises(TypeError):
        registration.make_scan(pair.source)
    with pytest.raises(TypeError, match="cloud: is a scan already"):
        registration.make_scan(pair.source_scan, 0.05)


def test_parts(pair):
    scan = pair.source_scan
    part = scan.within(scan.points[0], 0.5)
    assert 0 < len(part) < len(scan)
    assert np.all(np.linalg.norm(part.points - scan.points[0], axis=1) <= 0.5)
    with pytest.raises(ValueError, match="center: is of length 2"):
        scan.within([0, 0], 1)
    with pytest.raises(ValueError, match="center: has a number that is not finite"):
        scan.within([0, 0, np.nan], 1)
    with pytest.raises(TypeError, match="center: has to be three numbers"):
        scan.within(["a", "b", "c"], 1)
    unseen = scan.without_viewpoint()
    assert unseen.viewpoint is None and len(unseen) == len(scan)


def test_copies_and_pickles(pair):
    scan = pair.source_scan
    for other in (
        pickle.loads(pickle.dumps(scan)),
        copy.copy(scan),
        copy.deepcopy(scan),
    ):
        assert np.array_equal(other.points, scan.points)
        assert np.array_equal(other.descriptors, scan.descriptors)
        assert np.array_equal(other.viewpoint, scan.viewpoint)
        assert same_result(pcl_flashreg.align(other, pair.target_scan), pair.result)
    with pytest.raises(TypeError, match="pickle"):
        pickle.dumps(pair.result)


def test_files(pair, tmp_path):
    path = tmp_path / "scan"
    pair.source_scan.save(path)
    scan = pcl_flashreg.Scan.load(str(path))
    assert np.array_equal(scan.points, pair.source_scan.points)
    assert same_result(pcl_flashreg.align(scan, pair.target_scan), pair.result)
    damaged = bytearray(path.read_bytes())
    damaged[len(damaged) // 2] ^= 1
    path.write_bytes(damaged)
    with pytest.raises(ValueError, match="damaged"):
        pcl_flashreg.Scan.load(path)
    with pytest.raises(FileNotFoundError):
        pcl_flashreg.Scan.load(tmp_path / "none")
    with pytest.raises(OSError, match="none"):
        scan.save(tmp_path / "none" / "scan")


def test_index(pair, tmp_path):
    registration = pcl_flashreg.PairRegistration()
    index = registration.make_index(pair.target_scan)
    path = tmp_path / "index"
    index.save(path)
    opened = pcl_flashreg.ScanIndex.open(path, verify=True)
    path.unlink()  # which nobody who has it open minds
    assert len(opened) == len(pair.target_scan)
    assert opened.nbytes > 0 and opened.scan.resolution == pair.resolution
    assert repr(opened).startswith(f"ScanIndex({len(opened)} keypoints, resolution 0.05")
    for target in (index, opened):
        assert same_result(registration.align(pair.source_scan, target), pair.result)
        assert same_result(registration.align(pair.source, target), pair.result)


def test_damaged_index(pair, tmp_path):
    path = tmp_path / "index"
    pcl_flashreg.PairRegistration().make_index(pair.target_scan).save(path)
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    with pytest.raises(ValueError, match="incomplete"):
        pcl_flashreg.ScanIndex.open(path)
    path.write_bytes(b"something else")
    with pytest.raises(ValueError, match="index"):
        pcl_flashreg.ScanIndex.open(path)
    with pytest.raises(FileNotFoundError):
        pcl_flashreg.ScanIndex.open(tmp_path / "none")


def test_scans_are_not_made_by_hand():
    for made in (pcl_flashreg.Scan, pcl_flashreg.ScanIndex, pcl_flashreg.Result):
        with pytest.raises(TypeError, match="No constructor defined"):
            made()


@pytest.mark.parametrize("name", ["read_cloud", "align"])
def test_files_of_clouds(pair, tmp_path, name):
    def read(path, **options):
        if name == "read_cloud":
            return pcl_flashreg.read_cloud(path, **options)
        return pcl_flashreg.align(path, pair.target, 0.05)

    with pytest.raises(FileNotFoundError, match="none.pcd"):
        read(tmp_path / "none.pcd")
    with pytest.raises(IsADirectoryError):
        read(tmp_path)
    broken = tmp_path / "broken.pcd"
    broken.write_bytes(pair.source_path.read_bytes()[:4000])
    with pytest.raises(ValueError, match=f"{broken}: "):
        read(broken)
    empty = tmp_path / "empty.ply"
    empty.touch()
    with pytest.raises(ValueError, match="is empty"):
        read(empty)


def test_only_what_may_be_read(tmp_path):
    path = tmp_path / "mine.pcd"
    path.write_text("VERSION .7")
    path.chmod(0)
    if os.access(path, os.R_OK):
        pytest.skip("this user may read everything")
    with pytest.raises(PermissionError):
        pcl_flashreg.read_cloud(path)


def test_reading(pair, tmp_path):
    cloud = pcl_flashreg.read_cloud(pair.source_path)
    assert repr(cloud) == f"Cloud({len(cloud)} points, float64)"
    assert cloud.points.dtype == np.float64 and cloud.points.flags.c_contiguous
    assert np.array_equal(cloud.viewpoint, [0, 0, 0])
    assert cloud.normals is None and cloud.features is None
    raw = tmp_path / "scan.bin"
    np.c_[cloud.points, np.ones(len(cloud))].astype(np.float32).tofile(raw)
    again = pcl_flashreg.read_cloud(os.fsencode(raw), bin_fields=4)
    assert np.array_equal(again.points, cloud.points)
    with pytest.raises(TypeError):
        pcl_flashreg.read_cloud(3.5)


def test_what_a_reader_guesses_is_a_warning(tmp_path):
    pcd = tmp_path / "points.pcd"
    lines = ["VERSION .7", "FIELDS X Y Z", "SIZE 4 4 4", "TYPE F F F", "COUNT 1 1 1"]
    lines += ["WIDTH 2", "HEIGHT 1", "POINTS 2", "DATA ascii", "0 0 0", "1 2 3", ""]
    pcd.write_text("\n".join(lines))
    with pytest.warns(UserWarning, match="points.pcd: fields are taken for coordinates"):
        cloud = pcl_flashreg.read_cloud(pcd)
    assert np.array_equal(cloud.points, [[0, 0, 0], [1, 2, 3]])
