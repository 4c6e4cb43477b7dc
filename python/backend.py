# SPDX-License-Identifier: MIT
"""Builds the wheel of the Python module (PEP 517), with CMake and nothing else: no network, no other build tool.

    python3 -m build --wheel --no-isolation
    python3 -m build --wheel --no-isolation -Cbuild-dir=build/release      takes what is built there already

The wheel has what `cmake --install --component python` installs.
"""

from __future__ import annotations

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from typing import Any, Optional

_ROOT = pathlib.Path(__file__).resolve().parents[1]


def _version() -> str:
    found = re.search(r"project\(sigs VERSION ([0-9.]+)", (_ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
    assert found is not None
    return found[1]


def _tag() -> str:
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    return f"{python}-{python}-{platform}"


def _metadata() -> str:
    lines = [
        "Metadata-Version: 2.1",
        "Name: sigs",
        f"Version: {_version()}",
        "Summary: Simulated intruder aircraft in real UAV footage, with the truth of every frame",
        "License: MIT",
        "Requires-Python: >=3.9",
        "Requires-Dist: numpy",
    ]
    return "\n".join(lines) + "\n"


def _build(build: pathlib.Path, installed: pathlib.Path) -> None:
    """Builds the module in the folder `build`, configuring it first where it is new, and installs it."""
    if not (build / "CMakeCache.txt").exists():
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DSIGS_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}"]
        options += ["-DSIGS_TESTS=OFF", "-DSIGS_BENCH=OFF", "-DSIGS_EDITOR=OFF", "-DSIGS_UNITY=ON"]
        subprocess.run(["cmake", "-S", str(_ROOT), "-B", str(build), "-G", "Ninja", *options], check=True)
    subprocess.run(["cmake", "--build", str(build), "--target", "sigs_python"], check=True)
    command = ["cmake", "--install", str(build), "--component", "python", "--prefix", str(installed)]
    subprocess.run(command, check=True)


def _record(name: str, content: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}"


def _write(wheel: pathlib.Path, files: dict[str, bytes], info: str) -> None:
    record = "\n".join([*(_record(name, content) for name, content in files.items()), f"{info}/RECORD,,"]) + "\n"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in {**files, f"{info}/RECORD": record.encode()}.items():
            entry = zipfile.ZipInfo(name, (2020, 1, 1, 0, 0, 0))  # the same bytes whenever it is built
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)


def build_wheel(
    wheel_directory: str, config_settings: Optional[dict[str, Any]] = None, metadata_directory: Optional[str] = None
) -> str:
    build = pathlib.Path((config_settings or {}).get("build-dir", _ROOT / "build/wheel"))
    if not build.is_absolute():
        build = _ROOT / build
    info = f"sigs-{_version()}.dist-info"
    files: dict[str, bytes] = {}
    with tempfile.TemporaryDirectory() as folder:
        _build(build, pathlib.Path(folder))
        for package in sorted(pathlib.Path(folder).rglob("sigs/__init__.py")):
            site = package.parents[1]
            for file in sorted(package.parent.rglob("*")):
                if file.is_file() and "__pycache__" not in file.parts:
                    files[file.relative_to(site).as_posix()] = file.read_bytes()
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: sigs\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()
    files[f"{info}/LICENSE"] = (_ROOT / "LICENSE").read_bytes()
    name = f"sigs-{_version()}-{_tag()}.whl"
    _write(pathlib.Path(os.fspath(wheel_directory)) / name, files, info)
    return name


def get_requires_for_build_wheel(config_settings: Optional[dict[str, Any]] = None) -> list[str]:
    return []


def build_sdist(sdist_directory: str, config_settings: Optional[dict[str, Any]] = None) -> str:
    raise RuntimeError("there is no source distribution: build the wheel from the source tree, with --wheel")
