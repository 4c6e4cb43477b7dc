#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Trains a small detector on images that `sigs dataset` made, and lets it look at others.

    python3 train_detector.py train DATASET/labels/coco/train.json --images DATASET --out detector.pt
    python3 train_detector.py detect DATASET/labels/coco/val.json --images DATASET --weights detector.pt --out found.json
    sigs evaluate detect DATASET --split val --results found.json
    python3 train_detector.py watch VIDEOS... --weights detector.pt --out FOLDER      # needs python3-opencv
    sigs evaluate performance DATASET --results FOLDER

It finds where aircraft are and how large they look, not of which category they are. Needs PyTorch, NumPy and
Pillow (Debian: python3-torch python3-numpy python3-pil).

Pixels: (0, 0) is the corner of the first pixel, as in COCO. Boxes are left, top, width, height.
"""
import argparse
import json
import math
import pathlib
import sys
import time

import numpy as np
import torch
from torch import nn
from torch.nn import functional as F

STRIDE = 4  # pixels of the image a cell of the detector's map is wide
CROP_PX = 128  # side of what is trained on
BATCH = 16  # crops a step


def read_image(path):
    """An image as an array of height x width x 3 bytes: red, green, blue."""
    from PIL import Image

    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"))


class Images:
    """Images with boxes to find and boxes to ignore, read from a COCO file."""

    def __init__(self, coco_file, root, find_real=False, keep=lambda image: True):
        """find_real: real aircraft of the footage are to be found, and inserted ones are ignored."""
        coco = json.loads(pathlib.Path(coco_file).read_text())
        listed = [image for image in coco["images"] if keep(image)]
        places = {image["id"]: i for i, image in enumerate(listed)}
        self.ids = [image["id"] for image in listed]
        self.names = [image["file_name"] for image in listed]
        self.pixels = [read_image(pathlib.Path(root) / name) for name in self.names]
        self.boxes = [[] for _ in listed]
        self.ignored = [[] for _ in listed]
        for annotation in coco["annotations"]:
            place = places.get(annotation["image_id"])
            if place is None:
                continue
            is_real = annotation.get("real_aircraft", False)
            found = is_real if find_real else not annotation["iscrowd"] and not annotation.get("distractor", False)
            boxes = self.boxes if found else self.ignored
            if annotation["bbox"] not in boxes[place]:  # a crowd region is there once for each category
                boxes[place].append(annotation["bbox"])

    def __len__(self):
        return len(self.pixels)


class Detector(nn.Module):
    """A map, a quarter of the image's size, of where middles of aircraft are, and of the logarithm of their sizes.

    Some 120,000 numbers: three scales down, one up.
    """

    def __init__(self):
        super().__init__()

        def layer(inputs, outputs, stride=1):
            return nn.Sequential(
                nn.Conv2d(inputs, outputs, 3, stride, 1, bias=False), nn.BatchNorm2d(outputs), nn.ReLU(inplace=True)
            )

        self.fine = nn.Sequential(layer(3, 16, 2), layer(16, 16))
        self.middle = nn.Sequential(layer(16, 32, 2), layer(32, 32))
        self.coarse = nn.Sequential(layer(32, 64, 2), layer(64, 64))
        self.merge = nn.Sequential(layer(96, 32), layer(32, 32))
        self.out = nn.Conv2d(32, 3, 1)
        nn.init.constant_(self.out.bias, 0)
        with torch.no_grad():
            self.out.bias[0] = -4  # hardly any cell has an aircraft

    def forward(self, pixels):
        quarter = self.middle(self.fine(pixels))
        eighth = F.interpolate(self.coarse(quarter), size=quarter.shape[2:], mode="nearest")
        out = self.out(self.merge(torch.cat([quarter, eighth], 1)))
        return out[:, 0], out[:, 1:]


def crop_around(image_size, boxes, random):
    """The corner of a crop: two of three have an aircraft in them, if the image has one."""
    height, width = image_size
    x, y = random.uniform(0, width - CROP_PX), random.uniform(0, height - CROP_PX)
    if boxes and random.random() < 2 / 3:
        left, top, w, h = boxes[random.integers(len(boxes))]
        x = left + w / 2 - random.uniform(0.1, 0.9) * CROP_PX
        y = top + h / 2 - random.uniform(0.1, 0.9) * CROP_PX
    return int(min(max(x, 0), width - CROP_PX)), int(min(max(y, 0), height - CROP_PX))


def targets_of(boxes, ignored, corner):
    """Maps for a crop: heat (1 at the middle of a box, falling off around it), sizes, and where each counts."""
    cells = CROP_PX // STRIDE
    heat = np.zeros((cells, cells), np.float32)
    sizes = np.zeros((2, cells, cells), np.float32)
    has_size = np.zeros((cells, cells), np.float32)
    counts = np.ones((cells, cells), np.float32)
    rows, columns = np.mgrid[0:cells, 0:cells]
    for left, top, w, h in ignored:
        x0, y0 = (left - corner[0]) / STRIDE, (top - corner[1]) / STRIDE
        inside = (columns >= x0 - 1) & (columns <= x0 + w / STRIDE) & (rows >= y0 - 1) & (rows <= y0 + h / STRIDE)
        counts[inside] = 0
    for left, top, w, h in boxes:
        x, y = (left + w / 2 - corner[0]) / STRIDE, (top + h / 2 - corner[1]) / STRIDE
        column, row = int(math.floor(x)), int(math.floor(y))
        if not (0 <= column < cells and 0 <= row < cells):
            continue
        spread = max(0.7, 0.12 * max(w, h) / STRIDE)
        peak = np.exp(-((columns - column) ** 2 + (rows - row) ** 2) / (2 * spread**2)).astype(np.float32)
        heat = np.maximum(heat, peak)
        sizes[:, row, column] = np.log(max(w, 1)), np.log(max(h, 1))
        has_size[row, column] = 1
        counts[row, column] = 1
    return heat, sizes, has_size, counts


def crop_of(images, random):
    """A crop with its maps: mirrored half of the time, its light and contrast changed a little."""
    i = random.integers(len(images))
    pixels = images.pixels[i]
    corner = crop_around(pixels.shape[:2], images.boxes[i], random)
    crop = pixels[corner[1] : corner[1] + CROP_PX, corner[0] : corner[0] + CROP_PX].astype(np.float32) / 255
    maps = targets_of(images.boxes[i], images.ignored[i], corner)
    if random.random() < 0.5:
        crop = crop[:, ::-1]
        maps = tuple(one[..., ::-1] for one in maps)
    crop = (crop - 0.5) * random.uniform(0.7, 1.3) + 0.5 + random.uniform(-0.15, 0.15)
    return np.ascontiguousarray(crop.transpose(2, 0, 1)), [np.ascontiguousarray(one) for one in maps]


def loss_of(heat_out, size_out, heat, sizes, has_size, counts):
    """Focal loss of the heat, with less weight near a middle (Law, Deng 2018: CornerNet), and that of the sizes."""
    likely = torch.sigmoid(heat_out).clamp(1e-5, 1 - 1e-5)
    is_middle = (heat == 1).float()
    found = -((1 - likely) ** 2) * torch.log(likely) * is_middle
    false = -((1 - heat) ** 4) * likely**2 * torch.log(1 - likely) * (1 - is_middle)
    middles = is_middle.sum().clamp(min=1)
    size_error = F.smooth_l1_loss(size_out, sizes, reduction="none").sum(1) * has_size
    return ((found + false) * counts).sum() / middles + 0.2 * size_error.sum() / has_size.sum().clamp(min=1)


def train(images, steps=1000, seed=1, say=None):
    """A detector trained on Images. The same seed gives the same detector on the same machine."""
    torch.manual_seed(seed)
    random = np.random.default_rng(seed)
    detector = Detector()
    optimizer = torch.optim.Adam(detector.parameters(), lr=2e-3)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, max_lr=4e-3, total_steps=steps)
    detector.train()
    for step in range(steps):
        crops, maps = zip(*[crop_of(images, random) for _ in range(BATCH)])
        heat, sizes, has_size, counts = [torch.from_numpy(np.stack(one)) for one in zip(*maps)]
        loss = loss_of(*detector(torch.from_numpy(np.stack(crops)) - 0.5), heat, sizes, has_size, counts)
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
        schedule.step()
        if say and (step + 1) % 50 == 0:
            say(step + 1, steps, loss.item())
    return detector.eval()


def detect(detector, pixels, most=20):
    """What the detector finds in an image (height x width x 3 bytes): (score, [left, top, width, height]), best first."""
    height, width = (side // 8 * 8 for side in pixels.shape[:2])
    crop = np.ascontiguousarray(pixels[:height, :width].transpose(2, 0, 1)).astype(np.float32) / 255
    with torch.no_grad():
        heat, sizes = detector(torch.from_numpy(crop)[None] - 0.5)
        heat = torch.sigmoid(heat)
        is_peak = heat == F.max_pool2d(heat[None], 5, 1, 2)[0]
        scores, places = (heat * is_peak).flatten().topk(most)
    found = []
    for score, place in zip(scores.tolist(), places.tolist()):
        row, column = divmod(place, heat.shape[2])
        w, h = torch.exp(sizes[0, :, row, column]).tolist()
        x, y = (column + 0.5) * STRIDE, (row + 0.5) * STRIDE
        found.append((score, [x - w / 2, y - h / 2, w, h]))
    return found


def train_command(options):
    images = Images(options.labels, options.images)
    began = time.monotonic()

    def say(step, steps, loss):
        left_s = (time.monotonic() - began) / step * (steps - step)
        print(f"\r{step} of {steps} steps, loss {loss:.3f}, {left_s:.0f} s left ", end="", file=sys.stderr)

    detector = train(images, options.steps, options.seed, say)
    print(file=sys.stderr)
    torch.save(detector.state_dict(), options.out)


def detect_command(options):
    detector = Detector()
    detector.load_state_dict(torch.load(options.weights))
    detector.eval()
    images = Images(options.labels, options.images)
    results = [
        {"image_id": image_id, "category_id": 1, "bbox": [round(side, 2) for side in box], "score": round(score, 4)}
        for image_id, pixels in zip(images.ids, images.pixels)
        for score, box in detect(detector, pixels)
        if score >= options.score
    ]
    pathlib.Path(options.out).write_text(json.dumps(results))


def watch_command(options):
    """What a trained detector finds in videos: FOLDER/NAME.csv for each, in the layout that sigs reads."""
    import cv2

    detector = Detector()
    detector.load_state_dict(torch.load(options.weights))
    detector.eval()
    folder = pathlib.Path(options.out)
    folder.mkdir(parents=True, exist_ok=True)
    for number, name in enumerate(options.videos, 1):
        video = pathlib.Path(name)
        footage = cv2.VideoCapture(name)
        if not footage.isOpened():
            sys.exit(f"{name}: cannot be opened")
        lines = ["frame,x,y,width,height,score"]
        for frame in range(10**9):
            is_there, image = footage.read()
            if not is_there:
                break
            for score, box in detect(detector, np.ascontiguousarray(image[:, :, ::-1])):
                if score >= options.score:
                    lines.append(f"{frame}," + ",".join(f"{side:.1f}" for side in box) + f",{score:.3f}")
        (folder / (video.stem + ".csv")).write_text("\n".join(lines) + "\n")
        print(f"{number} of {len(options.videos)}: {video.stem}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    trains = commands.add_parser("train", help="a detector from a dataset's images")
    trains.add_argument("labels", help="labels/coco/train.json of the dataset")
    trains.add_argument("--images", required=True, help="the dataset's folder, from which the labels name images")
    trains.add_argument("--out", required=True, help="file for the detector's numbers")
    trains.add_argument("--steps", type=int, default=1000)
    trains.add_argument("--seed", type=int, default=1)
    detects = commands.add_parser("detect", help="what a trained detector finds")
    detects.add_argument("labels", help="COCO file that names the images; its boxes are not looked at")
    detects.add_argument("--images", required=True)
    detects.add_argument("--weights", required=True, help="file that train wrote")
    detects.add_argument("--out", required=True, help="COCO results: a list of image_id, bbox, score")
    detects.add_argument("--score", type=float, default=0.05, help="lower ones are left out")
    watches = commands.add_parser("watch", help="what a trained detector finds in videos")
    watches.add_argument("videos", nargs="+")
    watches.add_argument("--weights", required=True, help="file that train wrote")
    watches.add_argument("--out", required=True, help="folder for a CSV file of each video")
    watches.add_argument("--score", type=float, default=0.3, help="lower ones are left out")
    options = parser.parse_args()
    {"train": train_command, "detect": detect_command, "watch": watch_command}[options.command](options)


if __name__ == "__main__":
    main()
