# SPDX-License-Identifier: GPL-3.0-or-later
"""Outputs that cannot be written: said before the run if possible, and never the end of the other outputs."""
import os
import resource
import signal
import subprocess

from support import OUTPUTS, TIMEOUT_S, RgbdTumTest, run_or_skip


def forbid_large_files():
    """What a full disk is to a program, without a disk: writing beyond 512 bytes fails."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (512, 512))


class OutputFolder(RgbdTumTest):
    def test_folder_that_cannot_be_made(self):
        file = self.sequence.settings
        for folder in (os.path.join(file, "below"), file, "/proc/orbslam"):
            with self.subTest(folder):
                self.assert_refused(self.run_tum(output=folder), folder)

    def test_folder_that_cannot_be_written_is_found_out_before_the_run(self):
        result = self.run_tum(output="/proc")
        self.assert_refused(result, "/proc/settings.yaml", "cannot write")

    def test_disk_that_is_full_from_the_start(self):
        result = self.run_tum(preexec_fn=forbid_large_files)
        self.assert_refused(result, "settings.yaml", "cannot write", "too large")
        self.assertEqual(os.listdir(self.output), [])

    def test_disk_that_fills_up_spoils_one_file_only(self):
        os.mkdir(self.output)
        for name in OUTPUTS[:3]:
            with self.subTest(name):
                link = os.path.join(self.output, name)
                os.symlink("/dev/full", link)
                result = self.run_tum()
                self.assertEqual(result.returncode, 2)
                self.assert_says(result, "error", name, "No space left")
                os.remove(link)
                for other in OUTPUTS:
                    self.assertEqual(os.path.isfile(os.path.join(self.output, other)), other != name, other)
                    if other != name:
                        os.remove(os.path.join(self.output, other))

    def test_folder_in_place_of_a_file(self):
        os.makedirs(os.path.join(self.output, "KeyFrameTrajectory.txt"))
        result = self.run_tum()
        self.assertEqual(result.returncode, 2)
        self.assert_says(result, "error", "KeyFrameTrajectory.txt", "directory")
        self.assertEqual(len(self.trajectory()), self.frames)

    def test_results_of_an_earlier_run_are_replaced(self):
        self.run_tum()
        for name in ("CameraTrajectory_2.txt", "CameraTrajectory_3.txt", "KeyFrameTrajectory_2.txt"):
            os.rename(self.sequence.write(name, "of another map\n"), os.path.join(self.output, name))
        self.assert_works(self.run_tum("--max-frames", "3"), tracked=3)
        self.assertEqual(sorted(os.listdir(self.output)), sorted(OUTPUTS))

    def test_nobody_reads_what_is_printed(self):
        """Closed or full standard streams cost no results, and no result file gets their text."""
        redirections = {"closed": ">&- 2>&-", "all closed": "<&- >&- 2>&-", "full": ">/dev/full 2>&1"}
        for name, redirection in redirections.items():
            with self.subTest(name):
                command = ["bash", "-c", f'exec "$@" {redirection}', "bash", *self.command()]
                result = subprocess.run(command, timeout=TIMEOUT_S, check=False)
                self.assertEqual(result.returncode, 0)
                self.assertEqual(len(self.trajectory()), self.frames)
                self.assertEqual(self.report()["frames"]["tracked"], self.frames)


if __name__ == "__main__":
    run_or_skip(None)
