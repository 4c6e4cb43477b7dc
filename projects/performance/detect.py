#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A plain detector, as an example: small things that are darker or brighter than what is around them.

    detect.py VIDEO ... --out FOLDER

For each video it writes FOLDER/NAME.csv in the layout that `sigs evaluate` reads: frame, x, y, width, height, score and
track. It needs OpenCV and NumPy (python3-opencv), no training and no network. It knows neither truth nor camera.
"""

import argparse
import csv
import itertools
import pathlib

import cv2
import numpy as np

SCALES = (1, 2, 4)  # the image is also looked at so many times smaller, for larger things
WINDOW_PX = 25  # of the mean that stands for the background; larger things are not found at this scale
THRESHOLD = 6.0  # difference to it in code values
ROUGHNESS = 4.0  # what is rough everywhere, as land is, needs so many times its mean difference more
GROWN = (2.0, 1.5)  # width and height of a box, as multiples: what stands out is the body, not the thin wings
MOST_BOXES = 8  # of a frame, the strongest ones
STEP_PX = 24  # that a thing moves at most from one frame to the next
MISSED_FRAMES = 4  # after which a track ends


def boxes_at_scale(gray, scale):
    """(score, x, y, width, height) of each thing that stands out at one scale, in pixels of the whole image."""
    size = (gray.shape[1] // scale, gray.shape[0] // scale)
    small = cv2.resize(gray, size, interpolation=cv2.INTER_AREA) if scale > 1 else cv2.GaussianBlur(gray, (3, 3), 0)
    difference = cv2.absdiff(small, cv2.blur(small, (WINDOW_PX, WINDOW_PX)))
    roughness = cv2.blur(difference.astype(np.float32), (101, 101))
    stands_out = (difference > THRESHOLD + ROUGHNESS * roughness).astype(np.uint8)
    # Pieces of one thing are joined.
    stands_out = cv2.morphologyEx(stands_out, cv2.MORPH_CLOSE, np.ones((7, 7), np.uint8))
    count, labels, stats, _ = cv2.connectedComponentsWithStats(stands_out)
    found = []
    for i in range(1, count):
        x, y, width, height, area = (int(n) for n in stats[i])
        if area < 4 or max(width, height) > 2 * WINDOW_PX:
            continue
        part = labels[y : y + height, x : x + width] == i
        inside = difference[y : y + height, x : x + width][part]
        around = roughness[y + height // 2, x + width // 2]
        score = float(inside.max() / (THRESHOLD + ROUGHNESS * around))
        grown = [scale * width * GROWN[0], scale * height * GROWN[1]]
        found.append((score, scale * (x + width / 2) - grown[0] / 2, scale * (y + height / 2) - grown[1] / 2, *grown))
    return found


def overlap(a, b):
    width = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    height = min(a[2] + a[4], b[2] + b[4]) - max(a[2], b[2])
    return width > 0 and height > 0


def boxes_of(gray):
    """The boxes of all scales, the strongest first; of those that overlap the larger one."""
    found = [box for scale in SCALES for box in boxes_at_scale(gray, scale)]
    kept = []
    for box in sorted(found, key=lambda box: box[3] * box[4], reverse=True):
        if not any(overlap(box, other) for other in kept):
            kept.append(box)
    return sorted(kept, reverse=True)[:MOST_BOXES]


def tracks_of(boxes, tracks, frame, ids):
    """The track of each box: that of the nearest box of the frames before, else another one."""
    taken = []
    for score, x, y, width, height in boxes:
        at = np.array([x + width / 2, y + height / 2])
        near = [t for t in tracks if t["seen"] < frame and np.linalg.norm(t["at"] - at) < STEP_PX]
        if near:
            track = min(near, key=lambda t: np.linalg.norm(t["at"] - at))
        else:
            track = {"id": next(ids)}
            tracks.append(track)
        track.update(at=at, seen=frame)
        taken.append(track["id"])
    tracks[:] = [t for t in tracks if frame - t["seen"] < MISSED_FRAMES]
    return taken


def detect(video, file):
    footage = cv2.VideoCapture(str(video))
    if not footage.isOpened():
        raise SystemExit(f"{video}: cannot be opened")
    tracks, rows, frame, ids = [], [], 0, itertools.count(1)
    while True:
        is_there, image = footage.read()
        if not is_there:
            break
        boxes = boxes_of(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY))
        for (score, x, y, width, height), track in zip(boxes, tracks_of(boxes, tracks, frame, ids)):
            rows.append([frame, *(f"{n:.1f}" for n in (x, y, width, height, score)), track])
        frame += 1
    partial = file.with_suffix(".part")
    with open(partial, "w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["frame", "x", "y", "width", "height", "score", "track"])
        writer.writerows(rows)
    partial.replace(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("videos", nargs="+", type=pathlib.Path)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--keep", action="store_true", help="leave out videos whose results are there and newer")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for number, video in enumerate(options.videos, 1):
        file = options.out / (video.stem + ".csv")
        if options.keep and file.exists() and file.stat().st_mtime > video.stat().st_mtime:
            continue
        detect(video, file)
        print(f"{number} of {len(options.videos)}: {video.stem}", flush=True)


if __name__ == "__main__":
    main()
