#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Fits the coefficients of src/judgement/confidence.cpp to rows of pcl_flashreg_evaluate.

Reads CSV files of the methods flashreg_fast, flashreg, flashreg_source_viewpoint and
flashreg_no_viewpoint. Four logistic regressions: correspondences alone, clouds with both
viewpoints, with one, without. Cross-validated by scene: a pair is judged by coefficients that no pair with a
cloud of its source's scene had a part in. Needs numpy; --plot also matplotlib.

    scripts/fit_confidence.py correspondences.csv clouds.csv clouds_without_viewpoints.csv
"""

import argparse
import csv
import os

import numpy as np

THRESHOLDS = (0.5, 0.6, 0.7, 0.8, 0.9)
# A row of the table of calibration is this wide.
BINS = np.array([0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1])
# Weight of the penalty on the coefficients, the constant excepted.
RIDGE = 1.0


def features_of_correspondences(row):
    inliers = row["inliers"]
    return [
        np.log(inliers + 1),
        np.log(row["agreeing_ratio"] + 1e-4),
        np.log((inliers + 1) / (row["rival_inliers"] + 3)),
        np.log(row["thickness"] + 1),
    ]


def features_of_clouds(row):
    return [
        np.log(row["matched"] + 0.01),
        np.log(row["contradicted"] + 0.01),
        np.log(row["inliers"] + 5),
        row["lead"],
        np.log(row["stiffness"] + 0.001),
    ]


def features_without_viewpoints(row):
    features = features_of_clouds(row)
    return features[:1] + features[2:]


def limit_by_rival(row):
    """What src/judgement/confidence.cpp puts above a verdict from correspondences alone."""
    ratio = row["rival_inliers"] / max(1.0, row["inliers"])
    return 1 / (1 + ratio**4)


MODELS = {
    "correspondences": (features_of_correspondences, limit_by_rival),
    "clouds with viewpoints": (features_of_clouds, None),
    "clouds with one viewpoint": (features_of_clouds, None),
    "clouds without viewpoints": (features_without_viewpoints, None),
}


def model_of(row):
    if not row["has_clouds"]:
        return "correspondences"
    if not row["has_viewpoints"]:
        return "clouds without viewpoints"
    one = row["method"] == METHOD_OF["clouds with one viewpoint"]
    return "clouds with one viewpoint" if one else "clouds with viewpoints"


METHOD_OF = {
    "correspondences": "flashreg_fast",
    "clouds with viewpoints": "flashreg",
    "clouds with one viewpoint": "flashreg_source_viewpoint",
    "clouds without viewpoints": "flashreg_no_viewpoint",
}


def scene_of(path):
    # Three raw fragments are of a scene that is there already.
    return os.path.dirname(path).replace(
        "3dmatch_raw_redkitchen", "3dmatch/7-scenes-redkitchen"
    )


def read(path):
    rows = []
    with open(path, newline="") as file:
        for cells in csv.DictReader(line for line in file if line[0] != "#"):
            row = {}
            for name, text in cells.items():
                try:
                    row[name] = float(text)
                except ValueError:
                    row[name] = text
            if row["method"] != METHOD_OF[model_of(row)]:
                continue  # another method, or one that lacked what it is for
            row["scenes"] = {scene_of(row["source"]), scene_of(row["target"])}
            rows.append(row)
    return rows


def fit(x, y):
    """Logistic regression by Newton's method; the constant comes first."""
    x = np.column_stack([np.ones(len(x)), x])
    penalty = RIDGE * np.eye(x.shape[1])
    penalty[0, 0] = 1e-6
    coefficients = np.zeros(x.shape[1])
    for _ in range(100):
        p = 1 / (1 + np.exp(-x @ coefficients))
        gradient = x.T @ (y - p) - penalty @ coefficients
        hessian = (x * (p * (1 - p))[:, None]).T @ x + penalty
        step = np.linalg.solve(hessian, gradient)
        coefficients += step
        if np.abs(step).max() < 1e-9:
            break
    return coefficients


def predict(coefficients, x):
    return 1 / (1 + np.exp(-(coefficients[0] + x @ coefficients[1:])))


def cross_validate(rows, x, y):
    p = np.zeros(len(rows))
    for scene in sorted({scene_of(row["source"]) for row in rows}):
        apart = np.array([scene not in row["scenes"] for row in rows])
        here = np.array([scene == scene_of(row["source"]) for row in rows])
        p[here] = predict(fit(x[apart], y[apart]), x[here])
    return p


def percent(part, whole):
    return 100.0 * part / whole if whole else float("nan")


def print_table(p, y, datasets, without_overlap):
    truth = ~np.isin(datasets, without_overlap)
    accepted = [name for name in without_overlap if (datasets == name).any()]
    print("| threshold | precision | recall of the right poses |", end="")
    print("".join(" accepted of %s |" % name for name in accepted))
    print("|---" * (3 + len(accepted)) + "|")
    for threshold in THRESHOLDS:
        yes = p >= threshold
        shares = [
            percent((yes & y & truth).sum(), (yes & truth).sum()),
            percent((yes & y).sum(), y.sum()),
        ] + [percent(yes[datasets == name].sum(), (datasets == name).sum()) for name in accepted]
        print("| %.2f |" % threshold + "".join(" %.2f %% |" % share for share in shares))
    print()
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
    for name, (features, limit) in MODELS.items():
        mine = [row for row in rows if model_of(row) == name]
        if not mine:
            continue
        x = np.array([features(row) for row in mine])
        y = np.array([row["success"] for row in mine]) > 0
        datasets = np.array([row["dataset"] for row in mine])
        truth = ~np.isin(datasets, options.without_overlap)
        p = cross_validate(mine, x, y)
        if limit:
            p = np.minimum(p, [limit(row) for row in mine])
        final = fit(x, y)
        print("## %s: %d pairs, %d of them without overlap\n" % (name, len(y), (~truth).sum()))
        print("coefficients: " + ", ".join("%.2f" % c for c in final) + "\n")
        print_table(p, y, datasets, options.without_overlap)
        curves[name] = (p, y, truth)
    if options.plot:
        plot(curves, options.plot)


if __name__ == "__main__":
    main()
