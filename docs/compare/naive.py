"""This program gives the blind recordings of the five-bar to the naive way, smooth, differentiate and regress, and to PySINDy, has rigproof
open the seals and score the names, and prints what came of it as Markdown."""

import argparse
import json
import os
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from importlib import metadata
from pathlib import Path

sys.dont_write_bytecode = True
for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(threads, "1")

import numpy as np

import rig_columns
import rig_recording
import rig_select

# A recording of which more than this stays unexplained, N·m, and in which nothing is named, is said to be outside the library.
UNEXPLAINED_NM = 0.05


def answer(names, left_nm):
    effects = [{"mechanism": mechanism, "joint": joint} for mechanism, joint in names]
    quiet = "none_of_library" if left_nm > UNEXPLAINED_NM else "consistent"
    return {"verdict": "explained" if effects else quiet, "effects": effects}


def one(program, out, seed, window_s, forms):
    """The scores of a seed's recording, (way, setting) → score, and the root mean square of what the nominal model lacks, N·m."""
    folder = out / str(seed)
    if not (folder / "answer.sealed").exists():
        run(program, "blind", "make", "--plant", "rig", "--seed", str(seed), "--forms", forms, "--out", str(folder))
    recording = rig_recording.read(folder)
    problem = None if recording.fault else rig_columns.problem(recording, window_s)
    if problem is not None and problem.pushed_nm @ (problem.pushed_nm - problem.lacking_nm) < 0:
        # The nominal model needs the opposite of the force that was recorded.
        recording.fault, problem = "a force with its sign swapped", None
    if problem is None:
        report = {"verdict": "data_fault" if recording.fault else "not_excited", "effects": []}
        return {None: scored(program, folder, report)}, None
    scores, known = {}, {}
    for way, (names, left_nm) in rig_select.ways(problem).items():
        report = answer(names, left_nm)
        text = json.dumps(report)
        if text not in known:
            known[text] = scored(program, folder, report)
        scores[way] = known[text]
    return scores, float(np.sqrt(np.mean(problem.lacking_nm**2)))


def scored(program, folder, report):
    """The score as `blind score` has it; it alone opens the seal."""
    path = folder / "peer.json"
    path.write_text(json.dumps(report))
    said = json.loads(run(program, "blind", "score", "--json", str(folder / "answer.sealed"), str(path)))
    # Of other forms the names are judged: right, incomplete, a false name, silent or unseen.
    return said["score"] if "score" in said else said["judgement"]


def run(program, *words):
    done = subprocess.run([program, *words], check=True, capture_output=True, text=True)
    return done.stdout


def is_right(score):
    """What the trial does not call a miss."""
    if "outcome" in score:
        return score["outcome"] == "right"
    quiet = not score["named"]
    right = score["flagged"] and quiet if score["stratum"] == "not_in_library" else score["exact"]
    return right and not score["false_names"]


# Heading, which strata, what is counted.
COLUMNS = [
    ("false name where nothing is hidden", ("nothing",), lambda s: bool(s["false_names"])),
    ("single: mechanism and joint", ("single",), lambda s: s["exact"]),
    ("single: mechanism", ("single",), lambda s: s["mechanism_exact"]),
    ("several at once, all", ("masked",), lambda s: s["exact"]),
    ("late, noisy, in a loop, wrong inertia", ("late_onset", "noisy", "in_loop", "wrong_inertia"), lambda s: s["exact"]),
    ("true names among those given", ("single", "masked", "late_onset", "noisy", "in_loop", "wrong_inertia"), lambda s: s["inside"]),
    ("outside the library: flagged, not named", ("not_in_library",), lambda s: s["flagged"] and not s["named"]),
    ("fault of the data: said", ("data_fault",), lambda s: s["exact"]),
    ("a false name, of all", None, lambda s: bool(s["false_names"])),
    ("right, of all", None, is_right),
]


def judged(outcome):
    return lambda score: score["outcome"] == outcome


# The same for physics in other forms.
JUDGED = [
    ("false name where nothing is hidden", ("nothing",), judged("false_name")),
    ("single: right", ("single",), is_right),
    ("two or three: right", ("two", "three"), is_right),
    ("late: right", ("late_onset",), is_right),
    ("outside the library: flagged, not named", ("not_in_library",), is_right),
    ("incomplete, of all", None, judged("incomplete")),
    ("silent, of all", None, judged("silent")),
    ("a false name, of all", None, judged("false_name")),
    ("right, of all", None, is_right),
]


def columns(scores):
    return JUDGED if "outcome" in scores[0] else COLUMNS


def false_names(score):
    if "outcome" in score:
        return sum(not fine for _, _, fine in score["names"])
    return len(score["false_names"])


def line(title, scores):
    cells = []
    for _, strata, counts in columns(scores):
        about = [s for s in scores if strata is None or s["stratum"] in strata]
        cells.append(f"{sum(map(counts, about))} of {len(about)}")
    each = np.mean([false_names(score) for score in scores])
    return "| " + " | ".join([title, *cells, f"{each:.2f}"]) + " |"


# The settings that were right most often on seeds 1000 to 1100, for a table of other seeds.
CHOSEN = {
    "stepwise BIC": "penalty × 192",
    "PySINDy STLSQ": "threshold 0.013 N·m, ridge 0.001",
    "PySINDy SR3": "threshold 0.013 N·m, ν 100",
}


def table(by_way, ours):
    heads = ["way", *(words for words, _, _ in columns(next(iter(by_way.values())))), "false names a recording"]
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    for way in dict.fromkeys(way for way, _ in by_way):
        settings = {setting: scores for (name, setting), scores in by_way.items() if name == way}
        count = lambda setting: sum(map(is_right, settings[setting]))
        best = max(settings, key=count)
        if way == "stepwise BIC":
            lines.append(line(f"{way}, as it is", settings["penalty × 1"]))
        if CHOSEN.get(way, best) != best:
            lines.append(line(f"{way}, as chosen on seeds 1000 to 1100: {CHOSEN[way]}", settings[CHOSEN[way]]))
        lines.append(line(f"{way}, in hindsight: {best}", settings[best]))
    if ours:
        lines.append(line("`rigproof diagnose`", ours))
    return "\n".join(lines)


def told(seed, case):
    """What every way named, a line a way."""
    lines = []
    for way, score in case.items():
        words = ", ".join(way) if way else "refused"
        named = score["named"] if "named" in score else [name for name, _, _ in score["names"]]
        names = ", ".join(named) or score.get("verdict", "nothing")
        lines.append(f"{seed} {score['stratum']} | {', '.join(score['hidden']) or '-'} | {words} | {names}\n")
    return "".join(lines)


def diagnosed(path, seeds):
    """Scores of `blind trial --plant rig --details --json` of the same seeds."""
    cases = json.loads(path.read_text())["cases"]
    scores = {case["seed"]: case.get("judgement") or case["score"] for case in cases}
    return [scores[seed] for seed in seeds]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="the program `rigproof`")
    parser.add_argument("out", type=Path, help="folder for recordings and scores")
    parser.add_argument("--seeds", default="1000..1101", help="FIRST..END, END not among them")
    parser.add_argument("--forms", choices=("usual", "other"), default="usual", help="forms of what is hidden")
    parser.add_argument("--window-s", type=float, default=0.08, help="length of the Savitzky-Golay window")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--ours", type=Path, help="what `rigproof blind trial --plant rig --details --json` printed for these seeds, with the same --forms")
    choice = parser.parse_args()
    first, end = map(int, choice.seeds.split(".."))
    choice.out.mkdir(parents=True, exist_ok=True)
    seeds = range(first, end)
    with ProcessPoolExecutor(choice.jobs) as pool:
        done = list(pool.map(one, *zip(*((choice.program, choice.out, seed, choice.window_s, choice.forms) for seed in seeds))))
    cases = [case for case, _ in done]
    by_way = {way: [] for case in cases for way in case if way is not None}
    for case in cases:
        for way, scores in by_way.items():
            # A recording that was refused was refused on every way.
            scores.append(case.get(way, case.get(None)))
    versions = ", ".join(f"{name} {metadata.version(name)}" for name in ("pysindy", "numpy", "scipy"))
    print(f"Seeds {first} to {end - 1}; {versions}. Savitzky-Golay of order {rig_columns.ORDER} over {choice.window_s:g} s, passed twice; "
          f"a joint slower than {rig_columns.SLOW_RAD_S} rad/s is left out with a window on either side; a row every {rig_columns.HOP_S:g} s. "
          f"Nothing named and more than {UNEXPLAINED_NM} N·m left: outside the library.\n")
    quiet = [1e3 * lacking_nm for case, lacking_nm in done if next(iter(case.values()))["stratum"] == "nothing" and lacking_nm]
    if quiet:
        print(f"Where nothing is hidden the nominal model lacks {np.median(quiet):.1f} mN·m root mean square in the median recording, "
              f"{max(quiet):.1f} at most ({len(quiet)} recordings).\n")
    ours = diagnosed(choice.ours, seeds) if choice.ours else None
    print(table(by_way, ours))
    (choice.out / "naive.txt").write_text("".join(told(seed, case) for seed, case in zip(seeds, cases)))


if __name__ == "__main__":
    main()
