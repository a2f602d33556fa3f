"""Every source of hidden causes judged by what the others taught: are probabilities as true where nothing was learnt?

A statement is a cause that a report names or suspects. It is right where the cause is hidden at its place, is physics that makes the same, or goes
with a hidden one. For each source three sets of probabilities are scored by Brier's rule: as the program says them; one number for all, the share of
right statements of the other sources; and the program's, bent by a line in log odds that is fitted to the other sources (Platt). A bend that helps
the source that is left out says that the program's own are not calibrated.

    python sources.py rigproof OUT --blind axis:40000..40050 rig:34100..34120 --keys hinges=FOLDER arms=FOLDER

--blind makes recordings of a plant in other forms; a folder of --keys holds NAME.csv, NAME.toml and key/NAME.json, as the sources beside this file
write them. OUT gets the reports and statements.json.
"""
import argparse
import concurrent.futures
import json
import pathlib
import subprocess

import numpy as np

LEAST_SAID, NAMED = 0.5, 0.9
# Precision of a normal prior about no bend: it decides only where statements are few.
WEAK = 0.1


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)


def diagnosed(program, recording, rig, out):
    """The report of a recording; it is made once."""
    report = out / "report.json"
    if not report.exists():
        run(program, "diagnose", recording, "--rig", rig, "--out", out)
    return json.loads(report.read_text()) if report.exists() else {"effects": []}


def statements(report, is_right):
    """Probability and truth of what a report names or suspects."""
    said = [(own["probability"], is_right(own["mechanism"], own.get("joint"))) for own in report["effects"]]
    return [own for own in said if own[0] >= LEAST_SAID]


def of_blind(program, out, plant, seeds):
    """Statements about recordings in other forms, by seed."""
    first, end = (int(own) for own in seeds.split(".."))
    cases = out / f"{plant} cases"
    for folder in (cases, out / plant):
        folder.mkdir(exist_ok=True)

    def one(seed):
        case = cases / str(seed)
        if not (case / "recording.csv").exists():
            run(program, "blind", "make", "--plant", plant, "--forms", "other", "--seed", seed, "--out", case)
        return diagnosed(program, case / "recording.csv", case / "rig.toml", out / plant / str(seed))

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        reports = list(pool.map(one, range(first, end)))
    trial = run(program, "blind", "trial", "--plant", plant, "--forms", "other", "--seeds", seeds, "--reports", out / plant,
                "--details", "--json")
    answers = {own["seed"]: own["answer"]["effects"] for own in json.loads(trial.stdout)["cases"]}

    def judge(seed):
        def is_right(mechanism, joint):
            def allows(own):
                here = own.get("joint") in (None, joint) or joint is None
                return f"{mechanism} at {joint}" in sum(own.get("equivalent", []), []) or \
                    here and mechanism in own.get("right", []) + own.get("companions", [])
            return any(allows(own) for own in answers[seed])
        return is_right

    return [statements(report, judge(seed)) for seed, report in zip(range(first, end), reports) if seed in answers]


def of_keys(program, out, name, folder):
    """Statements about recordings with a key beside them."""
    (out / name).mkdir(exist_ok=True)

    def one(path):
        key = json.loads(path.read_text())
        report = diagnosed(program, folder / f"{path.stem}.csv", folder / f"{path.stem}.toml", out / name / path.stem)
        if isinstance(key["effects"], list):
            allowed = {tuple(own) for effect in key["effects"] for own in effect["right"]}
            return statements(report, lambda mechanism, joint: (mechanism, joint) in allowed)
        allowed = {own for kind in key["effects"] for own in key["right"][kind] + key["companions"].get(kind, [])}
        return statements(report, lambda mechanism, _: mechanism in allowed)

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return list(pool.map(one, sorted((folder / "key").glob("*.json"))))


def log_odds(said):
    said = np.clip(said, 1e-4, 1 - 1e-4)
    return np.log(said / (1 - said))


def bent(said, right, other):
    """Probabilities `other` by the line in log odds that fits said and right best (Platt 1999), both outcomes counted once more."""
    x = np.column_stack([np.ones_like(said), log_odds(said)])
    target = np.where(right, (right.sum() + 1) / (right.sum() + 2), 1 / ((~right).sum() + 2))

    def cost(line):
        return np.sum(np.logaddexp(0, x @ line) - target * (x @ line)) + 0.5 * WEAK * np.sum((line - [0, 1]) ** 2)

    line = np.array([0.0, 1.0])
    for _ in range(100):
        now = 1 / (1 + np.exp(-x @ line))
        slope = x.T @ (target - now) - WEAK * (line - [0, 1])
        step = np.linalg.solve(x.T @ ((now * (1 - now))[:, None] * x) + WEAK * np.eye(2), slope)
        while cost(line + step) > cost(line) and np.abs(step).max() > 1e-9:
            step /= 2
        line = line + step
    return 1 / (1 + np.exp(-(line[0] + line[1] * log_odds(other)))), line


def brier(said, right):
    return float(np.mean((said - right) ** 2))


def table(sources):
    rows = ["| left out | recordings | named and right | suspected and right | Brier, as said | one share for all | bent by the others | the line |",
            "|---|---|---|---|---|---|---|---|"]
    pairs = {name: np.array(sum(own, []), dtype=float).reshape(-1, 2) for name, own in sources.items()}
    for name, own in pairs.items():
        others = np.concatenate([pairs[other] for other in pairs if other != name])
        said, right = own[:, 0], own[:, 1] > 0.5
        by_others, line = bent(others[:, 0], others[:, 1] > 0.5, said)
        named = said >= NAMED
        rows.append(
            f"| {name} | {len(sources[name])} | {right[named].sum()} of {named.sum()} | {right[~named].sum()} of {(~named).sum()} "
            f"| {brier(said, right):.3f} | {brier(others[:, 1].mean(), right):.3f} | {brier(by_others, right):.3f} "
            f"| {line[0]:+.2f} {line[1]:+.2f} x |")
    return "\n".join(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--blind", nargs="*", default=[], help="plant:FIRST..END")
    parser.add_argument("--keys", nargs="*", default=[], help="name=FOLDER")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    sources = {}
    for own in args.blind:
        plant, seeds = own.split(":")
        sources[plant] = of_blind(args.program, args.out, plant, seeds)
    for own in args.keys:
        name, folder = own.split("=")
        sources[name] = of_keys(args.program, args.out, name, pathlib.Path(folder))
    (args.out / "statements.json").write_text(json.dumps(sources) + "\n")
    print(table(sources))


if __name__ == "__main__":
    main()
