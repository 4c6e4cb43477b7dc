# SPDX-License-Identifier: MIT
"""Runs one file of tests: run.py BUILD FILE. Exit status 77 where all its tests were skipped."""

import importlib
import os
import pathlib
import sys
import unittest


def main() -> int:
    build = pathlib.Path(sys.argv[1]).resolve()
    file = pathlib.Path(sys.argv[2]).resolve()
    places = [str(build / "python"), str(file.parent)]
    os.environ["SIGS_BUILD"] = str(build)
    os.environ["PYTHONPATH"] = os.pathsep.join(places)  # of processes that are started anew
    sys.path[:0] = places
    module = importlib.import_module(file.stem)
    result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromModule(module))
    if not result.wasSuccessful():
        return 1
    return 77 if result.testsRun > 0 and len(result.skipped) == result.testsRun else 0


if __name__ == "__main__":
    sys.exit(main())
