#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""regression.py on programs that are stand-ins: its tables, its bounds, what it refuses."""
import json
import os
import shutil
import unittest
from unittest import mock

from regression_support import NAME, StubbedTest
from support import run_script

from regression import BOUNDS, FIGURES, SITUATIONS, bounds_of, broken_bounds, read_bounds
from regression_runs import REAL_SEQUENCES, SYNTHETIC, find_real


class BoundsTest(StubbedTest):
    def test_a_bound_is_broken_only_beyond_it(self):
        for key, value, is_broken in (("max_ate_m", 0.02, False), ("max_ate_m", 0.021, True),
                                      ("min_recall", 0.9, False), ("min_recall", 0.89, True),
                                      ("min_recall", None, True), ("max_ate_m", float("nan"), True)):
            figures = {**dict.fromkeys(FIGURES), key[4:]: value}
            limit = {"max_ate_m": 0.02, "min_recall": 0.9}[key]
            self.assertEqual(len(broken_bounds("name", figures, {key: limit})), int(is_broken), (key, value))
        self.assertEqual(broken_bounds("name", dict.fromkeys(FIGURES), None), [])

    def test_what_is_broken_is_said_with_its_unit(self):
        line, = broken_bounds("fr1_xyz", {**dict.fromkeys(FIGURES), "wrongly_masked": 0.0213},
                              {"max_wrongly_masked": 0.001})
        self.assertEqual(line, "fr1_xyz: share of static pixels masked is 2.13 %, must be at most 0.1 %")

    def test_bounds_hold_for_every_seed_but_not_for_other_lengths(self):
        bounds = {"synthetic_close_xyz": {"max_ate_m": 1}, "synthetic_close_xyz_seed3": {"max_ate_m": 2}}
        for name, expected in (("synthetic_close_xyz", 1), ("synthetic_close_xyz_seed2", 1),
                               ("synthetic_close_xyz_seed3", 2)):
            self.assertEqual(bounds_of(name, bounds), {"max_ate_m": expected})
        self.assertIsNone(bounds_of("synthetic_close_xyz_150", bounds))

    def test_our_own_bounds_are_of_known_sequences(self):
        for name in read_bounds(BOUNDS):
            self.assertTrue(name in REAL_SEQUENCES or SYNTHETIC.fullmatch(name), name)


class RegressionTest(StubbedTest):
    script = "regression.sh"

    def bounds(self, text):
        return ["--bounds", self.write("bounds.yaml", text)]

    def run_ok(self, *arguments, **options):
        result = self.call(*arguments, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_tables_hold_the_figures_of_the_runs_and_their_improvement(self):
        output = self.run_ok(NAME, *self.bounds("")).stdout
        folder = os.path.join(self.output, NAME)
        trajectories = [os.path.join(folder, run, "CameraTrajectory.txt") for run in ("without", "with")]
        compared = run_script("compare_runs.py", os.path.join(folder, "sequence", "groundtruth.txt"),
                              *trajectories)
        for metric in ("ATE [m]", "Translational drift [m/s]", "Rotational drift [deg/s]"):
            self.assertEqual(self.table_cells(output, metric)[NAME],
                             self.table_cells(compared.stdout, "Metric")[metric])
        self.assertAlmostEqual(float(self.table_cells(output, "ATE")[NAME][4]), 90, delta=0.5)
        self.assertEqual(self.table_cells(output, "Detector")[NAME],
                         ["100.00"] * 5 + ["0.00", "10.0", "10.0", "1"])

    def test_walking_xyz_is_always_among_them(self):
        for options, first in (([], "synthetic_walking_xyz"), (["--quick"], "synthetic_walking_xyz_150")):
            output = self.run_ok(*options, NAME, *self.bounds("")).stdout
            self.assertEqual(list(self.table_cells(output, "ATE")), [first, NAME])
            self.assertIn(f"no bounds, only reported: {first}, {NAME}\n", output)

    def test_special_situations_come_alone_and_have_bounds(self):
        output = self.run_ok("--situations", *self.bounds("")).stdout
        self.assertEqual(list(self.table_cells(output, "ATE")), SITUATIONS)
        for name in SITUATIONS:
            self.assertIsNotNone(bounds_of(name, read_bounds(BOUNDS)), name)
        self.assertEqual(self.call("--situations", "--quick").returncode, 2)

    def test_within_the_bounds_it_succeeds(self):
        bounds = ("{max_ate_m: 0.1, min_ate_ratio_empty: 0.09, max_ate_ratio_empty: 0.11, "
                  "min_ate_ratio_true_masks: 0.06, max_ate_ratio_true_masks: 0.07, "
                  "min_eta_percent: 89, min_recall: 1}")
        result = self.run_ok("--quick", NAME, *self.bounds(f"{NAME}: {bounds}"))
        self.assertIn("all figures are within their bounds", result.stdout)
        self.assertEqual(result.stderr.count(f"{NAME}: making it"), 1)

    def test_each_broken_bound_is_told_in_a_line(self):
        bounds = "{max_ate_m: 0.1, max_ate_ratio: 1.03, min_eta_percent: 90, min_precision: 0.9}"
        result = self.call("--quick", NAME, *self.bounds(f"{NAME}: {bounds}"), with_m=1)
        self.assertEqual(result.returncode, 1, result.stderr)
        failures = [line for line in result.stderr.splitlines() if line.startswith("FAILED")]
        self.assertEqual(len(failures), 3, failures)
        self.assertRegex(failures[0],
                         rf"{NAME}: ATE RMSE with the detector is 1\.\d+ m, must be at most 0\.1 m")
        self.assertRegex(failures[2], r"improvement .* is -\d+.* %, must be at least 90 %")
        self.assertIn("| ATE [m]", result.stdout)
        self.assertNotIn("within their bounds", result.stdout)

    def test_a_run_that_fails_is_told_and_the_others_go_on(self):
        self.run_ok("--quick", NAME, *self.bounds(""))
        spoilt = shutil.copytree(os.path.join(self.output, NAME, "sequence"), self.path("spoilt"))
        self.write("spoilt/camera.yaml", "fail: 1\n")
        result = self.call("--quick", "synthetic_unknown_xyz", spoilt, NAME, "--json", "-", *self.bounds(""))
        self.assertEqual(result.returncode, 1)
        self.assertEqual(list(json.loads(result.stdout)["results"]), ["synthetic_walking_xyz_150", NAME])
        self.assertIn("FAILED synthetic_unknown_xyz: make_sequence failed", result.stderr)
        self.assertIn("FAILED spoilt: rgbd_tum failed (exit code 1): rgbd_tum: nothing was tracked\n",
                      result.stderr)

    def test_leaves_the_folders_of_others_alone(self):
        self.run_ok("--quick", NAME, *self.bounds(""))
        other = shutil.copytree(os.path.join(self.output, NAME, "sequence"), self.path(NAME))
        self.write(f"{NAME}/mine.txt", "kept")
        self.run_ok("--quick", other, *self.bounds(""))
        self.assertTrue(os.path.isfile(os.path.join(other, "mine.txt")))

    def test_real_sequences_are_found_where_they_are(self):
        folders = ["data/xyz_walk_a", "datasets/rgbd_dataset_freiburg3_walking_rpy", "data/fr1_xyz",
                   "datasets/rgbd_dataset_freiburg1_xyz"]
        for folder in folders:
            os.makedirs(self.path(f"{folder}/rgb"))
        with mock.patch.dict(os.environ, ORBSLAM_DATA=self.path("data")), \
                mock.patch("regression_runs.ROOT", self.folder):
            found = {name: find_real(name) for name in REAL_SEQUENCES if find_real(name)}
        self.assertEqual({name: sequence.folder for name, sequence in found.items()},
                         dict(zip(("xyz_walk_a", "fr3_walking_rpy", "fr1_xyz"), map(self.path, folders))))
        self.assertEqual(found["fr3_walking_rpy"].settings, self.path("config/TUM3.yaml"))
        self.assertEqual([name for name, sequence in found.items() if sequence.is_static], ["fr1_xyz"])

    def test_bad_input_is_refused_in_one_line(self):
        self.assert_refused(self.call(self.path("no")), self.path("no"))
        self.assert_refused(self.call("--quick", "--all"), "--all")
        self.assert_refused(self.call(*self.bounds("a: [")), "line 1", "not YAML")
        for text in ("a: {max_speed: 1}", "a: {max_ate_m: fast}", "a: 1", "a: {min_recall: yes}"):
            self.assert_refused(self.call(*self.bounds(text)), "a:", "max_FIGURE")
        self.assert_refused(self.call("--bounds", self.path("no.yaml")), "no.yaml")
        self.assert_refused(self.call("--vocabulary", "no.bin"), "no.bin")
        shutil.rmtree(self.build)
        self.assert_refused(self.call(), "build first")


if __name__ == "__main__":
    unittest.main()
