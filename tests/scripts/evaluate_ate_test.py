#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of the absolute trajectory error, and the command line of evaluate_ate.py."""
import json
import unittest

import numpy as np

from support import START, ScriptTest, random_rotation, run_script
from evaluate_ate import evaluate
from trajectory import read_trajectory


class AteLawsTest(ScriptTest):
    def test_a_rigid_motion_of_either_side_changes_nothing(self):
        groundtruth = self.random_trajectory(100)
        estimate = self.noisy(groundtruth)
        expected = evaluate(groundtruth, estimate).errors
        for _ in range(10):
            motion = random_rotation(self.random), self.random.normal(scale=5, size=3)
            np.testing.assert_allclose(evaluate(groundtruth, self.moved(estimate, *motion)).errors, expected,
                                       atol=1e-10)
            np.testing.assert_allclose(evaluate(self.moved(groundtruth, *motion), estimate).errors, expected,
                                       atol=1e-10)

    def test_a_moved_copy_has_no_error(self):
        groundtruth = self.random_trajectory(100)
        estimate = self.moved(groundtruth, random_rotation(self.random), np.ones(3))
        self.assertLess(evaluate(groundtruth, estimate).errors.max(), 1e-12)

    def test_scale_is_recovered_or_applied_on_demand_only(self):
        groundtruth = self.random_trajectory(100)
        estimate = self.trajectory(groundtruth.stamps, 0.5 * groundtruth.positions, groundtruth.rotations)
        self.assertGreater(evaluate(groundtruth, estimate).errors.max(), 1e-3)
        self.assertLess(evaluate(groundtruth, estimate, scale=2.0).errors.max(), 1e-12)
        aligned = evaluate(groundtruth, estimate, align_scale=True)
        self.assertAlmostEqual(aligned.alignment.scale, 2.0)
        self.assertLess(aligned.errors.max(), 1e-12)

    def test_offset_undoes_a_shift_of_the_clock(self):
        groundtruth = self.random_trajectory(100)
        late = self.trajectory(groundtruth.stamps + 0.5, groundtruth.positions, groundtruth.rotations)
        self.assertGreater(evaluate(groundtruth, late).errors.max(), 1e-3)
        self.assertLess(evaluate(groundtruth, late, offset=-0.5).errors.max(), 1e-12)


class AteScriptTest(ScriptTest):
    def setUp(self):
        super().setUp()
        truth = self.random_trajectory(60)
        motion = random_rotation(self.random), np.ones(3)
        self.groundtruth = self.save("groundtruth.txt", truth)
        self.estimate = self.save("estimate.txt", self.moved(self.noisy(truth), *motion))

    def run_ate(self, *options):
        result = run_script("evaluate_ate.py", self.groundtruth, self.estimate, *options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_prints_the_rmse_alone_or_all_figures(self):
        lines = self.run_ate("--verbose").splitlines()
        self.assertEqual(lines[0], "compared_pose_pairs 60 pairs")
        names = [line.split()[0].split(".")[1] for line in lines[1:]]
        self.assertEqual(names, ["rmse", "mean", "median", "std", "min", "max"])
        for line in lines[1:]:
            self.assertRegex(line, r"^absolute_translational_error\.\w+ \d+\.\d{6} m$")
        self.assertEqual(self.run_ate().strip(), lines[1].split()[1])

    def test_json_on_standard_output_stands_alone(self):
        result = json.loads(self.run_ate("--json", "-", "--verbose"))
        self.assertEqual(result["pairs"], 60)
        self.assertEqual(f"{result['rmse']:.6f}", self.run_ate("--json", self.path("ate.json")).strip())
        with open(self.path("ate.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file), result)

    def test_coverage_counts_the_poses_of_the_frames(self):
        lines = "".join(f"{i} a {i} b\n" for i in range(80))
        frames = self.write("associations.txt", "# rgb depth\n" + lines)
        for argument in ("80", frames):
            printed = self.run_ate("--verbose", "--frames", argument)
            self.assertIn("coverage 0.750000 (60 of 80 frames)", printed)
            result = json.loads(self.run_ate("--json", "-", "--frames", argument))
            self.assertEqual(result["coverage"], {"poses": 60, "frames": 80, "ratio": 0.75})

    def test_what_is_saved_is_aligned(self):
        saved, pairs = self.path("aligned.txt"), self.path("pairs.txt")
        rmse = float(self.run_ate("--save", saved, "--save_associations", pairs))
        found = evaluate(read_trajectory(self.groundtruth), read_trajectory(saved))
        np.testing.assert_allclose(found.alignment.rotation, np.eye(3), atol=1e-4)
        rows = np.loadtxt(pairs)
        self.assertEqual(rows.shape, (60, 8))
        distances = np.linalg.norm(rows[:, 1:4] - rows[:, 5:8], axis=1)
        self.assertAlmostEqual(np.sqrt(np.mean(distances ** 2)), rmse, delta=2e-6)

    def test_plots_in_the_format_of_the_name(self):
        for name, magic in (("ate.png", b"\x89PNG"), ("ate.pdf", b"%PDF")):
            self.run_ate("--plot", self.path(name))
            with open(self.path(name), "rb") as file:
                self.assertEqual(file.read(4), magic)
        result = run_script("evaluate_ate.py", self.groundtruth, self.estimate, "--plot", "a.xyz")
        self.assert_refused(result, ".png")

    def test_bad_input_is_refused_in_one_line(self):
        empty = self.write("empty.txt", "")
        other = self.write("other.txt", "9 0 0 0 0 0 0 1\n10 1 0 0 0 0 0 1\n")
        nan = self.write("nan.txt", "nan 0 0 0 0 0 0 1\n")
        for estimate in (empty, nan, other, self.path("none.txt"), self.folder):
            with self.subTest(estimate=estimate):
                self.assert_refused(run_script("evaluate_ate.py", self.groundtruth, estimate), estimate)
        for option in (("--frames", "0"), ("--frames", empty), ("--frames", self.path("none")),
                       ("--scale", "0"), ("--save", self.path("no/folder")), ("--json", self.folder),
                       ("--no-such-option",)):
            with self.subTest(option=option):
                self.assert_refused(run_script("evaluate_ate.py", self.groundtruth, self.estimate, *option))

    def test_a_line_of_nan_is_left_out_with_a_warning(self):
        with open(self.estimate, encoding="utf-8") as file:
            text = file.read()
        estimate = self.write("nan.txt", text + f"{START + 99:.6f} nan nan nan 0 0 0 1\n")
        result = run_script("evaluate_ate.py", self.groundtruth, estimate)
        self.assertEqual((result.returncode, result.stdout), (0, self.run_ate()))
        self.assertIn(f"{estimate}: skipped 1 malformed line(s), first at line 62", result.stderr)


if __name__ == "__main__":
    unittest.main()
