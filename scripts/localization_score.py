# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Runs pcl_flashreg_localize, and counts how many of its poses are right."""

import json
import statistics
import subprocess

import numpy as np


def locate(map_file, scans, leaf, options=()):
    """The lines of the program."""
    command = ["pcl_flashreg_localize", map_file, "--quiet", "--leaf", str(leaf)]
    run = subprocess.run(command + list(options) + scans, stdout=subprocess.PIPE, text=True)
    if run.returncode > 1:
        raise SystemExit("%s: exit code %d" % (" ".join(command), run.returncode))
    return [json.loads(line) for line in run.stdout.splitlines()]


class Score:
    def __init__(self, degrees, metres):
        """A right pose is off by less."""
        self.degrees, self.metres = degrees, metres
        self.all = self.right = self.trusted = self.wrong = 0
        self.times = []

    def is_right(self, found, true):
        turn = found[:3, :3].T @ true[:3, :3]
        cosine = np.clip((np.trace(turn) - 1) / 2, -1, 1)
        shift = np.linalg.norm(found[:3, 3] - true[:3, 3])
        return np.degrees(np.arccos(cosine)) < self.degrees and shift < self.metres

    def add(self, line, true):
        """A line of the program, and the true pose, or None where there is none."""
        right = true is not None and "transformation" in line
        right = right and self.is_right(np.array(line["transformation"]), true)
        self.all += 1
        self.right += right
        self.trusted += line["converged"] and right
        self.wrong += line["converged"] and not right
        self.times.append(line["timings_ms"]["placing"])

    def row(self, name, in_percent=False):
        times = sorted(self.times)
        right = "%.1f %%" % (100 * self.right / self.all) if in_percent else str(self.right)
        return "| %s | %d | %s | %d | %d | %.0f | %.0f |" % (
            name,
            self.all,
            right,
            self.trusted,
            self.wrong,
            statistics.median(times),
            times[int(0.95 * len(times))],
        )


def print_head(what, count="n"):
    print("| %s | %s | right | of these trusted | trusted and wrong | median ms | 95 %% |" % (what, count))
    print("|---|---|---|---|---|---|---|")
