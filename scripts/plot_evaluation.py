#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Draws what pcl_flashreg_evaluate --csv wrote: how recall falls with the inlier ratio, and
how precise each method's verdict is at each share of right poses that it accepts.

    scripts/plot_evaluation.py results.csv evaluation.png      (or .svg, .pdf)

Needs matplotlib (Debian and Ubuntu: apt-get install python3-matplotlib).
"""

import argparse
import csv
import sys
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import PercentFormatter

# Edges of the bins of the inlier ratio: each twice as wide as the one before.
EDGES = [0, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32, 1.0]
# Okabe and Ito's colours, which colour-blind people can tell apart.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X"]


class Row:
    """One method on one pair."""

    def __init__(self, cells):
        self.pair = int(cells["pair"])
        self.inlier_ratio = float(cells["inlier_ratio"])
        self.found = cells["found"] == "1"
        self.success = cells["success"] == "1"
        self.trusted = cells["trusted"] == "1"
        self.confidence = float(cells["confidence"])


def read(path, datasets):
    """Rows by method, in the order of the file."""
    methods = defaultdict(list)
    with open(path, newline="", encoding="utf-8") as file:
        lines = (line for line in file if not line.startswith("#"))
        for cells in csv.DictReader(lines):
            if not datasets or cells["dataset"] in datasets:
                methods[cells["method"]].append(Row(cells))
    return methods


def recall_by_bin(rows):
    """Recall in each bin of the inlier ratio, and the number of pairs there."""
    pairs, right = [0] * (len(EDGES) - 1), [0] * (len(EDGES) - 1)
    for row in rows:
        index = next(
            i for i in range(len(pairs)) if row.inlier_ratio < EDGES[i + 1] or i == len(pairs) - 1
        )
        pairs[index] += 1
        right[index] += row.success
    return [r / p if p else None for r, p in zip(right, pairs)], pairs


def precision_over_recall(rows):
    """Points of the curve that a threshold on the confidence runs through."""
    right = sum(row.success for row in rows)
    found = sorted((row for row in rows if row.found), key=lambda row: -row.confidence)
    recalls, precisions, accepted, rightly = [], [], 0, 0
    for i, row in enumerate(found):
        accepted += 1
        rightly += row.success
        is_last_of_ties = i + 1 == len(found) or found[i + 1].confidence != row.confidence
        if is_last_of_ties and right:
            recalls.append(rightly / right)
            precisions.append(rightly / accepted)
    return recalls, precisions


def draw_recall(axes, methods):
    _, pairs = recall_by_bin(next(iter(methods.values())))
    places = range(len(pairs))
    counts = axes.twinx()
    counts.bar(places, pairs, width=0.9, color="#E4E8EE", zorder=0)
    counts.set_ylabel("pairs", color="#8A94A0")
    counts.set_ylim(0, 2.2 * max(pairs))  # the bars stay in the lower half
    counts.tick_params(axis="y", colors="#8A94A0", length=0)
    counts.spines[:].set_visible(False)
    axes.set_zorder(counts.get_zorder() + 1)
    axes.patch.set_visible(False)
    for number, (method, rows) in enumerate(methods.items()):
        recall, _ = recall_by_bin(rows)
        shown = [(x, y) for x, y in zip(places, recall) if y is not None]
        axes.plot(*zip(*shown), label=method, **style(number))
    labels = [f"{100 * a:g} – {100 * b:g}" for a, b in zip(EDGES, EDGES[1:])]
    labels[0], labels[-1] = f"< {100 * EDGES[1]:g}", f"> {100 * EDGES[-2]:g}"
    axes.set_xticks(list(places), labels)
    axes.set_xlabel("right correspondences, %")
    axes.set_ylabel("recall")
    axes.set_ylim(0, 1.03)
    axes.yaxis.set_major_formatter(PercentFormatter(1))
    axes.set_title("Recall over the inlier ratio", loc="left")


def draw_verdict(axes, methods):
    lowest = 1.0
    for number, rows in enumerate(methods.values()):
        recalls, precisions = precision_over_recall(rows)
        if not recalls:
            continue
        line = dict(style(number), marker="")
        axes.plot(recalls, precisions, drawstyle="steps-post", **line)
        lowest = min([lowest] + [p for r, p in zip(recalls, precisions) if r > 0.05])
        trusted = [row for row in rows if row.trusted]
        if trusted:
            rightly = sum(row.success for row in trusted)
            right = sum(row.success for row in rows)
            point = dict(style(number), linestyle="", markersize=9, markeredgecolor="white")
            axes.plot([rightly / right], [rightly / len(trusted)], zorder=5, **point)
    axes.set_xlabel("right poses that are accepted")
    axes.set_ylabel("accepted poses that are right")
    axes.set_xlim(0, 1.03)
    axes.set_ylim(max(0.0, lowest - 0.05), 1.01)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(PercentFormatter(1))
    axes.set_title("The verdict: precision over recall", loc="left")
    axes.text(
        0.02, 0.03, "line: any threshold; mark: the method's own verdict",
        transform=axes.transAxes, color="#5A646E", fontsize=9,
    )


def style(number):
    return {
        "color": COLOURS[number % len(COLOURS)],
        "marker": MARKERS[number % len(MARKERS)],
        "linewidth": 1.8,
        "markersize": 5,
        "linestyle": "-" if number < len(COLOURS) else "--",
    }


def draw(methods, output):
    plt.rcParams.update({
        "font.size": 10.5,
        "axes.titleweight": "bold",
        "axes.titlesize": 11.5,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "svg.fonttype": "none",
        "svg.hashsalt": "pcl_flashreg",  # the same file from the same results
    })
    figure, (left, right) = plt.subplots(1, 2, figsize=(11.5, 4.8))
    draw_recall(left, methods)
    draw_verdict(right, methods)
    for axes in (left, right):
        axes.grid(True, axis="both" if axes is right else "y", color="#D5DAE0", linewidth=0.6)
        axes.set_axisbelow(True)
    lines = -(-len(methods) // 6)
    columns = -(-len(methods) // lines)
    figure.tight_layout(rect=(0, 0.05 * lines + 0.01, 1, 1), w_pad=2.5)
    handles, labels = left.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=columns, frameon=False)
    figure.savefig(output, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("results", help="file that --csv wrote")
    parser.add_argument("output", help="picture: .png, .svg or .pdf")
    parser.add_argument("--dataset", action="append", help="only this data set")
    options = parser.parse_args()
    try:
        methods = read(options.results, options.dataset)
    except (OSError, KeyError, ValueError, TypeError) as error:
        sys.exit(f"{sys.argv[0]}: {options.results}: is no file of results: {error!r}")
    if not methods:
        sys.exit(f"{sys.argv[0]}: {options.results}: holds no pairs to draw")
    draw(methods, options.output)


if __name__ == "__main__":
    main()
