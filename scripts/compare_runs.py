#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares two estimates of one sequence: RMSE and S.D. of the ATE and of the drift per second.

Prints a Markdown table. The improvement eta = (a - b) / a, in %, of run b over the baseline a is
positive where b errs less.
"""
import command_line
import evaluate_ate
import evaluate_rpe
from trajectory import read_trajectory

METRICS = {"ate": ("ATE", "m"), "translational_drift": ("Translational drift", "m/s"),
           "rotational_drift": ("Rotational drift", "deg/s")}
DRIFT_PER_SECOND = evaluate_rpe.RpeOptions(fixed_delta=True, delta=1.0, delta_unit="s")


def evaluate(groundtruth, estimate, frames):
    """The figures of one run: those of METRICS, poses compared, coverage."""
    ate = evaluate_ate.summarize(evaluate_ate.evaluate(groundtruth, estimate), None)
    rpe = evaluate_rpe.summarize(evaluate_rpe.evaluate(groundtruth, estimate, DRIFT_PER_SECOND))
    errors = {"ate": ate, "translational_drift": rpe["translational_error"],
              "rotational_drift": rpe["rotational_error"]}
    figures = {name: {"rmse": error["rmse"], "sd": error["std"]} for name, error in errors.items()}
    return {**figures, "poses": len(estimate), "ate_pairs": ate["pairs"], "rpe_pairs": rpe["pairs"],
            "coverage": command_line.coverage(len(estimate), frames)}


def improvement(baseline, other):
    """(a - b) / a in %; None if the baseline has no error to improve on."""
    return 100 * (baseline - other) / baseline if baseline > 0 else None


def compare(baseline, other):
    """Improvement of RMSE and S.D. of each metric, in %."""
    return {metric: {figure: improvement(baseline[metric][figure], other[metric][figure])
                     for figure in ("rmse", "sd")} for metric in METRICS}


def table_rows(labels, runs, improvements):
    """The table as rows of text, the header first."""
    rows = [["Metric", *(f"{label} {figure}" for label in labels for figure in ("RMSE", "S.D.")),
             "eta RMSE [%]", "eta S.D. [%]"]]
    for metric, (name, unit) in METRICS.items():
        figures = [f"{run[metric][figure]:.4f}" for run in runs for figure in ("rmse", "sd")]
        etas = [improvements[metric][figure] for figure in ("rmse", "sd")]
        rows.append([f"{name} [{unit}]", *figures, *("n/a" if eta is None else f"{eta:.2f}" for eta in etas)])
    return rows


def markdown(rows):
    """Lines of an aligned Markdown table: the first column to the left, figures to the right."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    rule = [":" + "-" * (widths[0] - 1), *("-" * (width - 1) + ":" for width in widths[1:])]
    def line(row):
        cells = [row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:]))]
        return f"| {' | '.join(cells)} |"
    return [line(row) for row in (rows[0], rule, *rows[1:])]


def coverage_line(label, run):
    """How much of the sequence stands behind a run's figures."""
    share = run["coverage"]
    frames = f" of {share['frames']} frames ({100 * share['ratio']:.1f} %)" if share else ""
    return f"{label}: {run['poses']} poses{frames}, {run['ate_pairs']} compared"


def parse_arguments():
    parser = command_line.Parser(description=__doc__)
    parser.add_argument("groundtruth", help="trajectory file: timestamp tx ty tz qx qy qz qw")
    parser.add_argument("baseline", help="trajectory file of the run to improve on")
    parser.add_argument("other", help="trajectory file of the other run")
    parser.add_argument("--labels", nargs=2, metavar=("A", "B"), default=["baseline", "other"],
                        help="names of the runs in the table")
    command_line.add_report_options(parser)
    return parser.parse_args()


def main():
    args = parse_arguments()
    groundtruth = read_trajectory(args.groundtruth)
    runs = [evaluate(groundtruth, read_trajectory(path), args.frames) for path in (args.baseline, args.other)]
    improvements = compare(*runs)
    lines = markdown(table_rows(args.labels, runs, improvements))
    lines += ["", *(coverage_line(label, run) for label, run in zip(args.labels, runs))]
    units = {metric: unit for metric, (_, unit) in METRICS.items()}
    result = {"labels": args.labels, "units": units, "baseline": runs[0], "other": runs[1],
              "improvement_percent": improvements}
    command_line.publish(result, lines, args.json)


if __name__ == "__main__":
    command_line.run(main)
