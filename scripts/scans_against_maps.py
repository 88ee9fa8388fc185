#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Makes maps out of the fragments of scenes: for every n-th fragment the union of all the
others of its scene, placed by the poses of the list, and a list of pairs for
pcl_flashreg_evaluate (--root DATA). Poses are chained from the scene's first fragment over
as few pairs as possible. A map has no viewpoint: methods with both believe the origin of
its first fragment. Needs numpy.

    scripts/scans_against_maps.py DATA/pairs.tsv OUT --dataset 3DMatch --every 4
    pcl_flashreg_evaluate OUT/pairs.tsv --root / \\
        --method flashreg_source_viewpoint,flashreg_no_viewpoint
"""

import argparse
import collections
import os

import numpy as np

from pcd_files import read_pcd, write_pcd

VOXEL = 0.025  # of 3DMatch's fragments as they are handed out


def thinned(points):
    """The first point of each voxel, in order."""
    cells = np.floor(points / VOXEL).astype(np.int64)
    cells -= cells.min(axis=0)
    spans = cells.max(axis=0) + 1
    keys = (cells[:, 2] * spans[1] + cells[:, 1]) * spans[0] + cells[:, 0]
    return points[np.sort(np.unique(keys, return_index=True)[1])]


def read_pairs(path, datasets):
    """Scene -> source, target, T_target_source of its pairs."""
    scenes = collections.defaultdict(list)
    with open(path) as lines:
        for line in lines:
            cells = line.rstrip("\n").split("\t")
            if cells[0] in datasets and len(cells) == 22:
                pose = np.array([float(c) for c in cells[6:]]).reshape(4, 4)
                scenes[os.path.dirname(cells[2])].append((cells[2], cells[3], pose))
    return scenes


def chain(pairs):
    """Fragment -> T_first_fragment of those that pairs tie to the first one."""
    neighbours = collections.defaultdict(list)
    for source, target, pose in pairs:
        neighbours[target].append((source, pose))
        neighbours[source].append((target, np.linalg.inv(pose)))
    natural = lambda path: (len(path), path)
    first = min(neighbours, key=natural)
    poses = {first: np.eye(4)}
    queue = collections.deque([first])
    while queue:
        at = queue.popleft()
        for other, T_at_other in sorted(neighbours[at], key=lambda n: natural(n[0])):
            if other not in poses:
                poses[other] = poses[at] @ T_at_other
                queue.append(other)
    return dict(sorted(poses.items(), key=lambda item: natural(item[0])))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pairs", help="list of pairs with known poses")
    parser.add_argument("out", help="folder for the maps and their list")
    parser.add_argument("--dataset", nargs="+", required=True, help="pairs to chain")
    parser.add_argument("--every", type=int, default=1, help="only every n-th fragment")
    options = parser.parse_args()
    root = os.path.abspath(os.path.dirname(options.pairs))
    os.makedirs(options.out, exist_ok=True)
    with open(os.path.join(options.out, "pairs.tsv"), "w") as out:
        for scene, pairs in sorted(read_pairs(options.pairs, options.dataset).items()):
            poses = chain(pairs)
            placed = {
                path: read_pcd(os.path.join(root, path)) @ T[:3, :3].T + T[:3, 3]
                for path, T in poses.items()
            }
            for path in list(poses)[:: options.every]:
                others = [points for other, points in placed.items() if other != path]
                name = os.path.basename(scene) + "_without_" + os.path.basename(path)
                map_path = os.path.abspath(os.path.join(options.out, name))
                write_pcd(map_path, thinned(np.vstack(others)))
                row = ["map", "made", os.path.join(root, path), map_path, "", ""]
                row += ["%.9g" % value for value in poses[path].ravel()]
                out.write("\t".join(row) + "\n")


if __name__ == "__main__":
    main()
