"""This program finds the dearest ticks of the controller: it screens many by the clock and counts the instructions of the slowest, one by one."""

import argparse
import subprocess
from pathlib import Path

# Where valgrind loads a position-independent program on x86-64.
LOADED_AT = 0x108000


def address(program, name):
    """Where a function of the program lies once loaded, as hexadecimal digits."""
    symbols = subprocess.run(["nm", "--demangle", program], check=True, capture_output=True, text=True).stdout
    [found] = [line.split()[0] for line in symbols.splitlines() if line.split()[-1] == name]
    return f"{int(found, 16) + LOADED_AT:x}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="the example `worst_tick` of the implementation")
    parser.add_argument("--episodes", type=int, default=20_000, help="episodes of 50 ticks that are screened")
    parser.add_argument("--keep", type=int, default=2, help="slowest episodes that are counted, for every law, path and layout")
    choice = parser.parse_args()
    screen = [choice.program, "screen", str(choice.episodes), str(choice.keep)]
    chosen = subprocess.run(screen, check=True, capture_output=True, text=True).stdout.strip()
    marks = [address(choice.program, f"worst_tick::{name}") for name in ("entry", "leave")]
    lackey = ["valgrind", "--tool=lackey", "--basic-counts=no", "--trace-mem=yes", "--log-fd=1"]
    trace = subprocess.Popen([*lackey, choice.program, "run", chosen], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    subprocess.run([choice.program, "count", chosen, *marks], check=True, stdin=trace.stdout)
    trace.wait()


if __name__ == "__main__":
    main()
