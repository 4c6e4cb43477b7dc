# SPDX-License-Identifier: MIT
"""Labels as arrays, and images and masks beside them: labels.py FOLDER NAME"""

import pathlib
import sys

import numpy as np

import sigs


def main(folder: str, name: str) -> None:
    out = pathlib.Path(folder)
    labels = sigs.read_labels(out / f"{name}.xml")
    columns = labels.columns()  # one row for each intruder in each frame
    seen = columns["pixels"] > 0
    print(f"{len(labels)} frames of {labels.video}, {np.count_nonzero(seen)} boxes")
    if seen.any():
        print(f"distances: {columns['distance_m'][seen].min():.0f} to {columns['distance_m'][seen].max():.0f} m")

    video = sigs.Video(out / f"{name}.mkv")
    masks = sigs.Video(out / f"{name}.masks.mkv")
    for i, frame in enumerate(labels):  # frame i of the labels belongs to image i of both videos
        for intruder in frame.visible:
            assert intruder.box is not None
            crop = video[i][intruder.box.slices]  # rows, columns, RGB
            opacity = masks[i][intruder.box.slices]
            print(frame.index, intruder.name, f"{intruder.distance_m:.1f} m", crop.shape, f"{opacity.mean():.0f}")
            return


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
