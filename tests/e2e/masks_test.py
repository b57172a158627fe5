# SPDX-License-Identifier: GPL-3.0-or-later
"""Masks of moving objects: made by others, written out, and the detector's switches."""
import os

import numpy as np
from PIL import Image

from support import RgbdTumTest, read, run_or_skip


class Masks(RgbdTumTest):
    frames = 12
    left_third = slice(0, 107)

    def write_masks(self, entries=None, size=(240, 320)):
        folder = self.path("masks")
        os.makedirs(folder, exist_ok=True)
        for entry in self.sequence.entries if entries is None else entries:
            mask = np.zeros(size, np.uint8)
            mask[:, self.left_third] = 1
            Image.fromarray(mask).save(os.path.join(folder, self.mask_name(entry)))
        return folder

    @staticmethod
    def mask_name(entry):
        return os.path.splitext(os.path.basename(entry[1]))[0] + ".png"

    def saved_mask(self, entry):
        return np.asarray(Image.open(os.path.join(self.path("saved"), self.mask_name(entry))))

    def test_masks_of_others_are_widened_used_and_written_out(self):
        masks = self.write_masks()
        for margin in (0, 8):
            settings = self.sequence.write("margin.yaml",
                                           read(self.sequence.settings) + f"\nMasks.margin: {margin}\n")
            self.assert_works(self.run_tum("--no-detector", "--mask-dir", masks, "--save-masks",
                                           self.path("saved"), settings=settings))
            columns = self.report()["per_frame"]
            for share, dropped in zip(columns["masked_share"], columns["keypoints_dropped"]):
                self.assertAlmostEqual(share, (107 + margin) / 320, places=6)
                self.assertGreater(dropped, 0)
            self.assertEqual(len(os.listdir(self.path("saved"))), self.frames)
            for entry in self.sequence.entries:
                mask = self.saved_mask(entry)
                self.assertTrue((mask[:, :107 + margin] == 255).all() and (mask[:, 107 + margin:] == 0).all())

    def test_masks_of_others_are_united_with_the_detectors(self):
        self.assert_works(self.run_tum("--mask-dir", self.write_masks(), "--save-masks", self.path("saved")))
        for entry in self.sequence.entries:
            self.assertTrue((self.saved_mask(entry)[:, self.left_third] == 255).all())

    def test_a_mask_that_misses_or_is_broken_is_warned_of(self):
        masks = self.write_masks(self.sequence.entries[:-2])
        with open(os.path.join(masks, self.mask_name(self.sequence.entries[-1])), "w", encoding="utf-8") as file:
            file.write("no picture")
        result = self.run_tum("--no-detector", "--mask-dir", masks)
        self.assert_works(result)
        self.assertEqual(self.report()["per_frame"]["masked_share"][-2:], [0, 0])
        for entry in self.sequence.entries[-2:]:
            self.assert_says(result, "no mask for a frame", self.mask_name(entry))

    def test_a_folder_that_cannot_serve_is_refused(self):
        self.assert_refused(self.run_tum("--mask-dir", self.path("nowhere")), self.path("nowhere"), "folder")
        os.makedirs(self.path("masks"))
        self.assert_refused(self.run_tum("--mask-dir", self.path("masks")), "has no mask for any image")
        blocked = self.sequence.write("file", "")
        self.assert_refused(self.run_tum("--save-masks", blocked), blocked)

    def test_the_detector_can_be_switched_off_in_two_ways_that_are_the_same(self):
        self.assert_works(self.run_tum("--sequential", "--no-detector"))
        self.assertNotIn("detect", self.report()["timings"])
        by_option = read(os.path.join(self.output, "CameraTrajectory.txt"))
        settings = self.sequence.write("off.yaml",
                                       read(self.sequence.settings) + "\nDynamicDetector.enabled: 0\n")
        self.assert_works(self.run_tum("--sequential", settings=settings))
        self.assertNotIn("detect", self.report()["timings"])
        self.assertEqual(read(os.path.join(self.output, "CameraTrajectory.txt")), by_option)

    def test_the_report_tells_of_the_detector(self):
        self.assert_works(self.run_tum())
        report = self.report()
        self.assertEqual(report["timings"]["detect"]["count"], self.frames)
        columns = report["per_frame"]
        for name in ("masked_share", "keypoints_dropped", "detector_latency_s", "fail_open", "objects"):
            self.assertEqual(len(columns[name]), self.frames, name)
        self.assertTrue(all(latency > 0 for latency in columns["detector_latency_s"]))


if __name__ == "__main__":
    run_or_skip(None)
