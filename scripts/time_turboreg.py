#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Times TurboReg's own public implementation on the correspondences that
pcl_flashreg_benchmark times, on the same GPU.

    git clone https://github.com/Laka-3DV/TurboReg
    pcl_flashreg_benchmark --sizes 7000 --export .
    scripts/time_turboreg.py --turboreg TurboReg --leaf 0.05 0_7000.txt

Needs PyTorch with CUDA, Ninja, a C++ compiler and Eigen; TurboReg is compiled as its own
setup does, into PyTorch's folder for extensions. Its parameters follow from the
resolution as this project's do (docs/method.md). A call begins with correspondences in
device memory, float32, and ends with the pose in host memory. Exits with 77 where there is
no PyTorch or no device, with 2 or 3 where something is wrong.
"""

import argparse
import glob
import json
import os
import statistics
import sys
import time

SKIPPED = 77
WARM_UP_RUNS = 3


def fail(message, status):
    print(f"time_turboreg.py: error: {message}", file=sys.stderr)
    sys.exit(status)


def parse_arguments():
    parser = argparse.ArgumentParser(
        description="Times TurboReg's public implementation.")
    parser.add_argument("files", nargs="+",
                        help="correspondences: six columns, or SOURCE,TARGET with three each")
    parser.add_argument("--turboreg", required=True,
                        help="folder with a checkout of TurboReg")
    parser.add_argument("--leaf", type=float, default=0.05,
                        help="resolution that sets every length [0.05]")
    parser.add_argument("--pivots", type=int, default=2000)
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--eigen", default="/usr/include/eigen3",
                        help="folder that holds Eigen/Core [/usr/include/eigen3]")
    parser.add_argument("--json", help="write the figures to this file, too")
    arguments = parser.parse_args()
    if not arguments.leaf > 0 or arguments.runs < 1 or arguments.pivots < 1:
        parser.error("--leaf, --runs and --pivots must be positive")
    return arguments


def read_correspondences(paths):
    """Source and target, NumPy arrays of N x 3 each."""
    import numpy
    tables = [numpy.loadtxt(path, ndmin=2) for path in paths.split(",")]
    table = numpy.hstack(tables)
    if table.shape[1] != 6:
        raise ValueError(f"{paths}: found {table.shape[1]} columns, expected 6")
    return table[:, :3], table[:, 3:]


def build(torch, arguments):
    """TurboReg as an extension, with the compiler flags of its own setup.py."""
    from torch.utils import cpp_extension
    sources = sorted(glob.glob(os.path.join(arguments.turboreg, "turboreg/src/*.cpp")))
    if not sources:
        fail(f"{arguments.turboreg}: no turboreg/src/*.cpp in there", 3)
    sources.append(os.path.join(arguments.turboreg, "bindings/pybinding.cpp"))
    try:
        return cpp_extension.load(
            name="turboreg_gpu",
            sources=sources,
            extra_include_paths=[os.path.join(arguments.turboreg, "turboreg/include"),
                                 arguments.eigen],
            extra_cflags=["-O2", "-std=c++17"])
    except RuntimeError as error:
        lines = str(error).splitlines()
        first = next((line for line in lines if " error: " in line), lines[0])
        fail(f"TurboReg could not be compiled: {first}", 3)


def time_calls(torch, solver, source, target, runs):
    """The pose, and milliseconds of each call."""
    times = []
    for run in range(WARM_UP_RUNS + runs):
        torch.cuda.synchronize()
        begin = time.perf_counter()
        pose = solver.run_reg(source, target).cpu()
        elapsed = 1e3 * (time.perf_counter() - begin)
        if run >= WARM_UP_RUNS:
            times.append(elapsed)
    return pose, times


def count_inliers(pose, source, target, inlier_distance):
    moved = source @ pose[:3, :3].T + pose[:3, 3]
    return int(((moved - target) ** 2).sum(1).lt(inlier_distance ** 2).sum())


def quantile(values, share):
    return sorted(values)[round(share * (len(values) - 1))]


def measure(torch, module, arguments, paths, device):
    source, target = (torch.from_numpy(side).float() for side in read_correspondences(paths))
    inlier_distance = 2 * arguments.leaf
    solver = module.TurboRegGPU(len(source), 0.24 * arguments.leaf, arguments.pivots,
                                3 * arguments.leaf, inlier_distance, "IN")
    torch.cuda.reset_peak_memory_stats()
    pose, times = time_calls(torch, solver, source.to(device), target.to(device),
                             arguments.runs)
    return {"file": paths,
            "correspondences": len(source),
            "inliers": count_inliers(pose, source, target, inlier_distance),
            "transformation": pose.tolist(),
            "total_ms": {"median": statistics.median(times),
                         "p10": quantile(times, 0.1),
                         "p90": quantile(times, 0.9),
                         "min": min(times)},
            "memory_bytes": torch.cuda.max_memory_allocated()}


def main():
    arguments = parse_arguments()
    try:
        import torch
    except ImportError:
        fail("PyTorch is not installed; nothing was timed", SKIPPED)
    if not torch.cuda.is_available():
        fail("PyTorch sees no device; nothing was timed", SKIPPED)
    device = torch.device("cuda")
    try:
        module = build(torch, arguments)
        results = []
        for paths in arguments.files:
            result = measure(torch, module, arguments, paths, device)
            results.append(result)
            spread = result["total_ms"]
            print(f"{paths}: N {result['correspondences']}, "
                  f"inliers {result['inliers']}, "
                  f"{spread['median']:.3f} ms (p10 {spread['p10']:.3f}, "
                  f"p90 {spread['p90']:.3f}), "
                  f"{1e-6 * result['memory_bytes']:.1f} MB", flush=True)
    except (OSError, ValueError, RuntimeError) as error:
        fail(error, 3)
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump({"device": torch.cuda.get_device_name(device),
                       "torch": torch.__version__,
                       "measurements": results}, file, indent=2)


if __name__ == "__main__":
    main()
