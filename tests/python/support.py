# SPDX-License-Identifier: MIT
"""What the tests share: places, the programs, and a small project of its own."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

BUILD = pathlib.Path(os.environ.get("SIGS_BUILD", "build/release"))
SOURCE = pathlib.Path(__file__).resolve().parents[2]
CROSSING = SOURCE / "projects/crossing/crossing.json"


class InFolder(unittest.TestCase):
    """A test with a folder of its own, self.folder."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="sigs_python_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)


def decoded(video, pixel_format, first=0, count=None):
    """All samples of a video's frames as FFmpeg's own program decodes them: bytes."""
    if shutil.which("ffmpeg") is None:
        raise unittest.SkipTest("ffmpeg is absent")
    limits = ["-vf", f"trim=start_frame={first}"] + (["-frames:v", str(count)] if count else [])
    command = ["ffmpeg", "-v", "error", "-i", str(video), *limits, "-f", "rawvideo", "-pix_fmt", pixel_format, "-"]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout


def exported(project, folder, *options):
    """Exports with the program `sigs`."""
    command = [str(BUILD / "sigs"), "export", str(project), "--out", str(folder), "--progress", "none", *options]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def samples(frame):
    """The samples of all planes, one after the other."""
    return b"".join(np.ascontiguousarray(plane).tobytes() for plane in frame.planes)
