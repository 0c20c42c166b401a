# SPDX-License-Identifier: MIT
"""vtk_test.py PROGRAM: the exports of a run, read by VTK itself, which nobody here wrote.

Its numbers are compared with report.json and with the map that the run left; a file with one cell changed, or cut off,
must be noticed. Exit codes: 0 all is well, 1 something is not, 77 there is no VTK for Python here."""
import base64
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
import zlib

DEBIAN_PYTHON = "/usr/bin/python3"  # whose modules Debian's packages are, whatever other Python comes first
try:
    import vtk
except ImportError:
    if os.path.exists(DEBIAN_PYTHON) and os.path.realpath(sys.executable) != os.path.realpath(DEBIAN_PYTHON):
        os.execv(DEBIAN_PYTHON, [DEBIAN_PYTHON, *sys.argv])
    print("Skipped: there is no VTK here to read exports with (python3-vtk9)")
    sys.exit(77)


def series(folder, name):
    """(view, file) of every part."""
    for entry in ET.parse(os.path.join(folder, name + ".pvd")).getroot().iter("DataSet"):
        yield int(entry.get("timestep")), os.path.join(folder, entry.get("file"))


def read(reader, file):
    """What VTK makes of a file; what it complains about is an error here."""
    complaints = []
    reader.AddObserver("ErrorEvent", lambda _, event: complaints.append(event))
    reader.SetFileName(file)
    reader.Update()
    if complaints:
        raise AssertionError(f"VTK complains about {file}")
    return reader.GetOutput()


def numbers(array):
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def read_occupancy(file, cell_m):
    """How many cells of each state a grid holds: unknown, free, occupied."""
    grid = read(vtk.vtkXMLImageDataReader(), file)
    states = numbers(grid.GetCellData().GetArray("occupancy"))
    assert len(states) == grid.GetNumberOfCells() > 0, file
    assert all(abs(spacing - cell_m) < 1e-9 for spacing in grid.GetSpacing()), grid.GetSpacing()
    assert all(abs(corner / cell_m - round(corner / cell_m)) < 1e-6 for corner in grid.GetOrigin()), grid.GetOrigin()
    return [states.count(state) for state in (0, 1, 2)]


def points_of(data):
    return [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]


def line(data, number):
    ends = vtk.vtkIdList()
    data.GetLines().GetCellAtId(number, ends)
    return [data.GetPoint(ends.GetId(i)) for i in range(ends.GetNumberOfIds())]


def check_grids(folder, report, counts):
    last = None
    views = []
    for view, file in series(folder, "occupancy"):
        last = read_occupancy(file, report["resolution_m"])
        views.append(view)
    assert views == sorted(set(views)) and views[-1] == report["views"] and len(views) > 3, views
    assert last[1:] == [counts["free"], counts["occupied"]], (last, counts)
    return len(views)


def check_ways(folder, report):
    for view, file in series(folder, "frontiers"):
        data = read(vtk.vtkXMLPolyDataReader(), file)
        wanted = report["cycles"][view - 1]["frontier_cells"]
        assert data.GetNumberOfPoints() == data.GetNumberOfCells() == wanted, (file, data.GetNumberOfPoints(), wanted)
    for view, file in series(folder, "path"):
        data = read(vtk.vtkXMLPolyDataReader(), file)
        assert all(data.GetCell(i).GetNumberOfPoints() >= 2 for i in range(data.GetNumberOfCells())), file
        behind = line(data, 0)
        cycle = report["cycles"][view - 1]
        length = sum(map(math.dist, behind, behind[1:]))
        assert abs(length - cycle["path_length_m"]) < 1e-3, (file, length, cycle["path_length_m"])
        assert math.dist(behind[-1], cycle["pose"][:3]) < 1e-3, file
        assert numbers(data.GetCellData().GetArray("planned")) == [0, 1][:data.GetNumberOfCells()], file
    fields = 0
    for _, file in series(folder, "field"):
        data = read(vtk.vtkXMLPolyDataReader(), file)
        phi = numbers(data.GetPointData().GetArray("phi"))
        downhill = data.GetPointData().GetArray("downhill")
        assert len(phi) == downhill.GetNumberOfTuples() == data.GetNumberOfPoints() > 0, file
        assert 0 <= min(phi) <= max(phi) <= 1, file
        for i in range(len(phi)):
            assert math.hypot(*downhill.GetTuple(i)) < 1.02, file
        fields += 1
    return fields


def check_ply(folder, report, counts):
    """The points are the occupied cells; the mesh encloses as much as they do."""
    cell_m = report["resolution_m"]
    points = points_of(read(vtk.vtkPLYReader(), os.path.join(folder, "points.ply")))
    assert len(points) == len(set(points)) == counts["occupied"], len(points)
    mesh = vtk.vtkTriangleFilter()
    mesh.SetInputData(read(vtk.vtkPLYReader(), os.path.join(folder, "map.ply")))
    mesh.Update()
    mass = vtk.vtkMassProperties()
    mass.SetInputConnection(mesh.GetOutputPort())
    mass.Update()
    wanted = counts["occupied"] * cell_m ** 3
    assert abs(mass.GetVolume() - wanted) < 1e-3 * wanted, (mass.GetVolume(), wanted)


def packed(data):
    """Numbers as a file holds them: one block, packed, its lengths before it in letters of their own."""
    body = zlib.compress(data)
    head = struct.pack("<4Q", 1, len(data), 0, len(body))
    return base64.b64encode(head) + base64.b64encode(body)


def plant(folder, kind):
    """Damages the last grid: one free cell becomes occupied, or the file ends in its middle."""
    file = list(series(folder, "occupancy"))[-1][1]
    with open(file, "rb") as whole:
        text = whole.read()
    if kind == "cut off":
        damaged = text[:len(text) // 2]
    else:
        states = bytearray(numbers(read(vtk.vtkXMLImageDataReader(), file).GetCellData().GetArray("occupancy")))
        states[states.index(1)] = 2
        damaged = re.sub(rb"(<DataArray[^>]*>)[^<]*", lambda found: found[1] + packed(bytes(states)), text)
    with open(file, "wb") as out:
        out.write(damaged)
    return file, text


def check_that_damage_is_seen(folder, report, counts):
    for kind in ("one cell changed", "cut off"):
        file, text = plant(folder, kind)
        try:
            check_grids(folder, report, counts)
        except (AssertionError, AttributeError):
            pass
        else:
            raise AssertionError(f"nobody noticed: {kind}")
        with open(file, "wb") as out:
            out.write(text)
    check_grids(folder, report, counts)


def main(program):
    vtk.vtkObject.GlobalWarningDisplayOff()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "explore", "--world", "table", "--planner", "harmonic", "--sensor", "panoramic",
                        "--resolution", "0.2", "--out", folder, "--quiet"], check=True)
        subprocess.run([program, "report", os.path.join(folder, "run.record"), "--out", folder, "--paraview", "--ply"],
                       check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            report = json.load(file)
        counts = json.loads(subprocess.run([program, "map", os.path.join(folder, "map.ot"), "--json", "-"],
                                           check=True, capture_output=True, text=True).stdout)["cells"]
        grids = check_grids(folder, report, counts)
        fields = check_ways(folder, report)
        check_ply(folder, report, counts)
        check_that_damage_is_seen(folder, report, counts)
        assert fields > 0
    print(f"VTK {vtk.vtkVersion.GetVTKVersion()} read {grids} grids, {fields} fields, a mesh and its points")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
