#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs rgbd_tum several times over sequences and prints accuracy, times and memory.

Times are CPU times in units of cv::ORB::detectAndCompute (1000 features, one thread) on the same images,
measured beside every run, so that figures of different machines, and of a noisy one, compare.
Build first: cmake --preset bench && cmake --build --preset bench
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

import regression_runs

ROOT = pathlib.Path(__file__).resolve().parent.parent


def run(command):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True).stdout


def measure(build, arguments, sequence, settings, extra):
    """One run: its figures, times in units of cv::ORB."""
    with tempfile.TemporaryDirectory() as folder:
        unit_s = float(run([build / "tests/bench/orb_reference", sequence]))
        run([build / "Examples/RGB-D/rgbd_tum", arguments.vocabulary, settings, sequence, "--output-dir", folder,
             "--quiet", *extra])
        report = json.loads(pathlib.Path(folder, "run.json").read_text())
        ate = json.loads(run([ROOT / "scripts/evaluate_ate.py", sequence / "groundtruth.txt",
                              pathlib.Path(folder, "CameraTrajectory.txt"), "--json", "-"]))
    tracking = sorted(report["per_frame"]["tracking_cpu_s"])
    detector = regression_runs.detector_figures(report)
    return {
        "ATE RMSE, m": ate["rmse"],
        "coverage": report["coverage"],
        "tracking median, cv::ORB": statistics.median(tracking) / unit_s,
        "tracking p99, cv::ORB": tracking[int(0.99 * (len(tracking) - 1))] / unit_s,
        "detector median, cv::ORB": (detector["median_s"] or 0) / unit_s,
        "detector p99, cv::ORB": (detector["p99_s"] or 0) / unit_s,
        "all threads a frame, cv::ORB": report["cpu_s"] / report["frames"]["processed"] / unit_s,
        "start to first frame, s": report["startup_s"],
        "peak memory, MB": report["peak_memory_mb"],
        "keyframes": report["map"]["keyframes"],
        "cv::ORB, ms": 1e3 * unit_s,
    }


def print_table(title, runs):
    print(f"\n{title}: median (lowest - highest) of {len(runs)} runs")
    for name in runs[0]:
        values = [figures[name] for figures in runs]
        print(f"  {name:30} {statistics.median(values):9.4f}  ({min(values):.4f} - {max(values):.4f})", flush=True)


def measure_growth(build, arguments, sequence, settings, num_frames):
    """Plays the sequence back and forth; tracking time in the last tenth over that in the first."""
    lines = [line.split() for line in (sequence / "associations.txt").read_text().splitlines()
             if line.strip() and not line.startswith("#")]
    there_and_back = lines + lines[-2:0:-1]
    with tempfile.TemporaryDirectory() as folder:
        associations = pathlib.Path(folder, "associations.txt")
        with associations.open("w") as file:
            for i in range(num_frames):
                _, rgb, _, depth = there_and_back[i % len(there_and_back)]
                file.write(f"{i / 30:.6f} {rgb} {i / 30:.6f} {depth}\n")
        run([build / "Examples/RGB-D/rgbd_tum", arguments.vocabulary, settings, sequence, associations,
             "--output-dir", folder, "--quiet"])
        report = json.loads(pathlib.Path(folder, "run.json").read_text())
    seconds = report["per_frame"]["tracking_cpu_s"]
    tenth = num_frames // 10
    ratio = statistics.median(seconds[-tenth:]) / statistics.median(seconds[:tenth])
    print(f"\n{sequence.name}, {num_frames} frames back and forth: tracking median in the last tenth "
          f"{ratio:.3f} x the first; {report['map']['keyframes']} keyframes, "
          f"{report['peak_memory_mb']:.0f} MB, coverage {report['coverage']:.4f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("settings", type=pathlib.Path)
    parser.add_argument("sequences", type=pathlib.Path, nargs="+")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/bench")
    parser.add_argument("--vocabulary", default=str(ROOT / "Vocabulary/orbslam.bin"))
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--modes", nargs="+", default=["fast", "realtime", "sequential"],
                        choices=["fast", "realtime", "sequential"])
    parser.add_argument("--growth", type=int, metavar="FRAMES", default=0,
                        help="also play the first sequence back and forth for so many frames")
    arguments = parser.parse_args()
    flags = {"fast": [], "realtime": ["--realtime"], "sequential": ["--sequential"]}
    try:
        for sequence in arguments.sequences:
            for mode in arguments.modes:
                runs = [measure(arguments.build, arguments, sequence, arguments.settings, flags[mode])
                        for _ in range(arguments.runs)]
                print_table(f"{sequence.name}, {mode}", runs)
        if arguments.growth:
            measure_growth(arguments.build, arguments, arguments.sequences[0], arguments.settings, arguments.growth)
    except subprocess.CalledProcessError as error:
        sys.exit(f"benchmark: {error.cmd[0]} failed: {error.stderr.strip()}")
    except FileNotFoundError as error:
        sys.exit(f"benchmark: {error.filename}: not found; build with the preset 'bench' first")


if __name__ == "__main__":
    main()
