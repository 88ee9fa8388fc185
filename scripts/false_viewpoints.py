#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Scans whose file states a viewpoint that is false: counts right and trusted poses.

The bundled pairs (data/indoor, data/street) are registered

- moved away from the origin, 0 to 3000 m, each scan in a frame of its own, with the VIEWPOINT
  that nobody set, (0, 0, 0);
- in the frames of their sensors, with a random pose as the VIEWPOINT.

    scripts/false_viewpoints.py --align build/ci/apps/pcl_flashreg_align [--ply]
"""
import argparse
import collections
import json
import os
import subprocess
import tempfile

import numpy as np

from pcd_files import read_pcd, write_pcd

PLY_HEADER = (
    "ply\nformat binary_little_endian 1.0\nelement vertex %d\n"
    "property float x\nproperty float y\nproperty float z\nend_header\n"
)
DISTANCES = (0, 3, 10, 30, 100, 300, 1000, 3000)
# Mean displacement of the source's points, in metres.
RIGHT = {"indoor": 0.15, "street": 0.6}


def turn_about_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def pose(angle, translation):
    matrix = np.eye(4)
    matrix[:3, :3] = turn_about_z(angle)
    matrix[:3, 3] = translation
    return matrix


def moved(matrix, points):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


class Runs:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        self.counts = collections.Counter()

    def write(self, name, points, viewpoint):
        path = os.path.join(self.folder, name)
        if not self.options.ply:
            write_pcd(path, points, viewpoint)
            return path
        with open(path, "wb") as file:
            file.write((PLY_HEADER % len(points)).encode())
            file.write(np.ascontiguousarray(points, "<f4").tobytes())
        return path

    def run(self, kind, scene, source, target, truth, viewpoints):
        ending = ".ply" if self.options.ply else ".pcd"
        files = [self.write(name + ending, points, viewpoint)
                 for name, points, viewpoint in zip(("source", "target"),
                                                    (source, target), viewpoints)]
        done = subprocess.run([self.options.align, *files, "--json", "-", "--quiet"],
                              capture_output=True, text=True)
        found = np.array(json.loads(done.stdout)["transformation"])
        off = np.linalg.norm(moved(found, source) - moved(truth, source), axis=1).mean()
        right, trusted = off < RIGHT[scene], done.returncode == 0
        self.counts[kind, right, trusted] += 1
        self.counts[kind] += 1
        if not (right and trusted):
            print(f"{kind} {scene}: right {right}, trusted {trusted}, off by {off:.3g} m")

    def report(self, kind):
        c = self.counts
        print(f"{kind}: {c[kind]} runs, right {c[kind, True, True] + c[kind, True, False]}, "
              f"right and trusted {c[kind, True, True]}, "
              f"wrong and trusted {c[kind, False, True]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--align", default="pcl_flashreg_align")
    parser.add_argument("--data", default=os.path.join(os.path.dirname(__file__), "..", "data"))
    parser.add_argument("--runs", type=int, default=100, help="of each scene")
    parser.add_argument("--ply", action="store_true", help="write PLY without a camera")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(options, folder)
        for scene in RIGHT:
            path = os.path.join(options.data, scene)
            source = read_pcd(os.path.join(path, "source.pcd"))
            target = read_pcd(os.path.join(path, "target.pcd"))
            truth = np.loadtxt(os.path.join(path, "T_target_source.txt"))
            nobody = "0 0 0 1 0 0 0"
            for k in range(options.runs):
                random = np.random.default_rng(1000 + k)
                away = random.normal(size=3)
                away *= DISTANCES[k % len(DISTANCES)] / np.linalg.norm(away)
                to_a, to_b = (pose(random.uniform(0, 2 * np.pi),
                                   away + random.uniform(-1, 1, 3)) for _ in "ab")
                runs.run("moved", scene, moved(to_a, source), moved(to_b, target),
                         to_b @ truth @ np.linalg.inv(to_a), (nobody, nobody))
            for k in range(0 if options.ply else options.runs // 10):
                random = np.random.default_rng(2000 + k)
                posed = []
                for _ in "ab":
                    place, quaternion = 5 * random.normal(size=3), random.normal(size=4)
                    quaternion /= np.linalg.norm(quaternion)
                    posed.append(" ".join(f"{v:.6f}" for v in (*place, *quaternion)))
                runs.run("posed", scene, source, target, truth, posed)
        runs.report("moved")
        if not options.ply:
            runs.report("posed")


if __name__ == "__main__":
    main()
