# SPDX-License-Identifier: GPL-3.0-or-later
"""Accuracy on real sequences: the TUM RGB-D benchmark's fr1_xyz and fr1_rpy (Sturm et al., IROS 2012).

They are in $ORBSLAM_DATA; without it: exit code 77, skipped.
"""
import json
import os
import subprocess

from support import ROOT, RgbdTumTest, read, run_or_skip

DATA = os.environ.get("ORBSLAM_DATA", "")
MAX_ATE_RMSE_M = {"fr1_xyz": 0.02, "fr1_rpy": 0.04}


class Accuracy(RgbdTumTest):
    def run_on(self, name, output):
        folder = os.path.join(DATA, name)
        result = self.run_tum("--sequential", "--quiet", sequence=folder, output=output,
                              vocabulary=os.path.join(ROOT, "Vocabulary", "orbslam.bin"),
                              settings=os.path.join(ROOT, "config", "TUM1.yaml"),
                              associations=os.path.join(folder, "associations.txt"))
        self.assertEqual(result.returncode, 0, result.stderr)
        return os.path.join(output, "CameraTrajectory.txt")

    def ate(self, name, estimate):
        """The figures of evaluate_ate.py."""
        folder = os.path.join(DATA, name)
        command = [os.path.join(ROOT, "scripts", "evaluate_ate.py"), os.path.join(folder, "groundtruth.txt"),
                   estimate, "--frames", os.path.join(folder, "associations.txt"), "--json", "-"]
        result = subprocess.run(command, capture_output=True, text=True, check=True)
        return json.loads(result.stdout)

    def test_error_coverage_and_repeatability(self):
        for name, max_rmse_m in MAX_ATE_RMSE_M.items():
            with self.subTest(name):
                first = self.run_on(name, self.path(f"{name}_1"))
                figures = self.ate(name, first)
                coverage = figures["coverage"]["ratio"]
                print(f"{name}: ATE RMSE {figures['rmse']:.4f} m, coverage {coverage:.3f}")
                self.assertLessEqual(figures["rmse"], max_rmse_m)
                self.assertEqual(coverage, 1)
                self.assertEqual(read(first), read(self.run_on(name, self.path(f"{name}_2"))))


if __name__ == "__main__":
    missing = [name for name in MAX_ATE_RMSE_M if not os.path.isdir(os.path.join(DATA, name))]
    run_or_skip(f"set ORBSLAM_DATA to the folder that holds {' and '.join(missing)}" if missing else None)
