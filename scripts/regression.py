#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs sequences without and with the detector of moving objects, and compares the figures with bounds.

Prints tables of RMSE, S.D. and improvement eta = (without - with) / without of the ATE and of the drift per
second, then figures of masks and detector. Runs are sequential, and so exactly repeatable. The synthetic
walking_xyz is always among them; real sequences are looked for in $ORBSLAM_DATA and in datasets/.

Bounds are read from a YAML file: for each sequence `min_FIGURE` or `max_FIGURE`. What has no bounds is only
reported. Exit codes: 0 all within their bounds, 1 a bound is broken or a run failed, 2 bad input.
"""
import argparse
import os
import sys

import yaml

import command_line
import compare_runs
import regression_runs as runs
from trajectory import InputError

BOUNDS = os.path.join(runs.ROOT, "tests", "e2e", "regression_bounds.yaml")
ALWAYS, QUICK = "synthetic_walking_xyz", "synthetic_walking_xyz_150"
OTHER_MOTIONS = [f"synthetic_walking_{motion}" for motion in ("static", "rpy", "halfsphere")]
SITUATIONS = [f"synthetic_{name}" for name in (
    "still_then_all_xyz_420", "cover_xyz", "close_xyz", "crossing_xyz_200", "waiting_xyz_240",
    "newly_seen_halfsphere_420", "put_down_xyz_240", "taken_away_xyz_240", "monitor_xyz_200", "crowd_xyz_200",
    "objects_halfsphere", "walking_static_200", "static_xyz_200")]

BASELINE_RATIOS = ("ate_ratio_empty", "ate_ratio_true_masks")

# What can be bounded: meaning, unit, units in the value of 1.
FIGURES = {
    "ate_m": ("ATE RMSE with the detector", " m", 1),
    "ate_ratio": ("ATE RMSE with the detector over that without", "", 1),
    "ate_ratio_empty": ("ATE RMSE over that of the same path with nobody there", "", 1),
    "ate_ratio_true_masks": ("ATE RMSE over that with the true masks", "", 1),
    "eta_percent": ("improvement eta of the ATE RMSE", " %", 1),
    "coverage": ("coverage with the detector", " %", 100),
    "recall": ("recall of the masks", " %", 100),
    "precision": ("precision of the masks", " %", 100),
    "iou": ("IoU of the masks", " %", 100),
    "wrongly_masked": ("share of static pixels masked", " %", 100),
    "detector_median_s": ("median latency of the detector", " ms", 1000),
    "detector_p99_s": ("p99 of the latency of the detector", " ms", 1000),
}


def read_bounds(path):
    """{sequence: {min_FIGURE or max_FIGURE: number}}; InputError if the file is none of that."""
    try:
        with open(path, encoding="utf-8") as file:
            bounds = yaml.safe_load(file) or {}
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f"line {mark.line + 1}: " if mark else ""
        raise InputError(f"{path}: {where}is not YAML; see tests/e2e/regression_bounds.yaml") from error
    if not isinstance(bounds, dict):
        raise InputError(f"{path}: expected a list of bounds under the name of each sequence")
    for name, entry in bounds.items():
        for key, bound in (entry if isinstance(entry, dict) else {"": entry}).items():
            known = str(key)[:4] in ("min_", "max_") and str(key)[4:] in FIGURES
            if not known or isinstance(bound, bool) or not isinstance(bound, (int, float)):
                raise InputError(f"{path}: {name}: found `{key}: {bound}`, expected `min_FIGURE: number` or "
                                 f"`max_FIGURE: number`, FIGURE one of {', '.join(FIGURES)}")
    return bounds


def bounds_of(name, bounds):
    """The bounds of a sequence; a synthetic one's hold for every seed."""
    parts = runs.SYNTHETIC.fullmatch(name)
    any_seed = name.replace(f"_seed{parts['seed']}", "") if parts else name
    return bounds.get(name, bounds.get(any_seed))


def figures_of(result):
    """The values of FIGURES in the result of a sequence; None where not known."""
    without, with_it = result["without"], result["with"]
    ate, masks = with_it["ate"]["rmse"], with_it["masks"] or {}

    def ratio(baseline):
        return ate / baseline if baseline else None
    return {"ate_m": ate, "ate_ratio": ratio(without["ate"]["rmse"]),
            **{name: ratio(result["baseline_ate_m"].get(name)) for name in BASELINE_RATIOS},
            "eta_percent": result["improvement_percent"]["ate"]["rmse"],
            "coverage": with_it["coverage"]["ratio"],
            **{name: masks.get(name) for name in ("recall", "precision", "iou", "wrongly_masked")},
            "detector_median_s": with_it["detector"]["median_s"],
            "detector_p99_s": with_it["detector"]["p99_s"]}


def text_of(figure, value):
    """A value with its unit."""
    _, unit, scale = FIGURES[figure]
    return f"{scale * value:.4g}{unit}"


def broken_bounds(name, figures, bounds):
    """A line for each bound that does not hold."""
    lines = []
    for key, bound in (bounds or {}).items():
        figure, is_max = key[4:], key.startswith("max_")
        value = figures[figure]
        if value is not None and (value <= bound if is_max else value >= bound):
            continue
        found = "was not measured" if value is None else f"is {text_of(figure, value)}"
        limit = f"{'at most' if is_max else 'at least'} {text_of(figure, bound)}"
        lines.append(f"{name}: {FIGURES[figure][0]} {found}, must be {limit}")
    return lines


def measure_baselines(sequence, bounds, output, programs):
    """For each of BASELINE_RATIOS that is bounded and known: the ATE RMSE, m, that it is over."""
    folder, baselines = os.path.join(output, sequence.name), {}
    if sequence.has_true_masks:
        masks = ["--mask-dir", os.path.join(sequence.folder, "mask")]
        baselines["ate_ratio_true_masks"] = (sequence, masks)
    if sequence.recipe is not None:
        empty = runs.locate(f"synthetic_static{sequence.name[sequence.recipe.end('script'):]}", output)
        baselines["ate_ratio_empty"] = (empty, [])
    errors = {}
    for name, (baseline, options) in baselines.items():
        if any(key.endswith(name) for key in bounds or {}):
            if baseline is not sequence:
                runs.make(baseline, programs)
            figures = runs.run_without_detector(baseline, os.path.join(folder, name), programs, options)
            errors[name] = figures["ate"]["rmse"]
    return errors


def measure(sequence, bounds, output, programs):
    """Makes the sequence if need be and runs without and with the detector."""
    runs.make(sequence, programs)
    folder = os.path.join(output, sequence.name)
    runs.say(f"{sequence.name}: tracking without the detector")
    without = runs.run_without_detector(sequence, os.path.join(folder, "without"), programs)
    runs.say(f"{sequence.name}: tracking with the detector")
    with_it, _ = runs.run_with_detector(sequence, os.path.join(folder, "with"), programs)
    return {"without": without, "with": with_it,
            "improvement_percent": compare_runs.compare(without, with_it),
            "baseline_ate_m": measure_baselines(sequence, bounds, output, programs)}


def improvement_tables(results):
    """For each metric a table of all sequences, in the form in which such methods are compared."""
    lines = []
    for metric, (title, unit) in compare_runs.METRICS.items():
        rows = [[f"{title} [{unit}]", *(f"{run} {figure}" for run in ("without", "with")
                                        for figure in ("RMSE", "S.D.")), "eta RMSE [%]", "eta S.D. [%]"]]
        for name, result in results.items():
            errors = [f"{result[run][metric][figure]:.4f}" for run in ("without", "with")
                      for figure in ("rmse", "sd")]
            etas = [result["improvement_percent"][metric][figure] for figure in ("rmse", "sd")]
            rows.append([name, *errors, *("n/a" if eta is None else f"{eta:.2f}" for eta in etas)])
        lines += [*compare_runs.markdown(rows), ""]
    return lines


def detector_table(results):
    """Coverage, masks and latency of all sequences."""
    def cell(value, scale=100, digits=2):
        return "n/a" if value is None else f"{scale * value:.{digits}f}"
    rows = [["Detector", "coverage without [%]", "with [%]", "precision [%]", "recall [%]", "IoU [%]",
             "wrongly masked [%]", "median [ms]", "p99 [ms]", "failed open"]]
    for name, result in results.items():
        figures, detector = figures_of(result), result["with"]["detector"]
        shares = [result["without"]["coverage"]["ratio"],
                  *(figures[key] for key in ("coverage", "precision", "recall", "iou", "wrongly_masked"))]
        latencies = [cell(detector[key], 1000, 1) for key in ("median_s", "p99_s")]
        rows.append([name, *map(cell, shares), *latencies, cell(detector["fail_open"], 1, 0)])
    return compare_runs.markdown(rows)


def parse_arguments():
    parser = command_line.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sequences", nargs="*", metavar="SEQUENCE",
                        help="a folder, a name such as fr3_walking_xyz, or synthetic_SCRIPT_MOTION[_seedN]"
                             "[_FRAMES] (default: all real ones that are there)")
    parser.add_argument("--all", action="store_true", help="also the synthetic walking with other motions")
    parser.add_argument("--situations", action="store_true",
                        help="the special situations instead: someone fills the picture, begins to walk, ...")
    parser.add_argument("--quick", action="store_true",
                        help="under two minutes: 150 frames of walking_xyz, one composite")
    parser.add_argument("--bounds", default=BOUNDS, metavar="FILE",
                        help="the bounds (default: tests/e2e/regression_bounds.yaml)")
    parser.add_argument("--output-dir", metavar="DIR",
                        default=os.path.join(runs.ROOT, "results", "regression"),
                        help="where sequences and runs go (default: results/regression)")
    runs.add_options(parser)
    args = parser.parse_args()
    if args.all + args.quick + args.situations > 1:
        parser.error("--all, --quick and --situations exclude each other")
    return args


def choose(args):
    """Names of the sequences to run, each once."""
    if args.situations:
        return list(dict.fromkeys([*SITUATIONS, *args.sequences]))
    real = runs.COMPOSITES[:1] if args.quick else runs.REAL_SEQUENCES
    others = args.sequences or [name for name in real if runs.find_real(name)]
    motions = OTHER_MOTIONS if args.all else []
    return list(dict.fromkeys([QUICK if args.quick else ALWAYS, *motions, *others]))


def measure_all(sequences, bounds, output, programs):
    """Results by sequence, and a line for each run that failed and each bound that is broken."""
    results, failures = {}, []
    for sequence in sequences:
        limits = bounds_of(sequence.name, bounds)
        try:
            result = measure(sequence, limits, output, programs)
        except runs.RunError as error:
            failures.append(f"{sequence.name}: {error}")
            continue
        results[sequence.name] = {**result, "bounds": limits}
        failures += broken_bounds(sequence.name, figures_of(result), limits)
    return results, failures


def main():
    args = parse_arguments()
    programs = runs.Programs(args.build, args.vocabulary)
    bounds = read_bounds(args.bounds)
    sequences = [runs.locate(name, args.output_dir) for name in choose(args)]
    results, failures = measure_all(sequences, bounds, args.output_dir, programs)
    lines = [*improvement_tables(results), *detector_table(results), ""] if results else []
    unbounded = [name for name, result in results.items() if not result["bounds"]]
    lines += [f"no bounds, only reported: {', '.join(unbounded)}"] if unbounded else []
    lines += [] if failures else ["all figures are within their bounds"]
    command_line.publish({"results": results, "failures": failures}, lines, args.json)
    sys.stdout.flush()
    if failures:
        sys.exit("\n".join(f"FAILED {line}" for line in failures))


if __name__ == "__main__":
    runs.run_main(main)
