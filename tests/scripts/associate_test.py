#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of associate.py; its matching is tested with the module trajectory."""
import unittest

from support import ScriptTest, run_script


class AssociateScriptTest(ScriptTest):
    def setUp(self):
        super().setUp()
        self.rgb = self.write(
            "rgb.txt", "# color images\n1.000 rgb/1.png\n1.040 rgb/2.png\n1.0800 rgb/3.png\n")
        self.depth = self.write(
            "depth.txt", "1.005 depth/1.png\r\n1.045,depth/2.png\r\n\r\n9.0 depth/3.png\r\n")

    def run_associate(self, *options):
        result = run_script("associate.py", self.rgb, self.depth, *options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_prints_pairs_with_the_stamps_as_they_are_written(self):
        self.assertEqual(self.run_associate(),
                         "1.000 rgb/1.png 1.005 depth/1.png\n1.040 rgb/2.png 1.045 depth/2.png\n")

    def test_first_only_leaves_the_second_file_out(self):
        self.assertEqual(self.run_associate("--first_only"), "1.000 rgb/1.png\n1.040 rgb/2.png\n")

    def test_offset_moves_the_second_file(self):
        self.assertEqual(self.run_associate("--offset", "0.04"),
                         "1.040 rgb/2.png 1.005 depth/1.png\n1.0800 rgb/3.png 1.045 depth/2.png\n")
        self.assertEqual(self.run_associate("--offset", "-7.92"), "1.0800 rgb/3.png 9.0 depth/3.png\n")

    def test_max_difference_widens_the_search(self):
        self.assertEqual(len(self.run_associate("--max_difference", "10").splitlines()), 3)

    def test_output_goes_to_a_file(self):
        self.assertEqual(self.run_associate("--output", self.path("out.txt")), "")
        with open(self.path("out.txt"), encoding="utf-8") as file:
            self.assertEqual(file.read(), self.run_associate())

    def test_data_may_be_several_fields(self):
        poses = self.write("poses.txt", "1.001 1 2 3 0 0 0 1\n")
        result = run_script("associate.py", self.rgb, poses)
        self.assertEqual(result.stdout, "1.000 rgb/1.png 1.001 1 2 3 0 0 0 1\n")

    def test_malformed_lines_are_skipped_with_a_warning(self):
        bad = self.write("bad.txt", "1.000 rgb/1.png\nnan rgb/2.png\n1.04\nx rgb/3.png\n")
        result = run_script("associate.py", bad, self.depth)
        self.assertEqual(result.stdout, "1.000 rgb/1.png 1.005 depth/1.png\n")
        self.assertIn("bad.txt: skipped 3 malformed line(s), first at line 2", result.stderr)

    def test_bad_input_is_refused_in_one_line(self):
        empty, missing = self.write("empty.txt", "# nothing\n"), self.path("none.txt")
        far = self.write("far.txt", "77 a\n")
        self.assert_refused(run_script("associate.py", self.rgb, empty), empty)
        self.assert_refused(run_script("associate.py", self.rgb, missing), missing)
        self.assert_refused(run_script("associate.py", self.folder, self.depth), self.folder)
        self.assert_refused(run_script("associate.py", self.rgb, far), far, "--max_difference")
        self.assert_refused(run_script("associate.py", self.rgb), "FILE2")
        for option in (("--max_difference", "0"), ("--max_difference", "x"), ("--offset", "nan")):
            self.assert_refused(run_script("associate.py", self.rgb, self.depth, *option), option[0])
        unwritable = self.path("no/folder.txt")
        result = run_script("associate.py", self.rgb, self.depth, "--output", unwritable)
        self.assert_refused(result, unwritable)


if __name__ == "__main__":
    unittest.main()
