#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The evaluations print what the benchmark's own tools print for published trajectories.

The reference files are in $ORBSLAM_DATA/reference_trajectories; without them: exit code 77, skipped.
"""
import json
import os
import sys
import unittest

from support import run_script

FOLDER = os.path.join(os.environ.get("ORBSLAM_DATA", ""), "reference_trajectories")
TOLERANCE = 1e-6


class ReferenceTrajectoriesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(os.path.join(FOLDER, "expected.json"), encoding="utf-8") as file:
            cls.cases = json.load(file)["cases"]

    def evaluate(self, script, case, *options):
        result = run_script(script, os.path.join(FOLDER, case["groundtruth"]),
                            os.path.join(FOLDER, case["estimate"]), *options, "--json", "-")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def assert_figures(self, expected, found):
        for figure, value in expected.items():
            self.assertAlmostEqual(found[figure], value, delta=TOLERANCE, msg=figure)

    def test_absolute_trajectory_error(self):
        for case in self.cases:
            with self.subTest(estimate=case["estimate"]):
                self.assert_figures(case["ate"], self.evaluate("evaluate_ate.py", case))

    def test_relative_pose_error_per_second(self):
        for case in self.cases:
            with self.subTest(estimate=case["estimate"]):
                result = self.evaluate("evaluate_rpe.py", case, "--fixed_delta", "--delta", "1",
                                       "--delta_unit", "s")
                found = {"pairs": result["pairs"]}
                for prefix, part in (("trans_", "translational_error"), ("rot_deg_", "rotational_error")):
                    found.update({prefix + figure: value for figure, value in result[part].items()})
                self.assert_figures(case["rpe_1s"], found)


if __name__ == "__main__":
    if not os.path.isfile(os.path.join(FOLDER, "expected.json")):
        print("skipped: set ORBSLAM_DATA to the folder that holds reference_trajectories/expected.json")
        sys.exit(77)
    unittest.main()
