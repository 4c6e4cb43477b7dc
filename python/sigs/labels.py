# SPDX-License-Identifier: MIT
"""Reading label files: SIGS annotation files (XML) and the COCO files that an export writes."""

from __future__ import annotations

import json
import os
import pathlib
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING, dataclass, fields
from typing import Any, Optional, TypeVar, Union, overload

import numpy as np
from numpy.typing import NDArray

from .errors import BadData, CannotRead
from .truth import (
    Appearance,
    Attitude,
    Box,
    CameraTruth,
    Clouds,
    Encounter,
    FrameTruth,
    IntruderTruth,
    Light,
    Place,
    Silhouette,
    WellClear,
)

_Path = Union[str, "os.PathLike[str]"]
_NAN = float("nan")
_Kind = TypeVar("_Kind")


@dataclass(frozen=True)
class Labels(Sequence[FrameTruth]):
    """The frames of a label file in order: len(labels), labels[i], and for frame in labels.

    labels[i] is the i-th frame of the file, which belongs to the i-th image of the exported video; its number in the
    footage is labels[i].index, and labels.frame(number) finds it by that.
    """

    path: pathlib.Path
    video: str
    size_px: tuple[int, int]
    frame_rate: tuple[int, int]
    frames: tuple[FrameTruth, ...]

    def __len__(self) -> int:
        return len(self.frames)

    @overload
    def __getitem__(self, i: int) -> FrameTruth: ...

    @overload
    def __getitem__(self, i: slice) -> tuple[FrameTruth, ...]: ...

    def __getitem__(self, i: int | slice) -> FrameTruth | tuple[FrameTruth, ...]:
        return self.frames[i]

    def frame(self, index: int) -> FrameTruth:
        """The frame with this number in the footage. Raises KeyError where the file has none."""
        first = self.frames[0].index if self.frames else 0
        if not (0 <= index - first < len(self.frames)) or self.frames[index - first].index != index:
            raise KeyError(index)
        return self.frames[index - first]

    def columns(self) -> dict[str, NDArray[Any]]:
        """One row for each intruder in each frame, as arrays by name, for training and for tables.

        row, frame, time_s  position of the frame in the file, its number in the footage, its time
        id, name, role      of the intruder
        position_m          [n, 3]; distance_m; attitude_deg [n, 3] (roll, pitch, yaw)
        in_picture          bool; visible_fraction; horizon (text)
        box, pixels         int64 [n, 4] (x, y, width, height) and [n]; zeros where no pixel shows it
        silhouette          float64 [n, 4]; NaN where no part of it has an image
        camera_position_m, camera_attitude_deg   [n, 3] of the frame
        weber_contrast, signal_to_noise          NaN where no pixel shows it
        """
        rows = [(row, frame, one) for row, frame in enumerate(self.frames) for one in frame.intruders]
        empty = Box(0, 0, 0, 0)
        nowhere = Silhouette(_NAN, _NAN, _NAN, _NAN)

        def numbers(values: list[Any], width: Optional[int] = None, kind: Any = np.float64) -> NDArray[Any]:
            return np.asarray(values, dtype=kind).reshape((len(rows),) if width is None else (len(rows), width))

        return {
            "row": numbers([row for row, _, _ in rows], kind=np.int64),
            "frame": numbers([frame.index for _, frame, _ in rows], kind=np.int64),
            "time_s": numbers([frame.time_s for _, frame, _ in rows]),
            "id": numbers([one.id for _, _, one in rows], kind=np.int64),
            "name": numbers([one.name for _, _, one in rows], kind=np.str_),
            "role": numbers([one.role for _, _, one in rows], kind=np.str_),
            "position_m": numbers([one.position_m for _, _, one in rows], 3),
            "distance_m": numbers([one.distance_m for _, _, one in rows]),
            "attitude_deg": numbers([one.attitude_deg for _, _, one in rows], 3),
            "in_picture": numbers([one.in_picture for _, _, one in rows], kind=np.bool_),
            "visible_fraction": numbers([one.visible_fraction for _, _, one in rows]),
            "horizon": numbers([one.horizon for _, _, one in rows], kind=np.str_),
            "box": numbers([one.box or empty for _, _, one in rows], 4, np.int64),
            "pixels": numbers([one.pixels for _, _, one in rows], kind=np.int64),
            "silhouette": numbers([one.silhouette or nowhere for _, _, one in rows], 4),
            "camera_position_m": numbers([frame.camera.position_m for _, frame, _ in rows], 3),
            "camera_attitude_deg": numbers([frame.camera.attitude_deg for _, frame, _ in rows], 3),
            "weber_contrast": numbers([one.appearance.weber_contrast if one.appearance else _NAN for _, _, one in rows]),
            "signal_to_noise": numbers(
                [one.appearance.signal_to_noise if one.appearance else _NAN for _, _, one in rows]
            ),
        }


def read_labels(path: _Path) -> Labels:
    """Reads a label file that an export wrote: NAME.xml (annotation-format.md), or NAME.coco.json.

    A COCO file has visible intruders alone and no pose of the camera: that is NaN then. Raises CannotRead and BadData,
    which name file and frame.
    """
    file = pathlib.Path(path)
    try:
        with file.open("rb") as opened:
            start = opened.read(64).lstrip(b"\xef\xbb\xbf \t\r\n")
        return _coco(file) if start.startswith(b"{") else _xml(file)
    except OSError as error:
        raise CannotRead(str(file), f"cannot be read: {error.strerror}", "cannot_read") from None


# --- SIGS annotation files.


def _number(node: ElementTree.Element, name: str) -> float:
    return float(node.attrib[name])


def _maybe(node: ElementTree.Element, name: str) -> Optional[float]:
    return float(node.attrib[name]) if name in node.attrib else None


def _vector(node: ElementTree.Element) -> tuple[float, float, float]:
    return _number(node, "x_m"), _number(node, "y_m"), _number(node, "z_m")


def _attitude(node: ElementTree.Element) -> Attitude:
    return Attitude(_number(node, "roll_deg"), _number(node, "pitch_deg"), _number(node, "yaw_deg"))


def _child(node: ElementTree.Element, name: str) -> ElementTree.Element:
    child = node.find(name)
    if child is None:
        raise KeyError(name)
    return child


def _of(values: Mapping[str, Any], kind: Callable[..., _Kind], **others: Any) -> _Kind:
    """A class of the truth from numbers by the names of its fields. Fields with a default may be missing."""
    named: Any = kind
    numbers = {
        one.name: float(values[one.name])
        for one in fields(named)
        if one.name not in others and (one.name in values or one.default is MISSING)
    }
    return kind(**numbers, **others)


def _of_child(node: ElementTree.Element, name: str, kind: Callable[..., _Kind]) -> Optional[_Kind]:
    child = node.find(name)
    return None if child is None else _of(child.attrib, kind)


def _box(node: ElementTree.Element, name: str) -> Optional[Box]:
    box = node.find(name)
    return None if box is None else Box(*(int(box.attrib[side]) for side in ("x", "y", "width", "height")))


def _camera(node: ElementTree.Element) -> CameraTruth:
    has_sd = "sd_x_deg" in node.attrib
    return CameraTruth(
        position_m=_vector(node),
        attitude_deg=_attitude(node),
        position_source=node.get("position_source", ""),
        attitude_source=node.get("attitude_source", ""),
        attitude_sd_deg=(_number(node, "sd_x_deg"), _number(node, "sd_y_deg"), _number(node, "sd_z_deg"))
        if has_sd
        else None,
        place=_of_child(node, "place", Place),
    )


def _encounter(node: ElementTree.Element) -> Optional[Encounter]:
    found = node.find("encounter")
    if found is None:
        return None
    return _of(
        found.attrib,
        Encounter,
        time_to_coaltitude_s=_maybe(found, "time_to_coaltitude_s"),
        well_clear=tuple(
            WellClear(one.attrib["volume"], one.attrib["lost"] == "true", _maybe(one, "tau_mod_s"), _number(one, "severity"))
            for one in found.iter("well_clear")
        ),
    )


def _intruder(node: ElementTree.Element) -> IntruderTruth:
    box = node.find("box")
    silhouette = node.find("silhouette")
    return IntruderTruth(
        id=int(node.attrib["id"]),
        name=node.attrib["name"],
        role=node.get("role", "intruder"),
        in_picture=node.attrib["in_picture"] == "true",
        visible_fraction=_number(node, "visible_fraction"),
        horizon=node.get("horizon", "unknown"),
        position_m=_vector(_child(node, "position")),
        distance_m=_number(_child(node, "distance"), "m"),
        attitude_deg=_attitude(_child(node, "attitude")),
        place=_of_child(node, "place", Place),
        box=_box(node, "box"),
        pixels=0 if box is None else int(box.attrib["pixels"]),
        other_box=_box(node, "other_box"),
        silhouette=None
        if silhouette is None
        else Silhouette(*(_number(silhouette, name) for name in ("x", "y", "width", "height"))),
        appearance=_of_child(node, "appearance", Appearance),
        encounter=_encounter(node),
        lights=tuple(_of(one.attrib, Light, name=one.attrib["name"]) for one in node.iter("light")),
        lights_alone=node.get("lights_alone") == "true",
        clouds=_of_child(node, "clouds", Clouds),
        contrail=node.get("contrail") == "true",
        shadow=node.get("shadow") == "true",
    )


def _frame(node: ElementTree.Element) -> FrameTruth:
    return FrameTruth(
        index=int(node.attrib["index"]),
        time_s=_number(node, "time_s"),
        substituted=node.get("substituted") == "true",
        camera=_camera(_child(node, "camera")),
        intruders=tuple(_intruder(one) for one in node.iter("intruder")),
    )


def _ratio(text: str) -> tuple[int, int]:
    numerator, _, denominator = text.partition("/")
    return int(numerator), int(denominator or "1")


def _xml(file: pathlib.Path) -> Labels:
    frames: list[FrameTruth] = []
    footage: dict[str, str] = {}
    place = "sigs"
    try:
        for _, node in ElementTree.iterparse(file, events=("end",)):
            if node.tag == "footage":
                footage = dict(node.attrib)
            elif node.tag == "frame":
                place = f"frame {node.get('index', '?')}"
                frames.append(_frame(node))
                node.clear()
        place = "footage"
        return Labels(
            path=file,
            video=footage["video"],
            size_px=(int(footage["width"]), int(footage["height"])),
            frame_rate=_ratio(footage["frame_rate"]),
            frames=tuple(frames),
        )
    except ElementTree.ParseError as error:
        raise BadData(str(file), f"is neither a SIGS annotation file nor a COCO file: {error}", "bad_data") from None
    except KeyError as error:
        raise BadData(f"{file}: {place}", f"{error.args[0]} is missing", "bad_data") from None
    except (ValueError, TypeError) as error:
        raise BadData(f"{file}: {place}", str(error), "bad_data") from None


# --- COCO files. Their origin is the upper left corner of the first pixel, ours its centre.


def _coco_intruder(one: dict[str, Any], names: dict[int, str]) -> IntruderTruth:
    amodal = one.get("amodal_bbox")
    return IntruderTruth(
        id=int(one["track_id"]),
        name=names.get(int(one["track_id"]), ""),
        role="distractor" if one.get("distractor") else "intruder",
        in_picture=True,
        visible_fraction=float(one["visible_fraction"]),
        horizon=str(one.get("horizon", "unknown")),
        position_m=(float(one["position_m"][0]), float(one["position_m"][1]), float(one["position_m"][2])),
        distance_m=float(one["distance_m"]),
        attitude_deg=Attitude(*(float(one["attitude_deg"][angle]) for angle in ("roll", "pitch", "yaw"))),
        box=Box(*(int(side) for side in one["bbox"])),
        pixels=int(one["area"]),
        silhouette=None if amodal is None else Silhouette(amodal[0] - 0.5, amodal[1] - 0.5, amodal[2], amodal[3]),
        appearance=_of(one, Appearance) if "weber_contrast" in one else None,
        lights_alone=bool(one.get("lights_alone")),
        contrail=bool(one.get("contrail")),
    )


def _coco(file: pathlib.Path) -> Labels:
    place = str(file)
    try:
        with file.open(encoding="utf-8") as opened:
            document = json.load(opened)
        names = {int(track["id"]): str(track["name"]) for track in document["tracks"]}
        of_image: dict[int, list[IntruderTruth]] = {int(image["id"]): [] for image in document["images"]}
        for one in document["annotations"]:
            place = f"{file}: annotation {one.get('id', '?')}"
            if "track_id" in one:  # others are regions to be ignored
                of_image[int(one["image_id"])].append(_coco_intruder(one, names))
        unknown = CameraTruth((_NAN, _NAN, _NAN), Attitude(_NAN, _NAN, _NAN))
        frames = []
        for image in document["images"]:
            place = f"{file}: image {image.get('id', '?')}"
            intruders = tuple(sorted(of_image[int(image["id"])], key=lambda one: one.id))
            frames.append(FrameTruth(int(image["footage_frame"]), float(image["time_s"]), False, unknown, intruders))
        place = f"{file}: videos"
        video = document["videos"][0]
        return Labels(
            path=file,
            video=str(video["footage"]["file_name"]),
            size_px=(int(video["width"]), int(video["height"])),
            frame_rate=(round(float(video["fps"]) * 1_000_000), 1_000_000),
            frames=tuple(frames),
        )
    except (KeyError, IndexError) as error:
        raise BadData(place, f"{error.args[0]} is missing: not a COCO file of an export", "bad_data") from None
    except (ValueError, TypeError, AttributeError, RecursionError) as error:
        raise BadData(place, str(error), "bad_data") from None
