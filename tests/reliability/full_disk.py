#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs commands of the program on a disk on which one operation fails, for every operation in turn.

Whichever it is, the program says so in one line and ends with 2, and what is there is whole. Usage:
full_disk.py PROGRAM FAULTY_DISK [--every N]; of the operations of a command only every Nth is tried.
"""

import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

from program_files import commands, faults_of, run


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("faulty_disk")
    parser.add_argument("--every", type=int, default=1)
    given = parser.parse_args()
    program = os.path.abspath(given.program)
    tried = 0
    faults = []
    with tempfile.TemporaryDirectory(prefix="vantage_disk_") as name:
        folder = Path(name)
        out = folder / "out"
        for command, words in commands(program, folder).items():
            arguments = [word.replace("{out}", str(out)) for word in words]
            for fault in ("fail", "full", "half"):
                at = 1
                while True:
                    shutil.rmtree(out, ignore_errors=True)
                    out.mkdir()
                    ended = run(program, arguments, env={**os.environ, "LD_PRELOAD": os.path.abspath(given.faulty_disk),
                                                         "VANTAGE_FAULT": f"{fault}:{at}"})
                    where = f"{command}, {fault}:{at}"
                    faults += [f"{where}: {what}" for what in faults_of(program, out, True)]
                    if ended.returncode in (0, 3, 4):  # the operation was not reached
                        break
                    tried += 1
                    if ended.returncode != 2 or ended.stderr.count("\n") != 1 or "cannot be" not in ended.stderr:
                        faults.append(f"{where}: exit code {ended.returncode}, {ended.stderr.strip()!r}")
                    at += given.every
    print("\n".join(faults[:40]), file=sys.stderr)
    print(f"{tried} operations failed, {len(faults)} faults")
    return 1 if faults or tried == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
