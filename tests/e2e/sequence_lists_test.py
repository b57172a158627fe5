# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists of a sequence that are missing or spoilt: refused, or skipped line by line with a counted warning."""
import os
import unittest

from support import RgbdTumTest, read, run_or_skip


class Lists(RgbdTumTest):
    def run_with(self, text):
        """Runs on this text as associations."""
        return self.run_tum(associations=self.sequence.write("associations.txt", text))

    def run_on_lists(self):
        """Runs on rgb.txt and depth.txt."""
        command = self.command()
        command.remove(self.sequence.associations)
        return self.finish(command)

    def lines(self):
        return read(self.sequence.associations).splitlines(keepends=True)

    def test_missing_files_and_folders_in_their_place(self):
        cases = {"associations": ("nowhere.txt", "No such file"), "sequence": ("nowhere", "No such file"),
                 "vocabulary": ("nowhere.bin", "No such file")}
        for argument, (name, reason) in cases.items():
            with self.subTest(missing=argument):
                self.assert_refused(self.run_tum(**{argument: self.path(name)}), name, reason)
        for argument in ("associations", "vocabulary"):
            with self.subTest(folder_in_place_of=argument):
                self.assert_refused(self.run_tum(**{argument: self.folder}), self.folder, "directory")
        self.assert_refused(self.run_tum(sequence=self.sequence.associations), "associations.txt", "folder")

    def test_missing_lists(self):
        for name in ("depth.txt", "rgb.txt"):
            os.remove(self.sequence.path(name))
            with self.subTest(name):
                self.assert_refused(self.run_on_lists(), name, "No such file")

    @unittest.skipIf(os.geteuid() == 0, "root may read everything")
    def test_file_without_permission(self):
        os.chmod(self.sequence.associations, 0)
        self.assert_refused(self.run_tum(), "associations.txt", "Permission denied")

    def test_lists_without_a_usable_line(self):
        contents = {"empty": "", "comments": "# rgb depth\n\n", "no text": b"\x00\xff\x00\xff\n" * 9,
                    "other fields": "1.0 rgb/a.png\n2.0 rgb/b.png\n",
                    "no times": "a rgb/a.png b depth/b.png\n"}
        for name, content in contents.items():
            with self.subTest(name):
                self.assert_refused(self.run_with(content), "associations.txt")

    def test_lists_with_no_common_times(self):
        self.sequence.write("depth.txt", "".join(f"{9 + i} {self.sequence.depth(i)}\n" for i in range(8)))
        self.assert_refused(self.run_on_lists(), self.sequence.folder, "0.02 s")

    def test_bad_lines_are_skipped_counted_and_warned_of(self):
        """Each bad line comes third, so that a warning has a line number to name."""
        cases = {"three fields": "0.05 rgb/a.png 0.05\n",
                 "five fields": "0.05 rgb/a.png 0.05 depth/a.png x\n",
                 "text": "soon rgb/a.png soon depth/a.png\n", "nan": "nan rgb/a.png nan depth/a.png\n",
                 "infinite": "inf rgb/a.png inf depth/a.png\n", "repeated": self.lines()[1],
                 "backwards": self.lines()[0], "depth's time": "0.05 rgb/a.png now depth/a.png\n",
                 "no UTF-8": "0.05 \udcff\udcfe\n"}
        lines = self.lines()
        for name, bad_line in cases.items():
            for count in (1, 2):
                with self.subTest(name, count=count):
                    result = self.run_with("".join(lines[:2] + count * [bad_line] + lines[2:]))
                    self.assert_works(result)
                    self.assert_says(result, "warning", "associations.txt:3:", f"{count} such line")
                    self.assertEqual(len(self.report()["warnings"]), 1)

    def test_comments_blank_lines_tabs_and_windows_line_ends(self):
        lines = self.lines()
        text = "# time rgb time depth\n\n" + lines[0].replace(" ", "\t") + "   \n# again\n"
        text += "".join(lines[1:])
        result = self.run_with(text.replace("\n", "\r\n"))
        self.assert_works(result)
        self.assertEqual(self.report()["warnings"], [])
        for name in ("rgb.txt", "depth.txt"):
            text = "# time file\n\n" + read(self.sequence.path(name))
            self.sequence.write(name, text.replace("\n", "\r\n").rstrip())
        self.assert_works(self.run_on_lists())

    def test_absolute_paths_of_images(self):
        self.sequence.write_associations([[stamp, self.sequence.path(rgb), time, self.sequence.path(depth)]
                                          for stamp, rgb, time, depth in self.sequence.entries])
        self.assert_works(self.run_tum(sequence=self.folder))


if __name__ == "__main__":
    run_or_skip(None)
