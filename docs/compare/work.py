"""This file says what an error costs: of each engine the cheapest of all its settings and steps, at several levels of error."""

import math

# Levels besides MuJoCo's own errors at 1 ms, mm.
LEVELS_MM = [1.0, 0.1, 0.01]
OURS = "fixed step"


def row(cells):
    return "| " + " | ".join(cells) + " |"


def step(line, tick_ms):
    steps_a_ms = line["steps_a_tick"] / tick_ms
    return f"{1.0 / steps_a_ms:g} ms" if steps_a_ms <= 1.0 else f"1/{steps_a_ms:g} ms"


def cheapest(lines, engine, level_mm):
    """The line of an engine with the least time among those whose error is no larger; none if there is none."""
    close = [line for line in lines if line["engine"] == engine and line["greatest_mm"] <= level_mm]
    return min(close, key=lambda line: line["median_ns"], default=None)


def levels(case):
    """Names of levels of error and the levels, mm: MuJoCo's own at 1 ms first."""
    own = {
        f"MuJoCo's at 1 ms, {line['settings']}": line["greatest_mm"]
        for line in case["lines"]
        if line["engine"] == "MuJoCo" and line["steps_a_tick"] == case["tick_ms"] and math.isfinite(line["greatest_mm"])
    }
    return {**own, **{f"{level:g} mm": level for level in LEVELS_MM}}


def told(line, tick_ms):
    if line is None:
        return "none"
    return f"{line['settings']}, {step(line, tick_ms)}: {line['median_ns'] / 1e3:.3g} µs, {line['greatest_mm']:.2g} mm"


def markdown(case):
    lines, tick_ms = case["lines"], case["tick_ms"]
    out = ["Every setting and step: greatest error of the tip, mm, and µs for 1 ms of motion (median).", ""]
    counts = sorted({line["steps_a_tick"] for line in lines})
    names = {line["steps_a_tick"]: step(line, tick_ms) for line in lines}
    out += [row(["engine", *(names[count] for count in counts)]), row(["---"] * (1 + len(counts)))]
    for engine, settings in dict.fromkeys((line["engine"], line["settings"]) for line in lines):
        of = {line["steps_a_tick"]: line for line in lines if (line["engine"], line["settings"]) == (engine, settings)}
        cells = [f"{of[n]['greatest_mm']:.2g}; {of[n]['median_ns'] / 1e3:.3g}" if n in of else "" for n in counts]
        out.append(row([f"{engine}: {settings}", *cells]))
    out += ["", "The cheapest for an error no larger than a level:", ""]
    out += [row(["level, mm", "MuJoCo", "fixed step", "times as fast"]), row(["---"] * 4)]
    for name, level_mm in levels(case).items():
        theirs, ours = (cheapest(lines, engine, level_mm) for engine in ("MuJoCo", OURS))
        ratio = f"{theirs['median_ns'] / ours['median_ns']:.1f}" if theirs and ours else "–"
        out.append(row([f"{level_mm:.3g} ({name})", told(theirs, tick_ms), told(ours, tick_ms), ratio]))
    out += ["", f"The converged solution and one of half its step are {case['converged_apart_mm']:.2g} mm apart.", ""]
    return out
