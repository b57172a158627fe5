# SPDX-License-Identifier: GPL-3.0-or-later
"""What the detector costs or wins beyond chance.

The error of one run hangs on chance: a few keypoints more move it by 5 % (standard deviation) on fr1_rpy. So runs
are repeated with slightly different numbers of keypoints, and their means compared. Of nine, each is known to 2 %,
and their ratio to 3 %. (Their medians would be a quarter less well known.)
"""
import os
import re
import statistics

import command_line
import regression_runs as runs
from trajectory import InputError

NUM_FEATURES = "ORBextractor.nFeatures"
VARIATIONS = [percent / 100 for percent in range(96, 105)]  # of the number of keypoints


def num_features_of(settings_text):
    """The number of keypoints asked for."""
    found = re.search(rf"(?m)^{re.escape(NUM_FEATURES)}: *(\d+)", settings_text)
    if not found:
        raise InputError(f"rgbd_tum reports no setting {NUM_FEATURES}")
    return int(found.group(1))


def mean_ratio(sequence, folder, programs, settings_text):
    """Mean ATE RMSE of the runs with the detector over that without; everything is written to folder."""
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, "settings.yaml")
    errors = {"with": [], "without": []}
    for variation in VARIATIONS:
        num_features = round(variation * num_features_of(settings_text))
        command_line.write_lines(
            path, [runs.with_value(settings_text, NUM_FEATURES, num_features).rstrip("\n")])
        for kind, options in (("with", []), ("without", ["--no-detector"])):
            run_folder = os.path.join(folder, kind)
            runs.track(sequence, run_folder, programs, options, path)
            errors[kind].append(runs.trajectory_figures(sequence, run_folder)["ate"]["rmse"])
    return statistics.mean(errors["with"]) / statistics.mean(errors["without"])
