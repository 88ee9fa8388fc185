#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Looks for every n-th fragment of each scene in the map of all its others, and says how many
were found. Maps are the unions of fragments, placed by chained poses of the list, points alone;
with --beside, those of all scenes side by side, and with --foreign those of the other scenes,
where nothing is to be found; with --together N, N that follow each other as a sequence, in the
map of all others. pcl_flashreg_localize must be on the PATH. Needs numpy.

    scripts/localize_scenes.py DATA/pairs.tsv OUT --dataset 3DMatch --every 3
"""

import argparse
import os

import numpy as np

from localization_score import Score, locate, print_head
from pcd_files import read_pcd, write_pcd
from scans_against_maps import chain, read_pairs, thinned

LEAF = 0.05
MAX_DEGREES, MAX_METRES = 15, 0.3  # of a right pose
APART = 25.0  # metres between scenes that stand side by side


def locate_in(points, scans, out, options):
    """The program's lines for scans in a map of these points."""
    path = os.path.join(out, "map.pcd")
    write_pcd(path, thinned(points))
    return locate(path, scans, LEAF, options)


def locate_together(points, paths, true_poses, out):
    """Lines of the scans of a sequence, each alone and then together. Its poses are the true
    ones, in the frame of the first."""
    file = os.path.join(out, "sequence.kitti")
    with open(file, "w") as rows:
        for T in true_poses:
            own = np.linalg.inv(true_poses[0]) @ T
            rows.write(" ".join("%.9g" % value for value in own[:3].ravel()) + "\n")
    lines = locate_in(points, paths, out, ["--sequence", file])
    # Together all are right, or none: the last line is of the sequence.
    whole = dict(lines[0], timings_ms=lines[-1]["timings_ms"])
    alone = [dict(line["alone"], timings_ms=line["timings_ms"]) for line in lines[:-1]]
    return alone, whole


def run_together(scenes, placed, root, options):
    scores = {name: Score(MAX_DEGREES, MAX_METRES) for name in ("each alone", "together")}
    for poses in scenes.values():
        names = list(poses)
        for first in range(0, len(names) - options.together + 1, options.every):
            some = names[first : first + options.together]
            points = np.vstack([placed[other] for other in names if other not in some])
            paths = [os.path.join(root, path) for path in some]
            true = [poses[path] for path in some]
            alone, whole = locate_together(points, paths, true, options.out)
            for line, pose in zip(alone, true):
                scores["each alone"].add(line, pose)
            scores["together"].add(whole, true[0])
    for name, score in scores.items():
        print(score.row("%d %s" % (options.together, name), in_percent=True))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pairs", help="list of pairs with known poses")
    parser.add_argument("out", help="folder for the maps")
    parser.add_argument("--dataset", nargs="+", required=True, help="pairs to chain")
    parser.add_argument("--every", type=int, default=1, help="only every n-th fragment")
    parser.add_argument("--beside", action="store_true", help="one map of all scenes")
    parser.add_argument("--foreign", action="store_true", help="maps of other scenes")
    parser.add_argument("--together", type=int, help="so many that follow each other")
    parser.add_argument("--no-viewpoint", action="store_true", help="nor the fragments'")
    options = parser.parse_args()
    flags = ["--no-viewpoint"] if options.no_viewpoint else []
    root = os.path.abspath(os.path.dirname(options.pairs))
    os.makedirs(options.out, exist_ok=True)
    scenes = {}
    for number, (scene, pairs) in enumerate(
        sorted(read_pairs(options.pairs, options.dataset).items())
    ):
        poses = chain(pairs)
        if options.beside:
            for pose in poses.values():
                pose[0, 3] += APART * number
        scenes[scene] = poses
    placed = {
        path: read_pcd(os.path.join(root, path)) @ T[:3, :3].T + T[:3, 3]
        for poses in scenes.values()
        for path, T in poses.items()
    }
    print_head("scene", "fragments")
    total = Score(MAX_DEGREES, MAX_METRES)
    if options.together:
        run_together(scenes, placed, root, options)
        return
    for scene, poses in scenes.items():
        score = Score(MAX_DEGREES, MAX_METRES)
        chosen = list(poses)[:: options.every]
        if options.foreign:
            for other, others in scenes.items():
                if other != scene:
                    points = np.vstack([placed[path] for path in others])
                    scans = [os.path.join(root, path) for path in chosen]
                    for line in locate_in(points, scans, options.out, flags):
                        for sum_up in (score, total):
                            sum_up.add(line, None)
        else:
            in_map = placed if options.beside else poses
            for path in chosen:
                points = np.vstack([placed[other] for other in in_map if other != path])
                for line in locate_in(points, [os.path.join(root, path)], options.out, flags):
                    for sum_up in (score, total):
                        sum_up.add(line, poses[path])
        print(score.row(os.path.basename(scene), in_percent=True), flush=True)
    print(total.row("all", in_percent=True))


if __name__ == "__main__":
    main()
