"""What all programs share on the scenes of `scenes/scenes.json`: the reader, the rules of
`scenes/README.md`, the impact law, and the bound on work.

A program has a file here with `NAME`, `VERSION`, `SETTINGS` (pairs of words and a value) and
`simulate(case, value, hit)`, which reports each impact by `hit(time, gap, closing speed)`; and, if the
program goes on after it has printed that it may not see an event, `DOUBT`, a part of that message.
"""

import json
import os
import resource
import signal
import sys
import tempfile
from pathlib import Path

import numpy as np

FILE = Path(__file__).resolve().parents[3] / "scenes" / "scenes.json"
SECONDS = 10  # processor time of a case; what passes it gave up
TIE = 1e-9  # impacts this near in time may come in any order
LAWFUL = 0.02  # how far off the velocities of a `law` may be
SHUT = 1e-12  # a gap as narrow as this at the start is shut


class Enough(Exception):
    """The outcome is known."""


class Refused(Exception):
    """The program says beforehand that it does not support the case."""


class Warned(Exception):
    """The program reports an error in the run."""


class Case:
    """A case with its numbers as arrays. Mass j of n stands at x[j - 1]; gap k is the one behind mass k."""

    def __init__(self, case):
        scenario, start = case["scenario"], case["start"]
        self.d = scenario.get("spacing", 1.0)
        self.w2 = scenario.get("natural_frequency", 1.0) ** 2
        self.r = scenario.get("restitution", 0.8)
        single = scenario.get("forcing_frequency", 2.0**0.5)
        self.frequencies = np.array(scenario.get("forcing_frequencies", [single]))
        forcing = scenario["forcing"]
        forcing = np.array(forcing if "forcing_frequencies" in scenario else [forcing])
        # A row for each frequency, a column for each mass.
        self.alpha, self.beta = forcing[:, :, 0], forcing[:, :, 1]
        self.n = forcing.shape[1]
        self.places = self.d * np.arange(1, self.n + 1)
        self.time, self.until = start["time"], case["until"]
        self.x, self.v = np.array(start["positions"]), np.array(start["velocities"])
        self.expected = case["expected"]

    def force(self, t, x):
        """The forces on the masses, springs included."""
        phase = self.frequencies * t
        drive = np.cos(phase) @ self.alpha + np.sin(phase) @ self.beta
        return drive - self.w2 * (x - self.places)

    def gaps(self, x):
        """The widths of all gaps."""
        return np.diff(x, prepend=0.0, append=self.d * (self.n + 1))

    @staticmethod
    def opening(v):
        """The rates at which the gaps open."""
        return np.diff(v, prepend=0.0, append=0.0)

    def bounce(self, v, gap):
        """The impact law at a gap."""
        if 0 < gap < self.n:
            kick = 0.5 * (1.0 + self.r) * (v[gap - 1] - v[gap])
            v[gap - 1] -= kick
            v[gap] += kick
        else:
            v[min(gap, self.n - 1)] *= -self.r


def counts(expected, time, gap, speed):
    """Whether an impact counts."""
    kind = expected["kind"]
    if kind == "impacts":
        among = expected.get("among") or [gap]
        return speed > expected.get("faster", -1.0) and gap in among
    if kind == "rest":
        return time >= expected["since"] and speed > expected["slower"]
    return True


def enough(expected):
    """The number of impacts that decide the outcome."""
    kind = expected["kind"]
    if kind == "impacts":
        return len(expected["impacts"]) + expected.get("only", False)
    return {"speed": expected.get("impacts"), "rest": 1, "law": float("inf")}[kind]


def in_order(expected, within, seen):
    """Compares impacts one after the other; those of one instant may come in any order."""
    seen, first = list(seen), 0
    while first < len(expected):
        last = first + 1
        while last < len(expected) and expected[last][0] - expected[last - 1][0] <= TIE:
            last += 1
        gaps = [gap for _, gap in expected[first:last]]
        seen[first:last] = sorted(seen[first:last], key=lambda hit: gaps.index(hit[1]) if hit[1] in gaps else -1)
        first = last
    for (time, gap), hit in zip(expected, [*seen, *[None] * len(expected)]):
        if hit is None:
            return "missed"
        if hit[1] != gap:
            return "ghost" if hit[0] - time < -within else "missed"
        if not abs(hit[0] - time) <= within:
            return "late"
    return "ghost" if len(seen) > len(expected) else "right"


def lawful(before, seen):
    """Judges the first impacts of three masses with the walls by their velocities before they met."""
    first = {gap: speed for _, gap, speed in reversed(seen)}
    if 0 not in first or len(before) not in first:
        return "missed"
    left, right = -first[0], first[len(before)]
    middle = sum(before) - left - right
    grows = left**2 + middle**2 + right**2 > sum(v**2 for v in before) + LAWFUL
    apart = left <= middle + LAWFUL and middle <= right + LAWFUL
    return "right" if apart and not grows else "wrong_speed"


def judge(case, seen):
    expected = case.expected
    kind = expected["kind"]
    if kind == "impacts":
        return in_order(expected["impacts"], expected["within"], seen)
    if kind == "speed":
        if len(seen) < expected["impacts"]:
            return "missed"
        off = [abs(speed / expected["speed"] - 1.0) for _, _, speed in seen]
        return "right" if max(off) <= expected["within"] else "wrong_speed"
    if kind == "rest":
        return "wrong_rest" if seen else "right"
    return lawful(list(case.v), seen)


def outcome(program, case, value):
    """The outcome of a case; it ends as soon as the outcome is known."""
    seen, most = [], enough(case.expected)

    def hit(time, gap, speed):
        if time <= case.until and counts(case.expected, time, gap, speed):
            seen.append((time, gap, speed))
            if len(seen) >= most:
                raise Enough

    try:
        program.simulate(case, value, hit)
    except Enough:
        pass
    except Refused:
        return "refused"
    except Warned:
        found = judge(case, seen)
        return found if found == "right" else "warned"
    return judge(case, seen)


def main(program):
    """Prints a row of JSON for each setting and case, each run in a process of its own."""
    wanted = sys.argv[1:]
    for words, value in program.SETTINGS:
        for scene in json.loads(FILE.read_text()):
            if wanted and scene["id"] not in wanted:
                continue
            for number, case in enumerate(scene["cases"]):
                if hasattr(program, "prepare"):
                    program.prepare(Case(case))
                found, said = alone(lambda case=case, value=value: outcome(program, Case(case), value))
                if found not in ["right", "gave_up"] and getattr(program, "DOUBT", "\0") in said:
                    found = "warned"
                row = {"what": "scene", "name": program.NAME, "version": program.VERSION, "settings": words,
                       "scene": scene["id"], "case": number, "outcome": found}  # fmt: skip
                print(json.dumps(row), flush=True)


def alone(run):
    """The result of a function in a child, or `gave_up` after SECONDS of processor time; and what it
    printed."""
    read, write = os.pipe()
    printed = tempfile.TemporaryFile(mode="w+", errors="replace")
    child = os.fork()
    if child == 0:
        try:
            os.close(read)
            os.dup2(printed.fileno(), 1)
            os.dup2(printed.fileno(), 2)
            soft = int(resource.getrusage(resource.RUSAGE_SELF).ru_utime) + SECONDS
            resource.setrlimit(resource.RLIMIT_CPU, (soft, soft + 1))
            os.write(write, run().encode())
            os._exit(0)
        except BaseException as error:
            print(repr(error)[:300], file=sys.stderr)
            os._exit(1)
    os.close(write)
    with os.fdopen(read) as pipe:
        found = pipe.read()
    _, status = os.waitpid(child, 0)
    printed.seek(0)
    said = printed.read()
    sys.stderr.write(said)
    if found:
        return found, said
    late = os.WIFSIGNALED(status) and os.WTERMSIG(status) in (signal.SIGXCPU, signal.SIGKILL)
    return "gave_up" if late else "warned", said
