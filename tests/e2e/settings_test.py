# SPDX-License-Identifier: GPL-3.0-or-later
"""Wrong settings files are refused in one line that names file and key; odd ones that are right work."""
import os
import re

from support import ROOT, RgbdTumTest, read, run_or_skip

WRONG_VALUES = [
    ("Camera.fx", "wide"), ("Camera.fx", "nan"), ("Camera.fx", "-500"), ("Camera.fx", "0"),
    ("Camera.fx", ""), ("Camera.fx", "[1, 2]"), ("Camera.fx", '"500"'),
    ("Camera.width", "0"), ("Camera.height", "-240"), ("Camera.width", "320.5"),
    ("Camera.bf", "0"), ("Camera.fps", "-30"), ("ThDepth", "-40"), ("DepthMapFactor", "0"),
    ("DepthMapFactor", "-5000"), ("ORBextractor.nFeatures", "0"), ("ORBextractor.nFeatures", "-1000"),
    ("ORBextractor.nFeatures", "many"), ("ORBextractor.nFeatures", "99999999999999999999"),
    ("ORBextractor.scaleFactor", "1.0"), ("ORBextractor.nLevels", "0"), ("ORBextractor.nLevels", "-8"),
    ("ORBextractor.iniThFAST", "0"), ("ORBextractor.minThFAST", "-7"),
]
REQUIRED = ("Camera.fx", "Camera.fy", "Camera.cx", "Camera.cy", "Camera.bf", "ThDepth", "DepthMapFactor",
            "ORBextractor.nFeatures", "ORBextractor.scaleFactor", "ORBextractor.nLevels",
            "ORBextractor.iniThFAST", "ORBextractor.minThFAST")


class Settings(RgbdTumTest):
    def setUp(self):
        super().setUp()
        self.text = read(self.sequence.settings)

    def edited(self, key, replacement):
        """The settings with another line for the key."""
        text, count = re.subn(rf"(?m)^{re.escape(key)}:.*\n", replacement, self.text)
        self.assertEqual(count, 1, key)
        return text

    def run_with(self, text):
        return self.run_tum(settings=self.sequence.write("camera.yaml", text))

    def test_wrong_values_are_named(self):
        for key, value in WRONG_VALUES:
            with self.subTest(key=key, value=value):
                result = self.run_with(self.edited(key, f"{key}: {value}\n"))
                self.assert_refused(result, "camera.yaml:", key, "expected")

    def test_missing_keys_are_named(self):
        for key in REQUIRED:
            with self.subTest(key=key):
                self.assert_refused(self.run_with(self.edited(key, "")), "camera.yaml", f"{key} is missing")

    def test_every_error_has_a_line_of_its_own(self):
        text = self.text.replace("Camera.fx:", "Camera.gx:").replace("ThDepth: ", "ThDepth: -")
        result = self.run_with(text)
        self.assertEqual(result.returncode, 2)
        self.assert_says(result, "error", "ThDepth")
        self.assert_says(result, "error", "Camera.fx is missing", "Camera.gx")

    def test_what_is_no_settings_file(self):
        cases = {"empty": "", "blank": "\n\n", "no YAML": "camera: [unclosed\n",
                 "a picture": b"\x89PNG\r\n\x1a\n\0\0", "prose": "Camera is 320 wide.\n"}
        for name, content in cases.items():
            with self.subTest(name):
                result = self.run_with(content)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertEqual(result.stdout, "")
                self.assertTrue(result.stderr)
                for line in result.stderr.splitlines():
                    self.assertIn("camera.yaml", line)

    def test_file_that_cannot_be_read(self):
        self.assert_refused(self.run_tum(settings=self.path("nowhere.yaml")), "nowhere.yaml", "No such file")
        self.assert_refused(self.run_tum(settings=self.folder), self.folder, "directory")

    def test_without_the_line_that_opencv_wants_first(self):
        self.assertIn("%YAML", self.text)
        body = "".join(self.text.splitlines(keepends=True)[2:])
        self.assertNotIn("%YAML", body)
        self.assert_works(self.run_with(body))

    def test_windows_line_ends_comments_blank_lines_and_a_byte_order_mark(self):
        head, body = self.text.split("---\n")
        text = head + "---\n" + body.replace("\n", "   # a comment\n\n")
        self.assert_works(self.run_with("\ufeff" + text.replace("\n", "\r\n")))

    def test_tabs_are_refused_by_name(self):
        for line in ("Camera.fx:\t267.7\n", "\tCamera.fx: 267.7\n"):
            with self.subTest(line):
                self.assert_refused(self.run_with(self.edited("Camera.fx", line)), "camera.yaml:3: ", "tab")

    def test_unknown_key_is_warned_of(self):
        result = self.run_with(self.text + "Camera.fxx: 1\n")
        self.assert_works(result)
        self.assert_says(result, "warning", "Camera.fxx", "Camera.fx")
        self.assertEqual(len(self.report()["warnings"]), 1)

    def test_configurations_of_the_repository_are_read(self):
        """They are of 640 x 480: the settings are fine, and no frame is."""
        for name in sorted(os.listdir(os.path.join(ROOT, "config"))):
            with self.subTest(name):
                result = self.run_tum(settings=os.path.join(ROOT, "config", name))
                self.assertEqual(result.returncode, 2)
                self.assert_says(result, "Camera.width", "320", "640")
                self.assert_says(result, "error", "no frame")


if __name__ == "__main__":
    run_or_skip(None)
