#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tells what each switch of the detector of moving objects is worth: turns one at a time, and evaluates.

Switches are the settings DynamicDetector.* that are true or false, as rgbd_tum itself reports them; each run
turns one of them against its default. `--also DynamicDetector.mode=paper` adds a row for another value of any
setting. Prints Markdown tables, switches x sequences: ATE RMSE, coverage, recall and precision of the masks,
share of static pixels masked wrongly. Runs are sequential, and so exactly repeatable.
Exit codes: 0 done, 1 a run failed (its cells say so), 2 bad input.
"""
import argparse
import os
import sys

import command_line
import compare_runs
import regression_runs as runs
from trajectory import InputError

PREFIX = "DynamicDetector."
BASELINE = "default settings"
DEFAULT_SEQUENCES = ["synthetic_walking_xyz", *runs.COMPOSITES, *runs.STATIC_ROOMS]

# Title of a table, and the cell of a run in it.
TABLES = {
    "ATE RMSE [m]": lambda run: f"{run['ate']['rmse']:.4f}",
    "Coverage [%]": lambda run: share(run["coverage"]["ratio"]),
    "Recall [%]": lambda run: share((run["masks"] or {}).get("recall")),
    "Precision [%]": lambda run: share((run["masks"] or {}).get("precision")),
    "Wrongly masked [%]": lambda run: share((run["masks"] or {}).get("wrongly_masked")),
}


def share(value):
    return "n/a" if value is None else f"{100 * value:.2f}"


def switches_of(report):
    """{key: default} of the switches in a run.json; InputError if there are none."""
    switches = {key: value for key, value in report["settings"].items()
                if key.startswith(PREFIX) and isinstance(value, bool)}
    if not switches:
        raise InputError(f"rgbd_tum reports no setting {PREFIX}* that is true or false: nothing to turn off")
    return switches


def changes_of(report, also):
    """[(title, key, text of the value)] of the runs beside the baseline."""
    switches = [(f"{'without' if default else 'with'} {key[len(PREFIX):]}", key, str(int(not default)))
                for key, default in switches_of(report).items()]
    return switches + [(f"{key.removeprefix(PREFIX)}={value}", key, value) for key, value in also]


class Ablation:
    """The runs on one sequence, each in a folder of its own."""

    def __init__(self, sequence, folder, programs, max_frames):
        self.sequence, self.folder, self.programs, self.max_frames = sequence, folder, programs, max_frames
        self.runs, self.failures = {}, []

    def folder_of(self, title):
        return os.path.join(self.folder, title.replace(" ", "_"))

    def run(self, title, settings=None):
        """One run, stored under its title; returns its run.json, None if it failed."""
        runs.say(f"{self.sequence.name}: {title}")
        self.runs[title] = None
        try:
            self.runs[title], report = runs.run_with_detector(self.sequence, self.folder_of(title),
                                                              self.programs, settings, self.max_frames)
        except runs.RunError as error:
            self.failures.append(f"{self.sequence.name}, {title}: {error}")
            return None
        return report

    def run_all(self, also):
        """The baseline, then one run a switch, then one for each (key, value) of also."""
        report = self.run(BASELINE)
        if report is None:
            return
        settings = runs.read_settings(self.folder_of(BASELINE))
        path = os.path.join(self.folder, "settings.yaml")
        for title, key, value in changes_of(report, also):
            command_line.write_lines(path, [runs.with_value(settings, key, value).rstrip("\n")])
            self.run(title, path)


def tables(results):
    """Markdown: a table a figure, with a row a run and a column a sequence."""
    titles = dict.fromkeys(title for of_sequence in results.values() for title in of_sequence)
    lines = []
    for figure, cell in TABLES.items():
        rows = [[figure, *results]]
        for title in titles:
            cells = [of_sequence.get(title) for of_sequence in results.values()]
            rows.append([title, *("failed" if run is None else cell(run) for run in cells)])
        lines += [*compare_runs.markdown(rows), ""]
    return lines[:-1]


def assignment(text):
    """(key, value) of KEY=VALUE, as an argument type."""
    key, equals, value = text.partition("=")
    if not (key and equals and value):
        raise argparse.ArgumentTypeError(f"'{text}' is not KEY=VALUE")
    return key, value


def parse_arguments():
    parser = command_line.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sequences", nargs="+", metavar="SEQUENCE",
                        help="folders, names such as fr3_walking_xyz, or synthetic_SCRIPT_MOTION[_seedN]"
                             "[_FRAMES] (default: synthetic_walking_xyz, composites, static rooms)")
    parser.add_argument("--frames", type=command_line.count, default=0, metavar="N",
                        help="track the first N frames only (default: all)")
    parser.add_argument("--also", nargs="+", type=assignment, default=[], metavar="KEY=VALUE",
                        help="more rows: another value of a setting, such as DynamicDetector.mode=paper")
    parser.add_argument("--output-dir", metavar="DIR", default=os.path.join(runs.ROOT, "results", "ablation"),
                        help="where sequences and runs go (default: results/ablation)")
    runs.add_options(parser)
    return parser.parse_args()


def main():
    args = parse_arguments()
    programs = runs.Programs(args.build, args.vocabulary)
    names = args.sequences or [name for name in DEFAULT_SEQUENCES
                               if name not in runs.REAL_SEQUENCES or runs.find_real(name)]
    sequences = [runs.locate(name, args.output_dir) for name in dict.fromkeys(names)]
    results, failures = {}, []
    for sequence in sequences:
        try:
            runs.make(sequence, programs)
        except runs.RunError as error:
            failures.append(f"{sequence.name}: {error}")
            continue
        ablation = Ablation(sequence, os.path.join(args.output_dir, sequence.name), programs, args.frames)
        ablation.run_all(args.also)
        results[sequence.name] = ablation.runs
        failures += ablation.failures
    command_line.publish({"results": results, "failures": failures}, tables(results), args.json)
    sys.stdout.flush()
    if failures:
        sys.exit("\n".join(f"FAILED {line}" for line in failures))


if __name__ == "__main__":
    runs.run_main(main)
