# SPDX-License-Identifier: MIT
"""Several cameras on one aircraft (docs/rigs.md)."""

from __future__ import annotations

import csv
import json
import os
import pathlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from .errors import BadData, CannotRead, UsageError
from .labels import Labels, read_labels

if TYPE_CHECKING:
    from .project import Project

_Path = Union[str, "os.PathLike[str]"]
_TEXTS = ("name", "seen_by", "stereo_pair")
_COUNTS = ("frame", "intruder")


class RigCamera:
    """One of several cameras of a project. It stays the one at its position in the project's list."""

    def __init__(self, project: Project, index: int, name: str) -> None:
        self._project = project
        self._index = index
        self._name = name

    @property
    def index(self) -> int:
        """Its position in the project's list, from 0."""
        return self._index

    @property
    def name(self) -> str:
        """Its name, which is in the names of its files."""
        return self._name

    def __getitem__(self, key: str) -> Any:
        """A field by its key within the camera: camera["mount.position_m"]."""
        return self._project[f"cameras[{self._index}].{key}"]

    def __setitem__(self, key: str, value: Any) -> None:
        self._project[f"cameras[{self._index}].{key}"] = value

    def __repr__(self) -> str:
        return f"<sigs.RigCamera {self._index} '{self.name}'>"


def nearest_frame(times_s: NDArray[np.float64], time_s: float) -> Optional[int]:
    """The frame nearest to a time; None: it is farther than three quarters of the mean interval."""
    nearest = int(np.argmin(np.abs(times_s - time_s)))
    interval_s = (times_s[-1] - times_s[0]) / (len(times_s) - 1) if len(times_s) > 1 else 0.0
    return nearest if abs(times_s[nearest] - time_s) <= 0.75 * interval_s + 1e-9 else None


@dataclass(frozen=True)
class Rig:
    """What an export of several cameras has written of all of them: NAME.rig.json.

    cameras    by name in the project's order: video, size, frames, lens, mount and clock, as in the file
    intruders  id, name, category, views and handovers of each, as in the file (docs/rigs.md)
    """

    path: pathlib.Path
    name: str
    cameras: dict[str, dict[str, Any]] = field(repr=False)
    intruders: list[dict[str, Any]] = field(repr=False)

    def labels(self, camera: str) -> Labels:
        """The labels of one camera, from NAME.CAMERA.xml or NAME.CAMERA.coco.json beside the file."""
        if camera not in self.cameras:
            raise UsageError(f"camera {camera}", f"{self.path} has {', '.join(self.cameras)}", "usage")
        xml = self.path.parent / f"{self.name}.{camera}.xml"
        coco = self.path.parent / f"{self.name}.{camera}.coco.json"
        return read_labels(coco if coco.exists() and not xml.exists() else xml)

    def columns(self) -> dict[str, NDArray[Any]]:
        """NAME.rig.csv beside the file, as arrays by column: a row for each frame of the first camera and intruder.
        What is empty is NaN, or an empty text."""
        path = self.path.parent / f"{self.name}.rig.csv"
        try:
            with open(path, newline="", encoding="utf-8") as file:
                rows = list(csv.reader(file))
            header, cells = rows[0], rows[1:]
            return {name: _column(name, [row[i] for row in cells]) for i, name in enumerate(header)}
        except OSError as error:
            raise CannotRead(str(path), error.strerror or str(error), "cannot_read") from error
        except (IndexError, ValueError) as error:
            raise BadData(str(path), f"is no table of a rig: {error}", "bad_data") from error


def _column(name: str, cells: list[str]) -> NDArray[Any]:
    if name in _TEXTS:
        return np.array(cells, dtype=str)
    if name in _COUNTS:
        return np.array(cells, dtype=np.int64)
    return np.array([float(cell) if cell else np.nan for cell in cells])


def read_rig(path: _Path) -> Rig:
    """Reads NAME.rig.json, which an export of a project with several cameras writes."""
    path = pathlib.Path(path)
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise CannotRead(str(path), error.strerror or str(error), "cannot_read") from error
    except ValueError as error:
        raise BadData(str(path), f"is no JSON: {error}", "bad_data") from error
    if not isinstance(document, dict) or document.get("sigs_rig") != 1:
        raise BadData(str(path), "is no NAME.rig.json of an export, whose sigs_rig is 1", "bad_data")
    try:
        cameras = {str(camera["name"]): dict(camera) for camera in document["cameras"]}
        return Rig(path, str(document["name"]), cameras, list(document["intruders"]))
    except (KeyError, TypeError, ValueError) as error:
        raise BadData(str(path), f"is incomplete: {error}", "bad_data") from error
