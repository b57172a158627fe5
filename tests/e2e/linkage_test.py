# SPDX-License-Identifier: GPL-3.0-or-later
"""What rgbd_tum loads at every start: none of the large libraries that parts of OpenCV and PCL drag in."""
import re
import subprocess
import unittest

from support import RGBD_TUM, run_or_skip

UNWANTED = re.compile(r"lib(vtk|Qt\d|gdal|opencv_(highgui|viz|imgcodecs|videoio))\w*\.so", re.IGNORECASE)


class Linkage(unittest.TestCase):
    def test_no_vtk_qt_or_gdal(self):
        libraries = subprocess.run(["ldd", RGBD_TUM], capture_output=True, text=True, check=True).stdout
        self.assertIn("libopencv_core", libraries)
        self.assertEqual([match.group() for match in UNWANTED.finditer(libraries)], [])


if __name__ == "__main__":
    run_or_skip(None)
