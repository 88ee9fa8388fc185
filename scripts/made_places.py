# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Made streets and halls, and a turning laser scanner in them, for the scripts beside this one.
Places are lists of boxes, cylinders and balls; the ground is the plane z = 0. Needs numpy."""

import numpy as np

BEAMS = np.radians(np.linspace(-25, 15, 32))
STEPS = 900  # of a turn
NOISE = 0.02  # metres
RANGE = 60.0


def pose(x, y, z, heading=0.0, roll=0.0, pitch=0.0):
    """Of angles in radians, turned about x, y and z in this order."""
    T = np.eye(4)
    for axis, angle in ((0, roll), (1, pitch), (2, heading)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        R = np.eye(3)
        R[i, i] = R[j, j] = np.cos(angle)
        R[i, j], R[j, i] = -np.sin(angle), np.sin(angle)
        T[:3, :3] = R @ T[:3, :3]
    T[:3, 3] = x, y, z
    return T


def inverse(T):
    result = np.eye(4)
    result[:3, :3] = T[:3, :3].T
    result[:3, 3] = -T[:3, :3].T @ T[:3, 3]
    return result


def moved(T, points):
    return points @ T[:3, :3].T + T[:3, 3]


def box(x, y, z, length, width, height, heading=0.0):
    """Stands on z."""
    T = pose(x, y, z + height / 2, heading)
    return ("box", T, np.array([length, width, height]) / 2)


def cylinder(x, y, radius, height):
    return ("cylinder", np.array([x, y]), radius, height)


def ball(x, y, z, radius):
    return ("ball", np.array([x, y, z]), radius)


def shifted(shape, x, y, turned=False):
    """The same shape elsewhere, perhaps turned about the z axis by half a turn first."""
    sign = -1 if turned else 1
    flat = np.array([x, y])
    if shape[0] == "box":
        T = pose(x, y, 0, np.pi if turned else 0) @ shape[1]
        return ("box", T, shape[2])
    if shape[0] == "cylinder":
        return ("cylinder", sign * shape[1] + flat, shape[2], shape[3])
    return ("ball", np.append(sign * shape[1][:2] + flat, shape[1][2]), shape[2])


def centre_of(shape):
    return shape[1][:2, 3] if shape[0] == "box" else shape[1][:2]


def size_of(shape):
    return np.linalg.norm(shape[2]) if shape[0] == "box" else shape[2]


def to_box(shape, origin, rays):
    T, half = shape[1], shape[2]
    start, along = T[:3, :3].T @ (origin - T[:3, 3]), rays @ T[:3, :3]
    with np.errstate(divide="ignore", invalid="ignore"):
        a, b = (-half - start) / along, (half - start) / along
    enter = np.minimum(a, b).max(1)
    leave = np.maximum(a, b).min(1)
    return np.where((enter <= leave) & (enter > 0), enter, np.inf)


def to_round(start, along, radius):
    """The first meeting with a circle or a ball about 0."""
    a, b, c = (along**2).sum(1), along @ start, start @ start - radius**2
    root = b * b - a * c
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (-b - np.sqrt(np.maximum(root, 0))) / a
    return np.where((root > 0) & (t > 0), t, np.inf)


def rays_towards(shape, origin, azimuths):
    """Those of the rays that may meet it; a slice where that is all of them."""
    off = centre_of(shape) - origin[:2]
    distance, size = np.linalg.norm(off), size_of(shape)
    if distance > RANGE + size:
        return None
    if distance <= size:
        return slice(None)
    away = np.abs(np.remainder(azimuths - np.arctan2(off[1], off[0]) + np.pi, 2 * np.pi) - np.pi)
    return np.flatnonzero(away <= np.arcsin(size / distance))


def distances(shapes, origin, rays):
    """How far each ray goes; infinite where it meets nothing."""
    with np.errstate(divide="ignore"):
        best = np.where(rays[:, 2] < 0, -origin[2] / rays[:, 2], np.inf)
    azimuths = np.arctan2(rays[:, 1], rays[:, 0])
    for shape in shapes:
        chosen = rays_towards(shape, origin, azimuths)
        if chosen is None:
            continue
        some = rays[chosen]
        if shape[0] == "box":
            t = to_box(shape, origin, some)
        elif shape[0] == "cylinder":
            t = to_round(origin[:2] - shape[1], some[:, :2], shape[2])
            t = np.where(origin[2] + t * some[:, 2] < shape[3], t, np.inf)
        else:
            t = to_round(origin - shape[1], some, shape[2])
        best[chosen] = np.minimum(best[chosen], t)
    return best


def scan(shapes, T, rng, steps=STEPS):
    """A turn of the scanner at this pose, in its own frame."""
    turn = np.arange(steps) * 2 * np.pi / steps + rng.uniform(0, 2 * np.pi / steps)
    beam, turn = np.meshgrid(BEAMS, turn, indexing="ij")
    rays = np.stack(
        [np.cos(beam) * np.cos(turn), np.cos(beam) * np.sin(turn), np.sin(beam)], -1
    ).reshape(-1, 3)
    t = distances(shapes, T[:3, 3], rays @ T[:3, :3].T)
    seen = t < RANGE
    t = t[seen] + rng.normal(0, NOISE, seen.sum())
    return rays[seen] * t[:, None]


def level_pose(x, y, rng, height=1.7):
    """Of a scanner on a vehicle, turned anyhow."""
    tilt = np.radians(rng.normal(0, 1, 2))
    return pose(x, y, height, rng.uniform(-np.pi, np.pi), *tilt)


def mapped(shapes, places, rng):
    """The points of scans from all these places, in one frame."""
    return np.vstack([moved(T, scan(shapes, T, rng)) for T in places])


# ---- streets

HOUSE = 12.0  # metres of front
FRONT = 9.0  # from the middle of the street
LENGTH = 120.0
APART = 60.0
TYPES = 6


def house(rng):
    """One of the catalogue; its front is along x, and the street at lower y."""
    depth, height = rng.uniform(8, 12), rng.uniform(6, 11)
    width = rng.uniform(8, HOUSE)
    shapes = [box(0, depth / 2, 0, width, depth, height)]
    for _ in range(rng.integers(2, 5)):  # bays, porches, balconies
        wide = rng.uniform(0.8, 2.5)
        at = rng.uniform(-width / 2 + wide / 2, width / 2 - wide / 2)
        low = rng.choice([0, 0, 2.8])
        deep = rng.uniform(0.5, 1.6)
        shapes.append(box(at, -deep / 2, low, wide, deep, rng.uniform(1, 3.2)))
    for at in np.arange(-width / 2 + 1, width / 2 - 1, rng.uniform(1.8, 3)):  # sills
        for storey in (1.0, 3.8):
            shapes.append(box(at, -0.1, storey, 1.0, 0.2, 0.15))
    if rng.uniform() < 0.5:
        shapes.append(box(0, depth / 2, height, 1, 1, 1.5))
    return shapes


def furniture(rng, start):
    """Cars, trees and lamps of a street, which are nobody's copies."""
    shapes = []
    for side in (-1, 1):
        for x in np.arange(start, start + LENGTH, 7.0):
            if rng.uniform() < 0.5:
                at, heading = x + rng.uniform(-1, 1), rng.normal(0, 0.05)
                y = side * (4.5 + rng.uniform(-0.2, 0.2))
                length = rng.uniform(3.6, 5)
                shapes.append(box(at, y, 0.3, length, 1.8, 0.6, heading))
                shapes.append(box(at, y, 0.9, length / 2, 1.6, 0.6, heading))
            if rng.uniform() < 0.25:
                at = x + rng.uniform(1, 6)
                y = side * rng.uniform(6.3, 7)
                shapes.append(cylinder(at, y, rng.uniform(0.1, 0.25), 4))
                shapes.append(ball(at, y, 5, rng.uniform(1, 2)))
            if rng.uniform() < 0.2:
                shapes.append(cylinder(x, side * 6, 0.08, 6))
    return shapes


def streets(count, rng):
    """Parallel streets along x, whose houses are copies of a few. Of each its shapes, and
    where its middle is in y."""
    catalogue = [house(rng) for _ in range(TYPES)]
    result = []
    for street in range(count):
        y = APART * street
        shapes = []
        for side in (False, True):
            for x in np.arange(HOUSE / 2, LENGTH, HOUSE):
                for part in catalogue[rng.integers(TYPES)]:
                    moved_part = shifted(part, 0, 0)
                    at_front = shifted(moved_part, 0, FRONT)
                    across = shifted(at_front, x, 0, turned=side)
                    shapes.append(shifted(across, 0, y))
        shapes += [shifted(shape, 0, y) for shape in furniture(rng, 0.0)]
        result.append((shapes, y))
    return result


# ---- a hall with racks

AISLES = 6
RACK = 24.0  # metres long
AISLE = 4.0  # from rack to rack
END = 6.0  # from the racks to the wall


def rack(y, rng):
    shapes = [box(0, y, 0, RACK, 0.9, 5)]
    for x in np.arange(-RACK / 2, RACK / 2 + 0.1, 2.4):
        shapes.append(box(x, y, 0, 0.12, 1.2, 5))
    for z in (1.2, 2.6, 4.0):
        shapes.append(box(0, y, z, RACK, 1.15, 0.1))
    for x in np.arange(-RACK / 2 + 1.2, RACK / 2, 2.4):  # what lies on them
        for z in (0.0, 1.3, 2.7):
            deep, high = rng.uniform(0.95, 1.3), rng.uniform(0.5, 1.0)
            shapes.append(box(x, y, z, rng.uniform(0.8, 2), deep, high))
    return shapes


def warehouse(rng):
    """Aisles along x that are the same to the last millimetre, between walls; an office and
    some pallets stand at one end."""
    seed = rng.integers(1 << 30)
    width = AISLE * AISLES
    shapes = []
    for k in range(AISLES + 1):
        shapes += rack(AISLE * k - width / 2, np.random.default_rng(seed))
    length = RACK + 2 * END
    for side in (-1, 1):
        shapes.append(box(side * (length / 2 + 0.1), 0, 0, 0.2, width + 8, 7))
        shapes.append(box(0, side * (width / 2 + 4), 0, length, 0.2, 7))
    end = RACK / 2 + END
    shapes.append(box(end - 0.75, width / 4, 0, 1.5, 5, 3))
    for _ in range(8):
        y = rng.uniform(-width / 2, width / 8)
        shapes.append(box(end - rng.uniform(0.4, 0.8), y, 0, 0.8, 1.2, rng.uniform(0.3, 2)))
    return shapes


def middle_of_aisle(k):
    return AISLE * (k + 0.5) - AISLE * AISLES / 2
