#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of the shared module: alignment, matching, rotations, reading."""
import contextlib
import io
import unittest

import numpy as np

from support import START, ScriptTest, random_rotation
from evaluate_ate import quaternion_of
from trajectory import (InputError, align, associate, nearest, read_trajectory, rotation_angles,
                        rotations_of, statistics)

POSE = "0.1 0.2 0.3 0 0 0 1"


def brute_force(first, second, max_difference):
    """Every pair sorted by difference, taken greedily."""
    pairs = sorted((abs(a - b), i, j) for i, a in enumerate(first) for j, b in enumerate(second)
                   if abs(a - b) < max_difference)
    taken_first, taken_second, matches = set(), set(), []
    for _, i, j in pairs:
        if i not in taken_first and j not in taken_second:
            taken_first.add(i)
            taken_second.add(j)
            matches.append((i, j))
    return sorted(matches)


class AssociateTest(ScriptTest):
    def test_equals_the_greedy_choice_among_all_pairs(self):
        for max_difference in (0.005, 0.02, 0.5, 100.0):
            for _ in range(20):
                first = np.sort(START + self.random.uniform(0, 2, size=self.random.integers(0, 60)))
                second = np.sort(START + self.random.uniform(0, 2, size=self.random.integers(0, 60)))
                self.assertEqual(associate(first, second, max_difference),
                                 brute_force(first, second, max_difference))

    def test_equally_close_pairs_are_taken_earliest_first(self):
        for _ in range(50):
            first = np.flatnonzero(self.random.random(30) < 0.5).astype(float)
            second = np.flatnonzero(self.random.random(30) < 0.5).astype(float)
            self.assertEqual(associate(first, second, 3.0), brute_force(first, second, 3.0))

    def test_a_difference_equal_to_the_limit_is_too_large(self):
        self.assertEqual(associate(np.array([0.0]), np.array([0.5]), 0.5), [])

    def test_long_lists_with_a_wide_limit_take_no_table_of_all_pairs(self):
        stamps = np.arange(20000.0)
        self.assertEqual(associate(stamps, stamps + 0.25, 1e9), [(i, i) for i in range(20000)])


class AlignTest(ScriptTest):
    def test_recovers_a_similarity(self):
        points = self.random.normal(size=(50, 3))
        for scale in (0.1, 1.0, 7.0):
            rotation, translation = random_rotation(self.random), self.random.normal(size=3)
            found = align(points, scale * points @ rotation.T + translation, with_scale=True)
            self.assertAlmostEqual(found.scale, scale, places=10)
            np.testing.assert_allclose(found.rotation, rotation, atol=1e-10)
            np.testing.assert_allclose(found.translation, translation, atol=1e-10)

    def test_never_mirrors(self):
        points = self.random.normal(size=(50, 3))
        for shape in ([1, 1, 1], [1, 1, 0], [1, 0, 0], [0, 0, 0]):
            found = align(points * shape, points * shape * [-1, 1, 1])
            self.assertAlmostEqual(np.linalg.det(found.rotation), 1.0, places=10)

    def test_no_small_motion_improves_on_it(self):
        source, target = self.random.normal(size=(2, 40, 3))
        best = align(source, target)
        def cost(points):
            return np.sum((points - target) ** 2)
        for _ in range(20):
            quaternion = np.append(self.random.normal(scale=1e-3, size=3), 1.0)
            twist = rotations_of(quaternion[None] / np.linalg.norm(quaternion))[0]
            self.assertGreaterEqual(cost(best.apply(source) @ twist.T), cost(best.apply(source)))

    def test_scale_of_a_camera_at_rest_is_refused(self):
        with self.assertRaises(InputError):
            align(np.zeros((5, 3)), self.random.normal(size=(5, 3)), with_scale=True)


class RotationTest(ScriptTest):
    def test_quaternion_and_matrix_are_inverse(self):
        for _ in range(50):
            rotation = random_rotation(self.random)
            np.testing.assert_allclose(rotations_of(quaternion_of(rotation)[None])[0], rotation, atol=1e-12)

    def test_angle_is_that_of_the_axis_angle_vector(self):
        for angle in (0.0, 1e-9, 1e-4, 1.0, 3.0, np.pi):
            axis = self.random.normal(size=3)
            axis *= np.sin(angle / 2) / np.linalg.norm(axis)
            rotation = rotations_of(np.array([[*axis, np.cos(angle / 2)]]))
            self.assertAlmostEqual(rotation_angles(rotation)[0], angle, delta=1e-12)


class SmallFunctionsTest(ScriptTest):
    def test_nearest_equals_the_smallest_distance(self):
        for count in (1, 2, 50):
            values = np.sort(self.random.uniform(size=count))
            queries = self.random.uniform(-0.2, 1.2, size=100)
            expected = np.argmin(np.abs(values[None] - queries[:, None]), axis=1)
            np.testing.assert_array_equal(nearest(values, queries), expected)

    def test_rmse_is_mean_and_deviation_together(self):
        figures = statistics(self.random.uniform(size=99))
        self.assertAlmostEqual(figures["rmse"] ** 2, figures["mean"] ** 2 + figures["std"] ** 2)


class ReadTrajectoryTest(ScriptTest):
    def read(self, text):
        """The trajectory in a text, and the warnings."""
        with contextlib.redirect_stderr(io.StringIO()) as warnings:
            return read_trajectory(self.write("poses.txt", text)), warnings.getvalue()

    def test_separators_line_ends_comments_and_blank_lines_do_not_matter(self):
        plain = f"1.0 {POSE}\n2.0 {POSE}\n"
        expected, _ = self.read(plain)
        for text in (plain.replace("\n", "\r\n"), plain.replace(" ", ","), plain.replace(" ", ", "),
                     plain.replace(" ", "\t"), plain.replace("\n", "\n\n  \n"), "\ufeff" + plain,
                     "# header\n  # more, of it\n" + plain, plain.rstrip("\n")):
            with self.subTest(text=text):
                found, warnings = self.read(text)
                self.assertEqual(found.stamp_texts, expected.stamp_texts)
                np.testing.assert_array_equal(found.positions, expected.positions)
                self.assertEqual(warnings, "")

    def test_order_is_that_of_time(self):
        found, _ = self.read(f"3 {POSE}\n1 {POSE}\n2 {POSE}\n")
        self.assertEqual(found.stamp_texts, ["1", "2", "3"])

    def test_quaternions_are_normalised(self):
        found, _ = self.read("1 0 0 0 0 0 0.2 0.2\n")
        self.assertAlmostEqual(np.linalg.det(found.rotations[0]), 1.0)

    def test_malformed_lines_are_counted_and_the_first_is_named(self):
        for bad in ("nan 1 2 3 0 0 0 1", "2 nan 2 3 0 0 0 1", "2 1 2 3 0 0 0 inf", "2 1 2 3 0 0 0 0",
                    "2 1 2 3", "2 1 2 3 0 0 0 1 9", "two 1 2 3 0 0 0 1", "2", "\x00\x01"):
            with self.subTest(line=bad):
                found, warnings = self.read(f"# head\n1 {POSE}\n{bad}\n{bad}\n3 {POSE}\n")
                self.assertEqual(found.stamp_texts, ["1", "3"])
                self.assertIn("skipped 2 malformed line(s), first at line 3", warnings)
                self.assertEqual(warnings.count("\n"), 1)

    def test_the_last_of_equal_stamps_counts(self):
        found, warnings = self.read(f"1 {POSE}\n1.0 9 9 9 0 0 0 1\n")
        np.testing.assert_array_equal(found.positions, [[9, 9, 9]])
        self.assertIn("1 repeated time stamp", warnings)


if __name__ == "__main__":
    unittest.main()
