#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the curves of measure_vocabulary --csv: plot_recognition.py CURVES.csv OUT.png (needs matplotlib)."""
import collections
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)


def read_curves(path):
    """{curve: {method: ([x], [y])}}"""
    curves = collections.defaultdict(lambda: collections.defaultdict(lambda: ([], [])))
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            for values, column in zip(curves[row["curve"]][row["method"]], "xy"):
                values.append(float(row[column]))
    return curves


def draw(curves, out):
    figure, axes = plt.subplots(1, 2, figsize=(8, 3.2))
    labels = {"rank": ("best N answers", "right place among them"), "precision": ("recall", "precision")}
    for axis, (curve, (x_label, y_label)) in zip(axes, labels.items()):
        for method, (x, y) in curves[curve].items():
            axis.plot(x, y, marker="." if curve == "rank" else None, label=method)
        axis.set(xlabel=x_label, ylabel=y_label, ylim=(0, 1.03))
        axis.grid(alpha=0.3)
    axes[0].legend(loc="lower right")
    figure.tight_layout()
    figure.savefig(out, dpi=80)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    draw(read_curves(sys.argv[1]), sys.argv[2])
