"""This program bounds the instructions of any sample of the monitor of a certificate, as `worst_bound.py` does those of a tick.

Every loop of the monitor goes over arrays of a length that the source states. What the C library moves is charged by its size.
"""

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import worst_bound
from worst_bound import Bound, Code

ENTRY = "rigproof_impl::monitor::Monitor::watch"
# How often a loop goes round at most: over four joints where the sample is taken in, else over 17 numbers and what is known of them together.
ROUNDS = {ENTRY: [4], "monitor::": [18, 18]}
# No block, window or factor is larger than 2.5 kB; a processor moves at least eight bytes with an instruction.
MOVED = 350


class Watched(Bound):
    """Longest ways of a sample; a call into the C library is one that moves or clears what it is told."""

    joints = None

    def called(self, start, calls, address):
        if address in calls and calls[address] not in self.code.functions:
            return MOVED
        return super().called(start, calls, address)

    def loop(self, start, group, nodes, follows, cost, entry, depth):
        """Of the sample itself only the loop over the joints is known: a build that has another there cannot be bounded."""
        if depth == 0 and self.code.names[start] == ENTRY:
            if self.joints not in (None, min(group)):
                raise SystemExit(f"{ENTRY} has two loops, at {self.joints:x} and {min(group):x}: their rounds are not known")
            self.joints = min(group)
        return super().loop(start, group, nodes, follows, cost, entry, depth)


def greatest(program, samples):
    """The most instructions of a sample among so many, each counted by itself."""
    counts = []
    with tempfile.TemporaryDirectory() as folder:
        counting = ["valgrind", "--tool=callgrind", f"--toggle-collect={ENTRY}", f"--dump-after={ENTRY}", f"--callgrind-out-file={folder}/out"]
        subprocess.run([*counting, program, "monitor", str(samples)], check=True, capture_output=True)
        for dump in Path(folder).iterdir():
            found = re.search(r"^totals: (\d+)$", dump.read_text(), re.MULTILINE)
            counts.append(int(found[1]))
    # The last dump holds what came after the last sample: nothing.
    counts.sort()
    return len(counts) - 1, sum(counts) // samples, counts[-len(counts) // 100], counts[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="the example `instructions` of the implementation")
    parser.add_argument("--samples", type=int, default=3000, help="samples that are counted one by one")
    parser.add_argument("--most", type=int, help="a bound above this is an error")
    choice = parser.parse_args()
    sys.setrecursionlimit(20_000)
    code = Code(choice.program)
    [entry] = [address for address, name in code.names.items() if name == ENTRY]
    worst_bound.ROUNDS = ROUNDS
    bound = Watched(code, None, None).of(entry)
    counted, mean, hundredth, most = greatest(choice.program, choice.samples)
    print(f"{counted} samples: {mean} instructions in the mean, one in a hundred over {hundredth}, at most {most}; none needs more than {bound}")
    if most > bound:
        sys.exit("a count is above its bound")
    if choice.most is not None and bound > choice.most:
        sys.exit(f"the bound is above {choice.most}")


if __name__ == "__main__":
    main()
