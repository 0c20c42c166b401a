# SPDX-License-Identifier: MIT
"""paraview_test.py PROGRAM: the time series for ParaView, read by the words of VTK's own description of its files."""
import base64
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
import zlib

FORMATS = {"Float32": "f", "UInt8": "B", "Int32": "i"}


def values(array):
    """The numbers of a DataArray: lengths of blocks in letters of their own, then the blocks, packed."""
    text = array.text.strip()
    blocks, size, last = struct.unpack("<3Q", base64.b64decode(text[:32]))
    header = (8 * (3 + blocks) + 2) // 3 * 4
    lengths = struct.unpack(f"<{3 + blocks}Q", base64.b64decode(text[:header]))[3:]
    body = base64.b64decode(text[header:])
    data = b""
    for i, length in enumerate(lengths):
        part, body = zlib.decompress(body[:length]), body[length:]
        assert len(part) == (last if last and i + 1 == blocks else size)
        data += part
    assert not body
    letter = FORMATS[array.get("type")]
    return struct.unpack(f"<{len(data) // struct.calcsize(letter)}{letter}", data)


def parts(folder, name):
    """(time, root element, file) of every part of a series."""
    series = ET.parse(os.path.join(folder, name + ".pvd")).getroot()
    for entry in series.iter("DataSet"):
        file = os.path.join(folder, entry.get("file"))
        yield int(entry.get("timestep")), ET.parse(file).getroot(), file


def by_name(root, name):
    return values(next(a for a in root.iter("DataArray") if a.get("Name") == name))


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "explore", "--world", "rooms", "--out", folder, "--quiet"], check=True)
        subprocess.run([program, "report", os.path.join(folder, "run.record"), "--out", folder, "--paraview", "--ply"],
                       check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            report = json.load(file)
        views = report["views"]
        counts = json.loads(subprocess.run([program, "map", os.path.join(folder, "map.ot"), "--json", "-"],
                                           check=True, capture_output=True, text=True).stdout)["cells"]
        times = []
        for time, root, _ in parts(folder, "occupancy"):
            states = by_name(root, "occupancy")
            extent = [int(n) for n in root.find("ImageData").get("WholeExtent").split()]
            assert len(states) == extent[1] * extent[3] * extent[5] == 51 ** 3
            times.append(time)
        assert times == sorted(times) and times[-1] == views and len(times) > 5
        assert states.count(1) == counts["free"] and states.count(2) == counts["occupied"], counts
        for time, root, _ in parts(folder, "frontiers"):
            assert len(by_name(root, "Points")) == 3 * report["cycles"][time - 1]["frontier_cells"]
        for time, root, _ in parts(folder, "path"):
            points, planned = by_name(root, "Points"), by_name(root, "planned")
            first = by_name(root, "offsets")[0]
            corners = [points[3 * i:3 * i + 3] for i in range(first)]
            length = sum(map(math.dist, corners, corners[1:]))
            assert abs(length - report["cycles"][time - 1]["path_length_m"]) < 1e-3 and planned[0] == 0
        fields = 0
        for _, root, _ in parts(folder, "field"):
            phi, downhill = by_name(root, "phi"), by_name(root, "downhill")
            assert len(downhill) == 3 * len(phi) > 0 and 0.0 <= min(phi) <= max(phi) <= 1.0
            norms = [math.hypot(*downhill[i:i + 3]) for i in range(0, len(downhill), 3)]
            assert all(norm == 0 or abs(norm - 1) < 0.02 for norm in norms)
            fields += 1
        assert fields > 5
        print(f"{len(times)} grids and {fields} fields read back")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
