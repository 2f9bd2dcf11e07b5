# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reports of runs, by the library and on a server of this machine."""
import contextlib
import io
import threading
import unittest
import urllib.error
import urllib.request

from scenes import InScratch, small
from vesiflow import FileError, view
from vesiflow import run as runs
from vesiflow.__main__ import main


def said(words):
    """Exit code and what a command wrote, on both streams."""
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        code = main(words)
    return code, out.getvalue(), errors.getvalue()


class Reports(InScratch):
    def setUp(self):
        super().setUp()
        self.run = self.scratch / "run"

    def test_is_that_which_the_run_ended_with(self):
        runs.run(small(), self.run)
        of_run = (self.run / "report.html").read_bytes()
        self.assertIn(b"<!DOCTYPE html>", of_run)
        again = runs.write_report(self.run, self.scratch / "again.html")
        self.assertEqual(again.read_bytes(), of_run)
        code, out, _ = said(["report", str(self.run), "--file", str(self.scratch / "command.html")])
        self.assertEqual((code, out), (0, f"report in {self.scratch / 'command.html'}\n"))
        self.assertEqual((self.scratch / "command.html").read_bytes(), of_run)
        fewer = runs.write_report(self.run, self.scratch / "fewer.html", frames=2)
        self.assertLess(fewer.stat().st_size, again.stat().st_size)

    def test_is_left_out_where_a_scene_says_so(self):
        runs.run(small(output__report=False), self.run)
        self.assertFalse((self.run / "report.html").exists())
        self.assertEqual(runs.write_report(self.run), self.run / "report.html")

    def test_refuses_what_holds_no_run_and_no_frames(self):
        with self.assertRaisesRegex(FileError, str(self.scratch)):
            runs.write_report(self.scratch)
        code, _, errors = said(["report", str(self.scratch)])
        self.assertEqual(code, 4)
        self.assertIn(f"error: {self.scratch}", errors)
        runs.run(small(output__report=False), self.run)
        with self.assertRaisesRegex(ValueError, "0"):
            runs.write_report(self.run, frames=0)
        self.assertFalse((self.run / "report.html").exists())

    def test_is_served_to_this_machine_and_made_again_when_the_run_goes_on(self):
        self.run.mkdir()
        with view.serve(self.run, 0) as server:
            thread = threading.Thread(target=server.serve_forever)
            thread.start()
            self.addCleanup(thread.join)
            self.addCleanup(server.shutdown)
            address, port = server.server_address
            self.assertEqual(address, "127.0.0.1")

            def page():
                with urllib.request.urlopen(f"http://{address}:{port}/", timeout=30) as answer:
                    return answer.read().decode()

            self.assertIn("nothing to see yet", page())
            runs.run(small(time__end=0.125, output__report=False), self.run)
            first = page()
            self.assertIn("0.125", first)
            self.assertEqual(page(), first)
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(f"http://{address}:{port}/../summary.json", timeout=30)
            self.assertEqual(refused.exception.code, 404)


if __name__ == "__main__":
    unittest.main()
