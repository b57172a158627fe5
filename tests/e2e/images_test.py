# SPDX-License-Identifier: GPL-3.0-or-later
"""Images that are missing, spoilt, odd or useless."""
import io
import os

import numpy as np
from PIL import Image

from support import OUTPUTS, RgbdTumTest, run_or_skip

HEIGHT, WIDTH = 240, 320


def encoded(image, kind="PNG"):
    """The bytes of a file of the picture, given as array or PIL image."""
    image = image if isinstance(image, Image.Image) else Image.fromarray(image)
    buffer = io.BytesIO()
    image.save(buffer, kind)
    return buffer.getvalue()


def depth_image(value, height=HEIGHT, width=WIDTH):
    return encoded(np.full((height, width), value, np.uint16))


class Images(RgbdTumTest):
    def open(self, name):
        with Image.open(self.sequence.path(name)) as image:
            image.load()
            return image

    def bytes(self, name):
        with open(self.sequence.path(name), "rb") as file:
            return file.read()

    def bad_files(self):
        """name of the case -> (is it the depth image?, content, a word of the warning)"""
        color, depth = self.open(self.sequence.rgb(3)), self.open(self.sequence.depth(3))
        png, jpeg, depth_png = encoded(color), encoded(color, "JPEG"), self.bytes(self.sequence.depth(3))
        gray = np.asarray(color.convert("L"))
        return {
            "empty": (False, b"", "empty"), "prose": (False, b"not an image at all\n", "PNG"),
            "truncated PNG": (False, png[:len(png) // 2], ""), "PNG's header": (False, png[:8], ""),
            "truncated JPEG": (False, jpeg[:len(jpeg) // 2], "truncated"),
            "JPEG's header": (False, jpeg[:4], ""),
            "spoilt PNG": (False, png[:len(png) // 2] + bytes(64) + png[len(png) // 2 + 64:], ""),
            "another size": (False, encoded(color.resize((160, 120))), "160 x 120"),
            "a row less": (False, encoded(color.crop((0, 0, WIDTH, HEIGHT - 1))), "320 x 239"),
            "16 bit": (False, encoded(gray.astype(np.uint16)), "16 bit"),
            "CMYK": (False, encoded(color.convert("CMYK"), "JPEG"), "CMYK"),
            "truncated depth": (True, depth_png[:len(depth_png) // 2], ""),
            "depth of 8 bit": (True, encoded(gray), "8 bit"), "depth in colour": (True, png, "channel"),
            "JPEG for depth": (True, jpeg, "JPEG"), "empty depth": (True, b"", "empty"),
            "depth of another size": (True, depth_image(5000, 120, 160), "160 x 120"),
        }

    def test_bad_image_is_skipped_counted_and_warned_of(self):
        for name, (is_depth, content, word) in self.bad_files().items():
            with self.subTest(name):
                victim = self.sequence.depth(3) if is_depth else self.sequence.rgb(3)
                original = self.bytes(victim)
                self.sequence.write(victim, content)
                result = self.run_tum()
                self.assert_works(result, skipped=1)
                self.assert_says(result, "warning", victim, word)
                self.assertNotIn(self.sequence.entries[3][0], [line[0] for line in self.trajectory()])
                self.sequence.write(victim, original)

    def test_missing_image_or_folder_in_its_place(self):
        os.remove(self.sequence.path(self.sequence.rgb(2)))
        os.remove(self.sequence.path(self.sequence.depth(5)))
        os.mkdir(self.sequence.path(self.sequence.depth(5)))
        result = self.run_tum()
        self.assert_works(result, skipped=2)
        self.assert_says(result, "warning", self.sequence.rgb(2), "No such file")
        self.assert_says(result, "warning", self.sequence.depth(5), "directory")

    def test_bad_first_image_only_starts_later(self):
        self.sequence.write(self.sequence.rgb(0), b"")
        self.assert_works(self.run_tum(), skipped=1)

    def test_nothing_left_is_an_error_that_does_not_drown_the_screen(self):
        for _, rgb, _, _ in self.sequence.entries:
            self.sequence.write(rgb, b"")
        result = self.run_tum()
        self.assertEqual(result.returncode, 2)
        self.assert_says(result, "error", self.sequence.folder, "no frame")
        self.assertLess(result.stderr.count("warning"), self.frames)
        self.assertEqual(self.report()["frames"]["skipped"], self.frames)

    def spoil_all(self, column, content):
        for entry in self.sequence.entries:
            self.sequence.write(entry[column], content)

    def assert_no_pose(self, result):
        """Exit code 2 with a reason, and all outputs there, the trajectories without a line."""
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assert_says(result, "error", self.sequence.folder, "no camera pose")
        self.assertEqual(sorted(os.listdir(self.output)), sorted(OUTPUTS))
        self.assertEqual(self.trajectory() + self.trajectory("KeyFrameTrajectory.txt"), [])
        self.assertEqual(self.report()["frames"]["processed"], self.frames)

    def test_depth_that_measures_nothing(self):
        for value in (0, 65535):
            with self.subTest(depth=value):
                self.spoil_all(3, depth_image(value))
                self.assert_no_pose(self.run_tum())

    def test_images_that_show_nothing(self):
        for value in (0, 255):
            with self.subTest(gray=value):
                self.spoil_all(1, encoded(np.full((HEIGHT, WIDTH, 3), value, np.uint8)))
                self.assert_no_pose(self.run_tum())

    def test_dark_frame_in_between_is_lost_and_the_next_found_again_or_not_but_nothing_breaks(self):
        self.sequence.write(self.sequence.rgb(4), encoded(np.zeros((HEIGHT, WIDTH, 3), np.uint8)))
        self.sequence.write(self.sequence.depth(5), depth_image(0))
        result = self.run_tum()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.report()["frames"]["processed"], self.frames)

    def test_kinds_of_images_that_must_simply_work(self):
        def with_alpha(image):
            image.putalpha(128)
            return image
        kinds = {"gray": (lambda image: image.convert("L"), "PNG"), "RGBA": (with_alpha, "PNG"),
                 "gray and alpha": (lambda image: with_alpha(image.convert("L")), "PNG"),
                 "palette": (lambda image: image.quantize(256), "PNG"), "JPEG": (lambda image: image, "JPEG"),
                 "gray JPEG": (lambda image: image.convert("L"), "JPEG")}
        colors = [self.open(entry[1]) for entry in self.sequence.entries]
        for name, (convert, kind) in kinds.items():
            with self.subTest(name):
                for entry, color in zip(self.sequence.entries, colors):
                    self.sequence.write(entry[1], encoded(convert(color.copy()), kind))
                result = self.run_tum()
                self.assert_works(result)
                self.assertNotIn("warning", result.stderr)

    def test_gray_pngs_give_what_their_colours_give(self):
        """Alpha and a constant factor between channels change no gray level, so they change no pose."""
        self.run_tum("--sequential")
        for entry in self.sequence.entries:
            color = self.open(entry[1])
            color.putalpha(7)
            self.sequence.write(entry[1], encoded(color))
        again = self.path("again")
        self.run_tum("--sequential", output=again)
        self.assertEqual(self.trajectory(), self.trajectory(output=again))


if __name__ == "__main__":
    run_or_skip(None)
