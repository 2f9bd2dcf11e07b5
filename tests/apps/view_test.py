# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""python/vesiflow/view.py without the package's bindings: what the server of a run under way answers, and to whom. Its argument is the app `report`."""

import http.client
import importlib.util
import json
import os
import sys
import tempfile
import threading
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
spec = importlib.util.spec_from_file_location("view", ROOT / "python" / "vesiflow" / "view.py")
view = importlib.util.module_from_spec(spec)
spec.loader.exec_module(view)
APP = Path(sys.argv.pop(1)).resolve()


class View(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        with mock.patch.dict(os.environ, VESIFLOW_APPS=str(APP.parent)):
            self.server = view.serve(self.folder, 0)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(self.server.shutdown)

    def get(self, path, **headers):
        connection = http.client.HTTPConnection(*self.server.server_address)
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode(), answer

    def write(self, **summary):
        temporary = self.folder / "summary.json.new"
        temporary.write_text(json.dumps(summary))
        temporary.rename(self.folder / "summary.json")

    def test_only_on_this_machine(self):
        self.assertEqual(self.server.server_address[0], "127.0.0.1")
        self.assertEqual(self.get("/version", Host="evil.example")[0], 403)
        self.assertEqual(self.get("/version", Host="localhost:80")[0], 200)

    def test_nothing_but_the_page(self):
        self.write(status="running")
        for path in ("/summary.json", "/../summary.json", "//etc/passwd", "/report.html"):
            self.assertEqual(self.get(path)[0], 404, path)

    def test_waits_for_a_run(self):
        status, text, _ = self.get("/")
        self.assertEqual(status, 200)
        self.assertIn("nothing to see yet", text)

    def test_page_follows_the_files(self):
        self.write(status="running", time=0.25)
        first = self.get("/version")[1]
        status, text, answer = self.get("/")
        self.assertEqual(status, 200)
        self.assertIn("t = 0.25", text)
        self.assertIn("connect-src 'self'", text)
        self.assertEqual(answer.getheader("Cache-Control"), "no-store")
        self.assertEqual(self.get("/version")[1], first)
        self.write(status="completed", time=0.5)
        self.assertNotEqual(self.get("/version")[1], first)
        self.assertIn("t = 0.5", self.get("/")[1])
        # Nothing is left in the folder of the run.
        self.assertEqual(os.listdir(self.folder), ["summary.json"])

    def test_page_is_made_once_for_each_state(self):
        self.write(status="running")
        with mock.patch.object(view.subprocess, "run", wraps=view.subprocess.run) as made:
            for _ in range(3):
                self.get("/")
            self.assertEqual(made.call_count, 1)


class Report(unittest.TestCase):
    def test_app_is_found_or_named(self):
        with mock.patch.dict(os.environ, VESIFLOW_APPS=str(APP.parent)):
            self.assertEqual(view.find_report_app().resolve(), APP)
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ, VESIFLOW_APPS=folder, PATH=folder), \
                mock.patch.object(view, "__file__", f"{folder}/a/b/view.py"), mock.patch.object(sys, "argv", [f"{folder}/x"]):
            other = Path(folder, "report")
            other.write_text("#!/bin/sh\necho another program\n")
            other.chmod(0o755)
            with self.assertRaisesRegex(view.ReportError, "VESIFLOW_APPS"):
                view.find_report_app()

    # Without the library, as here, where the module is not one of its package.
    def test_the_command_writes_by_the_app(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ, VESIFLOW_APPS=str(APP.parent)), mock.patch("sys.stderr"), \
                mock.patch("sys.stdout"):
            self.assertEqual(view.report_main([folder]), 4)
            Path(folder, "summary.json").write_text("{}")
            self.assertEqual(view.report_main([folder]), 0)
            self.assertTrue(Path(folder, "report.html").exists())

    def test_bad_options_are_named(self):
        for main, arguments in ((view.view_main, ["/nowhere"]), (view.view_main, [".", "--port", "70000"]), (view.report_main, [".", "--frames", "0"])):
            with self.assertRaises(SystemExit) as end, mock.patch("sys.stderr"):
                main(arguments)
            self.assertEqual(end.exception.code, 2)


if __name__ == "__main__":
    unittest.main()
