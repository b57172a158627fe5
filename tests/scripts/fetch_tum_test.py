#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""fetch_tum.sh against a server on this machine: complete, resumed, broken and missing downloads."""
import http.server
import io
import os
import re
import shutil
import socket
import subprocess
import sys
import tarfile
import threading
import unittest

from support import SCRIPTS, ScriptTest

NAME = "rgbd_dataset_freiburg3_walking_xyz"
URL_PATH = f"/freiburg3/{NAME}.tgz"
FILES = {"rgb.txt": "1.00 rgb/1.png\n1.04 rgb/2.png\n", "depth.txt": "1.01 depth/1.png\n1.05 depth/2.png\n",
         "groundtruth.txt": "1.0 0 0 0 0 0 0 1\n", "noise.bin": os.urandom(200_000).hex()}
ASSOCIATIONS = "1.00 rgb/1.png 1.01 depth/1.png\n1.04 rgb/2.png 1.05 depth/2.png\n"


def make_archive(files, folder=NAME):
    """The bytes of a .tgz."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w:gz") as archive:
        for name, text in files.items():
            entry = tarfile.TarInfo(f"{folder}/{name}")
            entry.size = len(text)
            archive.addfile(entry, io.BytesIO(text.encode()))
    return buffer.getvalue()


class Server(http.server.ThreadingHTTPServer):
    """Serves files from memory; records requests; may hang up early or not know ranges."""
    daemon_threads = True

    def __init__(self, files):
        super().__init__(("127.0.0.1", 0), Handler)
        self.files, self.requests = files, []
        self.bytes_before_hanging_up, self.ranges, self.status = None, True, None

    @property
    def url(self):
        return f"http://127.0.0.1:{self.server_port}"


class Handler(http.server.BaseHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def do_HEAD(self):
        self.answer(with_body=False)

    def do_GET(self):
        self.answer(with_body=True)

    def answer(self, with_body):
        server, wanted = self.server, self.headers.get("Range", "")
        server.requests.append((self.command, wanted))
        content = server.files.get(self.path)
        if content is None or server.status:
            self.send_error(server.status or 404)
            return
        range_start = re.match(r"bytes=(\d+)-$", wanted) if server.ranges else None
        start = int(range_start[1]) if range_start else 0
        self.send_response(206 if range_start else 200)
        if range_start:
            self.send_header("Content-Range", f"bytes {start}-{len(content) - 1}/{len(content)}")
        self.send_header("Content-Length", str(len(content) - start))
        self.end_headers()
        if with_body:
            self.wfile.write(content[start:][:server.bytes_before_hanging_up])


class FetchTest(ScriptTest):
    def setUp(self):
        super().setUp()
        self.archive = make_archive(FILES)
        self.server = Server({URL_PATH: self.archive})
        thread = threading.Thread(target=self.server.serve_forever, kwargs={"poll_interval": 0.02})
        thread.start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(thread.join)
        self.addCleanup(self.server.shutdown)
        self.output = self.path("data")
        self.target = os.path.join(self.output, NAME)
        self.part = self.target + ".tgz.part"

    def fetch(self, *arguments, url=None):
        """Runs the script against the server; proxies are for the world outside this machine."""
        environment = {key: value for key, value in os.environ.items()
                       if not key.lower().endswith("_proxy")}
        environment.update(ORBSLAM_TUM_URL=url or self.server.url, no_proxy="127.0.0.1", LC_ALL="C")
        command = [os.path.join(SCRIPTS, "fetch_tum.sh"), "--output-dir", self.output, *arguments]
        return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60,
                              check=False)

    def read(self, name):
        with open(os.path.join(self.target, name), encoding="utf-8") as file:
            return file.read()

    def assert_fetched(self, result):
        """The sequence is there, associated, and nothing else is."""
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual({name: self.read(name) for name in FILES}, FILES)
        self.assertEqual(self.read("associations.txt"), ASSOCIATIONS)
        self.assertEqual(os.listdir(self.output), [NAME])

    def assert_failed(self, result, *words, code=1):
        """One line on stderr that holds the words; no half of a sequence is left."""
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertFalse(os.path.exists(self.target))

    def save_part(self, content):
        os.makedirs(self.output)
        with open(self.part, "wb") as file:
            file.write(content)

    def test_every_form_of_the_name_fetches_the_sequence(self):
        for name in ("fr3_walking_xyz", "freiburg3_walking_xyz", NAME):
            with self.subTest(name=name):
                self.assert_fetched(self.fetch(name))
                shutil.rmtree(self.target)

    def test_what_is_there_is_not_fetched_again(self):
        self.assert_fetched(self.fetch(NAME))
        self.server.requests.clear()
        os.remove(os.path.join(self.target, "associations.txt"))
        self.assert_fetched(self.fetch(NAME))
        self.assertEqual(self.server.requests, [])

    def test_a_partial_file_is_resumed(self):
        self.save_part(self.archive[:1000])
        self.assert_fetched(self.fetch(NAME))
        self.assertIn(("GET", "bytes=1000-"), self.server.requests)

    def test_a_complete_partial_file_is_not_fetched_again(self):
        self.save_part(self.archive)
        self.assert_fetched(self.fetch(NAME))
        self.assertEqual([command for command, _ in self.server.requests], ["HEAD"])

    def test_a_partial_file_too_long_or_not_resumable_is_fetched_anew(self):
        self.save_part(self.archive + b"more")
        self.assert_fetched(self.fetch(NAME))
        shutil.rmtree(self.output)
        self.server.ranges = False
        self.save_part(self.archive[:1000])
        self.assert_fetched(self.fetch(NAME))

    def test_a_download_that_breaks_off_is_reported_and_resumed_by_the_next(self):
        self.server.bytes_before_hanging_up = 5000
        self.assert_failed(self.fetch(NAME), "broke off", "resume")
        self.assertEqual(os.path.getsize(self.part), 5000)
        self.server.bytes_before_hanging_up = None
        self.assert_fetched(self.fetch(NAME))
        self.assertIn(("GET", "bytes=5000-"), self.server.requests)

    def test_a_truncated_or_foreign_archive_is_refused_and_removed(self):
        for content in (self.archive[:-100], b"<html>busy</html>", make_archive(FILES, "other"),
                        make_archive({"rgb.txt": "1 a\n"})):
            with self.subTest(size=len(content)):
                self.server.files[URL_PATH] = content
                self.assert_failed(self.fetch(NAME), f"{NAME}.tgz")
                self.assertEqual(os.listdir(self.output), [])

    def test_a_sequence_that_the_server_does_not_have(self):
        self.assert_failed(self.fetch("fr1_nowhere"), "rgbd_dataset_freiburg1_nowhere.tgz", "HTTP 404")

    def test_a_server_that_refuses(self):
        self.server.status = 503
        self.assert_failed(self.fetch(NAME), "HTTP 503")

    def test_a_server_that_cannot_be_reached(self):
        with socket.socket() as unused:
            unused.bind(("127.0.0.1", 0))
            url = f"http://127.0.0.1:{unused.getsockname()[1]}"
            self.assert_failed(self.fetch(NAME, url=url), "cannot be reached")

    def test_wrong_usage_is_refused_before_anything_is_fetched(self):
        for arguments in ([], ["walking_xyz"], ["fr4_desk"], ["fr3_../../etc"], ["--no-such-option"],
                          ["--output-dir"], [NAME, "fr1 xyz"]):
            with self.subTest(arguments=arguments):
                self.assert_failed(self.fetch(*arguments), "fetch_tum.sh: error: ", code=2)
        self.assertEqual(self.server.requests, [])

    def test_help_tells_the_options(self):
        result = self.fetch("--help")
        self.assertEqual(result.returncode, 0)
        for word in ("--output-dir", "--keep-archive", "ORBSLAM_TUM_URL", "fr3_walking_xyz"):
            self.assertIn(word, result.stdout)


if __name__ == "__main__":
    if not shutil.which("curl"):
        print("skipped: curl is not installed")
        sys.exit(77)
    unittest.main()
