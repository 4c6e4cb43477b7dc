#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A plain detector, as an example: small things that are darker or brighter than what is around them.

    detect.py VIDEO ... --out FOLDER

For each video it writes FOLDER/NAME.csv in the layout that `sigs evaluate` reads: frame, x, y, width, height, score and
track. It needs OpenCV and NumPy (python3-opencv), no training and no network. It knows neither truth nor camera.
"""

import argparse
import csv
import pathlib

import cv2
import numpy as np

WINDOW_PX = 21  # of the median that stands for the background; larger things are not found
THRESHOLD = 9.0  # difference to it in code values, after the noise is smoothed
MOST_BOXES = 40  # of a frame, the strongest ones
STEP_PX = 24  # that a thing moves at most from one frame to the next
MISSED_FRAMES = 4  # after which a track ends


def boxes_of(gray):
    """(score, x, y, width, height) of each thing that stands out, the strongest first."""
    smooth = cv2.GaussianBlur(gray, (3, 3), 0)
    background = cv2.medianBlur(smooth, WINDOW_PX)
    difference = cv2.absdiff(smooth, background)
    # What is rough everywhere, as land is, needs a larger difference.
    roughness = cv2.blur(difference.astype(np.float32), (61, 61))
    stands_out = (difference > THRESHOLD + 4 * roughness).astype(np.uint8)
    stands_out = cv2.dilate(stands_out, np.ones((3, 3), np.uint8))
    count, labels, stats, _ = cv2.connectedComponentsWithStats(stands_out)
    found = []
    for i in range(1, count):
        x, y, width, height, area = stats[i]
        if area < 6 or max(width, height) > 3 * WINDOW_PX:
            continue
        part = labels[y : y + height, x : x + width] == i
        score = float(difference[y : y + height, x : x + width][part].max())
        # The dilation has grown it by a pixel on each side.
        found.append((score, x + 1, y + 1, max(1, width - 2), max(1, height - 2)))
    return sorted(found, reverse=True)[:MOST_BOXES]


def tracks_of(boxes, tracks, frame):
    """The track of each box: that of the nearest box of the frames before, else another one."""
    taken = []
    for score, x, y, width, height in boxes:
        at = np.array([x + width / 2, y + height / 2])
        near = [t for t in tracks if t["seen"] < frame and np.linalg.norm(t["at"] - at) < STEP_PX]
        if near:
            track = min(near, key=lambda t: np.linalg.norm(t["at"] - at))
        else:
            track = {"id": tracks_of.next_id}
            tracks_of.next_id += 1
            tracks.append(track)
        track.update(at=at, seen=frame)
        taken.append(track["id"])
    tracks[:] = [t for t in tracks if frame - t["seen"] < MISSED_FRAMES]
    return taken


tracks_of.next_id = 1


def detect(video, file):
    footage = cv2.VideoCapture(str(video))
    if not footage.isOpened():
        raise SystemExit(f"{video}: cannot be opened")
    tracks, rows, frame = [], [], 0
    while True:
        is_there, image = footage.read()
        if not is_there:
            break
        boxes = boxes_of(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY))
        for (score, x, y, width, height), track in zip(boxes, tracks_of(boxes, tracks, frame)):
            rows.append([frame, x, y, width, height, f"{score:.1f}", track])
        frame += 1
    with open(file, "w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["frame", "x", "y", "width", "height", "score", "track"])
        writer.writerows(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("videos", nargs="+", type=pathlib.Path)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for number, video in enumerate(options.videos, 1):
        detect(video, options.out / (video.stem + ".csv"))
        print(f"{number} of {len(options.videos)}: {video.stem}", flush=True)


if __name__ == "__main__":
    main()
