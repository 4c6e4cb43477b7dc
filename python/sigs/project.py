# SPDX-License-Identifier: MIT
"""Projects: fields, waypoints, frames, and the export."""

from __future__ import annotations

import json
import operator
import os
import pathlib
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Callable, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _sigs
from ._sigs import Frame, FrameIterator
from .errors import ProjectWarning, UsageError
from .intruder import Intruder
from .rig import RigCamera, nearest_frame

_Path = Union[str, "os.PathLike[str]"]
_PoseTuple = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]


def _number_of(frame: int) -> int:
    try:
        return operator.index(frame)
    except TypeError:
        raise UsageError("frame", f"expected a whole number, found {frame!r}", "usage") from None


class Problem(NamedTuple):
    """A mistake in a project: the field's key, what is wrong, and the kind as in sigs.Error."""

    field: str
    what: str
    kind: str


@dataclass(frozen=True)
class Field:
    """One setting of a project: its key and value, and what docs/project-format.md says of it."""

    key: str
    value: Any
    unit: str
    help: str
    minimum: float
    maximum: float
    choices: tuple[str, ...]
    is_path: bool


@dataclass(frozen=True)
class Pose:
    """A pose in the world for Project.render.

    position_m    X forward, Y right, Z down (a height is a negative Z)
    attitude_deg  roll (right wing down), pitch (nose up), yaw (nose to the right)
    velocity_mps  in the world; counts for motion blur and a rolling shutter within the frame alone
    """

    position_m: Sequence[float]
    attitude_deg: Sequence[float] = (0.0, 0.0, 0.0)
    velocity_mps: Sequence[float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Footage:
    """The footage of an opened project. times_s: presentation time of each frame, 0 for the first; of a camera of a
    rig by the rig's clock."""

    path: pathlib.Path
    size_px: tuple[int, int]
    frame_count: int
    frame_rate: tuple[int, int]
    times_s: NDArray[np.float64] = field(repr=False)
    codec: str
    layout: str


@dataclass(frozen=True)
class ExportReport:
    """What an export has written. renderer is empty where no intruder came into view."""

    written: list[pathlib.Path]
    frames: int
    damaged_frames: int
    warnings: list[str]
    seconds: float
    renderer: str


def _vector(value: Any, what: str) -> tuple[float, float, float]:
    array = np.asarray(value, dtype=np.float64)
    if array.shape != (3,):
        raise UsageError(what, f"expected three numbers, found an array of the shape {array.shape}", "usage")
    return float(array[0]), float(array[1]), float(array[2])


def _pose_tuple(pose: Any, whose: str) -> _PoseTuple:
    if not isinstance(pose, Pose):
        if not isinstance(pose, (tuple, list)) or not 1 <= len(pose) <= 3:
            raise UsageError(whose, "expected a sigs.Pose, or (position_m, attitude_deg)", "usage")
        pose = Pose(*pose)
    return (
        _vector(pose.position_m, f"{whose}: position_m"),
        _vector(pose.attitude_deg, f"{whose}: attitude_deg"),
        _vector(pose.velocity_mps, f"{whose}: velocity_mps"),
    )


def _plain(value: Any) -> Any:
    """NumPy's numbers and arrays as those that JSON knows."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (tuple, list)):
        return [_plain(one) for one in value]
    return value


def _jobs(jobs: Optional[int]) -> int:
    return len(os.sched_getaffinity(0)) if jobs is None else max(1, jobs)


def _ends(frames: Optional[range]) -> Optional[tuple[int, int]]:
    if frames is None:
        return None
    if not isinstance(frames, range) or frames.step != 1 or len(frames) == 0:
        raise UsageError("frames", "expected a range of frame numbers with step 1, such as range(0, 100)", "usage")
    return frames[0], frames[-1]


def _warn(texts: Sequence[str]) -> None:
    for text in texts:
        warnings.warn(text, ProjectWarning, stacklevel=3)


class Project:
    """A project: footage, camera, light and intruders (docs/project-format.md).

    Made by sigs.open(). Fields are read and set by their keys: project["camera.speed_mps"] = 30. Ranges are checked
    when frames are asked for; problems() lists what is wrong before. A project may be used by several threads, can be
    pickled, and may be used in forked processes, where decoder and OpenGL are opened anew.
    """

    def __init__(self, inside: _sigs.Project) -> None:
        self._inside = inside

    @staticmethod
    def parse(text: str, path: _Path) -> Project:
        """The project of a file's text. Relative paths in it start in the folder of `path`, which need not exist."""
        return Project(_sigs.Project.parse(text, path))

    @property
    def path(self) -> pathlib.Path:
        """The file that it was read from."""
        return pathlib.Path(self._inside.path())

    def __getitem__(self, key: str) -> Any:
        """A field's value: a number, text, list or None. Raises UsageError where there is no such field."""
        return json.loads(self._inside.value(key))

    def __setitem__(self, key: str, value: Any) -> None:
        """Sets a field. Arrays become lists. Raises UsageError: no such field, a value of the wrong type."""
        try:
            text = json.dumps(_plain(value), allow_nan=False)
        except ValueError:
            raise UsageError(key, f"expected finite numbers, found {value}", "usage") from None
        self._inside.assign(key, text)

    def fields(self) -> dict[str, Field]:
        """All fields, by key, with unit, range and help."""
        return {one["key"]: Field(**{**one, "value": json.loads(one["value"])}) for one in self._inside.fields()}

    def problems(self) -> list[Problem]:
        """What is wrong in the fields; empty: nothing. The footage's contents are not looked at."""
        return [Problem(*problem) for problem in self._inside.problems()]

    def text(self) -> str:
        """The project as the JSON text of its file."""
        return self._inside.text()

    def save(self, path: _Path, overwrite: bool = False) -> None:
        """Writes the project file, which appears when it is complete. Relative paths in it are written as they are."""
        self._inside.write(path, overwrite)

    @property
    def intruders(self) -> list[Intruder]:
        """The intruders in the project's order."""
        return [Intruder(self, index) for index in range(self._inside.intruder_count())]

    def intruder(self, which: int | str) -> Intruder:
        """The intruder with this index or name. Raises KeyError where there is none."""
        for intruder in self.intruders:
            if which in (intruder.index, intruder.name):
                return intruder
        raise KeyError(which)

    def add_intruder(self, **settings: Any) -> Intruder:
        """Appends an intruder; settings: name, category, and model, a file."""
        model = settings.pop("model", None)
        added = Intruder(self, self._inside.add_intruder())
        try:
            for key, value in settings.items():
                added[key] = value
            if model is not None:
                added["model.file"] = model
        except BaseException:
            self._inside.remove_intruder(added.index)
            raise
        return added

    def remove_intruder(self, which: int | str) -> None:
        """Removes an intruder; those behind it move up."""
        self._inside.remove_intruder(self.intruder(which).index)

    @property
    def cameras(self) -> list[RigCamera]:
        """The cameras of an aircraft with several (docs/rigs.md), in the project's order; empty: it has one."""
        return [RigCamera(self, index, name) for index, name in enumerate(self._inside.camera_names())]

    @property
    def camera_name(self) -> Optional[str]:
        """Of a project from camera(): the camera's name."""
        return self._inside.camera_name()

    def camera(self, which: int | str) -> Project:
        """The project as one of several cameras sees it, by name or index: frames, labels and exports are that
        camera's, times are the rig's, fields are those of a project with one camera.

        It is a project of its own: later changes of one have no effect on the other. Its text() and save() give the
        whole rig, with what was changed through this camera. Raises UsageError where there is no such camera.
        """
        names = self._inside.camera_names()
        if isinstance(which, int) and not 0 <= which < len(names):
            raise UsageError(f"camera {which}", f"{self.path} has {len(names)} cameras, counted from 0", "usage")
        return Project(self._inside.camera(which))

    def _choose_camera(self) -> None:
        names = self._inside.camera_names()
        if names:
            raise UsageError(
                str(self.path),
                f"has several cameras ({', '.join(names)}); choose one, as in project.camera(\"{names[0]}\"), or take "
                "render_all()",
                "usage",
            )

    def render_all(self, frame: int, poses: Optional[Mapping[int | str, Any]] = None) -> dict[str, Frame]:
        """The frames of all cameras at the time of a frame of the first one, by the cameras' names in their order.

        frame  number in the first camera's footage
        poses  as those of render()

        Of each camera it is the frame nearest in time; frame.time_s is its own, by the rig's clock. A camera that has
        none within three quarters of its interval is left out. Decoders, models and OpenGL are kept from call to call.
        """
        names = self._inside.camera_names()
        if not names:
            raise UsageError(str(self.path), "has one camera; take render()", "usage")
        given = self._given(poses)
        first = self._inside.render_camera(0, _number_of(frame), given)
        frames = {names[0]: first}
        for index, name in enumerate(names[1:], 1):
            nearest = nearest_frame(self._inside.opened_camera(index)["times_s"], first.time_s)
            if nearest is not None:
                frames[name] = self._inside.render_camera(index, nearest, given)
        return frames

    def _opened(self) -> dict[str, Any]:
        self._choose_camera()
        opened = self._inside.opened()
        _warn(opened["warnings"])
        return opened

    @property
    def footage(self) -> Footage:
        """The footage's properties; opens the project."""
        of = self._opened()
        return Footage(
            path=pathlib.Path(of["path"]),
            size_px=(of["width"], of["height"]),
            frame_count=len(of["times_s"]),
            frame_rate=of["frame_rate"],
            times_s=of["times_s"],
            codec=of["codec"],
            layout=of["layout"],
        )

    @property
    def frame_range(self) -> range:
        """Numbers of the frames that an export writes; opens the project."""
        of = self._opened()
        return range(of["first_frame"], of["last_frame"] + 1)

    def frames(self, frames: Optional[range] = None, jobs: Optional[int] = None) -> FrameIterator:
        """The frames of an export, in order, without writing them.

        frames  numbers in the footage; None: the project's own range
        jobs    frames composed at a time, ahead of the one that is asked for; None: one for each processor. The
                frames do not depend on it, and at most some 2 jobs + 4 of them are in memory

        The project is read now: later changes have no effect on the frames.
        """
        self._choose_camera()
        iterator = FrameIterator(self._inside, _ends(frames), _jobs(jobs))
        _warn(iterator.warnings)
        return iterator

    def render(
        self,
        frame: int,
        poses: Optional[Mapping[int | str, Any]] = None,
        camera: Any = None,
    ) -> Frame:
        """Composes one frame of the footage: the same as an export's, with poses of your own if you like.

        poses   poses in the world of some intruders, by name or index: a sigs.Pose or (position_m, attitude_deg);
                those not named fly as the project says
        camera  likewise of the camera itself

        Decoder, models and OpenGL are kept from call to call, also when fields or waypoints change between them.
        Truth of encounters is that of whole flights and is None here.
        """
        self._choose_camera()
        place = None if camera is None else _pose_tuple(camera, "camera")
        return self._inside.render(_number_of(frame), place, self._given(poses))

    def _given(self, poses: Optional[Mapping[int | str, Any]]) -> list[tuple[int, _PoseTuple]]:
        return [
            (self.intruder(which).index, _pose_tuple(pose, f"intruder {which}"))
            for which, pose in (poses or {}).items()
        ]

    def close(self) -> None:
        """Frees decoder and OpenGL; the next render() opens them again."""
        self._inside.close()

    def copy(self) -> Project:
        """A project of its own with the same fields."""
        return _parsed(self.text(), self.path, self.camera_name)

    def __iter__(self) -> Iterator[Frame]:
        return iter(self.frames())

    def __reduce__(self) -> tuple[Callable[[str, _Path, Optional[str]], Project], tuple[str, str, Optional[str]]]:
        return _parsed, (self.text(), str(self.path.absolute()), self.camera_name)

    def __repr__(self) -> str:
        return f"<sigs.Project '{self['name']}', {len(self.intruders)} intruders>"


def _parsed(text: str, path: _Path, camera: Optional[str]) -> Project:
    whole = Project.parse(text, path)
    return whole if camera is None else whole.camera(camera)


def open(path: _Path) -> Project:
    """Reads a project file. Unknown keys are kept and give a ProjectWarning."""
    inside, texts = _sigs.Project.read(path)
    _warn(texts)
    return Project(inside)


def export(
    project: Project,
    folder: _Path,
    frames: Optional[range] = None,
    jobs: Optional[int] = None,
    overwrite: bool = False,
    progress: Optional[Callable[[int, int], object]] = None,
) -> ExportReport:
    """Exports as `sigs export` does: video, masks and labels, which appear when all are complete.

    folder    created if it is missing
    frames    of a project with several cameras, all of which are exported: those of the first one
    progress  called with the number of frames done and of all, on this thread, some 20 times a second; an exception
              that it raises stops the export

    Ctrl-C (KeyboardInterrupt) stops it too, and leaves no file.
    """
    report = ExportReport(**_sigs.export_to(project._inside, folder, _ends(frames), _jobs(jobs), overwrite, progress))
    _warn(report.warnings)
    return report
