# SPDX-License-Identifier: MIT
"""The wheel: built without network, installed into an environment of its own, used there."""

import importlib.util
import os
import subprocess
import sys
import unittest
import zipfile

import support

import sigs


def missing():
    return [name for name in ("build", "venv", "ensurepip") if importlib.util.find_spec(name) is None]


@unittest.skipIf(missing(), f"Python's modules are absent: {missing()}")
class Wheel(support.InFolder):
    def run_alone(self, *command, **more):
        environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "SIGS_BUILD")}
        done = subprocess.run(
            [str(word) for word in command], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def test_an_installed_wheel_works_without_the_source_tree(self):
        build = [sys.executable, "-m", "build", "--wheel", "--no-isolation", f"-Cbuild-dir={support.BUILD}"]
        self.run_alone(*build, "--outdir", self.folder, cwd=support.SOURCE)
        (wheel,) = self.folder.glob("sigs-*.whl")
        names = zipfile.ZipFile(wheel).namelist()
        for file in ("__init__.py", "_sigs.pyi", "py.typed", "truth.py"):
            self.assertIn(f"sigs/{file}", names)
        self.assertFalse([name for name in names if not name.startswith("sigs")])
        self.run_alone(sys.executable, "-m", "venv", "--system-site-packages", self.folder / "venv")
        python = self.folder / "venv/bin/python3"
        self.run_alone(python, "-m", "pip", "install", "--no-deps", "--no-index", wheel)
        code = "import sigs; print(sigs.__version__, sigs.__file__)"
        version, place = self.run_alone(python, "-c", code, cwd=self.folder).split()
        self.assertEqual(version, sigs.__version__)
        self.assertTrue(place.startswith(str(self.folder.resolve())), place)
        example = support.SOURCE / "docs/examples/python/frames.py"
        said = self.run_alone(python, example, support.CROSSING, cwd=self.folder)
        self.assertEqual(len(said.splitlines()), 10)
        listed = self.run_alone(python, "-m", "pip", "show", "sigs")
        self.assertIn(f"Version: {version}", listed)


if __name__ == "__main__":
    unittest.main()
