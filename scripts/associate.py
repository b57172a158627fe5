#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Matches the lines of two files by their time stamps and prints `timestamp1 data1 timestamp2 data2`.

The closest pair is matched first, and every line at most once, as the TUM RGB-D benchmark's tool does:
`associate.py rgb.txt depth.txt` makes the associations.txt of a sequence.
"""
import numpy as np

from command_line import Parser, number, positive, run, write_lines
from trajectory import InputError, associate, read_stamped


def parse_data(fields):
    """The data of a line as text; ValueError if there is none."""
    if not fields:
        raise ValueError("no data")
    return " ".join(fields)


def parse_arguments():
    parser = Parser(description=__doc__)
    parser.add_argument("first", metavar="FILE1", help="lines `timestamp data`")
    parser.add_argument("second", metavar="FILE2", help="lines `timestamp data`")
    parser.add_argument("--max_difference", type=positive, default=0.02,
                        help="pairs differ by less than this, s (default: %(default)s)")
    parser.add_argument("--offset", type=number, default=0.0,
                        help="seconds added to the second file's time stamps (default: %(default)s)")
    parser.add_argument("--first_only", action="store_true", help="print the first file's lines only")
    parser.add_argument("--output", metavar="FILE", help="write there and not to standard output")
    return parser.parse_args()


def main():
    args = parse_arguments()
    first = read_stamped(args.first, parse_data, "timestamp data")
    second = read_stamped(args.second, parse_data, "timestamp data")
    matches = associate(np.array([stamp for stamp, _, _ in first]),
                        np.array([stamp for stamp, _, _ in second]) + args.offset, args.max_difference)
    if not matches:
        raise InputError(f"{args.first} and {args.second}: no time stamps closer than "
                         f"{args.max_difference} s; check the files, --offset and --max_difference")
    rows = [[first[i]] if args.first_only else [first[i], second[j]] for i, j in matches]
    write_lines(args.output, [" ".join(f"{text} {data}" for _, text, data in row) for row in rows])


if __name__ == "__main__":
    run(main)
