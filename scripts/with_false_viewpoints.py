#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Copies the .pcd files of a list of pairs, each with a VIEWPOINT that is false: a random place
`--near` to `--far` lengths from the true one, as if somebody had moved the points and left the
viewpoint behind. The list comes along. Always the same places; the standard library is enough.

    scripts/with_false_viewpoints.py DATA/pairs.tsv OUT --dataset 3DMatch 3DLoMatch
    pcl_flashreg_evaluate OUT/pairs.tsv --dataset 3DMatch --dataset 3DLoMatch
"""

import argparse
import math
import os
import random
import re
import shutil


def direction(source):
    """Evenly over the directions that rise or fall by less than 30 degrees."""
    z = source.uniform(-0.5, 0.5)
    turn = source.uniform(0, 2 * math.pi)
    r = math.sqrt(1 - z * z)
    return r * math.cos(turn), r * math.sin(turn), z


def with_viewpoint(data, place):
    """A PCD file's bytes with another place in the VIEWPOINT line of its header."""
    header = data[: data.index(b"\nDATA") + 1]
    line = re.search(rb"^VIEWPOINT (\S+) (\S+) (\S+)(.*)$", header, re.MULTILINE)
    moved = [float(line[i + 1]) + place[i] for i in range(3)]
    new = "VIEWPOINT {} {} {}".format(*moved).encode() + line[4]
    return data[: line.start()] + new + data[line.end() :]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("pairs")
    parser.add_argument("out")
    parser.add_argument("--dataset", nargs="+", required=True)
    parser.add_argument("--near", type=float, default=10)
    parser.add_argument("--far", type=float, default=3000)
    options = parser.parse_args()
    root = os.path.dirname(os.path.abspath(options.pairs))
    clouds = set()
    with open(options.pairs) as lines:
        for fields in (line.rstrip("\n").split("\t") for line in lines):
            if fields[0] in options.dataset:
                clouds.update(fields[2:4])
    for cloud in sorted(clouds):
        source = random.Random(cloud)
        distance = options.near * (options.far / options.near) ** source.random()
        place = [distance * x for x in direction(source)]
        with open(os.path.join(root, cloud), "rb") as file:
            data = file.read()
        path = os.path.join(options.out, cloud)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(with_viewpoint(data, place))
    shutil.copy(options.pairs, os.path.join(options.out, "pairs.tsv"))


if __name__ == "__main__":
    main()
