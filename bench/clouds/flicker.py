"""flicker.py FOLDER: by how much opacity varies over the images of a folder at one place where there are clouds."""
import sys
from pathlib import Path

import numpy
from PIL import Image

stack = numpy.stack([numpy.array(Image.open(path).convert("L")) / 255 for path in sorted(Path(sys.argv[1]).iterdir())])
cloudy = stack.mean(axis=0) > 0.05
print(f"flicker over {len(stack)} frames where opacity is above 0.05: "
      f"median {numpy.median(stack.std(axis=0)[cloudy]):.3f}, 0.95 quantile {numpy.quantile(stack.std(axis=0)[cloudy], 0.95):.3f}")
