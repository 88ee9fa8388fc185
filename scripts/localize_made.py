#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Looks for scans in maps of made places, and says how many were found: ten streets whose
houses are copies of six, in one map; more of these, of twenty million points; halls whose
aisles are the same, where a scan in an aisle must not be trusted, one at the hall's end is to
be found, and so is a sequence of five that leads there. pcl_flashreg_localize must be on the PATH. Needs numpy.

    scripts/localize_made.py streets OUT
    scripts/localize_made.py warehouse OUT --seeds 10 11 12
"""

import argparse
import json
import os
import subprocess
import tempfile

import numpy as np

import made_places as made
from localization_score import Score, locate, print_head
from pcd_files import write_pcd

LEAF = 0.3
STREETS = 10
LARGE = 54  # streets, of which there are more than
MOST_POINTS = 20_000_000
A_FEW = 4  # only every so manieth of its scans
MAX_DEGREES, MAX_METRES = 5, 0.6  # of a right pose
DRIFT = 0.01  # of the way, and this many radians a metre
TURN_DRIFT = 0.001


def write_scans(out, name, shapes, poses, rng):
    paths = []
    for i, T in enumerate(poses):
        paths.append(os.path.join(out, "%s_%d.pcd" % (name, i)))
        write_pcd(paths[-1], made.scan(shapes, T, rng).astype(np.float32))
    return paths


def make_streets(out, count, scans, rng, most=None):
    """A map of streets, and scans of each, between and beside those that it is made of.
    Returns the map's file, its number of points, and the scans' files and poses."""
    all_points, paths, poses = [], [], []
    for number, (shapes, y) in enumerate(made.streets(count, rng)):
        along = np.arange(6.0, made.LENGTH, 8.0)
        places = [made.level_pose(x, y + rng.uniform(-1, 1), rng) for x in along]
        all_points.append(made.mapped(shapes, places, rng).astype(np.float32))
        own = [
            made.level_pose(rng.uniform(10, made.LENGTH - 10), y + rng.uniform(-3, 3), rng)
            for _ in range(scans)
        ]
        poses += own
        paths += write_scans(out, "street_%d" % number, shapes, own, rng)
    map_file = os.path.join(out, "streets.pcd")
    points = np.vstack(all_points)[:most]
    write_pcd(map_file, points)
    return map_file, len(points), paths, poses


def run_streets(options, seed):
    rng = np.random.default_rng(seed)
    map_file, count, paths, poses = make_streets(options.out, STREETS, options.scans, rng)
    score = Score(MAX_DEGREES, MAX_METRES)
    for line, true in zip(locate(map_file, paths, LEAF, options.more), poses):
        score.add(line, true)
    print(score.row("streets, seed %d, %d points" % (seed, count)), flush=True)


def timed(command):
    """Standard output and error of a command, and its peak memory in megabytes."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        run = subprocess.Popen(command, stdout=out, stderr=err)
        _, status, usage = os.wait4(run.pid, 0)
        if os.waitstatus_to_exitcode(status) > 1:
            raise SystemExit("%s: failed" % " ".join(command))
        texts = []
        for file in (out, err):
            file.seek(0)
            texts.append(file.read().decode())
    return texts[0], texts[1], usage.ru_maxrss / 1024


def run_large(options, seed):
    """One map of twenty million points: its index is made in one run, and opened in another."""
    rng = np.random.default_rng(seed)
    map_file, count, paths, poses = make_streets(options.out, LARGE, 1, rng, MOST_POINTS)
    paths, poses = paths[::A_FEW], poses[::A_FEW]
    index = os.path.join(options.out, "large.index")
    for old in (index, index + ".json"):
        if os.path.exists(old):
            os.remove(old)
    program = ["pcl_flashreg_localize", map_file, "--index", index, "--leaf", str(LEAF)]
    for what in ("made", "opened"):
        out, notes, memory = timed(program + list(options.more) + paths)
        score = Score(MAX_DEGREES, MAX_METRES)
        for line, true in zip(map(json.loads, out.splitlines()), poses):
            score.add(line, true)
        print("index %s: %d points, peak memory %.0f MB" % (what, count, memory))
        print(notes[: notes.index("\n")])
        print(score.row("large map, seed %d" % seed), flush=True)
    print("map %.0f MB, index %.0f MB" % tuple(os.path.getsize(f) / 1e6 for f in (map_file, index)))


def drifting(poses, rng):
    """What odometry makes of them, in the frame of the first."""
    result = [np.eye(4)]
    for before, after in zip(poses, poses[1:]):
        step = made.inverse(before) @ after
        way = np.linalg.norm(step[:3, 3])
        step[:3, 3] += rng.normal(0, DRIFT * way, 3)
        turns = rng.normal(0, TURN_DRIFT * way, 3)
        result.append(result[-1] @ step @ made.pose(0, 0, 0, *turns))
    return result


def write_kitti(path, poses):
    with open(path, "w") as file:
        for T in poses:
            file.write(" ".join("%.9g" % value for value in T[:3].ravel()) + "\n")


def run_sequence(options, name, map_file, shapes, poses, rng, scores):
    """The scans by themselves, and then the same together."""
    paths = write_scans(options.out, name, shapes, poses, rng)
    odometry = drifting(poses, rng)
    file = os.path.join(options.out, name + ".kitti")
    write_kitti(file, odometry)
    lines = locate(map_file, paths, LEAF, list(options.more) + ["--sequence", file])
    for line, true in zip(lines, poses):
        alone = dict(line["alone"], timings_ms=line["timings_ms"])
        scores[name + ", each alone"].add(alone, true)
    # Odometry turns the frame of the sequence; its last scan tells.
    whole = dict(lines[-2], timings_ms=lines[-1]["timings_ms"])
    scores[name + ", together"].add(whole, poses[-1])


def run_warehouse(options, seed, scores):
    rng = np.random.default_rng(seed)
    shapes = made.warehouse(rng)
    reach, end = made.RACK / 2, made.RACK / 2 + made.END / 2
    places = [
        made.level_pose(x, made.middle_of_aisle(k), rng)
        for k in range(made.AISLES)
        for x in (-end, -8, 0, 8, end)
    ]
    map_file = os.path.join(options.out, "warehouse.pcd")
    write_pcd(map_file, made.mapped(shapes, places, rng).astype(np.float32))
    for k in range(made.AISLES):
        y = made.middle_of_aisle(k)
        x = rng.uniform(-reach + 4, reach - 12)
        ways = {
            "within an aisle": np.linspace(x, x + 6, 5),
            "to the hall's end": np.linspace(reach - 10, end, 5),
        }
        for name, way in ways.items():
            poses = [made.level_pose(at, y + rng.uniform(-0.3, 0.3), rng) for at in way]
            run_sequence(options, name, map_file, shapes, poses, rng, scores)
    poses = [
        made.level_pose(end + rng.uniform(-0.5, 0.5), made.middle_of_aisle(k), rng)
        for k in range(made.AISLES)
    ]
    paths = write_scans(options.out, "end", shapes, poses, rng)
    for line, true in zip(locate(map_file, paths, LEAF, options.more), poses):
        scores["a scan at the hall's end"].add(line, true)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("streets", "large", "warehouse"))
    parser.add_argument("out", help="folder for maps and scans")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1], help="of the places")
    parser.add_argument("--scans", type=int, default=10, help="a street")
    parser.add_argument("more", nargs="*", help="options of pcl_flashreg_localize, after --")
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    if options.what != "warehouse":
        print_head("place")
        for seed in options.seeds:
            (run_streets if options.what == "streets" else run_large)(options, seed)
        return
    names = ["within an aisle, each alone", "within an aisle, together"]
    names += ["to the hall's end, each alone", "to the hall's end, together"]
    names.append("a scan at the hall's end")
    scores = {name: Score(MAX_DEGREES, MAX_METRES) for name in names}
    for seed in options.seeds:
        run_warehouse(options, seed, scores)
    print_head("scans")
    for name, score in scores.items():
        print(score.row(name))


if __name__ == "__main__":
    main()
