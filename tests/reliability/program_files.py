# SPDX-License-Identifier: MIT
"""What the scripts of this folder share: commands of the program that write files, and whether files are whole."""

import json
import subprocess
from pathlib import Path

SECONDS = 120
SHORT = ["--resolution", "0.2", "--sensor", "kinect", "--quiet", "--no-coverage", "--max-views"]
CUBE = """ply
format ascii 1.0
element vertex 8
property float x
property float y
property float z
element face 6
property list uchar int vertex_indices
end_header
0 0 0
0 0 .2
0 .2 0
0 .2 .2
.2 0 0
.2 0 .2
.2 .2 0
.2 .2 .2
4 0 1 3 2
4 4 6 7 5
4 0 4 5 1
4 2 3 7 6
4 0 2 6 4
4 1 5 7 3
"""


def run(program, arguments, **others):
    """Runs the program to its end; its output is text."""
    return subprocess.run([program, *arguments], capture_output=True, text=True, errors="replace", timeout=SECONDS,
                          check=False, **others)


def commands(program, folder):
    """Arguments of commands by name, `{out}` stands for an empty folder. Makes what they read in `folder`."""
    run(program, ["explore", "--world", "table", *SHORT, "3", "--out", folder / "made"])
    (folder / "cube.ply").write_text(CUBE)
    return {
        "explore": ["explore", "--world", "table", "--planner", "harmonic", *SHORT, "6", "--out", "{out}/run", "--json",
                    "{out}/report.json"],
        "reconstruct": ["reconstruct", "--object", str(folder / "cube.ply"), "--resolution", "0.05", "--max-views", "2",
                        "--candidates", "20", "--quiet", "--out", "{out}/run"],
        "search": ["search", "--world", "crates-open", "--planner", "nearest-frontier", "--resolution", "0.1",
                   "--max-views", "1", "--quiet", "--out", "{out}/run"],
        "report": ["report", str(folder / "made/run.record"), "--out", "{out}/run"],
        "map": ["map", str(folder / "made/map.ot"), "--json", "{out}/map.json"],
    }


def faults_of(program, folder, run_ended):
    """Sentences on the files in a folder that are neither whole nor named as unfinished."""
    faults = []
    for file in sorted(Path(folder).rglob("*")):
        if file.is_dir():
            continue
        content = file.read_bytes()
        if file.suffix == ".part":
            if run_ended:
                faults.append(f"{file.name} is left")
        elif file.name == "run.record":
            faults += record_faults(program, file, content)
        elif file.suffix == ".json":
            try:
                json.loads(content)
            except ValueError as error:
                faults.append(f"{file.name}: {error}")
        elif file.suffix == ".html" and not content.rstrip().endswith(b"</html>"):
            faults.append(f"{file.name} has no end")
        elif file.suffix == ".png" and (content[:8] != b"\x89PNG\r\n\x1a\n" or b"IEND" not in content[-12:]):
            faults.append(f"{file.name} is no whole picture")
        elif file.suffix in (".ot", ".bt"):
            read = run(program, ["map", file])
            if read.returncode != 0:
                faults.append(f"{file.name}: {read.stderr.strip()}")
    return faults


def record_faults(program, file, content):
    """A record opens as far as it goes. One without a whole view is refused in one line."""
    again = file.parent.parent / "again"
    read = run(program, ["report", file, "--out", again])
    if read.returncode == 0 or (read.returncode == 2 and len(content) < 20_000 and read.stderr.count("\n") == 1):
        return []
    return [f"{file.name} of {len(content)} bytes: exit code {read.returncode}, {read.stderr.strip()}"]
