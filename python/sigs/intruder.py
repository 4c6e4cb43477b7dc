# SPDX-License-Identifier: MIT
"""Intruders of a project."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import UsageError

if TYPE_CHECKING:
    from .project import Project


class Waypoints(NamedTuple):
    """frames: float64 [n], NaN for a waypoint whose frame is chosen by even spacing; positions_m: float64 [n, 3] in
    the world (X forward, Y right, Z down)."""

    frames: NDArray[np.float64]
    positions_m: NDArray[np.float64]


class Intruder:
    """One intruder of a project. It stays the one at its position in the project's list."""

    def __init__(self, project: Project, index: int) -> None:
        self._project = project
        self._index = index

    @property
    def index(self) -> int:
        """Its position in the project's list, from 0: the id in labels."""
        return self._index

    @property
    def name(self) -> str:
        """Its name in annotations."""
        return str(self["name"])

    @property
    def waypoints(self) -> Waypoints:
        """Frames and positions of its waypoints: copies; assign to change them.

        Assign Waypoints(frames, positions_m), or a tuple of both; where frames is None, or NaN in it, the frame is
        chosen by even spacing.
        """
        return Waypoints(*self._project._inside.waypoints(self._index))

    @waypoints.setter
    def waypoints(self, value: tuple[Optional[ArrayLike], ArrayLike]) -> None:
        frames, positions = value
        positions_m = np.asarray(positions, dtype=np.float64)
        if positions_m.ndim != 2 or positions_m.shape[1] != 3:
            raise UsageError("waypoints", f"expected positions [n, 3], found the shape {positions_m.shape}", "usage")
        numbers = np.full(len(positions_m), np.nan) if frames is None else np.asarray(frames, dtype=np.float64)
        if numbers.shape != (len(positions_m),):
            raise UsageError(
                "waypoints", f"{len(positions_m)} positions need as many frames, found {numbers.shape}", "usage"
            )
        self._project._inside.set_waypoints(
            self._index, [None if np.isnan(n) else float(n) for n in numbers], positions_m.tolist()
        )

    def __getitem__(self, key: str) -> Any:
        """A field by its key within the intruder: intruder["model.scale"]."""
        return self._project[f"intruders[{self._index}].{key}"]

    def __setitem__(self, key: str, value: Any) -> None:
        self._project[f"intruders[{self._index}].{key}"] = value

    def __repr__(self) -> str:
        return f"<sigs.Intruder {self._index} '{self.name}'>"
