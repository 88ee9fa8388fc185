#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Fits the coefficients of src/judgement/confidence.cpp to rows of pcl_flashreg_evaluate.

Reads CSV files of the methods flashreg_fast, flashreg, flashreg_source_viewpoint and
flashreg_no_viewpoint. Logistic regressions: correspondences alone, clouds with both
viewpoints, with one (and the sides of the other one's surfaces, or not), with sides alone,
each times what every pose needs. Cross-validated by scene: a
pair is judged by coefficients that no pair with a cloud of its source's scene had a part in.
Needs numpy; --plot also matplotlib.

    scripts/fit_confidence.py correspondences.csv clouds.csv clouds_without_viewpoints.csv
"""

import argparse
import csv
import json
import os

import numpy as np

THRESHOLDS = (0.5, 0.6, 0.7, 0.8, 0.9)
# Parameters::min_confidence
THRESHOLD = 0.6
SENSORS = {
    "rooms, depth camera, fused (3DMatch)": ["3DMatch", "3DMatch_raw"],
    "the same, less overlap (3DLoMatch)": ["3DLoMatch"],
    "depth cameras, single frames": ["UR5_D435_tabletop", "ICL_NUIM", "slambook_kinect"],
    "spinning lidar": ["KITTI_10m_corr", "KITTI_raw", "NCLT", "Indoor16line_rotating", "fast_gicp"],
    "handheld lidar": ["Hilti14_basement", "BALM"],
    "objects": ["stanford_bunny", "pcl_tutorials"],
}
# A row of the table of calibration is this wide.
BINS = np.array([0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1])
# Weight of the penalty on the coefficients, the constant excepted.
RIDGE = 1.0


def hold(row):
    return min(2.0, max(-1.0, row["hold"]))


def features_of_correspondences(row):
    inliers = row["inliers"]
    return [
        np.log(inliers + 1),
        np.log(row["agreeing_ratio"] + 1e-4),
        np.log((inliers + 1) / (row["rival_inliers"] + 3)),
        np.log(row["thickness"] + 1),
    ]


def features_of_clouds(row):
    matched = row["matched"] + 0.01
    return [
        np.log(matched),
        np.log(row["contradicted"] / matched + 0.01),
        np.log(row["support"] + 5),
        row["lead"],
        np.log(row["stiffness"] + 0.001),
        hold(row),
        row["residual"],
    ]


def features_without_viewpoints(row):
    return features_of_clouds(row)[2:]


def features_of_sides(row):
    # By its lead and hold, as what every pose needs has them, it is no better.
    features = features_of_clouds(row)
    return [features[i] for i in (0, 1, 2, 4, 6)]


def logistic(x):
    return 1 / (1 + np.exp(-np.clip(x, -50, 50)))


def half_at(value, half, power):
    scaled = (value / half) ** power
    return scaled / (1 + scaled)


# What src/judgement/confidence.cpp multiplies the regressions with.


def needed_of_correspondences(row):
    ratio = row["rival_inliers"] / max(1.0, row["inliers"])
    return (
        1 / (1 + ratio**4)
        * logistic(-row["log_chance"])
        * half_at(row["breadth"], 1, 4)
        * logistic(3 * (1.2 - row["mirrored"]))
    )


def needed_of_clouds(row):
    return (
        1 / (1 + row["rivals"] ** 1.5)
        * logistic(8 * (row["hold"] - 0.2))
        * half_at(row["stiffness"], 0.004, 4)
        * logistic(3 * (1.2 - row["mirrored"]))
    )


MODELS = {
    "correspondences": (features_of_correspondences, needed_of_correspondences),
    "clouds with viewpoints": (features_of_clouds, needed_of_clouds),
    "clouds with one viewpoint and sides": (features_of_clouds, needed_of_clouds),
    "clouds with one viewpoint": (features_without_viewpoints, needed_of_clouds),
    "clouds without viewpoints": (features_of_sides, needed_of_clouds),
}


def model_of(row):
    if not row["has_clouds"]:
        return "correspondences"
    if not row["has_viewpoints"]:
        return "clouds without viewpoints" if row["has_sides"] else "nothing believed"
    if row["has_sides"]:
        return "clouds with one viewpoint and sides"
    one = row["method"] == METHOD_OF["clouds with one viewpoint"]
    return "clouds with one viewpoint" if one else "clouds with viewpoints"


METHOD_OF = {
    "correspondences": "flashreg_fast",
    "clouds with viewpoints": "flashreg",
    "clouds with one viewpoint and sides": "flashreg_source_viewpoint",
    "clouds with one viewpoint": "flashreg_source_viewpoint",
    "clouds without viewpoints": "flashreg_no_viewpoint",
    # Chosen by what it says: no fit to these rows would be fair.
    "nothing believed": None,
}


def scene_of(path):
    # Three raw fragments are of a scene that is there already.
    return os.path.dirname(path).replace(
        "3dmatch_raw_redkitchen", "3dmatch/7-scenes-redkitchen"
    )


def read(path):
    rows = []
    with open(path, newline="") as file:
        limits = json.loads(file.readline().lstrip("# "))
        for cells in csv.DictReader(file):
            row = {}
            for name, text in cells.items():
                try:
                    row[name] = float(text)
                except ValueError:
                    row[name] = text
            if row["method"] != METHOD_OF[model_of(row)]:
                continue  # another method, or one that lacked what it is for
            row["scenes"] = {scene_of(row["source"]), scene_of(row["target"])}
            # Not grossly wrong: within twice what is right.
            row["near"] = row["success"] or (
                isinstance(row["rotation_error_deg"], float)
                and row["rotation_error_deg"] < 2 * limits["max_rotation_deg"]
                and row["translation_error"] < 2 * limits["max_translation"]
            )
            rows.append(row)
    return rows


def fit(x, y, needed, start=None):
    """Maximum likelihood of p = needed * logistic(constant + x . coefficients), by scoring."""
    x = np.column_stack([np.ones(len(x)), x])
    penalty = RIDGE * np.eye(x.shape[1])
    penalty[0, 0] = 1e-6
    coefficients = np.zeros(x.shape[1]) if start is None else start.copy()
    for _ in range(500):
        s = logistic(x @ coefficients)
        p = np.clip(needed * s, 1e-12, 1 - 1e-9)
        slope = needed * s * (1 - s)
        gradient = x.T @ ((y - p) * slope / (p * (1 - p))) - penalty @ coefficients
        hessian = (x * (slope**2 / (p * (1 - p)))[:, None]).T @ x + penalty
        step = np.linalg.solve(hessian, gradient)
        largest = np.abs(step).max()
        coefficients += step * min(1, 1 / largest)
        if largest < 1e-7:
            break
    return coefficients


def predict(coefficients, x, needed):
    return needed * logistic(coefficients[0] + x @ coefficients[1:])


def cross_validate(rows, x, y, needed, start):
    p = np.zeros(len(rows))
    for scene in sorted({scene_of(row["source"]) for row in rows}):
        apart = np.array([scene not in row["scenes"] for row in rows])
        here = np.array([scene == scene_of(row["source"]) for row in rows])
        coefficients = fit(x[apart], y[apart], needed[apart], start)
        p[here] = predict(coefficients, x[here], needed[here])
    return p


def percent(part, whole):
    return 100.0 * part / whole if whole else float("nan")


def print_thresholds(p, y, near, datasets, without_overlap):
    truth = ~np.isin(datasets, without_overlap)
    accepted = [name for name in without_overlap if (datasets == name).any()]
    print("| threshold | trusted that are right | not grossly wrong | right that are trusted |", end="")
    print("".join(" accepted of %s |" % name for name in accepted))
    print("|---" * (4 + len(accepted)) + "|")
    for threshold in THRESHOLDS:
        yes = p >= threshold
        shares = [
            percent((yes & y & truth).sum(), (yes & truth).sum()),
            percent((yes & near & truth).sum(), (yes & truth).sum()),
            percent((yes & y).sum(), y.sum()),
        ] + [percent(yes[datasets == name].sum(), (datasets == name).sum()) for name in accepted]
        print("| %.2f |" % threshold + "".join(" %.2f %% |" % share for share in shares))
    print()


def print_sensors(p, y, near, datasets):
    print("| sensor | pairs | right | trusted that are right | not grossly wrong | right that are trusted |")
    print("|---|---|---|---|---|---|")
    for sensor, names in SENSORS.items():
        here = np.isin(datasets, names)
        yes = here & (p >= THRESHOLD)
        if here.any():
            print(
                "| %s | %d | %.1f %% | %.2f %% | %.2f %% | %.1f %% |"
                % (
                    sensor,
                    here.sum(),
                    percent((here & y).sum(), here.sum()),
                    percent((yes & y).sum(), yes.sum()),
                    percent((yes & near).sum(), yes.sum()),
                    percent((yes & y).sum(), (here & y).sum()),
                )
            )
    print()


def print_calibration(p, y):
    print("| confidence | pairs | mean | right |")
    print("|---|---|---|---|")
    for low, high in zip(BINS[:-1], BINS[1:]):
        inside = (p >= low) & ((p < high) | (high == 1))
        if inside.any():
            print(
                "| %.2f – %.2f | %d | %.3f | %.3f |"
                % (low, high, inside.sum(), p[inside].mean(), y[inside].mean())
            )
    print()


def plot(curves, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6, 4))
    for name, (p, y, truth) in curves.items():
        order = np.argsort(-p[truth], kind="stable")
        right = np.cumsum(y[truth][order])
        axes.plot(
            100 * right / right[-1], 100 * right / np.arange(1, len(order) + 1), label=name
        )
    axes.set_xlabel("recall of the right poses / %")
    axes.set_ylabel("precision of the verdict / %")
    axes.set_ylim(90, 100.2)
    axes.grid(True)
    axes.legend(loc="lower left")
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("rows", nargs="+", help="CSV files of pcl_flashreg_evaluate")
    parser.add_argument(
        "--without-overlap",
        nargs="+",
        default=["none", "none_same_scene"],
        metavar="NAME",
        help="data sets whose pairs have no right pose (default: %(default)s)",
    )
    parser.add_argument("--plot", metavar="FILE.svg", help="precision over recall")
    options = parser.parse_args()

    rows = [row for path in options.rows for row in read(path)]
    curves = {}
    for name, (features, needed_of) in MODELS.items():
        mine = [row for row in rows if model_of(row) == name]
        if not mine:
            continue
        x = np.array([features(row) for row in mine])
        y = np.array([row["success"] for row in mine]) > 0
        datasets = np.array([row["dataset"] for row in mine])
        truth = ~np.isin(datasets, options.without_overlap)
        needed = np.array([needed_of(row) for row in mine])
        near = np.array([bool(row["near"]) for row in mine])
        final = fit(x, y, needed)
        p = cross_validate(mine, x, y, needed, final)
        print("## %s: %d pairs, %d of them without overlap\n" % (name, len(y), (~truth).sum()))
        print("coefficients: " + ", ".join("%.2f" % c for c in final) + "\n")
        print_thresholds(p, y, near, datasets, options.without_overlap)
        print_sensors(p, y, near, datasets)
        print_calibration(p, y)
        curves[name] = (p, y, truth)
    if options.plot:
        plot(curves, options.plot)


if __name__ == "__main__":
    main()
