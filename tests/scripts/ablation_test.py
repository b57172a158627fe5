#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""ablation.py on programs that are stand-ins: each switch is turned once, its worth is in the tables."""
import json
import os
import re
import unittest

from regression_support import NAME, StubbedTest
from ablation import switches_of
from regression_runs import with_value
from trajectory import InputError


class SwitchesTest(unittest.TestCase):
    def test_only_switches_of_the_detector_are_turned(self):
        settings = {"DynamicDetector.a": True, "DynamicDetector.b": False, "DynamicDetector.n": 1,
                    "DynamicDetector.mode": "full", "LoopClosing.enabled": True}
        self.assertEqual(switches_of({"settings": settings}),
                         {"DynamicDetector.a": True, "DynamicDetector.b": False})
        with self.assertRaises(InputError):
            switches_of({"settings": {"LoopClosing.enabled": True}})

    def test_one_line_of_the_settings_changes(self):
        text = "%YAML:1.0\n---\nD.a: 1  # use a\nD.ab: 1\n"
        self.assertEqual(with_value(text, "D.a", "0"), "%YAML:1.0\n---\nD.a: 0\nD.ab: 1\n")
        with self.assertRaises(InputError):
            with_value(text, "D.b", "1")


class AblationTest(StubbedTest):
    script = "ablation.sh"

    def test_each_switch_has_its_row_and_each_sequence_its_column(self):
        static = "synthetic_static_xyz_40"
        result = self.call("--sequences", NAME, static, "--also", "DynamicDetector.minPoints=7")
        self.assertEqual(result.returncode, 0, result.stderr)
        ate, recall = (self.table_cells(result.stdout, title) for title in ("ATE RMSE [m]", "Recall [%]"))
        self.assertEqual(list(ate),
                         ["default settings", "without enabled", "without freeSpace", "minPoints=7"])
        self.assertEqual(ate["minPoints=7"], ate["default settings"])
        ratio = float(ate["without freeSpace"][0]) / float(ate["default settings"][0])
        self.assertAlmostEqual(ratio, 10, delta=0.2)
        self.assertEqual(recall["default settings"], ["100.00", "n/a"])
        self.assertEqual(recall["without freeSpace"], ["0.00", "n/a"])
        wrong = self.table_cells(result.stdout, "Wrongly masked [%]")
        self.assertEqual(wrong["default settings"], ["0.00", "0.00"])
        self.assertRegex(result.stdout, re.escape(f"| {NAME} | {static} |"))

    def test_frames_shorten_the_runs(self):
        result = self.call("--sequences", NAME, "--frames", "35", "--json", "-")
        self.assertEqual(result.returncode, 0, result.stderr)
        for run in json.loads(result.stdout)["results"][NAME].values():
            self.assertEqual((run["poses"], run["coverage"]["ratio"], run["masks"]["frames"]), (35, 1, 35))

    def test_a_run_that_fails_is_told_and_the_others_go_on(self):
        self.call("--sequences", NAME)
        spoilt = os.path.join(self.output, NAME, "sequence")
        self.write(os.path.join(spoilt, "camera.yaml"), "fail: 1\n")
        result = self.call("--sequences", spoilt, "synthetic_static_xyz_40")
        self.assertEqual(result.returncode, 1)
        self.assertIn("FAILED sequence, default settings: rgbd_tum failed", result.stderr)
        self.assertEqual(self.table_cells(result.stdout, "ATE RMSE [m]")["default settings"][0], "failed")

    def test_bad_input_is_refused_in_one_line(self):
        self.assert_refused(self.call("--sequences", self.path("no")), self.path("no"))
        self.assert_refused(self.call("--sequences", NAME, "--frames", "few"), "few")
        self.assert_refused(self.call("--also", "mode"), "KEY=VALUE")
        result = self.call("--sequences", NAME, "--also", "mode=x")
        self.assertEqual(result.returncode, 2)
        self.assertIn("ablation.py: error: rgbd_tum knows no setting mode", result.stderr)


if __name__ == "__main__":
    unittest.main()
