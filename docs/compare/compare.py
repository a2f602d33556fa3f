"""This program runs the five-bar under the same forces with MuJoCo, Pinocchio, the reference model and the fixed-step implementation, and
prints what a step costs beside how far the tip ends up from a converged solution."""

import argparse
import json
import os
import platform
import subprocess
import sys
from importlib import metadata
from pathlib import Path

sys.dont_write_bytecode = True

import numpy as np

import mujoco_peer
import pinocchio_peer
from table import markdown

# Engine, settings, and how to make it for a case. MuJoCo: integrator, solver, no-slip iterations; Pinocchio: scheme, stabilisation.
MUJOCO = [
    ("Euler, default solver", ("Euler", "default", 0)),
    ("Euler, stiff solver", ("Euler", "stiff", 0)),
    ("implicitfast, stiff solver", ("implicitfast", "stiff", 0)),
    ("RK4, default solver", ("RK4", "default", 0)),
    ("RK4, stiff solver", ("RK4", "stiff", 0)),
]
MUJOCO_DRY = [
    ("Euler, default solver, 10 no-slip iterations", ("Euler", "default", 10)),
    ("Euler, stiff solver, 10 no-slip iterations", ("Euler", "stiff", 10)),
]
PINOCCHIO = [
    ("semi-implicit Euler", ("euler", 0.0)),
    ("semi-implicit Euler, stabilised at 100/s", ("euler", 100.0)),
    ("RK4", ("rk4", 0.0)),
]
# Steps a tick at which the peers' motion must come to the reference's.
FINE = [4, 16, 64]
# Steps a tick of 8 ms in the case that asks for work and precision: 8 ms to 1/32 ms, and how often the many small ones are timed in a round.
WORK = [1, 2, 4, 8, 16, 32, 64, 128, 256]
RUNS_OF_SMALL = 2
# Time after which a locked rig has taken up its backlash, s: creep is counted from there.
TAKEN_UP_S = 1.0


def read(path):
    return np.genfromtxt(path, delimiter=",", names=True)


class Case:
    """One case of the Rust program: the rig, the forces, the converged run and our engines."""

    def __init__(self, folder, entry):
        self.entry, self.name = entry, entry["name"]
        self.free, self.locked = self.name.endswith("free"), self.name.endswith("locked")
        run = read(folder / f"{self.name}-converged.csv")
        self.forces_n = np.column_stack([run["force_x_n"], run["force_y_n"]])[:-1]
        self.tips_m = tips(run)
        self.work = self.name.endswith("work")
        self.tick_ms = 1e3 * entry["step_s"]
        self.peers = []

    def line(self, engine, settings, left, right=None):
        """How far a run is from the converged one; peers have no backlash to take up, so that a locked one is judged by its creep."""
        off_mm = 1e3 * np.linalg.norm(left - self.tips_m, axis=1)
        line = {"engine": engine, "settings": settings}
        if right is not None:
            line["opening_m"] = float(np.linalg.norm(left - right, axis=1).max())
        if self.locked:
            from_tick = round(TAKEN_UP_S / self.entry["step_s"])
            time_s = (len(left) - 1 - from_tick) * self.entry["step_s"]
            line["creep_mm_s"] = 1e3 * float(np.linalg.norm(left[-1] - left[from_tick])) / time_s
        if not self.locked or right is None:
            line["greatest_mm"], line["end_mm"] = float(off_mm.max()), float(off_mm[-1])
        return line


def tips(run):
    return np.column_stack([run["tip_x_m"], run["tip_y_m"]])


def our_run(program, folder):
    """Runs the Rust program and returns its index."""
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([program, folder], check=True)
    return json.loads((folder / "runs.json").read_text())


def peers_of(case, program, folder):
    """The peers of a case and the lines they begin."""
    peers = []
    choices = MUJOCO if case.free else MUJOCO + MUJOCO_DRY
    for settings, (integrator, solver, noslip) in choices:
        for steps in WORK if case.work else [1]:
            peer = mujoco_peer.Peer(case.entry, case.forces_n, integrator, solver, steps, noslip)
            peers.append((peer, {**case.line("MuJoCo", settings, *peer.tips_m()), "steps_a_tick": steps}))
    if case.free:
        for settings, (scheme, rate) in PINOCCHIO:
            peer = pinocchio_peer.Peer(program, folder, case.entry, case.forces_n, scheme, 1, rate)
            peers.append((peer, {**case.line("Pinocchio", settings, *peer.tips_m()), "steps_a_tick": 1}))
    return peers


def fine(case, program, folder):
    """How far the peers are from the converged run at smaller steps: they come to it, or they are another mechanism."""
    lines = []
    for steps in FINE:
        peers = [
            ("MuJoCo", "RK4, stiff solver", mujoco_peer.Peer(case.entry, case.forces_n, "RK4", "stiff", steps)),
            ("MuJoCo", "Euler, stiff solver", mujoco_peer.Peer(case.entry, case.forces_n, "Euler", "stiff", steps)),
        ]
        for engine, settings, peer in peers:
            lines.append({**case.line(engine, settings, *peer.tips_m()), "steps_a_tick": steps})
        if case.free:
            for scheme, settings in [("rk4", "RK4"), ("euler", "semi-implicit Euler")]:
                peer = pinocchio_peer.Peer(program, folder, case.entry, case.forces_n, scheme, steps)
                lines.append({**case.line("Pinocchio", settings, *peer.tips_m()), "steps_a_tick": steps})
    return lines


def machine():
    names = [line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
    mhz = [float(line.split(":")[1]) for line in open("/proc/cpuinfo") if line.startswith("cpu MHz")]
    versions = {name: metadata.version(name) for name in ("mujoco", "pin", "numpy")}
    return {"processor": names[0], "cores": len(names), "mhz": round(mhz[0]), "python": platform.python_version(), **versions}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="the Rust example `compare`")
    parser.add_argument("out", type=Path, help="folder for runs and tables")
    parser.add_argument("--rounds", type=int, default=7, help="how often everything is timed, in turn")
    parser.add_argument("--runs", type=int, default=9, help="timed runs of a peer in a round")
    parser.add_argument("--core", type=int, default=1, help="the core everything runs on")
    choice = parser.parse_args()
    os.sched_setaffinity(0, {choice.core})
    index = our_run(choice.program, choice.out / "runs")
    cases = [Case(choice.out / "runs", entry) for entry in index]
    steps = pinocchio_peer.build(choice.out)
    folders = {case.name: choice.out / "peers" / case.name for case in cases}
    for case in cases:
        folders[case.name].mkdir(parents=True, exist_ok=True)
        case.peers = peers_of(case, steps, folders[case.name])
    rounds = [index]
    times = {}
    for turn in range(choice.rounds):
        rounds.append(our_run(choice.program, choice.out / "again"))
        for case in cases:
            for at, (peer, line) in enumerate(case.peers):
                runs = RUNS_OF_SMALL if line["steps_a_tick"] > 16 else choice.runs
                times.setdefault((case.name, at), []).append(peer.steps_ns(runs))
        print(f"round {turn + 1} of {choice.rounds}", file=sys.stderr)
    result = {"machine": machine(), "rounds": choice.rounds, "runs_a_round": choice.runs, "cases": []}
    for at_case, case in enumerate(cases):
        lines = [
            {**line, **cost(times[case.name, at], line["steps_a_tick"] / case.tick_ms)}
            for at, (_, line) in enumerate(case.peers)
        ]
        for at, ours in enumerate(case.entry["engines"]):
            line = case.line(ours["engine"], ours["settings"], tips(read(choice.out / "runs" / ours["run"])))
            each = [[of[at_case]["engines"][at][key] for key in ("median_ns", "least_ns")] for of in rounds]
            lines.append({**line, "steps_a_tick": ours["steps_a_tick"], **cost(each, 1.0 / case.tick_ms)})
        converged_mm = 1e3 * case.entry["converged_apart_m"]
        finer = [] if case.locked or case.work else fine(case, steps, folders[case.name])
        result["cases"].append({
            "name": case.name, "tick_ms": case.tick_ms, "converged_apart_mm": converged_mm, "lines": lines, "finer": finer,
        })
    (choice.out / "compare.json").write_text(json.dumps(result, indent=1) + "\n")
    (choice.out / "compare.md").write_text(markdown(result))
    print(markdown(result))


def cost(each, times):
    """The median of the rounds' medians and the least of all, for 1 ms of motion."""
    median_ns = float(np.median([median for median, _ in each]))
    return {"median_ns": times * median_ns, "least_ns": times * min(least for _, least in each)}


if __name__ == "__main__":
    main()
