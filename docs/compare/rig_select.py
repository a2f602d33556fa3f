"""This module chooses candidates from a regression: stepwise by Bayes's information criterion, or by the sparse optimisers of PySINDy."""

import warnings
from dataclasses import replace

import numpy as np
import pysindy

# More names than these no laboratory would believe; PySINDy's own rules are not bounded.
MOST_NAMES = 12


class Reduced:
    """The regression as a triangle: the same least squares for any choice of columns, in as few rows as there are columns."""

    def __init__(self, problem):
        sizes = [len(columns) for _, _, columns in problem.candidates]
        starts = np.concatenate([[0], np.cumsum(sizes)[:-1]])
        # A candidate: its name and where its columns stand.
        self.groups = [(c[0], c[1], np.arange(s, s + n)) for c, s, n in zip(problem.candidates, starts, sizes)]
        columns = np.stack([column for _, _, columns in problem.candidates for column in columns], axis=-1)
        self.rows = len(problem.lacking_nm)
        # Divided by the root of the number of rows, a column's length is its root mean square.
        both = np.column_stack([columns, problem.lacking_nm]) / np.sqrt(self.rows)
        triangle = np.linalg.qr(both, mode="r")
        self.columns, self.left = triangle[:, :-1], triangle[:, -1]
        lengths = np.linalg.norm(self.columns, axis=0)
        # A candidate that never acts in this recording cannot be named.
        self.acts = lengths > 1e-9
        self.columns = self.columns / np.where(self.acts, lengths, 1.0)

    def unexplained(self, chosen):
        """Mean square that is left after least squares on the columns of these candidates, (N·m)²."""
        if not chosen:
            return float(self.left @ self.left)
        columns = self.columns[:, np.concatenate([self.groups[k][2] for k in chosen])]
        left = self.left - columns @ np.linalg.lstsq(columns, self.left, rcond=1e-10)[0]
        return float(left @ left)

    def named(self, chosen):
        return sorted({self.groups[k][:2] for k in chosen}, key=str)


def stepwise(reduced, penalty):
    """Candidates that enter, and leave again, while n·ln(mean square) + penalty·k·ln(n) falls; one shape a name."""

    def cost(square, chosen):
        count = sum(len(reduced.groups[k][2]) for k in chosen)
        return reduced.rows * np.log(max(square, 1e-18)) + penalty * np.log(reduced.rows) * count

    chosen, square = [], reduced.unexplained([])
    while len(chosen) < MOST_NAMES:
        taken = {reduced.groups[k][:2] for k in chosen}
        others = [(k, square - drop) for k, drop in enumerate(drops(reduced, chosen)) if reduced.groups[k][:2] not in taken]
        enters = min(others, key=lambda other: cost(other[1], [*chosen, other[0]]))[0]
        more = [*chosen, enters]
        if cost(reduced.unexplained(more), more) >= cost(square, chosen):
            break
        chosen, square = more, reduced.unexplained(more)
        for leaves in more[:-1]:
            fewer = [k for k in chosen if k != leaves]
            less = reduced.unexplained(fewer)
            if cost(less, fewer) < cost(square, chosen):
                chosen, square = fewer, less
    return chosen


def drops(reduced, chosen):
    """By how much each candidate would lower the mean square beside those that are chosen."""
    columns, left = reduced.columns, reduced.left
    if chosen:
        basis = np.linalg.qr(columns[:, np.concatenate([reduced.groups[k][2] for k in chosen])])[0]
        columns, left = columns - basis @ (basis.T @ columns), left - basis @ (basis.T @ left)
    lengths = np.linalg.norm(columns, axis=0)
    # What the chosen columns imitate to a part in a million is not looked at.
    unit = np.where(lengths > 1e-6, columns / np.maximum(lengths, 1e-300), 0.0)
    along = unit.T @ left
    out = []
    for _, _, group in reduced.groups:
        if len(group) == 1:
            out.append(float(along[group[0]] ** 2))
            continue
        first, second = group
        between = unit[:, first] @ unit[:, second]
        if abs(between) > 1 - 1e-9:
            out.append(float(along[first] ** 2))
            continue
        a, b = along[first], along[second]
        out.append(float((a * a + b * b - 2 * between * a * b) / (1 - between * between)))
    return out


def sparse(reduced, optimizer):
    """The candidates that an optimiser of PySINDy gives a coefficient other than zero; columns have unit length, so that a coefficient is the
    root mean square of what it contributes, N·m."""
    acts = np.flatnonzero(reduced.acts)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        optimizer.fit(reduced.columns[:, acts], reduced.left[:, None])
    kept = set(acts[np.abs(optimizer.coef_).ravel() > 1e-12].tolist())
    return [k for k, (_, _, group) in enumerate(reduced.groups) if kept & set(group.tolist())]


def without_force_gain(problem):
    """The same regression without the candidate that lets the equation explain itself: sparse optimisers do better so."""
    candidates = [candidate for candidate in problem.candidates if candidate[0] != "force_gain"]
    return replace(problem, candidates=candidates)


PENALTIES = (1, 16, 32, 64, 96, 128, 192, 256, 384, 512, 768, 1024)
THRESHOLDS_NM = tuple(float(f"{x:.2g}") for x in np.geomspace(0.002, 0.2, 11))
# Without some pull towards nothing an optimiser finds the equation itself in the library: force, inertia and every brake's torque, each times one.
RIDGES = (1e-4, 1e-3, 1e-2, 5e-2)
COUPLINGS = (10.0, 100.0, 1000.0)


def ways(problem):
    """Every way with every setting: (way, setting) → (names, root mean square of what is left, N·m)."""
    out = {}

    def tell(way, setting, reduced, chosen):
        out[way, setting] = reduced.named(chosen), float(np.sqrt(reduced.unexplained(chosen)))

    whole, other = Reduced(problem), Reduced(without_force_gain(problem))
    for penalty in PENALTIES:
        tell("stepwise BIC", f"penalty × {penalty}", whole, stepwise(whole, penalty))
    for words, reduced in [("", whole), (", no force gain", other)]:
        for threshold_nm in THRESHOLDS_NM:
            for ridge in RIDGES:
                stlsq = pysindy.STLSQ(threshold=threshold_nm, alpha=ridge)
                setting = f"threshold {threshold_nm:g} N·m, ridge {ridge:g}"
                tell("PySINDy STLSQ" + words, setting, reduced, sparse(reduced, stlsq))
            for coupling in COUPLINGS:
                # Its proximal step cuts at the root of 2·λ·ν.
                strength = 0.5 * threshold_nm**2 / coupling
                sr3 = pysindy.SR3(strength, "L0", coupling, max_iter=100, initial_guess=np.zeros((1, reduced.acts.sum())))
                setting = f"threshold {threshold_nm:g} N·m, ν {coupling:g}"
                tell("PySINDy SR3" + words, setting, reduced, sparse(reduced, sr3))
    return out
