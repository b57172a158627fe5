# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the scripts share: running them, and made-up trajectories."""
import os
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy as np

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")
sys.path.insert(0, SCRIPTS)

START = 1305031102.0  # s; stamps of this size have 0.2 us between doubles


def run_script(name, *arguments):
    """Runs a script; the result has stdout, stderr and returncode."""
    return subprocess.run([os.path.join(SCRIPTS, name), *map(str, arguments)], capture_output=True,
                          text=True, timeout=120, check=False)


def random_rotation(random):
    """A rotation matrix, uniformly distributed."""
    q, r = np.linalg.qr(random.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q * np.sign(np.linalg.det(q))


class ScriptTest(unittest.TestCase):
    """A test with a folder of its own and random numbers seeded by its name."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.random = np.random.default_rng(zlib.crc32(self.id().encode()))

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        """Writes the text as it is and returns the path."""
        with open(self.path(name), "w", encoding="utf-8", newline="") as file:
            file.write(text)
        return self.path(name)

    def assert_refused(self, result, *words):
        """Exit code 2, nothing on stdout, and one line on stderr that holds the words."""
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        for word in words:
            self.assertIn(str(word), result.stderr)

    def random_poses(self, count, rate_hz=30.0):
        """A smooth random walk: stamps, positions and rotations, of a camera at the given rate."""
        from trajectory import rotations_of
        stamps = START + np.arange(count) / rate_hz
        positions = np.cumsum(self.random.normal(scale=0.01, size=(count, 3)), axis=0)
        quaternions = np.cumsum(self.random.normal(scale=0.02, size=(count, 4)), axis=0) + [0, 0, 0, 1]
        quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
        return stamps, positions, rotations_of(quaternions)

    def random_trajectory(self, count, rate_hz=30.0):
        """random_poses as a Trajectory."""
        return self.trajectory(*self.random_poses(count, rate_hz))

    @staticmethod
    def trajectory(stamps, positions, rotations):
        from trajectory import Trajectory
        return Trajectory("made up", [f"{stamp:.6f}" for stamp in stamps], stamps, positions, rotations)

    def moved(self, trajectory, rotation, translation):
        """The same trajectory seen from another world frame."""
        return self.trajectory(trajectory.stamps, trajectory.positions @ rotation.T + translation,
                               rotation @ trajectory.rotations)

    def noisy(self, trajectory, sigma_m=0.02):
        """The trajectory with independent noise on its positions."""
        noise = self.random.normal(scale=sigma_m, size=trajectory.positions.shape)
        return self.trajectory(trajectory.stamps, trajectory.positions + noise, trajectory.rotations)

    def save(self, name, trajectory):
        """Writes a trajectory file and returns its path."""
        from evaluate_ate import quaternion_of
        rows = zip(trajectory.stamps, trajectory.positions, trajectory.rotations)
        return self.write(name, "# timestamp tx ty tz qx qy qz qw\n" + "".join(
            " ".join([f"{stamp:.6f}", *(f"{x:.9f}" for x in (*position, *quaternion_of(rotation)))]) + "\n"
            for stamp, position, rotation in rows))
