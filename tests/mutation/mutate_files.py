#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Damages whole files of every kind that the program reads, and runs the program on them under limits.

Whatever a file holds, the program ends by itself with 0, 2, 3 or 4; with 2 its last line says why and names the
file or an option. Usage: mutate_files.py PROGRAM [--runs N] [--seed N] [--kind NAME]; N runs of every kind.
"""

import argparse
import json
import os
import random
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

MEMORY_BYTES = 6 << 30
SECONDS = 60


def ply(kind):
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (0, 2)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    header = (
        f"ply\nformat {kind} 1.0\nelement vertex {len(corners)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    ).encode()
    if kind == "ascii":
        rows = [" ".join(map(str, row)) for row in corners]
        rows += [" ".join(map(str, (len(row), *row))) for row in faces]
        return header + ("\n".join(rows) + "\n").encode()
    order = "<" if kind == "binary_little_endian" else ">"
    body = b"".join(struct.pack(order + "3f", *row) for row in corners)
    return header + body + b"".join(struct.pack(order + "B4i", len(row), *row) for row in faces)


def obj():
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (0, 2)]
    faces = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    return "".join([f"v {x} {y} {z}\n" for x, y, z in corners] + ["f %d %d %d %d\n" % face for face in faces]).encode()


def stl():
    triangles = [((0, 0, 0), (2, 0, 0), (0, 2, 0)), ((0, 0, 0), (2, 0, 0), (0, 0, 2)), ((2, 0, 0), (0, 2, 0), (0, 0, 2))]
    body = b"".join(
        struct.pack("<3f", 0, 0, 1) + b"".join(struct.pack("<3f", *corner) for corner in triangle) + b"\0\0"
        for triangle in triangles
    )
    return bytes(80) + struct.pack("<I", len(triangles)) + body


def png16(width, height, millimetres):
    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    rows = (b"\0" + struct.pack(">H", millimetres) * width) * height
    header = struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class Kinds:
    """Whole files by kind, and the program's arguments to read them."""

    def __init__(self, program, source, folder):
        self.short = ["--planner", "nearest-frontier", "--max-views", "1", "--quiet", "--no-coverage"]
        self.kinds = {}
        run = folder / "run"
        subprocess.run(
            [program, "explore", "--world", "table", "--resolution", "0.2", "--sensor", "kinect", *self.short, "--out", run],
            check=False,
        )
        for kind in ("ascii", "binary_little_endian", "binary_big_endian"):
            self.add(f"ply-{kind}", "mesh.ply", ply(kind), self.explore)
        self.add("obj", "mesh.obj", obj(), self.explore)
        self.add("stl", "mesh.stl", stl(), self.explore)
        self.add("reconstruct", "mesh.ply", ply("ascii"), lambda f: ["reconstruct", "--object", f, "--candidates", "20",
                                                                     "--resolution", "0.1", "--max-views", "1", "-q"])
        self.add("octomap", "map.ot", (run / "map.ot").read_bytes(), lambda f: ["map", f])
        self.add("octomap-world", "map.ot", (run / "map.ot").read_bytes(), self.explore)
        self.add("record", "run.record", (run / "run.record").read_bytes(),
                 lambda f: ["report", f, "--ply", "--out", folder / "reported"])
        self.add("report", "report.json", (run / "report.json").read_bytes(),
                 lambda f: ["compare", f, "--out", folder / "compared"])
        sensor = {"projection": "spherical", "width": 64, "height": 32, "horizontal_fov_deg": 360,
                  "vertical_fov_deg": 90, "min_range_m": 0.1, "max_range_m": 8, "reports_no_return": True}
        self.add("sensor", "sensor.json", json.dumps(sensor, indent=1).encode(),
                 lambda f: ["explore", "--world", "table", "--resolution", "0.2", *self.short, "--sensor", f])
        if "search" in subprocess.run([program, "--help"], capture_output=True, text=True).stdout:
            self.add("urdf", "arm.urdf", (source / "examples" / "tracked_arm.urdf").read_bytes(),
                     lambda f: ["search", "--world", "crates-open", "--arm", f, "--joints", "0,-40,86,0,0",
                                "--resolution", "0.1", "--set", "views=20", "--max-views", "1", "-q"])
        pose = b"1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
        recording = {"a.depth.png": png16(32, 24, 2000), "a.pose.txt": pose,
                     "b.depth.png": png16(32, 24, 1500), "b.pose.txt": pose}
        for name in ("a.depth.png", "a.pose.txt"):
            self.add(f"7scenes-{name}", name, recording[name], self.replay("7scenes"), recording)
        tum = {"depth.txt": b"1.0 1.png\n2.0 2.png\n", "1.png": png16(32, 24, 9000), "2.png": png16(32, 24, 8000),
               "groundtruth.txt": b"1.0 0 0 0 0 0 0 1\n2.0 0.1 0 0 0 0 0 1\n"}
        for name in ("depth.txt", "groundtruth.txt"):
            self.add(f"tum-{name}", name, tum[name], self.replay("tum"), tum)

    def add(self, kind, name, content, arguments, beside=None):
        self.kinds[kind] = (name, content, arguments, beside or {})

    def explore(self, file):
        return ["explore", "--world", file, "--resolution", "0.2", "--sensor", "kinect", *self.short]

    @staticmethod
    def replay(form):
        return lambda f: ["replay", "--dataset", Path(f).parent, "--format", form, "--planner", "nearest-frontier",
                          "--resolution", "0.1", "-q"]


NUMBERS = [b"-1", b"0", b"1e20", b"nan", b"inf", b"4294967295", b"99999999999999999999", b"1e-300"]


def damaged(content, chance):
    """Cut, bytes changed, taken out or doubled, or a number in it replaced by an odd one."""
    data = bytearray(content)
    for _ in range(chance.randint(1, 3)):
        if not data:
            break
        at = chance.randrange(len(data))
        what = chance.randrange(6)
        if what == 0:
            del data[at:]
        elif what == 1:
            data[at] = chance.randrange(256)
        elif what == 2:
            del data[at : at + chance.randint(1, 32)]
        elif what == 3:
            data[at:at] = data[chance.randrange(len(data)) :][: chance.randint(1, 64)]
        elif what == 4:
            data[at : at + 4] = chance.choice([b"\xff\xff\xff\xff", b"\0\0\0\0", b"\0\0\0\x80", b"\0\0\xc0\x7f"])
        else:
            digits = [i for i in range(len(data)) if chr(data[i]) in "0123456789"]
            if digits:
                start = end = chance.choice(digits)
                while end < len(data) and chr(data[end]) in "0123456789.eE+-":
                    end += 1
                data[start:end] = chance.choice(NUMBERS)
    return bytes(data)


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def complaint(program, arguments, names):
    """What is wrong with how the program took it; None where nothing is. And its exit code."""
    command = [program, *map(str, arguments)]
    try:
        ran = subprocess.run(command, capture_output=True, timeout=SECONDS, preexec_fn=limited)
    except subprocess.TimeoutExpired:
        return f"did not end within {SECONDS} s", None
    said = ran.stderr.decode(errors="replace")
    if ran.returncode not in (0, 2, 3, 4):
        return f"exit code {ran.returncode}: {said}", ran.returncode
    if ran.returncode == 2:
        said = said.rstrip("\n").rpartition("\n")[2]  # doubts about a mesh may come before
        if not said.startswith("vantage: "):
            return f"does not say why: {said}", 2
        if not any(name in said for name in names) and "--" not in said:
            return f"names neither file nor option: {said}", 2
    return None, ran.returncode


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind")
    given = parser.parse_args()
    source = Path(__file__).resolve().parents[2]
    failures = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        kinds = Kinds(given.program, source, folder).kinds
        if given.kind:
            kinds = {given.kind: kinds[given.kind]}
        for kind, (name, content, arguments, beside) in kinds.items():
            codes = {}
            for run in range(given.runs):
                place = folder / "case"
                shutil.rmtree(place, ignore_errors=True)
                place.mkdir()
                for other, bytes_ in beside.items():
                    (place / other).write_bytes(bytes_)
                file = place / name
                # The first of every kind is whole: it must be read.
                chance = random.Random(f"{given.seed} {kind} {run}")
                file.write_bytes(content if run == 0 else damaged(content, chance))
                wrong, code = complaint(given.program, arguments(file), [str(file), str(place)])
                if run == 0 and code == 2:
                    wrong = wrong or "the whole file is refused"
                codes[code] = codes.get(code, 0) + 1
                if wrong:
                    failures += 1
                    print(f"{kind}, run {run}, seed {given.seed}: {wrong}", flush=True)
                    kept = os.environ.get("VANTAGE_KEEP")  # a folder for the files that went wrong
                    if kept:
                        shutil.copy(file, Path(kept) / f"{kind}-{run}-{name}")
            print(f"{kind}: " + ", ".join(f"{n} x {code}" for code, n in sorted(codes.items(), key=str)), flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
