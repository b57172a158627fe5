#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_floors.py must find every kind of planted violation, and none in a sound tree."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).with_name("check_floors.py")
SOUND_TREE = {
    "src/README.md": "| floor | module | rooms |\n|---|---|---|\n| 0 | `util` | a |\n| 1 | `geometry` | b |\n"
                     "| 2 | `matching` | c |\n| 2 | `optimization` | d |\n",
    "include/orbslam/util/ids.h": "#include <vector>\n",
    "include/orbslam/geometry/rigid3.h": '#include "orbslam/util/ids.h"\n',
    "include/orbslam/matching/search.h": '#include "orbslam/geometry/rigid3.h"\n',
    "src/geometry/CMakeLists.txt": "orbslam_module(geometry SOURCES rigid3.cc PUBLIC orbslam::util)\n",
    "src/optimization/cost.h": "#include <ceres/ceres.h>\n",
    "src/optimization/solver.cc": '#include "cost.h"\n#include "optimization/cost.h"\n#include "version.h"\n',
    "src/optimization/version.h.in": "",
    "Examples/main.cc": "#include <orbslam/util/ids.h>\n",
}


class CheckFloorsTest(unittest.TestCase):
    def check(self, changes):
        """Runs the script on the sound tree with changes {path: text}."""
        with tempfile.TemporaryDirectory() as folder:
            for path, text in {**SOUND_TREE, **changes}.items():
                file = Path(folder) / path
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8")
            return subprocess.run([sys.executable, "-B", SCRIPT, folder], capture_output=True, text=True, check=False)

    def expect_violation(self, path, text):
        result = self.check({path: text})
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(len(result.stdout.splitlines()), 1, result.stdout)
        self.assertTrue(result.stdout.startswith(path), result.stdout)

    def test_sound_tree_passes(self):
        result = self.check({})
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)

    def test_include_that_goes_up(self):
        self.expect_violation("include/orbslam/util/bad.h", '#include "orbslam/geometry/rigid3.h"\n')
        self.expect_violation("src/util/bad.cc", "  #  include <orbslam/geometry/rigid3.h>\n")

    def test_include_of_a_sibling(self):
        self.expect_violation("src/optimization/bad.cc", '#include "orbslam/matching/search.h"\n')

    def test_include_of_an_unknown_module(self):
        self.expect_violation("src/geometry/bad.cc", '#include "orbslam/attic/box.h"\n')

    def test_private_header_of_another_module(self):
        for include in ("optimization/cost.h", "../optimization/cost.h", "nowhere.h"):
            self.expect_violation("src/matching/bad.cc", f'#include "{include}"\n')

    def test_private_header_in_a_public_one(self):
        self.expect_violation("include/orbslam/optimization/bad.h", '#include "optimization/cost.h"\n')

    def test_package_in_the_wrong_module(self):
        for include in ("ceres/ceres.h", "pcl/point_types.h", "GL/gl.h", "opencv2/imgcodecs.hpp"):
            self.expect_violation("src/matching/bad.cc", f"#include <{include}>\n")

    def test_package_in_a_public_header(self):
        self.expect_violation("include/orbslam/optimization/bad.h", "#include <ceres/ceres.h>\n")

    def test_link_that_goes_up(self):
        self.expect_violation("src/util/CMakeLists.txt", "orbslam_module(util PUBLIC orbslam::geometry)\n")

    def test_module_without_a_floor(self):
        result = self.check({"src/attic/box.cc": ""})
        self.assertEqual(result.returncode, 1)
        self.assertIn("src/attic", result.stdout)

    def test_long_file(self):
        for path in ("src/util/bad.cc", "include/orbslam/util/bad.h", "Examples/bad.cc"):
            self.expect_violation(path, "\n" * 401)
        self.assertEqual(self.check({"src/util/good.cc": "\n" * 400}).returncode, 0)

    def test_missing_table(self):
        result = self.check({"src/README.md": "no table"})
        self.assertEqual(result.returncode, 1)
        self.assertIn("no table of floors", result.stdout)


if __name__ == "__main__":
    unittest.main()
