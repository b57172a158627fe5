#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Precision, recall and IoU of masks of what moves, against a sequence's ground truth.

MASKS_DIR holds a PNG per frame, named like the colour image (STEM.png), non-zero = masked; where there is
none, nothing is masked. The sequence has two folders of the same naming: mask_moving/, what moves at this
moment, and mask/, what can move (a person who stands still may stay masked). Pixels are of four kinds:

  moving    in mask_moving/                      hit: masked; missed: not masked
  movable   in mask/ only                        right if masked, but need not be
  border    up to 8 px (Euclidean) outside       counts neither way
  static    all others                           wrong if masked

  precision       masked in mask/ / (masked in mask/ + wrong)
  recall          hit / (hit + missed)
  IoU             hit / (hit + missed + wrong): what may be masked or not counts neither way
  wrongly masked  wrong / static

Figures of several frames are those of the sums of their pixels.
"""
import argparse
import os
from dataclasses import astuple, dataclass, fields

import numpy as np

import command_line
from trajectory import InputError, read_rows

BORDER_PX = 8
FIGURES = ("precision", "recall", "iou", "wrongly_masked")


@dataclass
class PixelCounts:
    """Pixels of a frame, or of many."""
    moving: int = 0   # in mask_moving/
    hit: int = 0      # moving and masked
    masked: int = 0
    right: int = 0    # masked, in mask/
    static: int = 0
    wrong: int = 0    # static and masked

    def __add__(self, other):
        return PixelCounts(*(a + b for a, b in zip(astuple(self), astuple(other))))

    def figures(self):
        """The ratios of the module's docstring; None where there is nothing to divide by."""
        def ratio(part, whole):
            return part / whole if whole else None
        return {"precision": ratio(self.right, self.right + self.wrong),
                "recall": ratio(self.hit, self.moving),
                "iou": ratio(self.hit, self.moving + self.wrong),
                "wrongly_masked": ratio(self.wrong, self.static)}


@dataclass
class Frame:
    """What was counted in a frame."""
    stem: str
    pixels: PixelCounts
    has_mask: bool        # a file; otherwise nothing is masked
    counts: bool = True   # into the overall figures


def shifted(mask, offset, axis):
    """The mask moved by offset pixels along the axis; what comes in is False."""
    result = np.zeros_like(mask)
    target, source = [slice(None)] * 2, [slice(None)] * 2
    target[axis] = slice(max(offset, 0), mask.shape[axis] + min(offset, 0))
    source[axis] = slice(max(-offset, 0), mask.shape[axis] - max(offset, 0))
    result[tuple(target)] = mask[tuple(source)]
    return result


def dilate(mask, radius):
    """Pixels at most radius px, Euclidean, from one of the mask, (h, w) bool: a disc of horizontal runs."""
    runs = [mask]
    for _ in range(radius):
        runs.append(runs[-1] | shifted(runs[-1], 1, 1) | shifted(runs[-1], -1, 1))
    result = np.zeros_like(mask)
    for dy in range(-radius, radius + 1):
        result |= shifted(runs[int(np.sqrt(radius ** 2 - dy ** 2))], dy, 0)
    return result


def count_pixels(masked, moving, movable):
    """Counts one frame; all three (h, w) bool. What moves can move, whatever mask/ says."""
    movable = movable | moving
    static = ~dilate(movable, BORDER_PX)
    sets = (moving, masked & moving, masked, masked & movable, static, masked & static)
    return PixelCounts(*(int(np.count_nonzero(pixels)) for pixels in sets))


def open_image(path):
    """The image, not decoded yet; InputError if it is none."""
    from PIL import Image, UnidentifiedImageError
    try:
        return Image.open(path)
    except UnidentifiedImageError as error:
        raise InputError(f"{path}: is no image; write it anew") from error


def read_mask(path):
    """The non-zero pixels, (h, w) bool, of an image of any mode; an alpha channel does not count."""
    image = open_image(path)
    try:
        if image.mode in ("P", "PA"):
            image = image.convert("RGB")
        pixels = np.asarray(image)
    except (OSError, SyntaxError, ValueError) as error:
        raise InputError(f"{path}: is damaged; write it anew") from error
    channels = [pixels[..., channel] for channel, name in enumerate(image.getbands()) if name != "A"] \
        if pixels.ndim == 3 else [pixels]
    return np.any([channel != 0 for channel in channels], axis=0)


def read_rgb_files(sequence):
    """The colour images of a sequence as its associations.txt lists them, else its rgb.txt, else by name."""
    for name in ("associations.txt", "rgb.txt"):
        path = os.path.join(sequence, name)
        if os.path.isfile(path):
            files = [row[1] for _, row in read_rows(path) if len(row) > 1]
            break
    else:
        folder = os.path.join(sequence, "rgb")
        if not os.path.isdir(folder):
            raise InputError(f"{sequence}: no sequence; expected associations.txt, rgb.txt or rgb/ in it")
        files = [os.path.join("rgb", name) for name in sorted(os.listdir(folder))]
    if not files:
        raise InputError(f"{sequence}: lists no frame")
    return files


def stem_of(file):
    return os.path.splitext(os.path.basename(file))[0]


class GroundTruth:
    """The true masks of a sequence; of one in which nothing can move, empty ones."""

    def __init__(self, sequence, is_static):
        self.sequence, self.is_static = sequence, is_static
        for name in () if is_static else ("mask", "mask_moving"):
            if not os.path.isdir(os.path.join(sequence, name)):
                raise InputError(f"{sequence}: has no {name}/; if nothing moves in it, say --static")

    def read(self, rgb_file):
        """What moves, what can move: (h, w) bool each."""
        if self.is_static:
            with open_image(os.path.join(self.sequence, rgb_file)) as image:
                nothing = np.zeros(image.size[::-1], bool)
            return nothing, nothing
        name = stem_of(rgb_file) + ".png"
        moving, movable = (read_mask(os.path.join(self.sequence, part, name))
                           for part in ("mask_moving", "mask"))
        if moving.shape != movable.shape:
            raise InputError(f"{self.sequence}: mask/ and mask_moving/ differ in size at {name}")
        return moving, movable


def evaluate_frame(masks_dir, truth, rgb_file):
    """Counts the pixels of one frame."""
    moving, movable = truth.read(rgb_file)
    path = os.path.join(masks_dir, stem_of(rgb_file) + ".png")
    has_mask = os.path.exists(path)
    masked = read_mask(path) if has_mask else np.zeros_like(moving)
    if masked.shape != moving.shape:
        raise InputError(f"{path}: is {masked.shape[1]} x {masked.shape[0]} px, but the sequence "
                         f"{moving.shape[1]} x {moving.shape[0]}")
    return Frame(stem_of(rgb_file), count_pixels(masked, moving, movable), has_mask)


def leave_out_beginnings(frames, min_moving_frames):
    """Frames count in which something moves, as in so many frames before and with them; 0: all count."""
    moved_for = 0
    for frame in frames:
        moved_for = moved_for + 1 if frame.pixels.moving else 0
        frame.counts = moved_for >= min_moving_frames


def evaluate(masks_dir, sequence, is_static=False, min_moving_frames=0, max_frames=0):
    """The first max_frames (0: all) frames of a sequence, counted; InputError if something is missing."""
    if not os.path.isdir(masks_dir):
        raise InputError(f"{masks_dir}: no such folder; it should hold the masks")
    if not os.path.isdir(sequence):
        raise InputError(f"{sequence}: no such folder; it should hold the sequence")
    truth = GroundTruth(sequence, is_static)
    files = read_rgb_files(sequence)[:max_frames or None]
    frames = [evaluate_frame(masks_dir, truth, file) for file in files]
    leave_out_beginnings(frames, min_moving_frames)
    return frames


def summarize(frames):
    """Sums and figures of the frames that count; shares in [0, 1], None if there is nothing to count."""
    counted = [frame.pixels for frame in frames if frame.counts]
    total = sum(counted, PixelCounts())
    return {"frames": len(frames), "frames_counted": len(counted),
            "masks_missing": sum(not frame.has_mask for frame in frames),
            "pixels": vars(total), **total.figures()}


def percent(share):
    return "n/a" if share is None else f"{100 * share:.2f} %"


def report_lines(result, is_static):
    """One line for humans, and how many masks were missing."""
    shares = {name: percent(result[name]) for name in FIGURES}
    others = "precision {precision}, recall {recall}, IoU {iou}, ".format(**shares)
    missing = f"; {result['masks_missing']} masks missing" if result["masks_missing"] else ""
    return [f"{'' if is_static else others}wrongly masked {shares['wrongly_masked']} of the static pixels "
            f"({result['frames_counted']} of {result['frames']} frames counted{missing})"]


def csv_lines(frames):
    """A header and a line a frame: pixel counts, figures (empty: nothing to divide by), whether it counts."""
    pixel_names = [field.name for field in fields(PixelCounts)]
    lines = [",".join(["frame", *pixel_names, *FIGURES, "has_mask", "counts"])]
    for frame in frames:
        ratios = ["" if value is None else f"{value:.6f}" for value in frame.pixels.figures().values()]
        flags = [str(int(frame.has_mask)), str(int(frame.counts))]
        lines.append(",".join([frame.stem, *map(str, astuple(frame.pixels)), *ratios, *flags]))
    return lines


def plot(path, frames, result, is_static):
    """Draws the figures over the frames; gray: frames that do not count."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    names = ("wrongly_masked",) if is_static else FIGURES
    figure, panels = pyplot.subplots(len(names), 1, sharex=True, squeeze=False,
                                     figsize=(9, 1 + 1.6 * len(names)), constrained_layout=True)
    left_out = [not frame.counts for frame in frames]
    for axes, name in zip(panels[:, 0], names):
        shares = [frame.pixels.figures()[name] for frame in frames]
        axes.plot([np.nan if share is None else 100 * share for share in shares], linewidth=1.2)
        axes.fill_between(range(len(frames)), 0, 1, where=left_out, color="0.9",
                          transform=axes.get_xaxis_transform())
        axes.set_ylabel(f"{name.replace('_', ' ')} [%]")
        axes.set_title(f"overall {percent(result[name])}", fontsize="small", loc="right")
        axes.set_ylim(0, None if name == "wrongly_masked" else 102)
        axes.grid(color="0.9")
    panels[-1, 0].set_xlabel("frame")
    figure.savefig(path, dpi=150)
    pyplot.close(figure)


def parse_arguments():
    parser = command_line.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("masks_dir", metavar="MASKS_DIR", help="PNG, such as rgbd_tum --save-masks writes")
    parser.add_argument("sequence", metavar="SEQUENCE", help="folder with mask/ and mask_moving/")
    parser.add_argument("--static", action="store_true", help="nothing can move: all that is masked is wrong")
    parser.add_argument("--min-moving-frames", type=command_line.count, default=0, metavar="N",
                        help="count only frames where something has moved for N frames (default: all)")
    parser.add_argument("--max-frames", type=command_line.count, default=0, metavar="N",
                        help="look at the first N frames only (default: all)")
    parser.add_argument("--per-frame", metavar="FILE", help="write counts and figures of each frame as CSV")
    parser.add_argument("--plot", metavar="FILE", type=command_line.plot_file,
                        help="write a PNG, PDF or SVG figure")
    parser.add_argument("--json", metavar="FILE", help="write the figures as JSON; - is standard output")
    args = parser.parse_args()
    if args.static and args.min_moving_frames:
        parser.error("--min-moving-frames leaves nothing to count with --static")
    return args


def main():
    args = parse_arguments()
    frames = evaluate(args.masks_dir, args.sequence, args.static, args.min_moving_frames, args.max_frames)
    result = {**summarize(frames), "min_moving_frames": args.min_moving_frames, "static": args.static}
    if args.per_frame:
        command_line.write_lines(args.per_frame, csv_lines(frames))
    if args.plot:
        plot(args.plot, frames, result, args.static)
    command_line.publish(result, report_lines(result, args.static), args.json)


if __name__ == "__main__":
    command_line.run(main)
