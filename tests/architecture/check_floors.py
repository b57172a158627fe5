#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that the sources keep to the floors that the table in src/README.md draws.

Prints one line per violation and exits with 1 if there is any.
"""

import argparse
import re
import sys
from pathlib import Path

MAX_LINES = 400
SUFFIXES = {".h", ".cc", ".inc"}
TABLE_ROW = re.compile(r"^\|\s*(\d+)\s*\|\s*`(\w+)`\s*\|", re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
LINKED_MODULE = re.compile(r"\borbslam(?:::|_)(\w+)")

# First folder (or path) of an include -> modules whose private sources may use it.
PACKAGE_USERS = {
    "ceres": {"optimization"},
    "pcl": {"dynamic", "cloud"},
    "GL": {"render"},
    "opencv2/imgcodecs": set(),
    "opencv2/highgui": set(),
    "opencv2/viz": set(),
    "opencv2/opencv": set(),
}


def read_floors(readme):
    return {module: int(floor) for floor, module in TABLE_ROW.findall(readme.read_text(encoding="utf-8"))}


def source_files(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SUFFIXES)


def package_of(include):
    """The key of PACKAGE_USERS that the include belongs to, if any."""
    for package in PACKAGE_USERS:
        if include.startswith((package + "/", package + ".h")):
            return package
    return None


class Checker:
    def __init__(self, root):
        self.root = root
        self.floors = read_floors(root / "src" / "README.md")
        self.violations = []

    def run(self):
        if not self.floors:
            self.report(self.root / "src" / "README.md", "has no table of floors")
        for base in (self.root / "include" / "orbslam", self.root / "src"):
            for folder in sorted(path for path in base.iterdir() if path.is_dir()):
                self.check_module(folder, is_public=base.name == "orbslam")
        for name in ("src", "include", "Examples"):
            for path in source_files(self.root / name):
                self.check_length(path)
        return self.violations

    def report(self, path, what):
        self.violations.append(f"{path.relative_to(self.root)}: {what}")

    def check_module(self, folder, is_public):
        module = folder.name
        if module not in self.floors:
            self.report(folder, "is a module that the table in src/README.md does not have")
            return
        for path in source_files(folder):
            for bracket, include in INCLUDE.findall(path.read_text(encoding="utf-8")):
                self.check_package(path, module, is_public, include)
                if include.startswith("orbslam/"):
                    self.check_goes_down(path, module, include.split("/")[1], f"includes {include}")
                elif bracket == '"':
                    self.check_private_include(path, module, is_public, include)
        self.check_links(folder / "CMakeLists.txt", module)

    def check_goes_down(self, path, module, other, does_what):
        if other == module:
            return
        if other not in self.floors:
            self.report(path, f"{does_what}, of an unknown module")
        elif self.floors[other] >= self.floors[module]:
            self.report(path, f"{does_what}, but {module} is on floor {self.floors[module]} and {other} on "
                              f"{self.floors[other]}")

    def check_package(self, path, module, is_public, include):
        package = package_of(include)
        if package is None:
            return
        if is_public:
            self.report(path, f"shows {include} in a public header")
        elif module not in PACKAGE_USERS[package]:
            self.report(path, f"includes {include}, which is not for {module}")

    def check_private_include(self, path, module, is_public, include):
        """A quoted include that is not orbslam/...: a private header beside the file, or by <module>/<header>."""
        own = self.root / "src" / module
        places = [path.parent / include, own.parent / include]
        found = [place.resolve() for place in places
                 if place.exists() or place.with_name(place.name + ".in").exists()]
        if is_public:
            self.report(path, f"includes the private header {include} in a public one")
        elif not any(place.is_relative_to(own.resolve()) for place in found):
            self.report(path, f"includes {include}, which is no private header of {module}")

    def check_links(self, path, module):
        if not path.exists():
            return
        text = re.sub(r"#.*", "", path.read_text(encoding="utf-8"))
        for other in LINKED_MODULE.findall(text):
            if other != "module":  # orbslam_module(...)
                self.check_goes_down(path, module, other, f"links {other}")

    def check_length(self, path):
        num_lines = len(path.read_text(encoding="utf-8").splitlines())
        if num_lines > MAX_LINES:
            self.report(path, f"has {num_lines} lines, more than {MAX_LINES}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=Path, help="folder of the project")
    violations = Checker(parser.parse_args().root).run()
    for violation in violations:
        print(violation)
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
