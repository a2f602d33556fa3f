"""This file says how the comparison is printed."""

import work

TITLES = {
    "free": "free motion, no friction, 1.5 s",
    "dry": "dry joints, 1.5 s: the brakes without current",
    "work": "dry joints, 1.5 s, the force holds for 8 ms, steps of every length",
    "locked": "all brakes locked, 11 N on the tip, 5 s",
}
LAYOUTS = {"three": "3-brake layout", "four": "4-brake layout"}


def number(value):
    return "–" if value is None else "0" if value == 0.0 else f"{value:.3g}"


def micro(ns):
    return f"{ns / 1e3:.3f}" if ns < 1e4 else f"{ns / 1e3:.1f}"


def row(cells):
    return "| " + " | ".join(cells) + " |"


def slower(line, lines):
    """How many times longer the fastest of MuJoCo's settings takes whose error, or creep, is no smaller than this line's."""
    measure = "creep_mm_s" if "creep_mm_s" in line else "greatest_mm"
    peers = [peer["median_ns"] for peer in lines if peer["engine"] == "MuJoCo" and peer[measure] >= line[measure]]
    return f"{min(peers) / line['median_ns']:.1f}" if peers and line["engine"] != "MuJoCo" else "–"


def markdown(result):
    machine = result["machine"]
    out = [
        f"{machine['processor']}, {machine['cores']} cores, {machine['mhz']} MHz, one core used; MuJoCo {machine['mujoco']}, "
        f"Pinocchio {machine['pin']}; median of {result['rounds']} rounds taken in turn, least of all; other work on the machine.",
        "",
    ]
    for case in result["cases"]:
        layout, kind = case["name"].split("-")
        locked = kind == "locked"
        out += [f"### {LAYOUTS[layout]}, {TITLES[kind]}", ""]
        if kind == "work":
            out += work.markdown(case)
            continue
        heads = ["engine", "settings", "µs a millisecond, median", "least", "greatest tip error, mm", "at the end, mm", "loop open, m"]
        heads += ["creep, mm/s"] if locked else []
        heads += ["times as fast as MuJoCo at no larger " + ("creep" if locked else "error")]
        out += [row(heads), row(["---"] * len(heads))]
        for line in case["lines"]:
            steps = line["steps_a_tick"]
            settings = line["settings"] + (f", {steps} steps a ms" if steps > 1 else "")
            cells = [line["engine"], settings, micro(line["median_ns"]), micro(line["least_ns"])]
            cells += [number(line.get("greatest_mm")), number(line.get("end_mm")), number(line.get("opening_m"))]
            cells += [number(line["creep_mm_s"])] if locked else []
            cells += [slower(line, case["lines"])]
            out.append(row(cells))
        out += ["", f"The converged solution and one of half its step are {number(case['converged_apart_mm'])} mm apart.", ""]
        if case["finer"]:
            out += ["At smaller steps the peers come to it:", ""]
            steps = sorted({line["steps_a_tick"] for line in case["finer"]})
            out += [row(["engine", "settings", *(f"1/{n} ms: greatest error, mm" for n in steps)]), row(["---"] * (2 + len(steps)))]
            for engine, settings in dict.fromkeys((line["engine"], line["settings"]) for line in case["finer"]):
                of = [line for line in case["finer"] if (line["engine"], line["settings"]) == (engine, settings)]
                out.append(row([engine, settings, *(number(line["greatest_mm"]) for line in of)]))
            out.append("")
    return "\n".join(out) + "\n"
