# SPDX-License-Identifier: MIT
"""What is true of a frame: the names, frames and units of the label file (docs/annotation-format.md).

Positions are in metres: the camera's in the world, an intruder's in the camera frame (X along the optical axis, Y right,
Z down). Angles are in degrees. The centre of the first pixel is (0, 0). All objects compare by value, can be pickled,
and do not change.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Optional


class Attitude(NamedTuple):
    """Roll, pitch and yaw in degrees: positive with the right wing down, the nose up, the nose to the right."""

    roll: float
    pitch: float
    yaw: float


class Box(NamedTuple):
    """Whole pixels: x, y are the first covered column and row, width and height count columns and rows."""

    x: int
    y: int
    width: int
    height: int

    @property
    def slices(self) -> tuple[slice, slice]:
        """Rows and columns of an image: image[box.slices] is what lies in the box."""
        return slice(self.y, self.y + self.height), slice(self.x, self.x + self.width)

    @property
    def edges(self) -> tuple[int, int, int, int]:
        """First column, first row, and the column and row after the last: x1, y1, x2, y2 as detectors have them."""
        return self.x, self.y, self.x + self.width, self.y + self.height


class Silhouette(NamedTuple):
    """The whole body's box, hidden or beyond the image or not: x, y are its left and upper edge, continuous, in px."""

    x: float
    y: float
    width: float
    height: float


@dataclass(frozen=True)
class Place:
    """A place on the Earth (WGS-84)."""

    latitude_deg: float
    longitude_deg: float
    height_m: float


@dataclass(frozen=True)
class Appearance:
    """How well an intruder stands out, and how its image was formed."""

    weber_contrast: float
    rms_contrast: float
    signal_to_noise: float
    blur_px: float
    motion_blur_px: float
    visibility_m: Optional[float] = None


@dataclass(frozen=True)
class WellClear:
    """Whether well clear of one volume is lost. tau_mod_s is None where it is infinite."""

    volume: str
    lost: bool
    tau_mod_s: Optional[float]
    severity: float


@dataclass(frozen=True)
class Encounter:
    """How an intruder moves against the camera's platform (docs/encounters.md)."""

    range_rate_mps: float
    closing_speed_mps: float
    bearing_deg: float
    elevation_deg: float
    hmd_m: float
    vmd_m: float
    time_to_closest_approach_s: float
    time_to_coaltitude_s: Optional[float]
    well_clear: tuple[WellClear, ...] = ()


@dataclass(frozen=True)
class Light:
    """One of an intruder's lights that adds to the image.

    x, y       where it is seen, px
    share      of the exposure during which it is on
    brightest  linear light that it adds to the pixel it adds most to; 1 is white
    """

    name: str
    x: float
    y: float
    share: float
    brightest: float


@dataclass(frozen=True)
class Clouds:
    """What the footage's clouds hide of an intruder, 0 to 1, and how far away they are taken to be."""

    hidden: float
    assumed_distance_m: float


@dataclass(frozen=True)
class IntruderTruth:
    """One intruder in one frame.

    position_m    of its reference point in the camera frame: X forward, Y right, Z down
    attitude_deg  of its body in the world
    box, pixels   visible pixels; None and 0 where no pixel shows it
    other_box     of the smaller part of one across the sides of 360 degree footage; None where it is in one part
    silhouette    of the whole body through the lens; None where no part of it has an image
    lights        those that add to the image; lights_alone: its body changes nothing, what is visible is its lights
    clouds        None where the project's clouds hide nothing
    contrail, shadow  some of it is in the image; no box has it
    """

    id: int
    name: str
    role: str
    in_picture: bool
    visible_fraction: float
    horizon: str
    position_m: tuple[float, float, float]
    distance_m: float
    attitude_deg: Attitude
    place: Optional[Place] = None
    box: Optional[Box] = None
    pixels: int = 0
    silhouette: Optional[Silhouette] = None
    appearance: Optional[Appearance] = None
    encounter: Optional[Encounter] = None
    other_box: Optional[Box] = None
    lights: tuple[Light, ...] = ()
    lights_alone: bool = False
    clouds: Optional[Clouds] = None
    contrail: bool = False
    shadow: bool = False


@dataclass(frozen=True)
class CameraTruth:
    """The camera's pose in the world, and where it is known from (empty: the project's settings)."""

    position_m: tuple[float, float, float]
    attitude_deg: Attitude
    position_source: str = ""
    attitude_source: str = ""
    attitude_sd_deg: Optional[tuple[float, float, float]] = None
    place: Optional[Place] = None


@dataclass(frozen=True)
class FrameTruth:
    """One frame. index counts the footage's frames from 0; substituted: its image is that of another frame."""

    index: int
    time_s: float
    substituted: bool
    camera: CameraTruth
    intruders: tuple[IntruderTruth, ...]

    def intruder(self, which: int | str) -> IntruderTruth:
        """The intruder with this id or this name. Raises KeyError where there is none."""
        for intruder in self.intruders:
            if which in (intruder.id, intruder.name):
                return intruder
        raise KeyError(which)

    @property
    def visible(self) -> tuple[IntruderTruth, ...]:
        """Those that some pixel shows."""
        return tuple(intruder for intruder in self.intruders if intruder.box is not None)
