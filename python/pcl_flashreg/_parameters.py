# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

from __future__ import annotations

import dataclasses

from . import _core


@dataclasses.dataclass(frozen=True, kw_only=True)
class Parameters:
    """Everything that the estimator can be told; what each means is in docs/method.md.

    Lengths are in the unit of the clouds; None takes them from the resolution. A value that
    is out of its range is a ValueError of the call that it is given to.

    length_tolerance: two correspondences are compatible if their distances in source and
        target differ by less. > 0; 0.24 resolutions.
    min_length_sum: pairs of correspondences whose two distances sum to no more are ignored.
        >= 0; 3 resolutions.
    inlier_distance: residual below which a correspondence agrees with a pose. > 0;
        2 resolutions.
    max_correspondences: the best-ranked are used, the others left out. 3 to 200000.
    pivots: best edges that cliques are grown from. 1 to 1000000.
    cliques_per_pivot: 3-cliques kept a pivot. 1 to 16.
    row_capacity: bounded mode, voters and entries kept a row. 1 to 4096.
    pool_capacity: bounded mode, best edges a row that may become pivots. 1 to row_capacity.
    second_order: 'auto', 'exact' or 'bounded'.
    score_metric: 'inliers', 'mae' or 'mse'.
    refinement_iterations: rounds of reweighted alignment at most. 0 to 1000.
    max_hypotheses: distinct hypotheses that a result lists at most. 1 to 64.
    motion: 'rigid', or 'upright' where it is known which way is up.
    max_tilt: upright motion, how many degrees gravity may be off. > 0, <= 30.
    source_gravity, target_gravity: upright motion, the directions of gravity, or the opposite
        ones of both, in each cloud's frame.
    min_confidence: a pose is trusted if its confidence is at least this. 0 to 1.
    """

    length_tolerance: float | None = None
    min_length_sum: float | None = None
    inlier_distance: float | None = None
    max_correspondences: int = 7000
    pivots: int = 2000
    cliques_per_pivot: int = 2
    row_capacity: int = 128
    pool_capacity: int = 32
    second_order: str = "auto"
    score_metric: str = "inliers"
    refinement_iterations: int = 20
    max_hypotheses: int = 5
    motion: str = "rigid"
    max_tilt: float = 3.0
    source_gravity: tuple[float, float, float] = (0.0, 0.0, 1.0)
    target_gravity: tuple[float, float, float] = (0.0, 0.0, 1.0)
    min_confidence: float = 0.6

    @classmethod
    def from_resolution(cls, resolution: float) -> Parameters:
        """The defaults with the lengths that a resolution gives.

        Raises:
            ValueError: it is not > 0 and finite.
        """
        return cls(**_core.default_parameters(resolution))
