"""SciPy: solve_ivp with DOP853 and a terminal event for each gap."""

import sys

import common
import located
import numpy as np
import scipy
from scipy.integrate import solve_ivp

NAME, VERSION = "SciPy", scipy.__version__
SETTINGS = [
    ("DOP853, tol=1e-12", (1e-12, 0.0)),
    ("DOP853, tol=1e-12, stop=5e-7", (1e-12, 5e-7)),
]


def simulate(case, value, hit):
    tol, stop = value
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

        events = [event(gap) for gap in range(n + 1)]
        y = np.concatenate((x, v))
        found = solve_ivp(motion, (t, case.until), y, "DOP853", events=events, rtol=tol, atol=tol / 1e3)
        if found.status < 0:
            raise common.Warned(found.message)
        for gap, times in enumerate(found.t_events):
            if len(times):
                y = found.y_events[gap][0]
                return times[0], y[:n], y[n:], gap
        return found.t[-1], found.y[:n, -1], found.y[n:, -1], None

    located.simulate(case, stop, advance, hit)


if __name__ == "__main__":
    common.main(sys.modules[__name__])
