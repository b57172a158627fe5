# SPDX-License-Identifier: GPL-3.0-or-later
"""What the end-to-end tests share: running rgbd_tum, and small sequences to spoil.

The build says by environment variables where things are: RGBD_TUM, the program; E2E_SEQUENCE, a synthetic
sequence of 40 frames of 320 x 240 that make_sequence wrote and nobody changes.
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

RGBD_TUM = os.environ.get("RGBD_TUM", "rgbd_tum")
SEQUENCE = os.environ.get("E2E_SEQUENCE", "")
ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
TIMEOUT_S = 120  # far more than any run takes: what reaches it hangs
SKIPPED = 77     # the exit code that ctest shows as skipped
OUTPUTS = ("CameraTrajectory.txt", "KeyFrameTrajectory.txt", "run.json", "settings.yaml")


def read(path):
    """The text of a file, its line ends as they are."""
    with open(path, encoding="utf-8", newline="") as file:
        return file.read()


def rows(path):
    """The lines of a file, each as its fields."""
    return [line.split() for line in read(path).splitlines()]


def run_or_skip(reason):
    """Runs the tests of the calling script, or says why not."""
    if reason:
        print(f"skipped: {reason}")
        sys.exit(SKIPPED)
    unittest.main()


class Sequence:
    """A sequence of the first frames of E2E_SEQUENCE in a folder of its own, its images links to spoil."""

    def __init__(self, folder, frames):
        self.folder = folder
        for part in ("rgb", "depth"):
            os.makedirs(self.path(part))
        self.entries = rows(os.path.join(SEQUENCE, "associations.txt"))[:frames]
        for _, rgb, _, depth in self.entries:
            os.symlink(os.path.join(SEQUENCE, rgb), self.path(rgb))
            os.symlink(os.path.join(SEQUENCE, depth), self.path(depth))
        self.settings = self.write("camera.yaml", read(os.path.join(SEQUENCE, "camera.yaml")))
        self.associations = self.write_associations(self.entries)
        for name, column in (("rgb.txt", 0), ("depth.txt", 2)):
            self.write(name, "".join(f"{entry[column]} {entry[column + 1]}\n" for entry in self.entries))

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        """Writes text or bytes in place of the file or link of this name, and returns the path."""
        if os.path.lexists(self.path(name)):
            os.remove(self.path(name))
        data = content.encode(errors="surrogateescape") if isinstance(content, str) else content
        with open(self.path(name), "wb") as file:
            file.write(data)
        return self.path(name)

    def write_associations(self, entries):
        return self.write("associations.txt", "".join(" ".join(entry) + "\n" for entry in entries))

    def rgb(self, frame):
        """The name of the colour image of a frame."""
        return self.entries[frame][1]

    def depth(self, frame):
        return self.entries[frame][3]


class RgbdTumTest(unittest.TestCase):
    """A test with a folder, a sequence (self.sequence) and an output folder of its own."""

    frames = 8

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbslam_e2e_")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.sequence = Sequence(self.path("sequence"), self.frames)
        self.output = self.path("output")

    def path(self, name):
        return os.path.join(self.folder, name)

    def command(self, *options, settings=None, sequence=None, associations=None, output=None,
                vocabulary="-"):
        """How rgbd_tum is called on this test's sequence, unless something else is given."""
        return [RGBD_TUM, vocabulary, settings or self.sequence.settings, sequence or self.sequence.folder,
                associations or self.sequence.associations, "--output-dir", output or self.output, *options]

    def run_tum(self, *options, preexec_fn=None, **arguments):
        """Runs it; the result has stdout, stderr and returncode. A crash or a hang fails the test."""
        return self.finish(self.command(*options, **arguments), preexec_fn=preexec_fn)

    def finish(self, command, **options):
        result = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=TIMEOUT_S,
                                check=False, **options)
        self.assertGreaterEqual(result.returncode, 0, f"died of signal {-result.returncode}: {result.stderr}")
        return result

    def report(self, output=None):
        return json.loads(read(os.path.join(output or self.output, "run.json")))

    def trajectory(self, name="CameraTrajectory.txt", output=None):
        """The lines of a trajectory of the run, each as its fields."""
        return rows(os.path.join(output or self.output, name))

    def assert_works(self, result, tracked=None, skipped=0):
        """Exit code 0, all outputs written, and poses for all frames but those skipped."""
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in OUTPUTS:
            self.assertTrue(os.path.isfile(os.path.join(self.output, name)), name)
        tracked = self.frames - skipped if tracked is None else tracked
        counts = self.report()["frames"]
        self.assertEqual((counts["tracked"], counts["skipped"]), (tracked, skipped), result.stderr)
        self.assertEqual(len(self.trajectory()), tracked)

    def assert_refused(self, result, *words):
        """Exit code 2 and on stderr a single line, which holds the words."""
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assert_says(result, *words)

    def assert_says(self, result, *words):
        """One line of stderr holds all the words."""
        lines = result.stderr.splitlines()
        self.assertTrue(any(all(str(word) in line for word in words) for line in lines),
                        f"no line with {words} in:\n{result.stderr}")
