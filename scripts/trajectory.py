# SPDX-License-Identifier: GPL-3.0-or-later
"""Trajectories in the TUM RGB-D format: reading, matching in time, alignment, statistics.

A trajectory file has one pose a line, `timestamp tx ty tz qx qy qz qw`: world_from_camera, seconds,
metres, quaternion. Lines that start with '#' are comments; commas and tabs count as blanks.
"""
import heapq
import math
import sys
from dataclasses import dataclass

import numpy as np

POSE_FORMAT = "timestamp tx ty tz qx qy qz qw"


class InputError(Exception):
    """What is wrong with the user's input and what to do about it, in one line."""


@dataclass
class Trajectory:
    """Poses world_from_camera in the order of their stamps, which are unique."""
    path: str
    stamp_texts: list       # n stamps as the file writes them
    stamps: np.ndarray      # (n,), s
    positions: np.ndarray   # (n, 3), m
    rotations: np.ndarray   # (n, 3, 3)

    def __len__(self):
        return len(self.stamps)


@dataclass
class Similarity:
    """target_from_source: x -> scale * rotation * x + translation."""
    scale: float
    rotation: np.ndarray     # (3, 3)
    translation: np.ndarray  # (3,), m

    def apply(self, points):
        """Maps points, (n, 3), from source to target."""
        return self.scale * points @ self.rotation.T + self.translation


def read_rows(path):
    """Returns (line number, fields) of every line that is neither blank nor a comment."""
    try:
        with open(path, encoding="utf-8-sig", errors="replace") as file:
            lines = file.read().split("\n")
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the path") from error
    rows = ((number, line.replace(",", " ").split()) for number, line in enumerate(lines, 1))
    return [(number, row) for number, row in rows if row and not row[0].startswith("#")]


def finite_floats(fields):
    """Numbers of the fields; ValueError if one is none or is not finite."""
    values = [float(field) for field in fields]
    if not all(map(math.isfinite, values)):
        raise ValueError("not finite")
    return values


def read_stamped(path, parse, expected):
    """Returns [(stamp, stamp text, parse(other fields))] by increasing, unique stamp.

    Lines that do not parse are left out with a warning; of equal stamps the last one counts.
    """
    entries, bad_lines, repeated = {}, [], 0
    for number, (text, *fields) in read_rows(path):
        try:
            stamp, value = finite_floats([text])[0], parse(fields)
        except ValueError:
            bad_lines.append(number)
            continue
        repeated += stamp in entries
        entries[stamp] = (stamp, text, value)
    skipped = f"{len(bad_lines)} malformed line(s), first at line {bad_lines[0]}" if bad_lines else ""
    if not entries:
        raise InputError(f"{path}: no usable line ({skipped or 'the file is empty'}); "
                         f"expected lines `{expected}`")
    if skipped:
        print(f"warning: {path}: skipped {skipped}; expected `{expected}`", file=sys.stderr)
    if repeated:
        print(f"warning: {path}: {repeated} repeated time stamp(s); the last line of each counts",
              file=sys.stderr)
    return [entries[stamp] for stamp in sorted(entries)]


def parse_pose(fields):
    """(tx, ty, tz, qx, qy, qz, qw) with the quaternion normalised; ValueError if there is none."""
    if len(fields) != 7:
        raise ValueError("wrong number of fields")
    pose = np.array(finite_floats(fields))
    norm = np.linalg.norm(pose[3:])
    if not 1e-6 < norm < 1e6:
        raise ValueError("not a rotation")
    pose[3:] /= norm
    return pose


def read_trajectory(path):
    """Reads a trajectory file; InputError if it holds no pose."""
    stamps, texts, poses = zip(*read_stamped(path, parse_pose, POSE_FORMAT))
    poses = np.array(poses)
    return Trajectory(path, list(texts), np.array(stamps), poses[:, :3], rotations_of(poses[:, 3:]))


def rotations_of(quaternions):
    """Rotation matrices, (n, 3, 3), of unit quaternions (x, y, z, w), (n, 4)."""
    x, y, z, w = quaternions.T
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), 2, 0)


def rotation_angles(rotations):
    """Angles, (n,), rad, of rotation matrices (n, 3, 3); precise also close to 0."""
    r = rotations
    axis = np.stack([r[:, 2, 1] - r[:, 1, 2], r[:, 0, 2] - r[:, 2, 0], r[:, 1, 0] - r[:, 0, 1]], 1)
    return np.arctan2(np.linalg.norm(axis, axis=1), np.trace(r, axis1=1, axis2=2) - 1)


def nearest(sorted_values, queries):
    """Index of the value nearest to each query; the lower one of two equally near."""
    after = np.clip(np.searchsorted(sorted_values, queries), 1, max(len(sorted_values) - 1, 1))
    before = after - 1
    after = np.minimum(after, len(sorted_values) - 1)
    closer_after = np.abs(sorted_values[after] - queries) < np.abs(sorted_values[before] - queries)
    return np.where(closer_after, after, before)


def associate(first, second, max_difference):
    """Greedy one-to-one matching of two increasing lists of stamps, the closest pair first.

    Returns index pairs (i, j), by i, with |first[i] - second[j]| < max_difference. The closest of the
    pairs that are left is always a pair of neighbours on the common time line, so that a heap of
    neighbours replaces the list of all pairs: O((n + m) log(n + m)).
    """
    count = len(first) + len(second)
    stamps = np.concatenate([first, second])
    order = np.argsort(stamps, kind="stable")
    before, after = list(range(-1, count - 1)), list(range(1, count + 1))
    alive, heap, matches = [True] * count, [], []

    def offer(left, right):
        if left < 0 or right >= count:
            return
        i, j = sorted((int(order[left]), int(order[right])))
        difference = abs(stamps[i] - stamps[j])
        if i < len(first) <= j and difference < max_difference:
            heapq.heappush(heap, (difference, i, j, left, right))

    for left in range(count - 1):
        offer(left, left + 1)
    while heap:
        _, i, j, left, right = heapq.heappop(heap)
        if not (alive[left] and alive[right]):
            continue
        alive[left] = alive[right] = False
        matches.append((i, j - len(first)))
        outer_left, outer_right = before[left], after[right]
        if outer_left >= 0:
            after[outer_left] = outer_right
        if outer_right < count:
            before[outer_right] = outer_left
        offer(outer_left, outer_right)
    return sorted(matches)


def align(source, target, with_scale=False):
    """Least-squares target_from_source of paired points, (n, 3); scale 1 unless with_scale.

    Umeyama, "Least-squares estimation of transformation parameters between two point patterns",
    PAMI 1991, eq. 40-43.
    """
    source_mean, target_mean = source.mean(axis=0), target.mean(axis=0)
    source_zero, target_zero = source - source_mean, target - target_mean
    u, singular, vt = np.linalg.svd(target_zero.T @ source_zero)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(u) * np.linalg.det(vt))])
    rotation = (u * signs) @ vt
    scale = 1.0
    if with_scale:
        spread = np.sum(source_zero ** 2)
        if spread < 1e-12:
            raise InputError("the estimate does not move: its scale cannot be found; "
                             "leave --align-scale out")
        scale = float(singular @ signs / spread)
    return Similarity(scale, rotation, target_mean - scale * rotation @ source_mean)


def statistics(errors):
    """The benchmark's figures of a list of errors; std is that of the population."""
    return {"rmse": float(np.sqrt(np.mean(errors ** 2))), "mean": float(np.mean(errors)),
            "median": float(np.median(errors)), "std": float(np.std(errors)),
            "min": float(np.min(errors)), "max": float(np.max(errors))}
