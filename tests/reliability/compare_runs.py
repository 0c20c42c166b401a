#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The same run, whatever it runs on: planners x threads x instruction sets x locales x folders.

All but the times of a report, and the bytes of the map, must be the same. Usage: compare_runs.py PROGRAM [--sample];
with --sample all of them differ at once, and the runs are short.
"""

import argparse
import itertools
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from program_files import run

RUN = ["explore", "--world", "office", "--size", "9,7", "--sensor", "kinect", "--no-coverage", "--quiet"]
TIMES = ("insert_ms", "plan_ms", "time_ms", "peak_memory_mb", "threads")


def comma_locale(folder):
    """A locale that writes 1.000,5 for 1000.5, made here because few machines have one; None if that fails."""
    made = folder / "locales" / "de_DE.UTF-8"
    made.parent.mkdir()
    tool = shutil.which("localedef")
    if tool is not None:
        subprocess.run([tool, "--no-archive", "-i", "de_DE", "-f", "UTF-8", made], capture_output=True, check=False)
    return {"LOCPATH": str(made.parent), "LC_ALL": "de_DE.UTF-8"} if made.exists() else None


def instruction_sets():
    flags = Path("/proc/cpuinfo").read_text() if Path("/proc/cpuinfo").exists() else ""
    return ["baseline"] + [name for name, flag in (("avx2", " avx2"), ("avx512", " avx512bw")) if flag in flags]


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(of) for key, of in value.items() if key not in TIMES}
    return [without_times(of) for of in value] if isinstance(value, list) else value


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--sample", action="store_true")
    given = parser.parse_args()
    program = os.path.abspath(given.program)
    planners = [line.split()[0] for line in planner_lines(run(program, ["list"]).stdout)]
    faults = []
    runs = 0
    with tempfile.TemporaryDirectory(prefix="vantage_same_") as name:
        folder = Path(name)
        comma = comma_locale(folder)
        if comma is None:
            print("no comma locale can be made here (localedef, locales): that part is left out")
        locales = [{"LC_ALL": "C"}] + ([comma] if comma else [])
        folders = [folder / "a", folder / "of its own, ü" / "deep"]
        ways = list(itertools.product(("1", "3"), instruction_sets(), locales, folders))
        if given.sample:
            ways = [ways[0], ways[-1]]
        views = "8" if given.sample else "25"
        for planner in planners:
            expected = None
            for threads, instructions, locale, where in ways:
                shutil.rmtree(where, ignore_errors=True)
                where.mkdir(parents=True)
                environment = {**os.environ, **locale, "VANTAGE_INSTRUCTION_SET": instructions}
                ended = run(program, [*RUN, "--max-views", views, "--planner", planner, "--threads", threads,
                                      "--out", "run"], cwd=where, env=environment)
                what = f"{planner}, {threads} threads, {instructions}, {locale['LC_ALL']}, {where.name}"
                runs += 1
                if ended.returncode not in (0, 3, 4):
                    faults.append(f"{what}: exit code {ended.returncode}, {ended.stderr.strip()}")
                    continue
                report = without_times(json.loads((where / "run" / "report.json").read_text()))
                found = (json.dumps(report), (where / "run" / "map.ot").read_bytes())
                expected = expected or found
                if found != expected:
                    faults.append(f"{what}: not the run of one thread")
    print("\n".join(faults[:40]), file=sys.stderr)
    print(f"{runs} runs of {len(planners)} planners, {len(faults)} faults")
    return 1 if faults or not planners else 0


def planner_lines(listed):
    """The lines below the heading of the planners."""
    here = False
    for line in listed.splitlines():
        if line and not line.startswith(" "):
            here = line.split()[0] == "planners"
        elif here and line.strip():
            yield line


if __name__ == "__main__":
    sys.exit(main())
