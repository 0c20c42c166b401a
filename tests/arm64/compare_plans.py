#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the plans that two builds of plans_in_small_worlds print, for processors with other mathematical functions.

Usage: compare_plans.py PROGRAM OTHER... (a program, and the command of another). Words must be equal, and numbers up
to 1e-12: sin, cos, atan2 and hypot of the C library may differ in the last bit.
"""
import subprocess
import sys


def printed_by(command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()


def is_same(one, other):
    if one == other:
        return True
    try:
        return abs(float.fromhex(one) - float.fromhex(other)) <= 1e-12
    except ValueError:
        return False


def main():
    one = printed_by(sys.argv[1:2])
    other = printed_by(sys.argv[2:])
    if len(one) != len(other):
        sys.exit(f"{len(one)} words, and {len(other)} of the other program")
    differing = [at for at, pair in enumerate(zip(one, other)) if not is_same(*pair)]
    if differing:
        at = differing[0]
        sys.exit(f"{len(differing)} of {len(one)} words differ, first: {one[at]} and {other[at]}")
    equal = sum(a == b for a, b in zip(one, other))
    print(f"{len(one)} words: {equal} are equal bit for bit, {len(one) - equal} up to 1e-12")


if __name__ == "__main__":
    main()
