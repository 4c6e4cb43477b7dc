"""Opacities that SIGS finds against clouds painted by hand: mean of each class, and how well opacity orders them.

score.py PAINTED FOLDER: FOLDER has the opacity of the frame number N of the list as N.png.
"""
import json
import sys
from pathlib import Path

import numpy
from PIL import Image, ImageDraw


def inside(polygons, size):
    mask = Image.new("1", size)
    for polygon in polygons:
        ImageDraw.Draw(mask).polygon([tuple(point) for point in polygon], fill=1)
    return numpy.array(mask)


def area_under_curve(low, high):
    """How often a pixel of `high` is more opaque than one of `low`; ties count half."""
    order = numpy.sort(low)
    below = numpy.searchsorted(order, high, "left")
    up_to = numpy.searchsorted(order, high, "right")
    return ((below + up_to) / 2).mean() / len(order)


def main(painted, folder):
    print("clip                     tuned  clear  veil  opaque  AUC")
    for number, frame in enumerate(json.loads(Path(painted).read_text())["frames"]):
        image = Image.open(Path(folder) / f"{number}.png").convert("L")
        opacity = numpy.array(image) / 255
        classes = {kind: opacity[inside(frame.get(kind, []), image.size)] for kind in ("clear", "veil", "opaque")}
        means = ["  -  " if not len(values) else f"{values.mean():5.2f}" for values in classes.values()]
        cloud = numpy.concatenate([classes["veil"], classes["opaque"]])
        print(f"{Path(frame['clip']).stem:24} {'yes' if frame['tuned'] else 'no':>5}  {'  '.join(means)}"
              f"  {area_under_curve(classes['clear'], cloud):5.3f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
