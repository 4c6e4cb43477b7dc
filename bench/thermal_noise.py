#!/usr/bin/env python3
"""Noise and gain of thermal clips, for docs/thermal.md: how much of the noise is fixed to the sensor, and whether the
background changes with the target's size.

    bench/thermal_noise.py [FOLDER]     default: ../shared/data/thermal; needs FFmpeg and numpy

A line for each clip, 8-bit codes, from its first 240 frames: `noise` is the standard deviation of what is left of flat
parts less the mean of 7x7 pixels around; `fixed` the part of it that is the same in both halves of the clip, by their
covariance; `columns` and `rows` the same of the means over columns and rows. `small` and `large` are the median of all
that is at least 40 px from the labelled target in the fifths of frames with its smallest and largest boxes (first 400
frames), with the largest box's share of the image.
"""
import csv
import pathlib
import subprocess
import sys

import numpy as np


def frames_of(clip, count):
    probe = ["ffprobe", "-v", "error", "-select_streams", "v", "-show_entries", "stream=width,height", "-of", "csv=p=0", clip]
    width, height = (int(n) for n in subprocess.run(probe, capture_output=True, text=True, check=True).stdout.strip().split(",")[:2])
    decode = ["ffmpeg", "-v", "error", "-i", clip, "-frames:v", str(count), "-f", "rawvideo", "-pix_fmt", "gray", "-"]
    return np.frombuffer(subprocess.run(decode, capture_output=True, check=True).stdout, np.uint8).reshape(-1, height, width)


def mean_around(image, side=7):
    half = side // 2
    sums = np.cumsum(np.cumsum(np.pad(np.pad(image, half, mode="edge"), ((1, 0), (1, 0))), 0), 1)
    return (sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side]) / side**2


def shared_sd(a, b):
    return np.sqrt(max(np.mean((a - a.mean()) * (b - b.mean())), 0))


def noise_of(frames):
    halves, deviations = [], []
    for half in (frames[: len(frames) // 2], frames[len(frames) // 2 :]):
        total, count = np.zeros(frames[0].shape), np.zeros(frames[0].shape)
        for frame in half.astype(np.float64):
            left = frame - mean_around(frame)
            is_flat = mean_around(left**2) < 16
            total += np.where(is_flat, left, 0)
            count += is_flat
            deviations.append(left[is_flat].std() if is_flat.any() else 0)
        halves.append(np.where(2 * count > len(half), total / np.maximum(count, 1), np.nan))
    known = ~np.isnan(halves[0] + halves[1])
    if known.sum() < 1000:
        return None
    lines = []
    for axis in (0, 1):
        enough = known.sum(axis) > 30
        lines.append([np.nanmean(np.where(known, half, np.nan)[:, enough] if axis == 0 else np.where(known, half, np.nan)[enough], axis) for half in halves])
    return np.median(deviations), shared_sd(halves[0][known], halves[1][known]), shared_sd(*lines[0]), shared_sd(*lines[1])


def gain_of(frames, boxes):
    areas, backgrounds = [], []
    for number, frame in enumerate(frames):
        if number not in boxes:
            continue
        x, y, width, height = boxes[number]
        is_far = np.ones(frame.shape, bool)
        is_far[max(0, int(y - 40)) : int(y + height + 40), max(0, int(x - 40)) : int(x + width + 40)] = False
        if is_far.sum() > 2000:
            areas.append(width * height / frame.size)
            backgrounds.append(np.median(frame[is_far]))
    if len(areas) < 30:
        return None
    areas, backgrounds = np.array(areas), np.array(backgrounds)
    low, high = np.quantile(areas, 0.2), np.quantile(areas, 0.8)
    return np.median(backgrounds[areas <= low]), np.median(backgrounds[areas >= high]), areas.max()


folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2] / "shared/data/thermal")
print(f"{'clip':22}{'noise':>7}{'fixed':>7}{'columns':>9}{'rows':>6}{'small':>8}{'large':>7}{'largest box':>13}")
for clip in sorted(folder.glob("IR_*.mp4")):
    frames = frames_of(clip, 400)
    boxes = {}
    with open(clip.with_name(clip.stem + "_gt.csv")) as file:
        for row in csv.DictReader(file):
            if float(row["w"] or 0) > 0:
                boxes[int(row["frame"])] = tuple(float(row[key]) for key in "xywh")
    noise, gain = noise_of(frames[:240]), gain_of(frames, boxes)
    line = f"{clip.stem:22}" + ("{:7.2f}{:7.2f}{:9.2f}{:6.2f}".format(*noise) if noise else f"{'no flat parts':>29}")
    print(line + ("{:8.0f}{:7.0f}{:12.1%}".format(*gain) if gain else ""), flush=True)
