"""This program bounds the instructions of any tick: the longest way through the machine code, with every loop taken as often as it can be.

How often that is stands below and is argued in the source (decision 0082): nothing in a tick is repeated until something is small enough. What the
program is told besides is which calls no tick of a law and path makes, and how often `crossing` is called in all.
"""

import argparse
import re
import struct
import subprocess
import sys
from pathlib import Path

ENTRY = "worst_tick::entry"
# The cost of a call that no tick makes: no longest way goes there.
NEVER = -(10**12)


class Code:
    """A program taken apart: functions by name, each its instructions as (address, mnemonic, operand)."""

    def __init__(self, program):
        listing = run("objdump", "-d", "--no-show-raw-insn", "--demangle", program)
        self.functions, self.names, self.taken = {}, {}, set()
        for line in listing.splitlines():
            if head := re.match(r"([0-9a-f]+) <(.*)>:$", line):
                address = int(head[1], 16)
                self.functions[address] = current = []
                self.names[address] = head[2]
            elif found := re.match(r" +([0-9a-f]+):\t(\S+) *(.*)$", line):
                current.append((int(found[1], 16), found[2], found[3]))
                if found[2] == "lea" and (place := re.search(r"# ([0-9a-f]+)", found[3])):
                    self.taken.add(int(place[1], 16))
        self.bytes = Path(program).read_bytes()
        self.sections = []
        for line in run("objdump", "-h", program).splitlines():
            if found := re.match(r" +\d+ \S+ +([0-9a-f]+) +([0-9a-f]+) +\S+ +([0-9a-f]+)", line):
                self.sections.append(tuple(int(part, 16) for part in found.groups()))
        slots = run("objdump", "-R", program)
        self.slots = {int(a, 16): int(b, 16) for a, b in re.findall(r"^([0-9a-f]+) R_X86_64_RELATIVE +\*ABS\*\+0x([0-9a-f]+)", slots, re.M)}

    def word(self, address):
        """Four bytes of a jump table."""
        for size, start, offset in self.sections:
            if start <= address < start + size:
                return struct.unpack_from("<i", self.bytes, offset + address - start)[0]
        raise SystemExit(f"no section at {address:x}")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def target(operand):
    found = re.match(r"([0-9a-f]+) <", operand)
    return int(found[1], 16) if found else None


def table(code, body, index):
    """Where a jump through a table can go: the table's address was taken a few instructions before."""
    low, high = body[0][0], body[-1][0]
    for _, mnemonic, operand in reversed(body[max(0, index - 24) : index]):
        found = re.search(r"# ([0-9a-f]+)", operand)
        if mnemonic == "lea" and found:
            start, places = int(found[1], 16), []
            # It ends where another one begins.
            while (at := start + 4 * len(places)) == start or at not in code.taken:
                if not low <= start + code.word(at) <= high:
                    break
                places.append(start + code.word(at))
            if places:
                return places
    raise SystemExit(f"{body[index][0]:x}: a jump whose table is not found")


def held(code, body, register):
    """The function whose address a register holds: the only one that is ever put there."""
    found = set()
    for _, mnemonic, operand in body:
        source = re.search(r"# ([0-9a-f]+)", operand)
        if source and re.search(re.escape(register) + r"\b", operand.split("#")[0].rsplit(",", 1)[-1]):
            place = int(source[1], 16)
            found.add(code.slots.get(place) if mnemonic == "mov" else place)
    functions = {place for place in found if place in code.functions}
    return functions.pop() if len(functions) == 1 and len(found) == 1 else None


def graph(code, start, kind=None):
    """Of a function: which instruction can follow which, and whom it calls where; its first jump through a table takes one of its ways only."""
    body = code.functions[start]
    places = {address: index for index, (address, _, _) in enumerate(body)}
    follows, calls = {}, {}
    for index, (address, mnemonic, operand) in enumerate(body):
        after = [body[index + 1][0]] if index + 1 < len(body) else []
        slot = re.search(r"\*.*# ([0-9a-f]+)", operand)
        if mnemonic == "call" and (register := re.match(r"\*(%\w+)$", operand)):
            calls[address] = held(code, body, register[1])
        elif mnemonic == "call":
            calls[address] = code.slots.get(int(slot[1], 16)) if slot else target(operand)
        elif mnemonic == "jmp" and slot:
            after, calls[address] = [], code.slots.get(int(slot[1], 16))
        elif mnemonic == "jmp" and "*" in operand:
            after = table(code, body, index)
            if kind is not None:
                after, kind = [after[kind]], None
        elif mnemonic.startswith("j"):
            to = target(operand)
            inside = to in places
            if not inside:
                calls[address] = to
            after = ([to] if inside else []) + (after if mnemonic != "jmp" else [])
        elif mnemonic in ("ret", "ud2", "hlt"):
            after = []
        follows[address] = after
    # What fills up the space before an aligned place is never reached.
    reached, waiting = set(), [start]
    while waiting:
        address = waiting.pop()
        if address not in reached:
            reached.add(address)
            waiting.extend(follows[address])
    return {address: after for address, after in follows.items() if address in reached}, calls


def components(nodes, follows):
    """Sets of instructions that can come back to themselves, and single ones; a set comes after everything that can follow it (Tarjan)."""
    number, lowest, stack, on_stack, found = {}, {}, [], set(), []
    for root in nodes:
        if root in number:
            continue
        work = [(root, iter(follows[root]))]
        number[root] = lowest[root] = len(number)
        stack.append(root)
        on_stack.add(root)
        while work:
            node, rest = work[-1]
            for after in rest:
                if after not in nodes:
                    continue
                if after not in number:
                    number[after] = lowest[after] = len(number)
                    stack.append(after)
                    on_stack.add(after)
                    work.append((after, iter(follows[after])))
                    break
                if after in on_stack:
                    lowest[node] = min(lowest[node], number[after])
            else:
                work.pop()
                if work:
                    above = work[-1][0]
                    lowest[above] = min(lowest[above], lowest[node])
                if lowest[node] == number[node]:
                    group = set()
                    while node not in group:
                        last = stack.pop()
                        on_stack.discard(last)
                        group.add(last)
                    found.append(group)
    return found


class Bound:
    """Longest ways, function by function, of one law on one path; `free` functions cost nothing."""

    def __init__(self, code, law, path, free=()):
        self.code, self.free, self.law = code, free, law
        self.kinds = {ANY_LAW: law, ANY_PATH: path}
        self.known, self.limited = {}, {}

    def of(self, start):
        """The most instructions of a call."""
        if start not in self.known:
            self.known[start] = None
            kind = next((kind for part, kind in self.kinds.items() if part in self.code.names[start]), None)
            follows, calls = graph(self.code, start, kind)
            self.limited = {}
            cost = {address: 1 + self.called(start, calls, address) for address in follows}
            limited = sum(self.limited.values())
            self.known[start] = limited + self.longest(start, set(follows), follows, cost, start, 0)
        if self.known[start] is None:
            raise SystemExit(f"{self.code.names[start]} calls itself")
        return self.known[start]

    def called(self, start, calls, address):
        if address not in calls:
            return 0
        callee = calls[address]
        name = self.code.names.get(callee, "?")
        if any(part in name for part in NEVER_CALLED):
            return NEVER
        if any(part in name for part in self.free):
            return 0
        if callee not in self.code.functions:
            raise SystemExit(f"{self.code.names[start]}, {address:x}: calls what is not known")
        before, own = self.limited, self.of(callee)
        self.limited = before
        for (caller, called), most in CALLS.items():
            if caller in self.code.names[start] and called in name:
                self.limited[called] = most * own
                return 0
        return own

    def longest(self, start, nodes, follows, cost, entry, depth):
        """The most instructions from an entry on, inside a set of them."""
        best = {}
        for group in components(nodes, follows):
            after = [best[n] for node in group for n in follows[node] if n in nodes and n not in group]
            some = min(group)
            if len(group) == 1 and some not in follows[some]:
                own = cost[some]
            else:
                own = self.loop(start, group, nodes, follows, cost, entry, depth)
            for node in group:
                best[node] = own + max(after, default=0)
        return best[entry]

    def loop(self, start, group, nodes, follows, cost, entry, depth):
        """A loop costs its rounds times the longest way round it."""
        heads = {n for node in nodes - group for n in follows[node] if n in group} | ({entry} & group)
        name = self.code.names[start]
        if len(heads) > 1:
            raise SystemExit(f"{name}: the loop at {min(group):x} is entered in {len(heads)} places")
        [head] = heads
        rounds = next((rounds for part, rounds in ROUNDS.items() if part in name), {})
        rounds = rounds.get(self.law, []) if isinstance(rounds, dict) else rounds
        if depth >= len(rounds):
            raise SystemExit(f"{name}: the rounds of the loop at {min(group):x} are not known")
        inner = {node: [n for n in follows[node] if n != head] for node in group}
        return rounds[depth] * self.longest(start, group, inner, cost, head, depth + 1)


# The functions that choose a law and a path, each by its first jump through a table, and the kinds in the order of the tables.
ANY_LAW, ANY_PATH = "law::any::PathLaw", "path::any::AnyPath"
LAWS = ["uncontrolled", "SDOF with gap", "proportional", "velocity ratio", "optimal", "impedance"]
PATHS = ["line", "arc", "polyline of 16", "spline of 16"]
# What no tick calls: nothing panics, and no angle is beyond a turn, where the sine would need its long way.
NEVER_CALLED = ["panic", "rem_pio2_large"]
# How often the body of a loop is entered at most, by the number of loops it stands in: 16 pieces of a path, 6 pairs of neighbouring shares of a
# piece (`path/spline.rs`, `path/roots.rs`); 16 steps (`path/roots.rs`); of optimal control 4 joints with 20 levels each (`law/optimal.rs`); of
# impedance control 3 forces, 4 joints, 3 others (`law/impedance.rs`). A cycle inside the innermost loop is no loop of the source: as often as that.
ROUNDS = {
    ANY_PATH: [16, 6, 6],
    "path::roots::crossing": [16],
    ANY_LAW: {LAWS.index("optimal"): [4, 20], LAWS.index("impedance"): [3, 4, 3, 3]},
}
# Calls that the loops round them would allow more often than they can be: of the derivatives of a polynomial of the fifth degree the fourth
# changes its sign once, the third twice, and so on, and the polynomial five times (`path/roots.rs`).
CALLS = {(ANY_PATH, "path::roots::crossing"): 16 * (1 + 2 + 3 + 4 + 5)}


def counted(table):
    """The greatest counts that `worst_tick.py` printed, by law and path."""
    greatest = {}
    for line in table.read_text().splitlines()[1:]:
        law, path, _, _, most, *_ = (part.strip() for part in line.split("|"))
        kind = path.removeprefix("tangled ")
        greatest[law, kind] = max(int(most), greatest.get((law, kind), 0))
    return greatest


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="the example `worst_tick` of the implementation")
    parser.add_argument("--counted", type=Path, help="the table that `worst_tick.py` printed; a count above its bound is an error")
    choice = parser.parse_args()
    sys.setrecursionlimit(20_000)
    code = Code(choice.program)
    [entry] = [address for address, name in code.names.items() if name == ENTRY]
    [any_law] = [address for address, name in code.names.items() if ANY_LAW in name and name.endswith("::command")]
    greatest = counted(choice.counted) if choice.counted else {}
    print("law | path | bound | greatest count")
    broken = False

    def line(law, path, bound):
        most = greatest.get((law, path))
        print(f"{law} | {path} | {bound} | {'–' if most is None else most}")
        return most is not None and most > bound

    for path, on_path in enumerate(PATHS):
        for law, of_law in enumerate(LAWS):
            around = Bound(code, law, path, free=[ANY_LAW, ANY_PATH]).of(entry)
            broken |= line(of_law, on_path, around + Bound(code, law, path).of(any_law))
        inner = LAWS.index("SDOF with gap")
        broken |= line("obstacle, SDOF inside", on_path, Bound(code, inner, path).of(entry))
    sys.exit("a count is above its bound" if broken else 0)


if __name__ == "__main__":
    main()
