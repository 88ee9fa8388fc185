# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

"""Global registration of point clouds: two clouds and no initial guess in; a rigid pose, a
verdict and the inliers out, in milliseconds, and the same every time.

    import pcl_flashreg
    result = pcl_flashreg.align("source.pcd", "target.pcd", 0.05)
    if result.converged:
        print(result.T_target_source)
"""

from . import _core
from ._core import (
    BackendError,
    Cloud,
    CloudAgreement,
    DescribedCloud,
    Evidence,
    FreeMotion,
    Hypothesis,
    MapEdge,
    MultiviewRegistration,
    MultiviewResult,
    PairRegistration,
    Result,
    Scan,
    ScanIndex,
    ScanPlace,
    __version__,
    available_backends,
    compute_features,
    estimate_resolution,
    match_features,
    read_cloud,
)
from ._parameters import Parameters

__all__ = [
    "BackendError",
    "Cloud",
    "CloudAgreement",
    "DescribedCloud",
    "Evidence",
    "FreeMotion",
    "Hypothesis",
    "MapEdge",
    "MultiviewRegistration",
    "MultiviewResult",
    "PairRegistration",
    "Parameters",
    "Result",
    "Scan",
    "ScanIndex",
    "ScanPlace",
    "align",
    "available_backends",
    "compute_features",
    "estimate_pose",
    "estimate_resolution",
    "match_features",
    "read_cloud",
]


def align(source, target, resolution=None, *, num_threads=0, backend="auto", **options):
    return PairRegistration(num_threads, backend).align(
        source, target, resolution, **options
    )


def estimate_pose(
    source_points, target_points, resolution=None, *, num_threads=0, backend="auto", **options
):
    return PairRegistration(num_threads, backend).estimate_pose(
        source_points, target_points, resolution, **options
    )


def _finish():
    """Classes are of this package, wherever they were made, and functions that have a method's
    arguments have its description."""
    for name in __all__:
        if isinstance(globals()[name], type):
            globals()[name].__module__ = __name__
    for function in (align, estimate_pose):
        method = getattr(PairRegistration, function.__name__)
        function.__doc__ = method.__doc__.partition("\n\n")[2] + (
            "\nA PairRegistration of num_threads (0: all processors) and backend is made for"
            "\nthis call; make one yourself for many.\n"
        )


_finish()
