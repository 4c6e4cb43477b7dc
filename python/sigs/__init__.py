# SPDX-License-Identifier: MIT
"""SIGS: simulated intruder aircraft in real UAV footage, with the truth of every frame.

    import sigs
    project = sigs.open("crossing.json")
    for frame in project.frames(range(100)):
        frame.rgb, frame.mask, frame.truth          # arrays and objects

Metres, seconds, pixels; degrees where a name says so. The world and the camera have X forward, Y right, Z down. The
manual is docs/python.md.
"""

from ._sigs import Frame, FrameIterator, Video, __version__
from .errors import (
    BadData,
    BadProject,
    CannotCreate,
    CannotRead,
    Error,
    Interrupted,
    ProjectWarning,
    Unavailable,
    UsageError,
    WriteFailed,
)
from .intruder import Intruder, Waypoints
from .labels import Labels, read_labels
from .project import (
    ExportReport,
    Field,
    Footage,
    Pose,
    Problem,
    Project,
    export,
    open,
)
from .rig import Rig, RigCamera, read_rig
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

__all__ = [
    "Appearance",
    "Attitude",
    "BadData",
    "BadProject",
    "Box",
    "CameraTruth",
    "CannotCreate",
    "CannotRead",
    "Clouds",
    "Encounter",
    "Error",
    "ExportReport",
    "Field",
    "Footage",
    "Frame",
    "FrameIterator",
    "FrameTruth",
    "Interrupted",
    "Intruder",
    "IntruderTruth",
    "Labels",
    "Light",
    "Place",
    "Pose",
    "Problem",
    "Project",
    "ProjectWarning",
    "Rig",
    "RigCamera",
    "Silhouette",
    "Unavailable",
    "UsageError",
    "Video",
    "Waypoints",
    "WellClear",
    "WriteFailed",
    "__version__",
    "export",
    "open",
    "read_labels",
    "read_rig",
]
