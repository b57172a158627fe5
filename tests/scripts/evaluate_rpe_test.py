#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of the relative pose error, and the command line of evaluate_rpe.py."""
import json
import unittest

import numpy as np

from support import ScriptTest, random_rotation, run_script
from evaluate_rpe import RpeOptions, choose_pairs, evaluate, positions_along
from trajectory import rotations_of

PER_SECOND = RpeOptions(fixed_delta=True)


def rotation_about_z(angles):
    """Rotation matrices, (n, 3, 3)."""
    zeros = np.zeros_like(angles)
    return rotations_of(np.stack([zeros, zeros, np.sin(angles / 2), np.cos(angles / 2)], axis=1))


class RpeLawsTest(ScriptTest):
    def test_a_rigid_motion_of_either_side_changes_nothing(self):
        groundtruth = self.random_trajectory(100)
        estimate = self.noisy(groundtruth)
        expected = evaluate(groundtruth, estimate, PER_SECOND)
        for _ in range(5):
            motion = random_rotation(self.random), self.random.normal(scale=5, size=3)
            found = evaluate(self.moved(groundtruth, *motion), estimate, PER_SECOND)
            np.testing.assert_allclose(found.translational_errors, expected.translational_errors, atol=1e-10)
            np.testing.assert_allclose(found.rotational_errors, expected.rotational_errors, atol=1e-7)

    def test_a_steady_drift_is_found(self):
        stamps = np.arange(200) / 30
        at_rest = self.trajectory(stamps, np.zeros((200, 3)), np.tile(np.eye(3), (200, 1, 1)))
        drifting = self.trajectory(stamps, np.outer(0.03 * stamps, [0, 0, 1]),
                                   rotation_about_z(0.02 * stamps))
        found = evaluate(at_rest, drifting, PER_SECOND)
        np.testing.assert_allclose(found.translational_errors, 0.03, atol=1e-12)
        np.testing.assert_allclose(found.rotational_errors, 0.02, atol=1e-12)

    def test_the_error_is_that_of_the_4x4_formula(self):
        groundtruth, estimate = self.random_trajectory(50), self.random_trajectory(50)
        found = evaluate(groundtruth, estimate, RpeOptions(max_pairs=0))
        def pose(trajectory, index):
            matrix = np.eye(4)
            matrix[:3, :3], matrix[:3, 3] = trajectory.rotations[index], trajectory.positions[index]
            return matrix
        for k in self.random.integers(0, len(found.pairs), 50):
            i, j = found.pairs[k]
            motions = [np.linalg.inv(pose(t, j)) @ pose(t, i) for t in (estimate, groundtruth)]
            error = np.linalg.inv(motions[0]) @ motions[1]
            self.assertAlmostEqual(found.translational_errors[k], np.linalg.norm(error[:3, 3]))
            cosine = np.clip((np.trace(error[:3, :3]) - 1) / 2, -1, 1)
            self.assertAlmostEqual(found.rotational_errors[k], np.arccos(cosine), delta=1e-6)

    def test_scale_and_offset_are_undone(self):
        groundtruth = self.random_trajectory(100)
        estimate = self.trajectory(groundtruth.stamps + 0.5, 0.5 * groundtruth.positions,
                                   groundtruth.rotations)
        found = evaluate(groundtruth, estimate, RpeOptions(fixed_delta=True, scale=2.0, offset=-0.5))
        self.assertLess(found.translational_errors.max(), 1e-12)


class PairsTest(ScriptTest):
    def test_pairs_are_delta_apart_in_every_unit(self):
        trajectory = self.random_trajectory(200)
        for unit, delta in (("s", 1.0), ("f", 7), ("m", 0.3), ("rad", 0.5), ("deg", 20.0)):
            along = positions_along(trajectory, unit)
            pairs = choose_pairs(trajectory, RpeOptions(fixed_delta=True, delta=delta, delta_unit=unit))
            distances = along[pairs[:, 1]] - along[pairs[:, 0]]
            self.assertGreater(len(pairs), 10)
            self.assertLessEqual(np.abs(distances - delta).max(), np.diff(along).max() / 2 + 1e-9)

    def test_more_pairs_than_allowed_are_sampled_repeatably(self):
        trajectory = self.random_trajectory(100)
        for fixed in (True, False):
            options = RpeOptions(fixed_delta=fixed, max_pairs=20)
            pairs = choose_pairs(trajectory, options)
            self.assertEqual(len(pairs), 20)
            np.testing.assert_array_equal(pairs, choose_pairs(trajectory, options))
        self.assertEqual(len(choose_pairs(trajectory, RpeOptions(max_pairs=0))), 100 * 100)

    def test_pairs_without_ground_truth_are_dropped(self):
        whole = self.random_trajectory(100)
        keep = np.r_[0:40, 60:100]
        gap = self.trajectory(whole.stamps[keep], whole.positions[keep], whole.rotations[keep])
        found = evaluate(gap, whole, PER_SECOND)
        self.assertEqual(len(found.pairs), sum(i not in range(42, 58) and i + 30 not in range(42, 58)
                                               for i in range(69)))
        self.assertLess(np.abs(gap.stamps[found.groundtruth_pairs] - whole.stamps[found.pairs]).max(), 0.0667)


class RpeScriptTest(ScriptTest):
    def setUp(self):
        super().setUp()
        truth = self.random_trajectory(100)
        self.groundtruth = self.save("groundtruth.txt", truth)
        self.estimate = self.save("estimate.txt", self.noisy(truth))

    def run_rpe(self, *options):
        result = run_script("evaluate_rpe.py", self.groundtruth, self.estimate, "--fixed_delta", *options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_prints_the_mean_alone_or_all_figures(self):
        lines = self.run_rpe("--verbose", "--frames", "200").splitlines()
        self.assertEqual(lines[0], "compared_pose_pairs 69 pairs")
        for name, unit, part in (("translational", "m", lines[1:7]), ("rotational", "deg", lines[7:13])):
            figures = ("rmse", "mean", "median", "std", "min", "max")
            for figure, line in zip(figures, part, strict=True):
                self.assertRegex(line, rf"^{name}_error\.{figure} \d+\.\d{{6}} {unit}$")
        self.assertEqual(lines[13:], ["coverage 0.500000 (100 of 200 frames)"])
        self.assertEqual(self.run_rpe().strip(), lines[2].split()[1])

    def test_json_saved_pairs_and_plot_agree(self):
        saved, figure = self.path("pairs.txt"), self.path("rpe.png")
        result = json.loads(self.run_rpe("--json", "-", "--save", saved, "--plot", figure, "--frames", "100"))
        rows = np.loadtxt(saved)
        self.assertEqual(rows.shape, (result["pairs"], 6))
        self.assertAlmostEqual(rows[:, 4].mean(), result["translational_error"]["mean"], delta=1e-6)
        self.assertAlmostEqual(np.degrees(rows[:, 5]).mean(), result["rotational_error"]["mean"], delta=1e-4)
        self.assertEqual(result["coverage"]["ratio"], 1.0)
        with open(figure, "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")

    def test_bad_input_is_refused_in_one_line(self):
        one = self.write("one.txt", "9 0 0 0 0 0 0 1\n")
        far = self.write("far.txt", "9 0 0 0 0 0 0 1\n10 1 0 0 0 0 0 1\n")
        for estimate in (self.write("empty.txt", ""), one, far, self.path("none.txt")):
            with self.subTest(estimate=estimate):
                self.assert_refused(run_script("evaluate_rpe.py", self.groundtruth, estimate), estimate)
        for option in (("--delta", "0"), ("--delta_unit", "h"), ("--max_pairs", "-1"),
                       ("--delta", "1e6", "--fixed_delta")):
            with self.subTest(option=option):
                self.assert_refused(run_script("evaluate_rpe.py", self.groundtruth, self.estimate, *option))


if __name__ == "__main__":
    unittest.main()
