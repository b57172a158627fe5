# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C at any time: exit code 130, and everything so far is written."""
import os
import signal
import subprocess

from support import OUTPUTS, TIMEOUT_S, RgbdTumTest, run_or_skip


class Interrupt(RgbdTumTest):
    frames = 40

    def write_times(self, times):
        """A list of as many frames, the sequence's over and over, both images at the same time."""
        entries = [self.sequence.entries[i % self.frames] for i in range(len(times))]
        self.sequence.write_associations(
            [[time, rgb, time, depth] for time, (_, rgb, _, depth) in zip(times, entries)])

    def interrupt(self, *options):
        """Runs it, sends SIGINT when the first frames are done, and checks what is left behind."""
        process = subprocess.Popen(self.command(*options), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True)
        self.addCleanup(process.kill)
        self.assertIn("OK", process.stderr.readline())
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=TIMEOUT_S)
        self.assertEqual(process.returncode, 130)
        self.assertEqual(sorted(os.listdir(self.output)), sorted(OUTPUTS))
        report = self.report()
        self.assertTrue(report["interrupted"])
        self.assertGreater(report["frames"]["tracked"], 0)
        self.assertLess(report["frames"]["processed"], report["frames"]["listed"])
        self.assertEqual(len(self.trajectory()), report["frames"]["tracked"])

    def test_at_full_speed(self):
        """A list long enough not to be through before the signal arrives."""
        self.write_times([f"{i / 30:.6f}" for i in range(20000)])
        for mode in ([], ["--sequential"]):
            with self.subTest(mode=mode):
                self.interrupt(*mode)

    def test_while_waiting_for_the_next_frame(self):
        """Frames ten minutes apart: all that happens after the first one is waiting."""
        self.write_times([f"{600 * i}" for i in range(self.frames)])
        self.interrupt("--realtime")


if __name__ == "__main__":
    run_or_skip(None)
