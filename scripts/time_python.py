#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

"""Times the Python module: what a call costs beyond the core's own time, how threads with an
object each scale, and how long Ctrl-C takes.

    PYTHONPATH=build/ci/python scripts/time_python.py data/indoor 0.05
"""

import argparse
import concurrent.futures
import pathlib
import signal
import statistics
import time

import numpy as np

import pcl_flashreg


def milliseconds(call, times):
    spent = []
    for _ in range(times):
        begin = time.perf_counter()
        call()
        spent.append(1e3 * (time.perf_counter() - begin))
    return statistics.median(spent)


def overhead(source, target, resolution):
    registration = pcl_flashreg.PairRegistration()
    of_core = []

    def call():
        result = registration.align(source, target, resolution)
        of_core.append(result.timings_ms["total"])

    whole = milliseconds(call, 30)
    print(f"align: {whole:.2f} ms, of which the core {statistics.median(of_core):.2f}")
    points = np.random.default_rng(1).uniform(size=(20, 3))
    small = pcl_flashreg.PairRegistration(1)
    whole = milliseconds(lambda: small.estimate_pose(points, points, 0.05), 2000)
    core = small.estimate_pose(points, points, 0.05).timings_ms["total"]
    print(f"estimate_pose of 20: {whole:.3f} ms, of which the core {core:.3f}")
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        run = lambda: milliseconds(lambda: small.estimate_pose(points, points, 0.05), 2000)
        print(f"the same outside the main thread: {pool.submit(run).result():.3f} ms")


def scaling(source, target, resolution, calls):
    def work(_):
        registration = pcl_flashreg.PairRegistration(1)
        for _ in range(calls):
            registration.align(source, target, resolution)

    alone = None
    for threads in (1, 2, 4, 8):
        with concurrent.futures.ThreadPoolExecutor(threads) as pool:
            begin = time.perf_counter()
            list(pool.map(work, range(threads)))
            rate = threads * calls / (time.perf_counter() - begin)
        alone = alone or rate
        print(f"{threads} threads: {rate:.1f} pairs a second, {rate / alone:.2f} times one")


class Interrupt(Exception):
    pass


def interruption(source, target, resolution):
    def handle(number, frame):
        raise Interrupt

    signal.signal(signal.SIGALRM, handle)
    registration = pcl_flashreg.PairRegistration(1)
    waits = []
    for i in range(20):
        delay = 0.005 * (i + 1)
        begin = time.perf_counter()
        signal.setitimer(signal.ITIMER_REAL, delay)
        try:
            while True:
                registration.align(source, target, resolution)
        except Interrupt:
            waits.append(1e3 * (time.perf_counter() - begin - delay))
    print(f"a signal ends a call within {statistics.median(waits):.0f} ms (median), "
          f"{max(waits):.0f} at most")


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=pathlib.Path, help="with source.pcd and target.pcd")
    parser.add_argument("resolution", type=float)
    parser.add_argument("--calls", type=int, default=10, help="a thread")
    options = parser.parse_args()
    clouds = [
        pcl_flashreg.read_cloud(options.folder / f"{side}.pcd")
        for side in ("source", "target")
    ]
    overhead(*clouds, options.resolution)
    scaling(*clouds, options.resolution, options.calls)
    interruption(*clouds, options.resolution)


if __name__ == "__main__":
    main()
