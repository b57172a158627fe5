# SPDX-License-Identifier: GPL-3.0-or-later
"""Two sequential runs write the same bytes."""
import os

from support import RgbdTumTest, read, run_or_skip


class Repeatable(RgbdTumTest):
    frames = 40

    def test_two_sequential_runs_write_the_same_trajectories(self):
        outputs = [self.path("first"), self.path("second")]
        for output in outputs:
            self.assertEqual(self.run_tum("--sequential", output=output).returncode, 0)
        for name in ("CameraTrajectory.txt", "KeyFrameTrajectory.txt"):
            first, second = (read(os.path.join(output, name)) for output in outputs)
            self.assertTrue(first)
            self.assertEqual(first, second)

    def test_what_is_printed_changes_nothing(self):
        self.run_tum("--sequential")
        quiet = self.path("quiet")
        self.run_tum("--sequential", "--quiet", "--log-level", "off", output=quiet)
        self.assertEqual(self.trajectory(), self.trajectory(output=quiet))


if __name__ == "__main__":
    run_or_skip(None)
