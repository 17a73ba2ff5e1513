"""SciPy: solve_ivp with DOP853 and a terminal event for each gap.

An event at a change of sign passes over a gap that opens again within a step. With `rates` the least
widths of each gap are events as well, and one below zero shows that the gap shut before.
"""

import sys

import common
import located
import numpy as np
import scipy
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

NAME, VERSION = "SciPy", scipy.__version__
TOL = 1e-12
SETTINGS = [
    ("DOP853, tol=1e-12", (0.0, False)),
    ("DOP853, tol=1e-12, stop=1e-12", (1e-12, False)),
    ("DOP853, tol=1e-12, stop=1e-12, rates", (1e-12, True)),
]


def simulate(case, value, hit):
    stop, rates = value
    n = case.n

    def advance(t, x, v, contact):
        def motion(t, y):
            return np.concatenate((y[n:], contact.P @ case.force(t, y[:n])))

        def event(gap):
            def function(t, y):
                if contact.shut[gap]:
                    return contact.L[gap] @ case.force(t, y[:n])
                return case.gaps(y[:n])[gap]

            function.terminal, function.direction = True, -1
            return function

        def rate(gap):
            def function(t, y):
                return 1.0 if contact.shut[gap] else case.opening(y[n:])[gap]

            function.direction = 1
            return function

        events = [event(gap) for gap in range(n + 1)]
        if rates:
            events += [rate(gap) for gap in range(n + 1)]
        found = solve_ivp(motion, (t, case.until), np.concatenate((x, v)), "DOP853", events=events,
                          rtol=TOL, atol=TOL / 1e3, dense_output=rates)  # fmt: skip
        if found.status < 0:
            raise common.Warned(found.message)
        for time, gap in least(found):
            y = found.sol(time)
            return time, y[:n], y[n:], gap
        for gap, times in enumerate(found.t_events[: n + 1]):
            if len(times):
                y = found.y_events[gap][0]
                return times[0], y[:n], y[n:], gap
        return found.t[-1], found.y[:n, -1], found.y[n:, -1], None

    def least(found):
        """The first gap that shut and opened again within a step, and when it shut; or nothing."""
        dips = [
            (time, gap)
            for gap, times in enumerate(found.t_events[n + 1 :])
            for time, y in zip(times, found.y_events[n + 1 + gap], strict=True)
            if case.gaps(y[:n])[gap] < 0.0
        ]
        for time, gap in sorted(dips):
            before = found.t[np.searchsorted(found.t, time) - 1]
            width = lambda t, gap=gap: case.gaps(found.sol(t)[:n])[gap]  # noqa: E731
            if width(before) > 0.0:
                return [(brentq(width, before, time, xtol=1e-15), gap)]
        return []

    located.simulate(case, stop, advance, hit)


if __name__ == "__main__":
    common.main(sys.modules[__name__])
