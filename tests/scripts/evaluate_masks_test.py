#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of the figures of masks, and the command line of evaluate_masks.py."""
import csv
import json
import os
import unittest

import numpy as np
from PIL import Image

from support import ScriptTest, run_script
from evaluate_masks import BORDER_PX, FIGURES, count_pixels, dilate

HEIGHT, WIDTH = 60, 80


def box(top, left, bottom, right):
    mask = np.zeros((HEIGHT, WIDTH), bool)
    mask[top:bottom, left:right] = True
    return mask


NOTHING, FIGURE = box(0, 0, 0, 0), box(20, 30, 40, 50)


class MaskLawsTest(ScriptTest):
    def random_blob(self):
        return self.random.random((HEIGHT, WIDTH)) < 0.01

    def test_dilation_reaches_all_pixels_of_the_distance_and_no_other(self):
        rows, columns = np.indices((HEIGHT, WIDTH))
        for radius in (0, 1, 3, BORDER_PX):
            mask = self.random_blob()
            points = np.argwhere(mask)
            squared = ((rows[..., None] - points[:, 0]) ** 2 + (columns[..., None] - points[:, 1]) ** 2)
            np.testing.assert_array_equal(dilate(mask, radius), squared.min(axis=2) <= radius ** 2)

    def test_perfect_masks_are_perfect(self):
        figures = count_pixels(FIGURE, FIGURE, FIGURE).figures()
        self.assertEqual(figures, {"precision": 1, "recall": 1, "iou": 1, "wrongly_masked": 0})

    def test_empty_masks_recall_nothing_and_have_no_precision(self):
        figures = count_pixels(NOTHING, FIGURE, FIGURE).figures()
        self.assertEqual(figures, {"precision": None, "recall": 0, "iou": 0, "wrongly_masked": 0})

    def test_the_border_counts_neither_way(self):
        border = dilate(FIGURE, BORDER_PX) & ~FIGURE
        for _ in range(20):
            masked = self.random.random(FIGURE.shape) < 0.3
            other = np.where(border, self.random.random(FIGURE.shape) < 0.5, masked)
            self.assertEqual(count_pixels(masked, FIGURE, FIGURE).figures(),
                             count_pixels(other, FIGURE, FIGURE).figures())

    def test_eight_pixels_outside_are_border_and_the_ninth_is_wrong(self):
        for gap, wrong in ((8, 0), (9, 1)):
            pixel = box(30, 30 - gap, 31, 31 - gap)
            self.assertEqual(count_pixels(FIGURE | pixel, FIGURE, FIGURE).wrong, wrong)

    def test_who_pauses_may_be_masked_and_need_not_be(self):
        paused = box(20, 30, 40, 40)
        moving = FIGURE & ~paused
        for masked in (moving, FIGURE):
            figures = count_pixels(masked, moving, FIGURE).figures()
            self.assertEqual(figures, {"precision": 1, "recall": 1, "iou": 1, "wrongly_masked": 0})

    def test_what_moves_can_move_whatever_the_other_folder_says(self):
        self.assertEqual(count_pixels(FIGURE, FIGURE, NOTHING), count_pixels(FIGURE, FIGURE, FIGURE))

    def test_a_shifted_mask_has_the_figures_of_its_overlap(self):
        side, shift = 20, 12
        counts = count_pixels(box(20, 30 + shift, 40, 50 + shift), FIGURE, FIGURE)
        hit, wrong = side * (side - shift), side * (shift - BORDER_PX)
        figures = counts.figures()
        self.assertEqual((counts.hit, counts.wrong), (hit, wrong))
        self.assertAlmostEqual(figures["recall"], hit / side ** 2)
        self.assertAlmostEqual(figures["precision"], hit / (hit + wrong))
        self.assertAlmostEqual(figures["iou"], hit / (side ** 2 + wrong))

    def test_counts_add_up(self):
        for _ in range(20):
            masked, moving = self.random_blob(), self.random_blob()
            a, b = count_pixels(masked, moving, moving), count_pixels(FIGURE, FIGURE, FIGURE)
            total = a + b
            self.assertEqual((total.hit, total.wrong, total.static), (a.hit + b.hit, a.wrong + b.wrong,
                                                                      a.static + b.static))
            self.assertLessEqual(a.right + a.wrong, a.masked)


class MaskScriptTest(ScriptTest):
    def setUp(self):
        super().setUp()
        self.stems = [f"{i / 30:.6f}" for i in range(12)]
        for part in ("rgb", "mask", "mask_moving", "masks"):
            os.makedirs(self.path(part))
        self.write("rgb.txt", "".join(f"{stem} rgb/{stem}.png\n" for stem in self.stems))
        for i, stem in enumerate(self.stems):
            self.save_image("rgb", stem, NOTHING)
            self.save_image("mask", stem, FIGURE)
            self.save_image("mask_moving", stem, FIGURE if i >= 2 else NOTHING)
            self.save_image("masks", stem, FIGURE if i >= 6 else NOTHING)

    def save_image(self, folder, stem, mask, value=255):
        Image.fromarray(value * mask.astype(np.uint8)).save(self.path(f"{folder}/{stem}.png"))

    def evaluate(self, *options):
        return run_script("evaluate_masks.py", self.path("masks"), self.folder, *options)

    def result(self, *options):
        result = self.evaluate("--json", "-", *options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return json.loads(result.stdout)

    def test_overall_figures_are_those_of_the_sums(self):
        result = self.result()
        self.assertEqual([result[name] for name in FIGURES], [1, 0.6, 0.6, 0])
        self.assertEqual((result["frames"], result["frames_counted"], result["masks_missing"]), (12, 12, 0))
        self.assertEqual(self.evaluate().stdout.count("\n"), 1)
        self.assertIn("precision 100.00 %, recall 60.00 %", self.evaluate().stdout)

    def test_beginnings_of_motion_can_be_left_out(self):
        for settled, counted in ((1, 10), (5, 6), (10, 1)):
            self.assertEqual(self.result("--min-moving-frames", settled)["frames_counted"], counted)
        self.assertEqual(self.result("--min-moving-frames", 5)["recall"], 1)
        self.assertIsNone(self.result("--min-moving-frames", 99)["recall"])

    def test_a_missing_mask_masks_nothing_and_is_told(self):
        for stem in self.stems[6:]:
            os.remove(self.path(f"masks/{stem}.png"))
        result = self.evaluate()
        self.assertIn("recall 0.00 %", result.stdout)
        self.assertIn("6 masks missing", result.stdout)

    def test_any_value_but_zero_is_masked(self):
        for stem in self.stems[6:]:
            self.save_image("masks", stem, FIGURE, 1)
        Image.fromarray(FIGURE).convert("RGBA").save(self.path(f"masks/{self.stems[6]}.png"))
        Image.new("RGBA", (WIDTH, HEIGHT), (0, 0, 0, 255)).save(self.path(f"masks/{self.stems[0]}.png"))
        Image.fromarray(FIGURE.astype(np.uint8)).convert("P").save(self.path(f"masks/{self.stems[7]}.png"))
        result = self.result()
        self.assertEqual((result["recall"], result["wrongly_masked"]), (0.6, 0))

    def test_where_nothing_moves_all_that_is_masked_is_wrong(self):
        result = self.result("--static")
        self.assertEqual(result["wrongly_masked"], 6 * FIGURE.sum() / (12 * FIGURE.size))
        self.assertNotIn("recall", self.evaluate("--static").stdout)

    def test_writes_each_frame_and_a_figure(self):
        self.evaluate("--per-frame", self.path("frames.csv"), "--plot", self.path("plot.png"),
                      "--max-frames", 8)
        with open(self.path("frames.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["frame"] for row in rows], self.stems[:8])
        self.assertEqual([row["recall"] for row in rows], ["", "", *4 * ["0.000000"], *2 * ["1.000000"]])
        with Image.open(self.path("plot.png")) as image:
            self.assertEqual(image.format, "PNG")

    def test_bad_input_is_refused_in_one_line(self):
        self.assert_refused(run_script("evaluate_masks.py", self.path("no"), self.folder), self.path("no"))
        self.assert_refused(run_script("evaluate_masks.py", self.path("masks"), self.path("no")), "no such")
        self.assert_refused(run_script("evaluate_masks.py", self.path("masks"), self.path("rgb")), "mask/")
        self.assert_refused(self.evaluate("--min-moving-frames", "-1"), "-1")
        self.assert_refused(self.evaluate("--static", "--min-moving-frames", "5"), "--static")
        self.assert_refused(self.evaluate("--plot", "x.txt"), ".png")
        self.assert_refused(self.evaluate("--json", self.path("no/x.json")), "no/x.json")

    def test_bad_images_are_refused_in_one_line(self):
        first = f"{self.stems[0]}.png"
        Image.fromarray(np.zeros((3, 4), np.uint8)).save(self.path(f"masks/{first}"))
        self.assert_refused(self.evaluate(), first, "4 x 3")
        self.write(f"masks/{first}", "no image")
        self.assert_refused(self.evaluate(), first, "no image")
        with open(self.path(f"mask/{first}"), "rb") as file:
            content = file.read()
        with open(self.path(f"masks/{first}"), "wb") as file:
            file.write(content[:60])
        self.assert_refused(self.evaluate(), first, "damaged")
        os.remove(self.path(f"mask_moving/{first}"))
        self.assert_refused(self.evaluate(), f"mask_moving/{first}")


if __name__ == "__main__":
    unittest.main()
