# SPDX-License-Identifier: MIT
"""Several threads, forked and spawned processes, and Ctrl-C."""

import concurrent.futures
import hashlib
import multiprocessing
import signal
import subprocess
import sys
import time
import unittest

import support

import sigs

NUMBERS = (97, 98, 99, 100)
PROJECT = sigs.open(support.CROSSING)


def digest(frame):
    return hashlib.sha256(support.samples(frame)).hexdigest()


def rendered(number):
    return digest(PROJECT.render(number))


def next_of_inherited(frames, answer):
    try:
        next(frames)
        answer.put("a frame")
    except sigs.UsageError as error:
        answer.put(str(error))


class Processes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.expected = [digest(frame) for frame in PROJECT.frames(range(NUMBERS[0], NUMBERS[-1] + 1))]

    def results_of(self, method):
        context = multiprocessing.get_context(method)
        with context.Pool(2) as pool:
            return pool.map_async(rendered, NUMBERS).get(timeout=300)

    def test_forked_processes_render_the_same_frames_before_this_one_has_and_after(self):
        self.assertEqual(self.results_of("fork"), self.expected)
        self.assertEqual(rendered(NUMBERS[0]), self.expected[0])
        self.assertEqual(self.results_of("fork"), self.expected)
        self.assertEqual(rendered(NUMBERS[1]), self.expected[1])

    def test_spawned_processes_render_the_same_frames(self):
        self.assertEqual(self.results_of("spawn"), self.expected)

    def test_frames_that_are_being_iterated_stay_with_their_process(self):
        context = multiprocessing.get_context("fork")
        answer = context.Queue()
        with PROJECT.frames(range(90, 110)) as frames:
            self.assertEqual(next(frames).index, 90)
            child = context.Process(target=next_of_inherited, args=(frames, answer))
            child.start()
            self.assertIn("forked", answer.get(timeout=300))
            child.join(60)
            self.assertEqual(child.exitcode, 0)
            self.assertEqual([frame.index for frame in frames], list(range(91, 110)))

    def test_threads_share_a_project_and_a_video(self):
        video = sigs.Video(PROJECT.footage.path)
        first = video[5]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            self.assertEqual(list(pool.map(rendered, NUMBERS * 3)), self.expected * 3)
            self.assertTrue(all((image == first).all() for image in pool.map(video.__getitem__, [5] * 8)))

    def test_threads_share_the_frames_of_one_iterator(self):
        frames = PROJECT.frames(range(90, 110), jobs=2)
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            numbers = [n for part in pool.map(lambda _: [f.index for f in frames], range(3)) for n in part]
        self.assertEqual(sorted(numbers), list(range(90, 110)))


class Interrupts(support.InFolder):
    def interrupted(self, code):
        """Runs a program that says "ready", sends it Ctrl-C, and returns what else it says."""
        child = subprocess.Popen(
            [sys.executable, "-c", code, str(support.CROSSING), str(self.folder)],
            stdout=subprocess.PIPE,
            text=True,
        )
        with child:
            self.assertEqual(child.stdout.readline(), "ready\n")
            time.sleep(0.3)
            child.send_signal(signal.SIGINT)
            return child.communicate(timeout=120)[0].strip()

    def test_ctrl_c_stops_an_export_and_leaves_no_file(self):
        said = self.interrupted(
            "import sys, sigs\n"
            "project = sigs.open(sys.argv[1])\n"
            "first = True\n"
            "def progress(done, total):\n"
            "    global first\n"
            "    if first: print('ready', flush=True)\n"
            "    first = False\n"
            "try:\n"
            "    while True: sigs.export(project, sys.argv[2] + '/out', jobs=1, overwrite=True, progress=progress)\n"
            "except KeyboardInterrupt: print('stopped')\n"
        )
        self.assertEqual(said, "stopped")
        self.assertEqual([file.name for file in (self.folder / "out").glob("*") if ".part" in file.name], [])

    def test_ctrl_c_stops_an_iteration(self):
        said = self.interrupted(
            "import sys, sigs\n"
            "project = sigs.open(sys.argv[1])\n"
            "print('ready', flush=True)\n"
            "try:\n"
            "    while True:\n"
            "        for frame in project.frames(): frame.rgb\n"
            "except KeyboardInterrupt: print('stopped')\n"
            "print(project.render(3).index)\n"
        )
        self.assertEqual(said, "stopped\n3")

    def test_ctrl_c_stops_rendering_and_the_project_stays_usable(self):
        said = self.interrupted(
            "import sys, sigs\n"
            "project = sigs.open(sys.argv[1])\n"
            "print('ready', flush=True)\n"
            "try:\n"
            "    while True: project.render(150); project.render(20)\n"
            "except KeyboardInterrupt: print('stopped')\n"
            "print(project.render(3).index)\n"
        )
        self.assertEqual(said, "stopped\n3")

    def test_an_exception_of_the_progress_function_stops_the_export(self):
        class Enough(Exception):
            pass

        def progress(done, total):
            raise Enough

        with self.assertRaises(Enough):
            sigs.export(PROJECT, self.folder / "out", progress=progress)
        self.assertFalse((self.folder / "out" / "crossing.mkv").exists())


if __name__ == "__main__":
    unittest.main()
