# SPDX-License-Identifier: GPL-3.0-or-later
"""What regression.py and ablation.py share: finding and making sequences, running rgbd_tum, its figures.

Sequences have names: those of REAL_SEQUENCES, or synthetic_SCRIPT_MOTION[_seedN][_FRAMES] (seed 1 and 300
frames unless said), which Examples/Synthetic/make_sequence writes.
"""
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
from dataclasses import dataclass

import command_line
import compare_runs
import evaluate_masks
from trajectory import InputError, read_trajectory

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
SYNTHETIC = re.compile(r"synthetic_(?P<script>[a-z_]+)_(?P<motion>[a-z]+)"
                       r"(_seed(?P<seed>\d+))?(_(?P<frames>\d+))?")
SYNTHETIC_FRAMES = 300
SETTLED_FRAMES = 5  # on synthetic sequences masks count where something has moved for so long

WALKING = [f"fr3_walking_{motion}" for motion in ("static", "xyz", "rpy", "halfsphere")]
COMPOSITES = ["xyz_walk_a", "rpy_walk_a"]
STATIC_ROOMS = ["fr1_xyz", "fr1_rpy"]
REAL_SEQUENCES = {**{name: "TUM3.yaml" for name in WALKING},
                  **{name: "TUM1.yaml" for name in (*COMPOSITES, *STATIC_ROOMS)}}


class RunError(Exception):
    """A run that failed, in one line: a result, not a fault of the user."""


@dataclass
class Sequence:
    """A sequence to run on."""
    name: str
    folder: str
    settings: str
    is_static: bool = False     # nothing moves in it: all that is masked is wrong
    recipe: re.Match = None     # of SYNTHETIC, if the folder is ours to make

    @property
    def has_true_masks(self):
        return os.path.isdir(os.path.join(self.folder, "mask_moving"))


@dataclass
class Programs:
    """What a build made, and the vocabulary."""
    build: str
    vocabulary: str = "-"

    def __post_init__(self):
        self.rgbd_tum = os.path.join(self.build, "Examples", "RGB-D", "rgbd_tum")
        self.make_sequence = os.path.join(self.build, "Examples", "Synthetic", "make_sequence")
        for program in (self.rgbd_tum, self.make_sequence):
            if not os.access(program, os.X_OK):
                raise InputError(f"{program}: no such program; build first "
                                 f"(cmake --preset release && cmake --build build/release), or name --build")
        if self.vocabulary != "-" and not os.path.isfile(self.vocabulary):
            raise InputError(f"{self.vocabulary}: no such vocabulary; - goes without one")


def add_options(parser):
    """The options that both scripts have."""
    parser.add_argument("--build", default=os.path.join(ROOT, "build", "release"), metavar="DIR",
                        help="the built tree (default: build/release)")
    parser.add_argument("--vocabulary", metavar="FILE",
                        default=os.path.join(ROOT, "Vocabulary", "orbslam.bin"),
                        help="visual vocabulary, - for none (default: Vocabulary/orbslam.bin)")
    parser.add_argument("--json", metavar="FILE", help="write all figures as JSON; - is standard output")


def run_main(main):
    """Runs main(): bad input is one line and exit code 2, Ctrl-C exit code 130."""
    try:
        command_line.run(main)
    except KeyboardInterrupt:
        sys.exit(130)


def say(text):
    """Progress, on stderr: standard output is for the tables."""
    print(text, file=sys.stderr, flush=True)


def places(name):
    """Folders where a real sequence may be, best first: in $ORBSLAM_DATA or where fetch_tum.sh puts it."""
    full_name = re.sub("^fr([123])_", r"rgbd_dataset_freiburg\1_", name)
    data = os.environ.get("ORBSLAM_DATA")
    parents = ([data] if data else []) + [os.path.join(ROOT, "datasets")]
    return [os.path.join(parent, folder) for parent in parents for folder in (name, full_name)]


def find_real(name):
    """The sequence of a name of REAL_SEQUENCES; None if it is not on this machine."""
    settings = os.path.join(ROOT, "config", REAL_SEQUENCES[name])
    found = [folder for folder in places(name) if os.path.isdir(os.path.join(folder, "rgb"))]
    return Sequence(name, found[0], settings, name in STATIC_ROOMS) if found else None


def open_folder(folder):
    """The sequence of a folder; settings: its camera.yaml, or by its name or the freiburgN in it."""
    folder = os.path.normpath(folder)
    name = os.path.basename(os.path.abspath(folder))
    camera = re.search(r"(?:freiburg|fr)([123])(?:_|$)", name)
    settings = os.path.join(folder, "camera.yaml")
    if not os.path.isfile(settings):
        config = f"TUM{camera.group(1)}.yaml" if camera else REAL_SEQUENCES.get(name)
        if config is None:
            raise InputError(f"{folder}: which camera? Put its settings there as camera.yaml")
        settings = os.path.join(ROOT, "config", config)
    short_name = re.sub("^rgbd_dataset_freiburg([123])_", r"fr\1_", name)
    return Sequence(short_name, folder, settings, short_name in STATIC_ROOMS)


def locate(text, output):
    """The sequence that the user names: synthetic (not made yet; under output), real, or a folder."""
    parts = SYNTHETIC.fullmatch(text)
    if parts:
        folder = os.path.join(output, text, "sequence")
        return Sequence(text, folder, os.path.join(folder, "camera.yaml"), parts["script"] == "static", parts)
    if os.path.isdir(text):
        return open_folder(text)
    if text not in REAL_SEQUENCES:
        raise InputError(f"{text}: no such folder, and not the name of a sequence such as "
                         f"synthetic_walking_xyz, {', '.join(REAL_SEQUENCES)}")
    sequence = find_real(text)
    if sequence is None:
        raise InputError(f"{text}: not found; put it into $ORBSLAM_DATA or run scripts/fetch_tum.sh")
    return sequence


def make(sequence, programs):
    """Writes a synthetic sequence in place of what was there; leaves others as they are."""
    if sequence.recipe is None:
        return
    parts = sequence.recipe
    shutil.rmtree(sequence.folder, ignore_errors=True)
    os.makedirs(sequence.folder)
    say(f"{sequence.name}: making it")
    call([programs.make_sequence, "--script", parts["script"], "--motion", parts["motion"],
          "--seed", parts["seed"] or 1, "--frames", parts["frames"] or SYNTHETIC_FRAMES,
          "--out", sequence.folder, "--quiet"])


def call(command):
    """Runs a program; RunError with the last thing it said if it fails."""
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True, errors="replace",
                            check=False)
    if result.returncode == 130:
        raise KeyboardInterrupt
    if result.returncode != 0:
        last = (result.stderr.strip().splitlines() or ["it said nothing"])[-1]
        raise RunError(f"{os.path.basename(command[0])} failed (exit code {result.returncode}): {last}")


def track(sequence, folder, programs, options=(), settings=None, max_frames=0):
    """Runs rgbd_tum on one thread; everything it writes goes to folder, emptied before. Returns run.json."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    associations = os.path.join(sequence.folder, "associations.txt")
    limit = ["--max-frames", max_frames] if max_frames else []
    call([programs.rgbd_tum, programs.vocabulary, settings or sequence.settings, sequence.folder,
          *([associations] if os.path.isfile(associations) else []), "--output-dir", folder, "--sequential",
          "--quiet", *limit, *options])
    with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
        return json.load(file)


def read_settings(folder):
    """All settings of the run in folder, as rgbd_tum wrote them."""
    with open(os.path.join(folder, "settings.yaml"), encoding="utf-8") as file:
        return file.read()


def with_value(settings_text, key, value):
    """The settings, as rgbd_tum writes them, with another value (text or number) of one."""
    text, count = re.subn(rf"(?m)^{re.escape(key)}:.*$", lambda _: f"{key}: {value}", settings_text)
    if count != 1:
        raise InputError(f"rgbd_tum knows no setting {key}; its settings.yaml lists them")
    return text


def trajectory_figures(sequence, folder, max_frames=0):
    """The errors of the trajectory in folder, as compare_runs.py has them; RunError if there are none."""
    frames = len(evaluate_masks.read_rgb_files(sequence.folder)[:max_frames or None])
    groundtruth = read_trajectory(os.path.join(sequence.folder, "groundtruth.txt"))
    try:
        estimate = read_trajectory(os.path.join(folder, "CameraTrajectory.txt"))
        return compare_runs.evaluate(groundtruth, estimate, str(frames))
    except (InputError, FileNotFoundError) as error:
        raise RunError(str(error)) from error


def mask_figures(sequence, folder, max_frames=0):
    """What evaluate_masks.py says of the masks in folder; None where the truth is not known."""
    if not (sequence.is_static or sequence.has_true_masks):
        return None
    settled = SETTLED_FRAMES if sequence.recipe and not sequence.is_static else 0
    frames = evaluate_masks.evaluate(folder, sequence.folder, sequence.is_static, settled, max_frames)
    return evaluate_masks.summarize(frames)


def detector_figures(report):
    """Latency and failures of the detector in a run.json; None where it does not tell."""
    columns = report.get("per_frame", {})
    latencies = sorted(filter(None, columns.get("detector_latency_s", [])))
    shares = columns.get("masked_share", [])
    return {"median_s": statistics.median(latencies) if latencies else None,
            "p99_s": latencies[int(0.99 * (len(latencies) - 1))] if latencies else None,
            "masked_share": statistics.fmean(shares) if shares else None,
            "fail_open": sum(map(bool, columns["fail_open"])) if "fail_open" in columns else None}


def run_with_detector(sequence, folder, programs, settings=None, max_frames=0):
    """One run that looks for what moves: errors, figures of the masks and of the detector, run.json."""
    masks = os.path.join(folder, "masks")
    report = track(sequence, folder, programs, ["--save-masks", masks], settings, max_frames)
    os.makedirs(masks, exist_ok=True)
    return {**trajectory_figures(sequence, folder, max_frames),
            "masks": mask_figures(sequence, masks, max_frames), "detector": detector_figures(report)}, report


def run_without_detector(sequence, folder, programs, options=()):
    """The same without the detector; errors only."""
    track(sequence, folder, programs, ["--no-detector", *options])
    return trajectory_figures(sequence, folder)
