#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands in for make_sequence and rgbd_tum, as which it is called, in tests of the scripts that run them.

Estimates are the ground truth with made-up errors of STUB_WITHOUT_M and STUB_WITH_M; masks are the true ones.
Masks of --mask-dir that hide something make errors 1.5 times as large.
With the switch freeSpace off errors are ten times as large and no masks written. It fails if the settings
hold `fail`.
"""
import argparse
import json
import os
import pathlib
import random
import shutil
import sys

SETTINGS = {"Camera.fps": 30.0, "ORBextractor.nFeatures": 1000, "DynamicDetector.enabled": True, "DynamicDetector.freeSpace": True,
            "DynamicDetector.minPoints": 1, "Tracking.other": True}


def save_masks(folder, with_figure):
    from PIL import Image
    image = Image.new("L", (32, 24))
    image.save(folder / "black.png")
    if with_figure:
        image.paste(255, (5, 5, 10, 10))
    image.save(folder / "mask.png")


def make_sequence():
    parser = argparse.ArgumentParser()
    for name in ("--script", "--motion", "--seed", "--frames", "--out"):
        parser.add_argument(name, required=True)
    parser.add_argument("--quiet", action="store_true")
    args = parser.parse_args()
    if args.script == "unknown":
        sys.exit("make_sequence: --script: unknown is no script")
    folder = pathlib.Path(args.out)
    for part in ("rgb", "mask", "mask_moving"):
        (folder / part).mkdir()
    save_masks(folder, args.script != "static")
    walk = random.Random(int(args.seed))
    position = [0.0, 0.0, 0.0]
    truth, rgb = "", ""
    for i in range(int(args.frames)):
        position = [x + walk.gauss(0, 0.02) for x in position]
        stamp = f"{i / 30:.6f}"
        rgb += f"{stamp} rgb/{stamp}.png\n"
        truth += f"{stamp} " + " ".join(f"{x:.6f}" for x in position) + " 0 0 0 1\n"
        for part, image in (("rgb", "black.png"), ("mask", "mask.png"), ("mask_moving", "mask.png")):
            os.link(folder / image, folder / part / f"{stamp}.png")
    for name, text in (("rgb.txt", rgb), ("groundtruth.txt", truth), ("camera.yaml", "Camera.fps: 30\n")):
        (folder / name).write_text(text)


def has_figure(masks):
    from PIL import Image
    return Image.open(min(masks.iterdir())).getbbox() is not None


def error_m(settings, without):
    if without or "DynamicDetector.enabled: 0" in settings:
        return float(os.environ["STUB_WITHOUT_M"])
    return float(os.environ["STUB_WITH_M"]) * (10 if "DynamicDetector.freeSpace: 0" in settings else 1)


def rgbd_tum():
    parser = argparse.ArgumentParser()
    for name in ("vocabulary", "settings", "sequence"):
        parser.add_argument(name)
    for name in ("--output-dir", "--save-masks", "--mask-dir"):
        parser.add_argument(name)
    for name in ("--sequential", "--quiet", "--no-detector"):
        parser.add_argument(name, action="store_true")
    parser.add_argument("--max-frames", type=int)
    args = parser.parse_args()
    settings = pathlib.Path(args.settings).read_text()
    if "fail" in settings and not args.no_detector:
        sys.exit("warning: something\nrgbd_tum: nothing was tracked")
    output, sequence = pathlib.Path(args.output_dir), pathlib.Path(args.sequence)
    truth = (sequence / "groundtruth.txt").read_text().splitlines()
    rows = [line.split() for line in truth[:args.max_frames]]
    noise, sigma_m = random.Random(1), error_m(settings, args.no_detector)
    if args.mask_dir:  # masks of others cost half as much again
        sigma_m *= 1.5 if has_figure(pathlib.Path(args.mask_dir)) else 1
    estimate = [[row[0], *(f"{float(x) + noise.gauss(0, sigma_m):.6f}" for x in row[1:4]), *row[4:]]
                for row in rows]
    (output / "CameraTrajectory.txt").write_text("".join(" ".join(row) + "\n" for row in estimate))
    values = {key: f"{key}: {int(value)}  # what it is\n" for key, value in SETTINGS.items()}
    (output / "settings.yaml").write_text("%YAML:1.0\n---\n" + "".join(values.values()))
    per_frame = {"detector_latency_s": [0.01] * len(rows), "masked_share": [0.25] * len(rows),
                 "fail_open": ["lost"] + [""] * (len(rows) - 1)}
    (output / "run.json").write_text(json.dumps({"settings": SETTINGS, "per_frame": per_frame}))
    if args.save_masks and "freeSpace: 0" not in settings:
        shutil.copytree(sequence / "mask_moving", args.save_masks)


if __name__ == "__main__":
    {"make_sequence": make_sequence, "rgbd_tum": rgbd_tum}[os.path.basename(sys.argv[0])]()
