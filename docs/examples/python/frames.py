# SPDX-License-Identifier: MIT
"""The frames of a project without writing them: frames.py PROJECT"""

import sys

import sigs


def main(path: str) -> None:
    project = sigs.open(path)
    project["camera.speed_mps"] = 30
    for problem in project.problems():
        print(problem.field, problem.what)

    airliner = project.intruders[0]
    frames, positions_m = airliner.waypoints
    airliner.waypoints = (frames, positions_m + [0, 20, 0])  # 20 m to the right

    for frame in project.frames(range(90, 100)):
        intruder = frame.truth.intruder(airliner.name)
        print(frame.index, frame.rgb.shape, frame.mask.max(), intruder.box, f"{intruder.distance_m:.1f} m")


if __name__ == "__main__":
    main(sys.argv[1])
