# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps that are saved, loaded and localised in; map and vocabulary files that are wrong."""
import io
import os

import numpy as np
from PIL import Image

from support import ROOT, RgbdTumTest, run_or_skip

VOCABULARY = os.path.join(ROOT, "Vocabulary", "orbslam.bin")


def read_bytes(path):
    with open(path, "rb") as file:
        return file.read()


def spoilt(content):
    """name of the case -> content that is not what was written"""
    middle = len(content) // 2
    flipped = bytes([content[middle] ^ 1])
    return {"empty": b"", "prose": b"not what was asked for\n", "header": content[:12],
            "truncated": content[:middle], "a byte less": content[:-1], "longer": content + b"\0",
            "one bit": content[:middle] + flipped + content[middle + 1:]}


class Maps(RgbdTumTest):
    frames = 40

    def setUp(self):
        super().setUp()
        self.map = self.path("room.map")

    def save_map(self, *options):
        self.assert_works(self.run_tum("--sequential", "--save-map", self.map, *options))

    def test_saved_map_repeats(self):
        self.save_map()
        first = read_bytes(self.map)
        self.save_map()
        self.assertTrue(first)
        self.assertEqual(read_bytes(self.map), first)

    def test_localising_finds_the_same_poses_and_leaves_the_map(self):
        """The second run starts in the first one's world: both trajectories agree without an alignment."""
        self.save_map()
        before = np.array([line[1:4] for line in self.trajectory()], float)
        keyframes = self.report()["map"]["keyframes"]
        again = self.path("again")
        result = self.run_tum("--sequential", "--load-map", self.map, "--localization", output=again)
        self.assertEqual(result.returncode, 0, result.stderr)
        after = np.array([line[1:4] for line in self.trajectory(output=again)], float)
        self.assertEqual(self.report(again)["map"]["keyframes"], keyframes)
        self.assertEqual(len(after), len(before))
        self.assertLess(np.sqrt(np.mean(np.sum((after - before) ** 2, axis=1))), 0.02)  # m

    def test_localising_elsewhere_says_so(self):
        self.save_map()
        with Image.open(self.sequence.path(self.sequence.entries[0][1])) as image:
            noise = np.random.default_rng(1).integers(0, 256, (image.height, image.width, 3), np.uint8)
        content = io.BytesIO()
        Image.fromarray(noise).save(content, "PNG")
        for entry in self.sequence.entries:
            self.sequence.write(entry[1], content.getvalue())
        result = self.run_tum("--sequential", "--load-map", self.map, "--localization")
        self.assertEqual(result.returncode, 2)
        self.assert_says(result, "error", self.sequence.folder, "no image shows a place of the loaded map")

    def test_localising_wants_a_map(self):
        self.assert_refused(self.run_tum("--localization"), "--load-map")

    def test_map_files_that_are_wrong(self):
        self.save_map()
        content = read_bytes(self.map)
        for name, bad in spoilt(content).items():
            with self.subTest(name):
                result = self.run_tum("--load-map", self.sequence.write("bad.map", bad))
                self.assert_refused(result, "bad.map")
        missing = self.run_tum("--load-map", self.path("nowhere.map"))
        self.assert_refused(missing, "nowhere.map", "No such file")
        self.assert_refused(self.run_tum("--load-map", self.folder), self.folder, "directory")

    def test_map_that_cannot_be_saved_costs_nothing_else(self):
        for path in ("/dev/full", os.path.join(self.sequence.settings, "room.map"), self.folder):
            with self.subTest(path):
                result = self.run_tum("--save-map", path)
                self.assertEqual(result.returncode, 2)
                self.assert_says(result, "error", path)
                self.assertEqual(len(self.trajectory()), self.frames)


class Vocabularies(RgbdTumTest):
    def test_the_one_that_comes_with_the_project(self):
        self.assert_works(self.run_tum(vocabulary=VOCABULARY))

    def test_files_that_are_wrong(self):
        content = read_bytes(VOCABULARY)
        for name, bad in spoilt(content).items():
            with self.subTest(name):
                result = self.run_tum(vocabulary=self.sequence.write("bad.bin", bad))
                self.assert_refused(result, "bad.bin")

    def test_text_that_ends_early(self):
        node = "0 0 " + " ".join(["7"] * 32) + " 0\n"
        result = self.run_tum(vocabulary=self.sequence.write("voc.txt", "10 6 0 0\n" + 10 * node))
        self.assert_refused(result, "voc.txt")


if __name__ == "__main__":
    run_or_skip(None)
