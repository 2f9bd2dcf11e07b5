# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""`vesiflow report DIR` writes the report of a run; `vesiflow view DIR` serves that of a run under way on this machine, always up to date.

Both call the library. Where the package has no bindings, as in a checkout in which only programs were built, they call the app `report`, which is
looked for in the folder that VESIFLOW_APPS names, beside this program, in the build trees of the checkout (the newest first) and on the PATH.
"""

import argparse
import http.server
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import webbrowser
from pathlib import Path

ADDRESS = "127.0.0.1"  # nobody else's business
DEFAULT_PORT = 8765
MOST_FRAMES = 200


class ReportError(Exception):
    """The report cannot be made; the message says why."""


def find_report_app():
    """Path of the app `report`.

    Raises ReportError, which names where it was looked for.
    """
    folders = [Path(os.environ["VESIFLOW_APPS"])] if os.environ.get("VESIFLOW_APPS") else []
    folders.append(Path(sys.argv[0]).resolve().parent)
    builds = Path(__file__).resolve().parents[2].glob("build/*/apps")
    folders += sorted(builds, key=lambda folder: folder.stat().st_mtime, reverse=True)
    on_path = shutil.which("report")
    if on_path:
        folders.append(Path(on_path).parent)
    for folder in folders:
        app = folder / "report"
        if app.is_file() and os.access(app, os.X_OK) and _is_ours(app):
            return app
    raise ReportError(f"the app report is in none of {', '.join(map(str, folders))}; build it, or name its folder in VESIFLOW_APPS")


def _is_ours(app):
    """Others may have programs of that name, too."""
    try:
        answer = subprocess.run([app, "--version"], capture_output=True, text=True, timeout=10, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return answer.stdout.startswith("report of Vesiflow")


def page_writer():
    """A function (folder, file, frames, live) that writes a page and raises ReportError where it cannot.

    Raises ReportError where there is neither the library nor the app.
    """
    try:
        from . import run
    except ImportError:
        app = find_report_app()

        def write(folder, file, frames, live):
            made = subprocess.run([app, folder, "--quiet", "--threads", "1", "--file", file, "--frames", str(frames), *["--live"] * live],
                                  capture_output=True, text=True, check=False)
            if made.returncode != 0:
                raise ReportError(made.stderr.strip().removeprefix("error: ") or f"report ended with {made.returncode}")

        return write

    from .errors import FileError

    def write(folder, file, frames, live):
        try:
            run.write_report(folder, file, frames=frames, live=live)
        except (FileError, ValueError) as error:
            raise ReportError(str(error)) from error

    return write


def report_main(argv=None):
    """Writes the report of a run; returns the exit code."""
    parser = argparse.ArgumentParser(prog="vesiflow report", description="Writes the report of a run: one page with its membranes, numbers and scene, for any browser.")
    parser.add_argument("folder", help="folder of a run, under way or ended")
    parser.add_argument("--file", help="the page (default: report.html in the folder of the run)")
    parser.add_argument("--frames", type=int, default=MOST_FRAMES, help="snapshots of the membranes that the page holds at most, evenly chosen (default: %(default)s)")
    arguments = parser.parse_args(argv)
    if arguments.frames < 1:
        parser.error(f"--frames {arguments.frames}: must be 1 or more")
    file = Path(arguments.file) if arguments.file else Path(arguments.folder) / "report.html"
    try:
        page_writer()(arguments.folder, file, arguments.frames, False)
    except ReportError as error:
        print(f"error: {error}", file=sys.stderr)
        return 4
    print(f"report in {file}")
    return 0


class LivePage:
    """The page of a run that may be under way; made again when what is in the folder has changed, and somebody asks.

    A run replaces its files as a whole and adds snapshots as files, so that they can be read at any moment.
    """

    def __init__(self, folder, write):
        self.folder = Path(folder)
        self._write = write
        self._lock = threading.Lock()
        self._made_of = None
        self._html = b""

    def version(self):
        """A short text that changes when the page does."""
        states = []
        for name in ("summary.json", "diagnostics.csv", "vesicle.h5", "fluid.h5"):
            try:
                state = (self.folder / name).stat()
                states.append(f"{state.st_mtime_ns:x}-{state.st_size:x}-{state.st_ino:x}")
            except OSError:
                states.append("")
        try:
            states.append(str(len(os.listdir(self.folder / "snapshots"))))
        except OSError:
            states.append("")
        return "/".join(states)

    def html(self):
        """The page as bytes.

        Raises ReportError where there is none yet.
        """
        with self._lock:
            version = self.version()
            if version != self._made_of:
                self._html = self._make()
                self._made_of = version
            return self._html

    def _make(self):
        with tempfile.TemporaryDirectory(prefix="vesiflow_view_") as folder:
            page = Path(folder) / "report.html"
            self._write(self.folder, page, MOST_FRAMES, True)
            return page.read_bytes()


_WAITING = """<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><meta http-equiv="refresh" content="2">
<title>Vesiflow</title></head><body><p>There is nothing to see yet. This page asks again every two seconds.</p></body></html>
"""


def _handler(page):
    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            # A page of another site that has this machine's address under its own name is not answered.
            if self.headers.get("Host", "").rsplit(":", 1)[0] not in (ADDRESS, "localhost"):
                self.send_error(403)
            elif self.path == "/version":
                self._answer(page.version().encode(), "text/plain; charset=utf-8")
            elif self.path in ("/", "/index.html"):
                try:
                    html = page.html()
                except ReportError:
                    html = _WAITING.encode()
                self._answer(html, "text/html; charset=utf-8")
            else:
                self.send_error(404)

        def _answer(self, body, kind):
            self.send_response(200)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(body)))
            self.send_header("Cache-Control", "no-store")
            self.send_header("X-Content-Type-Options", "nosniff")
            self.end_headers()
            try:
                self.wfile.write(body)
            except (BrokenPipeError, ConnectionResetError):
                pass  # the reader has gone

        def log_message(self, *_):
            pass

    return Handler


def serve(folder, port=DEFAULT_PORT):
    """A server of the live page of `folder` on this machine alone; port 0 takes a free one. Call `serve_forever()` of what it returns.

    Raises ReportError without library and app, OSError where the port is taken.
    """
    return http.server.ThreadingHTTPServer((ADDRESS, port), _handler(LivePage(folder, page_writer())))


def view_main(argv=None):
    """Serves a run's folder until Ctrl-C; returns the exit code."""
    parser = argparse.ArgumentParser(prog="vesiflow view", description="Shows a run under way in a browser on this machine, always up to date.")
    parser.add_argument("folder", help="folder of the run; it may be empty as yet")
    parser.add_argument("--port", type=int, default=DEFAULT_PORT, help="of the page's address (default: %(default)s; 0: any that is free)")
    parser.add_argument("--open", action="store_true", help="open the page in the browser")
    arguments = parser.parse_args(argv)
    if not Path(arguments.folder).is_dir():
        parser.error(f"{arguments.folder}: is not a folder")
    if not 0 <= arguments.port <= 65535:
        parser.error(f"--port {arguments.port}: must be from 0 to 65535")
    try:
        server = serve(arguments.folder, arguments.port)
    except ReportError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"error: --port {arguments.port}: {error.strerror}; --port 0 takes one that is free", file=sys.stderr)
        return 1
    address = f"http://{ADDRESS}:{server.server_address[1]}/"
    print(f"{arguments.folder} is at {address} until Ctrl-C", flush=True)
    if arguments.open:
        webbrowser.open(address)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        pass
    finally:
        server.server_close()
    return 0


if __name__ == "__main__":
    sys.exit(view_main())
