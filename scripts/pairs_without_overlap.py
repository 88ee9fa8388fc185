#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Makes a list of pairs of clouds that do not overlap, in the format of pairs.tsv.

Across scenes: clouds of different folders. With --overlaps also within scenes: pairs whose
overlap is stated to be 0 in <folder>/<scene>/gt_overlap.log (as 3DMatch has them). The
seventh column is "none" instead of the 16 numbers of a pose. Always the same list.

    scripts/pairs_without_overlap.py DATA/pairs.tsv --dataset 3DMatch 3DLoMatch \\
        --overlaps DATA/3dmatch/benchmarks/3DMatch > none.tsv
"""

import argparse
import itertools
import os
import sys

GOLDEN = 0.6180339887498949  # spreads picks evenly over a list, however many they are


def natural(path):
    """cloud_bin_2 before cloud_bin_10."""
    digits = "".join(c if c.isdigit() else " " for c in path).split()
    return [int(d) for d in digits], path


def scene_of(path, separate):
    folder, name = os.path.split(path)
    return os.path.join(folder, name.split("_")[0]) if folder in separate else folder


def across(clouds, separate, count):
    scenes = {}
    for cloud in clouds:
        scenes.setdefault(scene_of(cloud, separate), []).append(cloud)
    for a, b in itertools.combinations(sorted(scenes), 2):
        pairs = list(itertools.product(sorted(scenes[a], key=natural), sorted(scenes[b], key=natural)))
        picks = min(count, len(pairs))
        if picks == len(pairs):
            yield from pairs
        else:
            for i in range(picks):
                yield pairs[int(i * GOLDEN % 1 * len(pairs))]


def within(clouds, overlaps, count):
    for folder in sorted({os.path.dirname(cloud) for cloud in clouds}):
        log = os.path.join(overlaps, os.path.basename(folder), "gt_overlap.log")
        if not os.path.exists(log):
            continue
        with open(log) as lines:
            cells = [line.strip().split(",") for line in lines if line.strip() and line[0] != "#"]
        apart = [(int(i), int(j)) for i, j, overlap in cells if float(overlap) == 0]
        step = max(1, len(apart) // count)
        for i, j in apart[::step][:count]:
            yield ("%s/cloud_bin_%d.pcd" % (folder, j), "%s/cloud_bin_%d.pcd" % (folder, i))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pairs", help="list of pairs to take the clouds from")
    parser.add_argument("--dataset", nargs="+", required=True, help="only clouds of these")
    parser.add_argument(
        "--separate",
        nargs="+",
        default=[],
        metavar="FOLDER",
        help="folders whose clouds are of one place only if their names begin alike, up to _",
    )
    parser.add_argument("--overlaps", metavar="FOLDER", help="folder of <scene>/gt_overlap.log")
    parser.add_argument("--count", type=int, default=250, help="pairs for two scenes (default: 250)")
    parser.add_argument("--count-within", type=int, default=200, help="pairs a scene (default: 200)")
    options = parser.parse_args()

    clouds = set()
    with open(options.pairs) as lines:
        for line in lines:
            cells = line.split("\t")
            if cells[0] in options.dataset:
                clouds.update(cells[2:4])
    if not clouds:
        sys.exit("%s: holds no pair of these data sets" % options.pairs)
    rows = [("none", pair) for pair in across(clouds, options.separate, options.count)]
    if options.overlaps:
        rows += [("none_same_scene", pair) for pair in within(clouds, options.overlaps, options.count_within)]
    for dataset, (source, target) in rows:
        print("\t".join([dataset, "made", source, target, "", "", "none"]))


if __name__ == "__main__":
    main()
