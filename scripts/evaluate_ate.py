#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Absolute trajectory error (ATE) of an estimate: distances to the ground truth after alignment.

Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012. Prints the RMSE in
metres, or all figures with --verbose; they are those of the TUM RGB-D benchmark's tool.
"""
from dataclasses import dataclass

import numpy as np

import command_line
from trajectory import InputError, Similarity, align, associate, read_trajectory, statistics


@dataclass
class Ate:
    """An alignment and what it leaves."""
    matches: np.ndarray          # (n, 2), indices into ground truth and estimate
    alignment: Similarity        # groundtruth_from_estimate
    errors: np.ndarray           # (n,), m
    aligned_positions: np.ndarray  # (all poses of the estimate, 3), m, in the ground truth's frame


def evaluate(groundtruth, estimate, max_difference=0.02, offset=0.0, scale=1.0, align_scale=False):
    """Aligns the estimate, scaled, to the ground truth; InputError if under two poses match."""
    matches = np.array(associate(groundtruth.stamps, estimate.stamps + offset, max_difference))
    if len(matches) < 2:
        raise InputError(
            f"{estimate.path}: {len(matches)} pose(s) within {max_difference} s of {groundtruth.path}; "
            f"stamps {estimate.stamp_texts[0]}..{estimate.stamp_texts[-1]} against "
            f"{groundtruth.stamp_texts[0]}..{groundtruth.stamp_texts[-1]}: check the files and --offset")
    source = scale * estimate.positions
    target = groundtruth.positions[matches[:, 0]]
    alignment = align(source[matches[:, 1]], target, align_scale)
    aligned = alignment.apply(source)
    errors = np.linalg.norm(aligned[matches[:, 1]] - target, axis=1)
    return Ate(matches, alignment, errors, aligned)


def quaternion_of(rotation):
    """Unit quaternion (x, y, z, w), w >= 0, of a rotation matrix: eigenvector of Bar-Itzhack's matrix."""
    r = rotation
    k = np.array([[r[0, 0] - r[1, 1] - r[2, 2], 0, 0, 0],
                  [r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], 0, 0],
                  [r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1], 0],
                  [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], np.trace(r)]])
    quaternion = np.linalg.eigh(k, UPLO="L")[1][:, -1]
    return quaternion if quaternion[3] >= 0 else -quaternion


def aligned_lines(estimate, ate):
    """The aligned estimate as lines of a trajectory file."""
    poses = zip(estimate.stamp_texts, ate.aligned_positions, ate.alignment.rotation @ estimate.rotations)
    return [text + "".join(f" {value:.6f}" for value in (*position, *quaternion_of(rotation)))
            for text, position, rotation in poses]


def association_lines(groundtruth, estimate, ate):
    """Matched stamps and positions: `t x y z` of the ground truth, then of the aligned estimate."""
    def fields(trajectory, positions, index):
        return trajectory.stamp_texts[index] + "".join(f" {value:.6f}" for value in positions[index])
    return [f"{fields(groundtruth, groundtruth.positions, i)} {fields(estimate, ate.aligned_positions, j)}"
            for i, j in ate.matches]


def with_gaps(stamps, points):
    """Points with a row of NaN wherever the stamps pause, so that no line is drawn across."""
    steps = np.diff(stamps)
    pauses = np.flatnonzero(steps > 3 * np.median(steps)) + 1
    return np.insert(points, pauses, np.nan, axis=0)


def plot(path, groundtruth, estimate, ate):
    """Draws both trajectories and their differences on the plane in which the ground truth moves most."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    from matplotlib.collections import LineCollection

    plane = sorted(np.argsort(np.ptp(groundtruth.positions, axis=0))[1:])
    true = with_gaps(groundtruth.stamps, groundtruth.positions)[:, plane]
    estimated = with_gaps(estimate.stamps, ate.aligned_positions)[:, plane]
    ends = np.stack([groundtruth.positions[ate.matches[:, 0]], ate.aligned_positions[ate.matches[:, 1]]], 1)
    figure, axes = pyplot.subplots(figsize=(7, 6), constrained_layout=True)
    axes.add_collection(LineCollection(ends[:, :, plane], color="#d62728", linewidth=0.6, alpha=0.6,
                                       label="difference", zorder=1))
    axes.plot(*true.T, color="black", linewidth=1.4, label="ground truth", zorder=2)
    axes.plot(*estimated.T, color="#1f77b4", linewidth=1.2, label="estimate, aligned", zorder=3)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(f"{'xyz'[plane[0]]} [m]")
    axes.set_ylabel(f"{'xyz'[plane[1]]} [m]")
    axes.set_title(f"ATE RMSE {statistics(ate.errors)['rmse']:.4f} m, {len(ate.errors)} pairs")
    axes.grid(color="0.9")
    axes.legend(loc="best", framealpha=0.9)
    figure.savefig(path, dpi=150)
    pyplot.close(figure)


def summarize(ate, share):
    """The figures as a dictionary; lengths in metres."""
    alignment = {"scale": ate.alignment.scale, "rotation": ate.alignment.rotation.tolist(),
                 "translation": ate.alignment.translation.tolist()}
    result = {"unit": "m", "pairs": len(ate.errors), **statistics(ate.errors), "alignment": alignment}
    return {**result, "coverage": share} if share else result


def report_lines(ate, share, args):
    """What is printed."""
    errors = statistics(ate.errors)
    if not args.verbose:
        return [f"{errors['rmse']:.6f}"]
    scale = [f"alignment.scale {ate.alignment.scale:.6f}"] if args.align_scale else []
    return [f"compared_pose_pairs {len(ate.errors)} pairs",
            *command_line.error_lines("absolute_translational_error", errors, "m"),
            *scale, *command_line.coverage_lines(share)]


def parse_arguments():
    parser = command_line.Parser(description=__doc__)
    command_line.add_evaluation_options(parser)
    parser.add_argument("--max_difference", type=command_line.positive, default=0.02,
                        help="matched stamps differ by less than this, s (default: %(default)s)")
    parser.add_argument("--align-scale", action="store_true",
                        help="align by a similarity (Sim(3)) and not by a rigid motion")
    parser.add_argument("--save_associations", metavar="FILE",
                        help="write matched stamps and positions, those of the estimate aligned")
    return parser.parse_args()


def main():
    args = parse_arguments()
    groundtruth, estimate = read_trajectory(args.groundtruth), read_trajectory(args.estimate)
    share = command_line.coverage(len(estimate), args.frames)
    ate = evaluate(groundtruth, estimate, args.max_difference, args.offset, args.scale, args.align_scale)
    if args.save:
        command_line.write_lines(args.save, aligned_lines(estimate, ate))
    if args.save_associations:
        command_line.write_lines(args.save_associations, association_lines(groundtruth, estimate, ate))
    if args.plot:
        plot(args.plot, groundtruth, estimate, ate)
    command_line.publish(summarize(ate, share), report_lines(ate, share, args), args.json)


if __name__ == "__main__":
    command_line.run(main)
