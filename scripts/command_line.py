# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts' command lines share: options, one-line errors with exit code 2, output."""
import argparse
import json
import math
import os
import signal
import sys

from trajectory import InputError, read_rows

PLOT_FORMATS = (".png", ".pdf", ".svg")


class Parser(argparse.ArgumentParser):
    """An ArgumentParser that refuses a command line in one line."""

    def error(self, message):
        self.exit(2, f"{self.prog}: error: {message}; see {self.prog} --help\n")


def number(text):
    """A finite number, as an argument type."""
    value = float(text)
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"'{text}' is not a finite number")
    return value


def positive(text):
    """A number above zero, as an argument type."""
    value = number(text)
    if value <= 0:
        raise argparse.ArgumentTypeError(f"'{text}' is not above zero")
    return value


def count(text):
    """A whole number, zero or more, as an argument type."""
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number, zero or more")
    return int(text)


def plot_file(text):
    """The name of a figure in a format that can be written, as an argument type."""
    if not text.lower().endswith(PLOT_FORMATS):
        raise argparse.ArgumentTypeError(f"'{text}' must end in one of {' '.join(PLOT_FORMATS)}")
    return text


def run(main):
    """Runs main(); bad input, unreadable and unwritable files are one line and exit code 2."""
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    program = os.path.basename(sys.argv[0])
    try:
        main()
    except InputError as error:
        sys.exit(fail(program, error))
    except OSError as error:
        sys.exit(fail(program, f"{error.filename}: {error.strerror}; check the path"))


def fail(program, message):
    """Says what is wrong; returns the exit code of bad input."""
    print(f"{program}: error: {message}", file=sys.stderr)
    return 2


def add_evaluation_options(parser):
    """The arguments that evaluations of an estimate against ground truth have in common."""
    parser.add_argument("groundtruth", help="trajectory file: timestamp tx ty tz qx qy qz qw")
    parser.add_argument("estimate", help="trajectory file of the same format")
    parser.add_argument("--offset", type=number, default=0.0,
                        help="seconds added to the estimate's time stamps (default: %(default)s)")
    parser.add_argument("--scale", type=positive, default=1.0,
                        help="factor on the estimate's translations (default: %(default)s)")
    parser.add_argument("--save", metavar="FILE", help="write what was evaluated, as text")
    parser.add_argument("--plot", metavar="FILE", type=plot_file, help="write a PNG, PDF or SVG figure")
    parser.add_argument("--verbose", action="store_true", help="print all figures, not only one")
    add_report_options(parser)


def add_report_options(parser):
    """--json and --frames."""
    parser.add_argument("--json", metavar="FILE", help="write the figures as JSON; - is standard output")
    parser.add_argument("--frames", metavar="N|FILE",
                        help="frames of the sequence, or its associations.txt: report the coverage")


def coverage(pose_count, frames):
    """Share of the frames that have a pose; None if the user did not name the frames."""
    if frames is None:
        return None
    frame_count = int(frames) if frames.isdecimal() else len(read_rows(frames))
    if frame_count == 0:
        raise InputError(f"--frames {frames}: holds no frame; give a number above zero or associations.txt")
    return {"poses": pose_count, "frames": frame_count, "ratio": pose_count / frame_count}


def error_lines(name, errors, unit):
    """Lines `name.rmse 0.012345 m`, one a figure, as the benchmark's tools print them."""
    return [f"{name}.{figure} {value:.6f} {unit}" for figure, value in errors.items()]


def coverage_lines(share):
    """The line that reports a coverage, if there is one."""
    return [f"coverage {share['ratio']:.6f} ({share['poses']} of {share['frames']} frames)"] if share else []


def write_lines(path, lines):
    """Writes lines to a file, or to standard output if path is - or None."""
    text = "".join(f"{line}\n" for line in lines)
    if path in (None, "-"):
        sys.stdout.write(text)
        return
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def publish(result, lines, json_path):
    """Prints the lines and writes the JSON; JSON on standard output stands there alone."""
    if json_path:
        write_lines(json_path, [json.dumps(result, indent=2)])
    if json_path != "-":
        write_lines(None, lines)
