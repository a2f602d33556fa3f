"""This program counts the instructions of a tick in the mean: two runs of different length under callgrind, and their difference."""

import argparse
import re
import subprocess
from pathlib import Path

TICKS = (5_000, 10_000)
PARTS = {"loop": "closed loop", "controller": "controller alone", "plant": "plant alone", "linkage": "linkage without brakes"}


def counted(program, part, ticks):
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, part, str(ticks)]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stderr
    return int(re.search(r"Collected : (\d+)", printed).group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="the example `instructions` of the implementation")
    program = parser.parse_args().program
    few, many = TICKS
    for part, name in PARTS.items():
        each = (counted(program, part, many) - counted(program, part, few)) / (many - few)
        print(f"{name}: {each:.0f} instructions a tick")


if __name__ == "__main__":
    main()
