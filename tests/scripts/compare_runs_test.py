#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of compare_runs.py holds the figures of the evaluations, and their improvement."""
import json
import unittest

from support import ScriptTest, run_script
from compare_runs import improvement


class CompareRunsTest(ScriptTest):
    def setUp(self):
        super().setUp()
        truth = self.random_trajectory(100)
        self.groundtruth = self.save("groundtruth.txt", truth)
        self.bad = self.save("bad.txt", self.noisy(truth, 0.05))
        self.good = self.save("good.txt", self.noisy(truth, 0.01))

    def compare(self, *options):
        result = run_script("compare_runs.py", self.groundtruth, self.bad, self.good, *options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_improvement_is_a_share_of_the_baseline(self):
        self.assertAlmostEqual(improvement(0.5885, 0.0182), 96.9074, places=4)
        self.assertEqual(improvement(1.0, 2.0), -100.0)
        self.assertIsNone(improvement(0.0, 1.0))

    def test_prints_an_aligned_markdown_table(self):
        lines = self.compare("--labels", "off", "on", "--frames", "100").splitlines()
        table = lines[:5]
        self.assertEqual(len({len(line) for line in table}), 1)
        for line in table:
            self.assertRegex(line, r"^\|( [^|]+ \|){7}$")
        self.assertIn("off RMSE", table[0])
        self.assertEqual([line.split("|")[1].strip() for line in table[2:]],
                         ["ATE [m]", "Translational drift [m/s]", "Rotational drift [deg/s]"])
        self.assertEqual(lines[5:], ["", *(f"{label}: 100 poses of 100 frames (100.0 %), 100 compared"
                                           for label in ("off", "on"))])

    def test_figures_are_those_of_the_evaluations(self):
        result = json.loads(self.compare("--json", "-"))
        for run, estimate in (("baseline", self.bad), ("other", self.good)):
            ate = run_script("evaluate_ate.py", self.groundtruth, estimate, "--json", "-")
            rpe = run_script("evaluate_rpe.py", self.groundtruth, estimate, "--fixed_delta", "--json", "-")
            self.assertEqual(result[run]["ate"]["rmse"], json.loads(ate.stdout)["rmse"])
            drift = json.loads(rpe.stdout)
            self.assertEqual(result[run]["translational_drift"]["sd"], drift["translational_error"]["std"])
            self.assertEqual(result[run]["rotational_drift"]["rmse"], drift["rotational_error"]["rmse"])
        self.assertGreater(result["improvement_percent"]["ate"]["rmse"], 50)

    def test_bad_input_is_refused_in_one_line(self):
        empty = self.write("empty.txt", "")
        self.assert_refused(run_script("compare_runs.py", self.groundtruth, self.bad, empty), empty)
        self.assert_refused(run_script("compare_runs.py", self.groundtruth, self.bad), "other")


if __name__ == "__main__":
    unittest.main()
