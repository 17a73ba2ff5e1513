"""What all peers share: the scenario, the impact law, the truth, and how a run is timed and judged.

A peer calls `main` with a function `prepare(scenario, setting)` that returns a simulator
`run(t, u, v, until, first)`: from displacements u and velocities v at time t it simulates to
`until`, and returns its impacts as (time, gap), only the first one if `first`. Gap k lies between
masses k and k + 1, counted from 1; 0 and n + 1 are the walls.
"""

import json
import sys
import time

CLOSE = 1e-3  # a time that is further off than this is wrong
SEGMENT = 30.0  # no segment of the scenarios lasts longer
ENOUGH = 3.0  # seconds of repetitions
OPEN = 2.0**-52  # width of a gap right after its impact, one rounding: heyoka must see one above zero


def apart(u, gap, d):
    """Opens a gap that is shut but for rounding."""
    if gap == 0:
        u[0] = max(u[0], OPEN - d)
    elif gap == len(u):
        u[gap - 1] = min(u[gap - 1], d - OPEN)
    else:
        u[gap] = max(u[gap], u[gap - 1] - d + OPEN)


def bounce(u, v, gap, scenario):
    """The impact law at a gap, on arrays of displacements and velocities."""
    r = scenario["restitution"]
    if 0 < gap < len(u):
        kick = 0.5 * (1.0 + r) * (v[gap - 1] - v[gap])
        v[gap - 1] -= kick
        v[gap] += kick
    else:
        wall = min(gap, len(u) - 1)
        v[wall] = -r * v[wall]
    apart(u, gap, scenario["spacing"])


def judge(impacts, reference):
    """Impacts compared, and number and time of the first wrong one."""
    true = reference["impacts"]
    for number, (time_, gap) in enumerate(true, 1):
        own = impacts[number - 1] if number <= len(impacts) else None
        if own is None or own[1] != gap or not abs(own[0] - time_) <= CLOSE:
            return len(true), number, time_
    return len(true), None, None


def timed(run):
    """Result and the best wall time of all calls that begin within ENOUGH."""
    best, spent = float("inf"), 0.0
    while spent <= ENOUGH:
        began = time.perf_counter()
        result = run()
        took = time.perf_counter() - began
        best, spent = min(best, took), spent + took
    return result, best


def misses(run, reference, d):
    """How many segments end without their true impact."""
    missed = 0
    for segment in reference["segments"]:
        for gap in range(len(segment["u"]) + 1):
            apart(segment["u"], gap, d)
        until = min(segment["t"] + SEGMENT, segment["next_t"] + 1.0)
        try:
            found = run(segment["t"], segment["u"], segment["v"], until, True)
        except Exception:
            found = []
        right = found and found[0][1] == segment["next_gap"]
        missed += not (right and abs(found[0][0] - segment["next_t"]) <= CLOSE)
    return missed


def main(name, version, settings, prepare, note="", segments=True):
    """Runs all settings on the scenario of the command line, prints a row of JSON for each."""
    with open(sys.argv[1]) as file:
        scenario = json.load(file)
    with open(sys.argv[2]) as file:
        reference = json.load(file)
    until = float(sys.argv[3])
    n = len(scenario["forcing"])
    rest = [0.0] * n
    for setting in settings:
        run = prepare(scenario, setting)
        run(0.0, rest, rest, min(until, 1.0), False)  # compiles and warms up
        impacts, seconds = timed(lambda run=run: run(0.0, rest, rest, until, False))
        compared, number, when = judge(impacts, reference)
        row = {
            "what": "peer",
            "name": name,
            "version": version,
            "settings": setting_text(setting),
            "n": n,
            "until": until,
            "impacts": len(impacts),
            "microseconds_per_impact": seconds / len(impacts) * 1e6 if impacts else None,
            "seconds": seconds,
            "compared": compared,
            "horizon_impact": number,
            "horizon_time": when,
            "note": note,
        }
        if segments:
            row["segments"] = len(reference["segments"])
            row["segment_misses"] = misses(run, reference, scenario["spacing"])
        print(json.dumps(row), flush=True)


def setting_text(setting):
    """{"tol": 1e-10} as "tol=1e-10"."""
    return " ".join(f"{key}={value:g}" for key, value in setting.items())
