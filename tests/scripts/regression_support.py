# SPDX-License-Identifier: GPL-3.0-or-later
"""A built tree in which stubs stand in for the programs, and running scripts on it."""
import os
import shutil
import subprocess

from support import SCRIPTS, ScriptTest

STUB = os.path.join(os.path.dirname(os.path.abspath(__file__)), "regression_stub.py")
NAME = "synthetic_walking_xyz_40"


class StubbedTest(ScriptTest):
    """Errors without the detector are 0.5 m, with it 0.05 m."""

    script = ""

    def setUp(self):
        super().setUp()
        self.build = self.path("build")
        for folder, program in (("RGB-D", "rgbd_tum"), ("Synthetic", "make_sequence")):
            os.makedirs(os.path.join(self.build, "Examples", folder))
            shutil.copy(STUB, os.path.join(self.build, "Examples", folder, program))
            os.chmod(os.path.join(self.build, "Examples", folder, program), 0o755)
        self.output = self.path("output")

    def call(self, *arguments, with_m=0.05):
        """Runs the script on the stubs."""
        errors = {"STUB_WITHOUT_M": "0.5", "STUB_WITH_M": str(with_m)}
        command = [os.path.join(SCRIPTS, self.script), "--build", self.build, "--vocabulary", "-",
                   "--output-dir", self.output, *arguments]
        return subprocess.run(command, capture_output=True, text=True, timeout=100, check=False,
                              env={**os.environ, **errors})

    @staticmethod
    def table_cells(text, first_header):
        """{first cell: other cells} of the Markdown table that begins with this header."""
        lines = text[text.index(f"| {first_header}"):].split("\n\n")[0].splitlines()
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
        return {row[0]: row[1:] for row in rows[2:]}
