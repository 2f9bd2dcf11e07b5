# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Lets CMake compile the parts of the package vesiflow that are in C++. All else is in pyproject.toml.

CMAKE_ARGS in the environment has options for CMake, such as -DVESIFLOW_ARCH=x86-64-v3 for other machines than this one.
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """Configures, compiles and installs the component "python" into the package."""

    def run(self):
        if shutil.which("cmake") is None:
            sys.exit("CMake is needed to compile vesiflow (Debian: cmake, ninja-build)")
        build, target = Path(self.build_temp).resolve() / "cmake", Path(self.build_lib).resolve()
        if self.inplace:
            target = ROOT / "python"
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DVESIFLOW_BUILD_PYTHON=ON", "-DVESIFLOW_BUILD_APPS=OFF", "-DVESIFLOW_BUILD_TESTS=OFF",
                   "-DVESIFLOW_BATCH=8", f"-DPython_EXECUTABLE={sys.executable}", "-DVESIFLOW_PYTHON_DESTINATION=vesiflow"]
        for command in (["cmake", "-S", ROOT, "-B", build, *generator, *options, *shlex.split(os.environ.get("CMAKE_ARGS", ""))],
                        ["cmake", "--build", build, "--target", "python_package", "--parallel", str(len(os.sched_getaffinity(0)))],
                        ["cmake", "--install", build, "--component", "python", "--prefix", target]):
            subprocess.run([str(word) for word in command], check=True)

    def get_outputs(self):
        return [str(path) for path in (Path(self.build_lib) / "vesiflow").glob("*.so*")]


version = re.search(r"project\(Vesiflow VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
setup(version=version, ext_modules=[Extension("vesiflow._run", sources=[])], cmdclass={"build_ext": CMakeBuild})
