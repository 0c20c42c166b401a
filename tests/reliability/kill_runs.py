#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills runs of the program (SIGKILL): in the middle of every operation on its files, and at moments in time.

What was finished opens, and what is there is whole. Usage: kill_runs.py PROGRAM FAULTY_DISK [--every N]
[--moments N] [--seed N]; of the operations only every Nth is tried.
"""

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from program_files import commands, faults_of, run


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("faulty_disk")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--moments", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    program = os.path.abspath(given.program)
    faults = []
    killed = {"operations": 0, "moments": 0}
    draw = random.Random(given.seed)
    with tempfile.TemporaryDirectory(prefix="vantage_kill_") as name:
        folder = Path(name)
        out = folder / "out"

        def anew():
            shutil.rmtree(out, ignore_errors=True)
            out.mkdir()

        for command, words in commands(program, folder).items():
            arguments = [word.replace("{out}", str(out)) for word in words]
            at = 1
            while True:
                anew()
                ended = run(program, arguments, env={**os.environ, "LD_PRELOAD": os.path.abspath(given.faulty_disk),
                                                     "VANTAGE_FAULT": f"kill:{at}"})
                if ended.returncode != -signal.SIGKILL:
                    if ended.returncode not in (0, 3, 4):
                        faults.append(f"{command}, kill:{at}: exit code {ended.returncode}, {ended.stderr.strip()!r}")
                    break
                killed["operations"] += 1
                faults += [f"{command}, kill:{at}: {what}" for what in faults_of(program, out, False)]
                at += given.every
        arguments = [word.replace("{out}", str(out)) for word in commands(program, folder)["explore"]]
        anew()
        start = time.monotonic()
        run(program, arguments)
        whole_s = time.monotonic() - start
        for _ in range(given.moments):
            anew()
            after_s = draw.uniform(0.0, whole_s)
            process = subprocess.Popen([program, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(after_s)
            process.kill()
            killed["moments"] += process.wait() == -signal.SIGKILL
            faults += [f"explore, after {after_s:.3f} s: {what}" for what in faults_of(program, out, False)]
    print("\n".join(faults[:40]), file=sys.stderr)
    print(f"killed at {killed['operations']} operations and {killed['moments']} moments, {len(faults)} faults")
    return 1 if faults or killed["operations"] == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
