# SPDX-License-Identifier: MIT
"""Footage of 10 bits through a file, a pipe and Python: the same samples by each."""

import shutil
import subprocess
import unittest

import numpy as np
import support

import sigs

FRAMES = range(3, 11)


class DeepFootage(support.InFolder):
    def setUp(self):
        super().setUp()
        if shutil.which("ffmpeg") is None:
            raise unittest.SkipTest("ffmpeg is absent")
        source = "gradients=s=320x240:c0=skyblue:c1=white:d=1:r=25:seed=1,format=yuv420p10le"
        command = ["ffmpeg", "-v", "error", "-f", "lavfi", "-i", source, "-c:v", "ffv1", str(self.folder / "deep.mkv")]
        subprocess.run(command, check=True)
        self.project_file = self.folder / "deep.json"
        command = [str(support.BUILD / "sigs"), "init", str(self.folder / "deep.mkv"), "--out", str(self.project_file)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.range = ("--frames", f"{FRAMES[0]}-{FRAMES[-1]}")

    def test_file_pipe_and_python_have_the_same_samples_of_10_bits(self):
        support.exported(self.project_file, self.folder / "out", *self.range)
        by_file = support.decoded(self.folder / "out/deep.mkv", "yuv420p10le")

        export = [str(support.BUILD / "sigs"), "export", str(self.project_file), "--out", "-", "--container", "y4m"]
        with subprocess.Popen([*export, "--progress", "none", *self.range], stdout=subprocess.PIPE) as pipe:
            command = ["ffmpeg", "-v", "error", "-i", "-", "-f", "rawvideo", "-pix_fmt", "yuv420p10le", "-"]
            by_pipe = subprocess.run(command, check=True, stdin=pipe.stdout, stdout=subprocess.PIPE).stdout
        self.assertEqual(pipe.returncode, 0)

        frames = list(sigs.open(self.project_file).frames(FRAMES))
        by_python = b"".join(support.samples(frame) for frame in frames)
        self.assertEqual({plane.dtype for frame in frames for plane in frame.planes}, {np.dtype(np.uint16)})
        self.assertGreater(max(int(frame.mask.max()) for frame in frames), 0)
        self.assertEqual(len(by_file), len(FRAMES) * 320 * 240 * 3)
        self.assertTrue(by_file == by_pipe == by_python)


if __name__ == "__main__":
    unittest.main()
