#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the inputs from which the fuzzers start.

usage: seeds.py FOLDER [REAL_DATA]

Writes FOLDER/TARGET/*: the tree's own projects, models and calibrations; the files that its tests have as string
literals, and the examples of its documentation; small logs, images and videos made here; and, where the folder REAL_DATA
exists, the beginnings of the real files in it. Each has at most 16 kB: a fuzzer mutates small ones best.
"""
import ast
import hashlib
import re
import shutil
import struct
import subprocess
import sys
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MOST_BYTES = 16_000


class Seeds:
    def __init__(self, folder: Path):
        self.folder = folder

    def add(self, target: str, content: bytes) -> None:
        folder = self.folder / target
        folder.mkdir(parents=True, exist_ok=True)
        content = content[:MOST_BYTES]
        (folder / hashlib.sha1(content).hexdigest()[:16]).write_bytes(content)

    def add_files(self, target: str, root: Path, *patterns: str) -> None:
        for pattern in patterns:
            for path in sorted(root.glob(pattern)):
                if path.is_file():
                    self.add(target, path.read_bytes())


# --- String literals of the tests: files that are written for them.

RAW = re.compile(r'R"\((.*?)\)"', re.S)
ORDINARY = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')


def literals(source: str) -> list[bytes]:
    found = [text.encode() for text in RAW.findall(source)]
    for match in ORDINARY.findall(RAW.sub(" ", source)):
        pieces = re.findall(r'"(?:[^"\\\n]|\\.)*"', match)
        try:
            text = b"".join(ast.literal_eval("b" + piece) for piece in pieces)
        except (SyntaxError, ValueError):
            continue  # an escape or a letter that Python's bytes do not have
        if text.count(b"\n") >= 2:
            found.append(text)
    return [text for text in found if len(text) >= 20]


# The blocks of code of the documentation's pages: examples of the formats.
BLOCK = re.compile(r"^```(?:json|jsonc|xml|csv|yaml)\n(.*?)^```", re.S | re.M)


def add_examples(seeds: Seeds) -> None:
    pages = {"annotation-format.md": "truth", "project-format.md": "project", "dataset.md": "recipe",
             "dataset-recipe.md": "recipe", "design-domain.md": "recipe", "calibration-files.md": "calibration", "frames-and-units.md": "text_log",
             "encounters.md": "encounter", "risk.md": "sensor_model", "evaluation-reference.md": "results"}
    for page, target in pages.items():
        for block in BLOCK.findall((ROOT / "docs" / page).read_text()):
            seeds.add(target, block.encode())


def add_literals(seeds: Seeds) -> None:
    targets_of = {
        "project": ["project"], "scene": ["project", "text_log"], "cli": ["project", "calibration", "model"],
        "camera": ["calibration"], "mesh": ["model"], "telemetry": ["text_log"], "evaluation": ["results", "truth"],
        "labels": ["truth"], "dataset": ["recipe"], "geo": ["recorded_path"], "encounter": ["encounter"],
        "encounter_model": ["encounter_model"], "performance": ["sensor_model"], "video": ["image"],
    }
    for folder, targets in targets_of.items():
        for source in sorted((ROOT / "tests" / folder).glob("*.[ch]*")):
            for text in literals(source.read_text()):
                for target in targets:
                    seeds.add(target, text)


# --- Logs.

def ulog() -> bytes:
    def message(kind: bytes, body: bytes) -> bytes:
        return struct.pack("<H", len(body)) + kind + body

    formats = [
        (b"vehicle_attitude:uint64_t timestamp;float[4] q;", b"vehicle_attitude", "<Q4f", (1, 0, 0, 0)),
        (b"vehicle_global_position:uint64_t timestamp;double lat;double lon;float alt;bool lat_lon_valid;",
         b"vehicle_global_position", "<Qddf?", (47.3, 8.5, 450.0, True)),
        (b"vehicle_local_position:uint64_t timestamp;float x;float y;float z;float vx;float vy;float vz;bool xy_valid;"
         b"bool z_valid;bool v_xy_valid;bool v_z_valid;double ref_lat;double ref_lon;float ref_alt;",
         b"vehicle_local_position", "<Q6f4?ddf", (1, 2, 3, 4, 5, 6, True, True, True, True, 47.3, 8.5, 450.0)),
        (b"sensor_combined:uint64_t timestamp;float[3] gyro_rad;float[3] accelerometer_m_s2;", b"sensor_combined",
         "<Q6f", (0.1, 0.2, 0.3, 0, 0, -9.8)),
        (b"gimbal_device_attitude_status:uint64_t timestamp;float[4] q;uint16_t device_flags;",
         b"gimbal_device_attitude_status", "<Q4fH", (1, 0, 0, 0, 32)),
        (b"camera_capture:uint64_t timestamp;", b"camera_capture", "<Q", ()),
    ]
    text = b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 1_000_000) + message(b"B", bytes(40))
    text += message(b"I", b"\x10char[8] sys_namePX4 test")
    for form, _, _, _ in formats:
        text += message(b"F", form)
    for number, (_, topic, _, _) in enumerate(formats):
        text += message(b"A", struct.pack("<BH", 0, number) + topic)
    for i in range(3):
        for number, (_, _, layout, values) in enumerate(formats):
            text += message(b"D", struct.pack("<H", number) + struct.pack(layout, 1_000_000 + 100_000 * i, *values))
        text += message(b"O", struct.pack("<H", 20))
    return text


def dataflash() -> bytes:
    def form(kind: int, length: int, name: bytes, letters: bytes, columns: bytes) -> bytes:
        return b"\xA3\x95\x80" + struct.pack("<BB4s16s64s", kind, length, name, letters, columns)

    text = form(128, 89, b"FMT", b"BBnNZ", b"Type,Length,Name,Format,Columns")
    text += form(13, 23, b"ATT", b"QccccCC", b"TimeUS,DesRoll,Roll,DesPitch,Pitch,DesYaw,Yaw")
    text += form(14, 51, b"GPS", b"QBBIHBcLLeffffB", b"TimeUS,I,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ,Yaw,U")
    text += form(15, 36, b"IMU", b"QBffffff", b"TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ")
    text += form(17, 23, b"POS", b"QLLf", b"TimeUS,Lat,Lng,Alt")
    text += form(18, 48, b"MNT", b"QBfffffffff", b"TimeUS,I,DRoll,Roll,DPitch,Pitch,DYawB,YawB,DYawE,YawE,Dist")
    for i in range(3):
        us = 5_000_000 + 100_000 * i
        text += b"\xA3\x95\x0D" + struct.pack("<QhhhhHH", us, 0, 100 * i, 0, -1250, 0, 27000)
        text += b"\xA3\x95\x0E" + struct.pack("<QBBIHBhiiiffffB", us, 0, 3, 302_400_500, 2200, 12, 80, 473_000_000,
                                              -85_000_000, 45_678, 10, 90, -2, 0, 1)
        text += b"\xA3\x95\x0F" + struct.pack("<QB6f", us, 0, 0.1, 0.2, 0.3, 0, 0, -9.8)
        text += b"\xA3\x95\x11" + struct.pack("<Qiif", us, 473_000_100, -85_000_000, 460.25)
        text += b"\xA3\x95\x12" + struct.pack("<QB9f", us, 0, 0, 1, 0, -45, 0, 5, 0, 0, 0)
    return text


def klv() -> bytes:
    key = bytes.fromhex("060E2B34020B01010E01030101000000")
    text = b""
    for i in range(3):
        items = b""
        for tag, value in [(2, struct.pack(">Q", 1_500_000_000_000_000 + 40_000 * i)), (5, b"\x71\xC2"), (6, b"\xFD\x3D"),
                           (7, b"\x08\xB8"), (10, b"UAV"), (13, b"\x55\x95\xB6\x6D"), (14, b"\x5B\x53\x60\xC4"),
                           (15, b"\xC2\x21"), (16, b"\xCD\x9C"), (18, b"\x72\x4A\x0A\x20"), (19, b"\x87\xF8\x4B\x86"),
                           (20, b"\x7D\xC5\x5E\xCE"), (75, b"\xC2\x21"), (104, b"\x0B\xB3\xE1")]:
            items += bytes([tag, len(value)]) + value
        packet = key + bytes([0x81, len(items) + 4]) + items + b"\x01\x02"
        total = sum(byte << (8 * ((at + 1) % 2)) for at, byte in enumerate(packet)) % 65536
        text += packet + struct.pack(">H", total)
    return text


def gpmf() -> bytes:
    def element(name: bytes, kind: bytes, size: int, repeat: int, value: bytes) -> bytes:
        return name + kind + struct.pack(">BH", size, repeat) + value + bytes(-len(value) % 4)

    def nest(name: bytes, inside: bytes) -> bytes:
        return element(name, b"\0", 4, len(inside) // 4, inside)

    shorts = struct.pack(">12h", *range(1, 13))
    gyro = nest(b"STRM", element(b"TSMP", b"L", 4, 1, struct.pack(">L", 4)) + element(b"STNM", b"c", 1, 9, b"Gyroscope") +
                element(b"ORIN", b"c", 1, 3, b"ZXY") + element(b"SCAL", b"s", 2, 1, b"\0\x64") +
                element(b"GYRO", b"s", 6, 4, shorts))
    turns = nest(b"STRM", element(b"SCAL", b"s", 2, 1, b"\x7f\xff") +
                 element(b"CORI", b"s", 8, 2, struct.pack(">8h", 32767, 0, 0, 0, 32767, 0, 0, 0)))
    shutter = nest(b"STRM", element(b"SHUT", b"f", 4, 2, struct.pack(">2f", 0.01, 0.02)))
    gps = nest(b"STRM", element(b"GPSF", b"L", 4, 1, struct.pack(">L", 3)) +
               element(b"GPSU", b"U", 16, 1, b"220304050607.500") +
               element(b"SCAL", b"l", 4, 5, struct.pack(">5l", 10_000_000, 10_000_000, 1000, 1000, 100)) +
               element(b"GPS5", b"l", 20, 1, struct.pack(">5l", 473_000_000, 85_000_000, 400_000, 0, 0)))
    karma = nest(b"STRM", element(b"TYPE", b"c", 1, 7, b"Lffffff") +
                 element(b"ATTD", b"?", 28, 1, struct.pack(">L6f", 1000, 1, 2, 3, 4, 5, 6)))
    return nest(b"DEVC", element(b"DVID", b"L", 4, 1, struct.pack(">L", 1)) +
                element(b"DVNM", b"c", 1, 11, b"HERO9 Black") + gyro + turns + shutter + gps + karma)


# --- Images and videos, by Python's zlib and by FFmpeg where it is installed.

def png(width: int, height: int, depth: int, kind: int) -> bytes:
    def chunk(name: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    samples = {0: 1, 2: 3, 6: 4}[kind]
    row = b"\0" + bytes((7 * i) % 256 for i in range(width * samples * depth // 8))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(row * height)) + chunk(b"IEND", b""))


def ffmpeg(folder: Path, name: str, size: str, *options: str) -> bytes:
    path = folder / name
    command = ["ffmpeg", "-v", "quiet", "-nostdin", "-y", "-f", "lavfi", "-i", f"testsrc=size={size}:rate=5:duration=1", *options,
               "-fflags", "+bitexact", "-flags", "+bitexact", str(path)]
    done = subprocess.run(command, check=False, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return path.read_bytes() if done.returncode == 0 and path.exists() else b""


def add_images_and_videos(seeds: Seeds) -> None:
    for depth, kind in [(8, 0), (16, 0), (8, 2), (16, 2), (8, 6)]:
        seeds.add("image", png(8, 6, depth, kind))
    seeds.add("image", b"P5\n8 6\n255\n" + bytes(48))
    seeds.add("image", b"P2\n8 6\n255\n" + b"9 " * 48)
    seeds.add("image", b"# heading\n0.0 0.png\n0.1 1.png\n0.25 2.png\n")
    seeds.add("image", b"#timestamp [ns],filename\n1403636579763555584,0.png\n1403636579813555456,1.png\n1403636579863555584,2.png\n")
    seeds.add("video", b"YUV4MPEG2 W4 H2 F25:1 Ip A1:1 C420jpeg\n" + (b"FRAME\n" + bytes(12)) * 3)
    if shutil.which("ffmpeg") is None:
        return
    made = seeds.folder / "made"
    made.mkdir(parents=True, exist_ok=True)
    one = ["-frames:v", "1"]
    for name, options in {"a.jpg": one, "b.jpg": [*one, "-pix_fmt", "yuvj444p"], "a.tiff": one, "b.tiff": [*one, "-pix_fmt", "rgb48le"],
                          "a.bmp": one, "a.webp": one}.items():
        if content := ffmpeg(made, name, "8x6", *options):
            seeds.add("image", content)
    for name, options in {"a.mp4": ["-c:v", "libx264"], "b.mp4": ["-c:v", "mpeg4", "-bf", "2"], "a.mkv": ["-c:v", "ffv1", "-level", "3"],
                          "b.mkv": ["-c:v", "ffv1", "-pix_fmt", "yuv422p10le"], "a.avi": ["-c:v", "mjpeg"], "a.nut": ["-c:v", "huffyuv"],
                          "a.ts": ["-c:v", "mpeg2video"], "a.webm": ["-c:v", "libvpx"], "a.mov": ["-c:v", "prores_ks"],
                          "b.mov": ["-c:v", "libx265", "-tag:v", "hvc1"], "a.y4m": [], "a.h264": ["-c:v", "libx264"],
                          "c.avi": ["-c:v", "cinepak"], "a.gif": []}.items():
        if content := ffmpeg(made, name, "32x16", *options):
            seeds.add("video", content)
    (made / "s.srt").write_text("1\n00:00:00,000 --> 00:00:01,000\n[latitude: 47.3] [longitude: 8.5] [rel_alt: 1 abs_alt: 4]\n")
    for name in ["s.mp4", "s.mkv"]:
        codec = "mov_text" if name == "s.mp4" else "srt"
        if content := ffmpeg(made, name, "32x16", "-i", str(made / "s.srt"), "-c:v", "libx264", "-c:s", codec):
            seeds.add("video", content)
    shutil.rmtree(made)


def add_real_files(seeds: Seeds, data: Path) -> None:
    seeds.add_files("calibration", data, "calibrations/*")
    seeds.add_files("model", data, "models/*/*.mtl", "models/quad*/*.obj", "models/glider*/*.obj")
    seeds.add_files("text_log", data, "telemetry/dji-srt/*", "telemetry/gopro/*.csv")
    seeds.add_files("truth", data, "aot-scoring/groundtruth.json")
    seeds.add_files("results", data, "aot-scoring/result.json", "track/*046_gt.csv")
    seeds.add_files("encounter", data, "encounters/pairs/*")
    seeds.add_files("encounter_model", data, "encounters/models/*_v1.txt")
    seeds.add_files("video", data, "telemetry/klv/*.ts")


def main() -> int:
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 64
    seeds = Seeds(Path(sys.argv[1]))
    shutil.rmtree(seeds.folder, ignore_errors=True)
    seeds.add_files("project", ROOT, "projects/*/*.json")
    seeds.add_files("recipe", ROOT, "projects/*/*.json", "docs/examples/*.json")
    seeds.add_files("calibration", ROOT, "assets/calibrations/*.xml")
    seeds.add_files("model", ROOT, "assets/models/*/*.mtl", "assets/models/insect/*.obj")
    seeds.add_files("text_log", ROOT, "assets/footage/*.csv")
    seeds.add_files("image", ROOT, "assets/models/airliner/*.png")
    add_examples(seeds)
    add_literals(seeds)
    for log in (ulog(), dataflash(), klv(), gpmf()):
        seeds.add("binary_log", log)
    add_images_and_videos(seeds)
    if len(sys.argv) == 3 and Path(sys.argv[2]).is_dir():
        add_real_files(seeds, Path(sys.argv[2]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
