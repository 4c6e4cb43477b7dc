# SPDX-License-Identifier: MIT
"""A camera that keeps an intruder in the middle of the image, by what it sees: closed_loop.py PROJECT"""

import sys

import numpy as np

import sigs


def main(path: str) -> list[float]:
    project = sigs.open(path)
    width, _ = project.footage.size_px
    name = project.intruders[0].name
    focal_length_px = width / 2  # roughly; the loop is closed, so it need not be exact
    yaw_deg, errors_px = 0.0, []
    for n in project.frame_range[40:80]:
        camera = sigs.Pose((22.0 * n / 25, 0, -150), (0, 0, yaw_deg))
        frame = project.render(n, camera=camera)
        columns = np.flatnonzero(frame.visible(0).any(axis=0))  # a detector would go here
        if len(columns) == 0:
            break
        error_px = float(columns.mean() - width / 2)
        errors_px.append(error_px)
        yaw_deg += 0.5 * float(np.degrees(np.arctan(error_px / focal_length_px)))
        print(n, name, f"{error_px:+.1f} px", f"yaw {yaw_deg:+.2f}")
    return errors_px


if __name__ == "__main__":
    main(sys.argv[1])
