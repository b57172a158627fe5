# SPDX-License-Identifier: GPL-3.0-or-later
"""What rgbd_tum writes and prints, and what its options do."""
import os
import re

from support import RGBD_TUM, OUTPUTS, RgbdTumTest, read, run_or_skip

DECIMAL = re.compile(r"-?\d+\.\d{6,}")


class Outputs(RgbdTumTest):
    frames = 40

    def assert_trajectory(self, name, stamps):
        """TUM's format: `timestamp tx ty tz qx qy qz qw`, stamps letter by letter those of the input."""
        lines = self.trajectory(name)
        self.assertTrue(lines, name)
        found = [line[0] for line in lines]
        self.assertEqual(found, [stamp for stamp in stamps if stamp in set(found)])
        for line in lines:
            self.assertEqual(len(line), 8, line)
            for field in line[1:]:
                self.assertRegex(field, DECIMAL)
            self.assertAlmostEqual(sum(float(q) ** 2 for q in line[4:]), 1, places=6)

    def test_trajectories_carry_the_time_stamps_as_the_input_writes_them(self):
        stamps = [f"{1305031102 + i / 30:.{4 + i % 4}f}" for i in range(self.frames)]
        self.sequence.write_associations(
            [[stamp, *entry[1:]] for stamp, entry in zip(stamps, self.sequence.entries)])
        self.assert_works(self.run_tum())
        self.assert_trajectory("CameraTrajectory.txt", stamps)
        self.assert_trajectory("KeyFrameTrajectory.txt", stamps)
        self.assertEqual([line[0] for line in self.trajectory()], stamps)

    def test_first_camera_is_the_world(self):
        self.run_tum()
        self.assertEqual([float(field) for field in self.trajectory()[0][1:]], [0, 0, 0, 0, 0, 0, 1])

    def test_report_says_what_was_done(self):
        self.run_tum("--sequential")
        report = self.report()
        self.assertEqual(report["command_line"], self.command("--sequential"))
        self.assertRegex(report["version"], r"^\d+\.\d+\.\d+$")
        self.assertEqual(report["frames"],
                         {"listed": 40, "skipped": 0, "processed": 40, "tracked": 40, "lost": 0})
        self.assertEqual((report["coverage"], report["interrupted"], report["warnings"]), (1, False, []))
        self.assertEqual(report["map"]["keyframes"], len(self.trajectory("KeyFrameTrajectory.txt")))
        for figure in ("wall_s", "cpu_s", "startup_s", "peak_memory_mb"):
            self.assertGreater(report[figure], 0, figure)
        self.assertTrue(report["timings"])
        for stage, timing in report["timings"].items():
            self.assertLessEqual(timing["median_s"], timing["p90_s"], stage)
            self.assertLessEqual(timing["p90_s"], timing["max_s"], stage)

    def test_settings_in_use_are_settings_that_give_the_same(self):
        self.run_tum("--sequential")
        again = self.path("again")
        self.run_tum("--sequential", settings=os.path.join(self.output, "settings.yaml"), output=again)
        for name in ("CameraTrajectory.txt", "settings.yaml"):
            self.assertEqual(read(os.path.join(self.output, name)), read(os.path.join(again, name)))

    def test_keyframes_are_adjusted_at_the_end_unless_settings_say_otherwise(self):
        self.run_tum("--sequential")
        self.assertEqual(self.report()["timings"]["map.final_bundle"]["count"], 1)
        settings = self.sequence.write("no_adjustment.yaml",
                                       read(self.sequence.settings) + "\nLocalMapping.adjustAtEnd: 0\n")
        self.run_tum("--sequential", settings=settings)
        self.assertNotIn("map.final_bundle", self.report()["timings"])

    def test_lists_are_associated_as_the_file_given_says(self):
        self.run_tum("--sequential")
        again = self.path("again")
        command = self.command("--sequential", output=again)
        command.remove(self.sequence.associations)
        self.assertEqual(self.finish(command).returncode, 0)
        self.assertEqual(self.trajectory(), self.trajectory(output=again))

    def test_summary_has_the_times_that_orbslam2_prints(self):
        result = self.run_tum()
        self.assertRegex(result.stdout, r"median tracking time: \d+\.\d+\nmean tracking time: \d+\.\d+\n")
        self.assertIn("tracked 40 of 40 frames", result.stdout)
        self.assertIn(self.output, result.stdout)
        self.assertIn("40/40", result.stderr)

    def test_quiet_prints_nothing(self):
        result = self.run_tum("--quiet")
        self.assert_works(result)
        self.assertEqual(result.stdout + result.stderr, "")

    def test_max_frames_ends_early(self):
        self.assert_works(self.run_tum("--max-frames", "5"), tracked=5)
        self.assertEqual(self.report()["frames"]["listed"], 5)
        self.assert_works(self.run_tum("--max-frames", "1000"), tracked=40)

    def test_output_folder_is_made_and_holds_only_results(self):
        self.output = self.path("a/b")
        self.assert_works(self.run_tum())
        self.assertEqual(sorted(os.listdir(self.output)), sorted(OUTPUTS))

    def test_help_lists_every_option(self):
        result = self.finish([RGBD_TUM, "--help"])
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("VOCABULARY SETTINGS SEQUENCE", "--output-dir", "--sequential", "--realtime",
                     "--no-detector ", "--mask-dir", "--save-masks", "--max-frames", "--log-level", "--quiet", "--version"):
            self.assertIn(word, result.stdout)
        self.assertRegex(self.finish([RGBD_TUM, "--version"]).stdout, r"^rgbd_tum \d+\.\d+\.\d+\n$")

    def test_wrong_arguments_are_one_line(self):
        for arguments in ([], ["-"], self.command("--unknown"), self.command("--max-frames", "-1"),
                          self.command("--max-frames", "many"), self.command("--log-level", "loud"),
                          self.command("one", "more")):
            with self.subTest(arguments=arguments):
                self.assert_refused(self.finish([RGBD_TUM, *arguments[1:]]), "rgbd_tum: ", "--help")


if __name__ == "__main__":
    run_or_skip(None)
