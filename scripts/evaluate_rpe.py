#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Relative pose error (RPE) of an estimate: the drift between pairs of poses.

Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012, with the error of the
TUM RGB-D benchmark's tool: E = (Q_j^-1 Q_i)^-1 (P_j^-1 P_i), Q the estimate, P the ground truth.
`--fixed_delta --delta 1 --delta_unit s` gives the drift per second that papers print. Prints the mean
translational error in metres as that tool does, or all figures with --verbose.
"""
from dataclasses import dataclass

import numpy as np

import command_line
from trajectory import InputError, nearest, read_trajectory, rotation_angles, statistics

PAIRS_AT_ONCE = 100_000  # bounds the memory for the matrices of all pairs
UNITS = ("s", "m", "rad", "deg", "f")


@dataclass
class RpeOptions:
    """Which pairs of poses are compared."""
    fixed_delta: bool = False  # pairs delta apart; otherwise any pairs
    delta: float = 1.0         # in delta_unit
    delta_unit: str = "s"      # along the estimate: s, m, rad, deg, or f: frames
    max_pairs: int = 10000     # more are sampled at random; 0: no limit
    offset: float = 0.0        # s, added to the estimate's stamps
    scale: float = 1.0         # factor on the estimate's translations
    seed: int = 0              # of the sampling


@dataclass
class Rpe:
    """Errors of the pairs."""
    pairs: np.ndarray                 # (n, 2), indices of poses of the estimate
    groundtruth_pairs: np.ndarray     # (n, 2), indices of the ground truth's poses nearest to them
    translational_errors: np.ndarray  # (n,), m
    rotational_errors: np.ndarray     # (n,), rad


def relative_motions(trajectory, pairs):
    """P_j^-1 P_i of each pair (i, j): rotations (n, 3, 3), translations (n, 3) in the frame of j."""
    i, j = pairs.T
    j_from_world = np.swapaxes(trajectory.rotations[j], 1, 2)
    steps = trajectory.positions[i] - trajectory.positions[j]
    return j_from_world @ trajectory.rotations[i], np.einsum("nij,nj->ni", j_from_world, steps)


def positions_along(trajectory, unit):
    """Where each pose lies along the trajectory, (n,), in the unit."""
    if unit == "s":
        return trajectory.stamps
    if unit == "f":
        return np.arange(len(trajectory), dtype=float)
    indices = np.arange(len(trajectory))
    rotations, steps = relative_motions(trajectory, np.stack([indices[:-1], indices[1:]], axis=1))
    lengths = np.linalg.norm(steps, axis=1) if unit == "m" else rotation_angles(rotations)
    along = np.concatenate([[0.0], np.cumsum(lengths)])
    return np.degrees(along) if unit == "deg" else along


def choose_pairs(estimate, options):
    """Pairs (i, j) of poses of the estimate, (n, 2)."""
    count, random = len(estimate), np.random.default_rng(options.seed)
    if options.fixed_delta:
        along = positions_along(estimate, options.delta_unit)
        pairs = np.stack([np.arange(count), nearest(along, along + options.delta)], axis=1)
        pairs = pairs[pairs[:, 1] != count - 1]
        if options.max_pairs and len(pairs) > options.max_pairs:
            pairs = pairs[np.sort(random.choice(len(pairs), options.max_pairs, replace=False))]
        return pairs
    if options.max_pairs and count * count > options.max_pairs:
        return random.integers(0, count, (options.max_pairs, 2))
    return np.stack(np.divmod(np.arange(count * count), count), axis=1)


def pair_errors(groundtruth, estimate, rpe_pairs, groundtruth_pairs, scale):
    """Translational (m) and rotational (rad) part of E of each pair."""
    est_rotations, est_steps = relative_motions(estimate, rpe_pairs)
    true_rotations, true_steps = relative_motions(groundtruth, groundtruth_pairs)
    # E = A^-1 B has the translation R_A^T (t_B - t_A), whose length does not depend on R_A.
    return (np.linalg.norm(true_steps - scale * est_steps, axis=1),
            rotation_angles(np.swapaxes(est_rotations, 1, 2) @ true_rotations))


def evaluate(groundtruth, estimate, options=RpeOptions()):
    """Compares pairs of poses of the estimate with the ground truth nearest in time."""
    for trajectory in (groundtruth, estimate):
        if len(trajectory) < 2:
            raise InputError(f"{trajectory.path}: a single pose; drift takes at least two")
    stamps = estimate.stamps + options.offset
    true = nearest(groundtruth.stamps, stamps)
    max_gap = 2 * np.median(np.diff(groundtruth.stamps))
    usable = np.abs(groundtruth.stamps[true] - stamps) <= max_gap
    pairs = choose_pairs(estimate, options)
    pairs = pairs[usable[pairs].all(axis=1)]
    if not len(pairs):
        raise InputError(f"{estimate.path}: no pair of poses has ground truth in {groundtruth.path}; "
                         f"check the files, --offset and --delta")
    chunks = np.array_split(pairs, len(pairs) // PAIRS_AT_ONCE + 1)
    errors = [pair_errors(groundtruth, estimate, chunk, true[chunk], options.scale) for chunk in chunks]
    return Rpe(pairs, true[pairs], *map(np.concatenate, zip(*errors)))


def saved_lines(groundtruth, estimate, rpe):
    """`t_i t_j` of the estimate, `t_i t_j` of the ground truth, error in m, error in rad."""
    errors = zip(rpe.pairs, rpe.groundtruth_pairs, rpe.translational_errors, rpe.rotational_errors)
    return [" ".join([*(estimate.stamp_texts[k] for k in pair), *(groundtruth.stamp_texts[k] for k in true),
                      f"{translational:.6f}", f"{rotational:.6f}"])
            for pair, true, translational, rotational in errors]


def plot(path, estimate, rpe):
    """Draws both errors over the time of the first pose of each pair."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    order = np.argsort(rpe.pairs[:, 0], kind="stable")
    times = (estimate.stamps - estimate.stamps[0])[rpe.pairs[order, 0]]
    figure, panels = pyplot.subplots(2, 1, sharex=True, figsize=(8, 5), constrained_layout=True)
    series = [("translational error", "m", rpe.translational_errors, "#1f77b4"),
              ("rotational error", "deg", np.degrees(rpe.rotational_errors), "#d62728")]
    for axes, (name, unit, errors, color) in zip(panels, series):
        rmse = statistics(errors)["rmse"]
        axes.plot(times, errors[order], ".", markersize=3, color=color, label=name)
        axes.axhline(rmse, color="black", linewidth=1, linestyle="--", label=f"RMSE {rmse:.4f} {unit}")
        axes.set_ylabel(f"{name} [{unit}]")
        axes.set_ylim(bottom=0)
        axes.grid(color="0.9")
        axes.legend(loc="upper right")
    panels[1].set_xlabel("time [s]")
    figure.savefig(path, dpi=150)
    pyplot.close(figure)


def summarize(rpe, share=None):
    """The figures as a dictionary."""
    result = {"pairs": len(rpe.pairs),
              "translational_error": {"unit": "m", **statistics(rpe.translational_errors)},
              "rotational_error": {"unit": "deg", **statistics(np.degrees(rpe.rotational_errors))}}
    return {**result, "coverage": share} if share else result


def report_lines(rpe, share, verbose):
    """What is printed."""
    translational = statistics(rpe.translational_errors)
    rotational = statistics(np.degrees(rpe.rotational_errors))
    if not verbose:
        return [f"{translational['mean']:.6f}"]
    return [f"compared_pose_pairs {len(rpe.pairs)} pairs",
            *command_line.error_lines("translational_error", translational, "m"),
            *command_line.error_lines("rotational_error", rotational, "deg"),
            *command_line.coverage_lines(share)]


def parse_arguments():
    parser = command_line.Parser(description=__doc__)
    command_line.add_evaluation_options(parser)
    parser.add_argument("--max_pairs", type=command_line.count, default=10000,
                        help="sample this many pairs if there are more; 0: take all (default: %(default)s)")
    parser.add_argument("--fixed_delta", action="store_true", help="compare only poses delta apart")
    parser.add_argument("--delta", type=command_line.positive, default=1.0,
                        help="distance of the poses of a pair (default: %(default)s)")
    parser.add_argument("--delta_unit", choices=UNITS, default="s",
                        help="seconds, metres, radians, degrees or frames (default: %(default)s)")
    parser.add_argument("--seed", type=command_line.count, default=0,
                        help="of the random choice of pairs (default: %(default)s)")
    return parser.parse_args()


def main():
    args = parse_arguments()
    groundtruth, estimate = read_trajectory(args.groundtruth), read_trajectory(args.estimate)
    share = command_line.coverage(len(estimate), args.frames)
    rpe = evaluate(groundtruth, estimate, RpeOptions(args.fixed_delta, args.delta, args.delta_unit,
                                                     args.max_pairs, args.offset, args.scale, args.seed))
    if args.save:
        command_line.write_lines(args.save, saved_lines(groundtruth, estimate, rpe))
    if args.plot:
        plot(args.plot, estimate, rpe)
    command_line.publish(summarize(rpe, share), report_lines(rpe, share, args.verbose), args.json)


if __name__ == "__main__":
    command_line.run(main)
