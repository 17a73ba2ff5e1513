"""What all programs share on the scenes of `scenes/scenes.json`: they are commands for
`scenes/judge.py`, which gives each of them a case and judges what it prints.

A program has a file here with `NAME`, `VERSION`, `SETTINGS` (pairs of words and a value) and
`simulate(case, value, hit)`, which reports each impact by `hit(time, gap, closing speed)`; and, if the
program goes on after it has printed that it may not see an event, `DOUBT`, a part of that message.
Without an argument it says what it is; with the words of a setting it runs a case.
"""

import json
import os
import sys
import tempfile

import numpy as np


class Refused(Exception):
    """The program says beforehand that it does not support the case."""


class GaveUp(Exception):
    """The run has passed a bound on work."""


class Warned(Exception):
    """The program reports an error in the run."""


class Case:
    """A case with its numbers as arrays. Mass j of n stands at x[j - 1]; gap k is the one behind mass k."""

    def __init__(self, case):
        scenario, start = case["scenario"], case["start"]
        self.d, self.r = scenario["spacing"], scenario["restitution"]
        self.w2 = scenario["natural_frequency"] ** 2
        self.frequencies = np.array(scenario["forcing_frequencies"])
        forcing = np.array(scenario["forcing"])
        # A row for each frequency, a column for each mass.
        self.alpha, self.beta = forcing[:, :, 0], forcing[:, :, 1]
        self.n = forcing.shape[1]
        self.places = self.d * np.arange(1, self.n + 1)
        self.time, self.until = start["time"], case["until"]
        self.x, self.v = np.array(start["positions"]), np.array(start["velocities"])

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


def main(program):
    """Says what the program is, or runs it on the case that comes from standard input."""
    settings = dict(program.SETTINGS)
    if len(sys.argv) == 1:
        print(json.dumps({"name": program.NAME, "version": program.VERSION, "settings": list(settings)}))
        return
    if sys.argv[1] not in settings:
        sys.exit(f"there is no setting {sys.argv[1]!r}; choose of: {'; '.join(settings)}")
    # What libraries print is no result.
    results = os.fdopen(os.dup(1), "w")
    printed = tempfile.TemporaryFile(buffering=0)
    errors = os.dup(2)
    os.dup2(printed.fileno(), 1)
    os.dup2(printed.fileno(), 2)

    def say(*words):
        print(*words, file=results, flush=True)

    def messages():
        """Passes on what was printed, and says so if it is a doubt."""
        printed.seek(0)
        text = printed.read()
        printed.seek(0)
        printed.truncate()
        os.write(errors, text)
        if getattr(program, "DOUBT", "\0").encode() in text:
            say("warned", program.DOUBT)

    def hit(time, gap, speed):
        if os.fstat(printed.fileno()).st_size:
            messages()
        say(repr(float(time)), int(gap), repr(float(speed)))

    try:
        program.simulate(Case(json.load(sys.stdin)), settings[sys.argv[1]], hit)
    except Refused as why:
        say("refused", why)
    except GaveUp as why:
        say("gave_up", why)
    except Warned as why:
        say("warned", why)
        sys.exit(1)
    finally:
        sys.stdout.flush()
        os.dup2(errors, 2)
        messages()
