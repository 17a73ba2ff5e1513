"""SciPy: Runge–Kutta of order 8 (DOP853), an event at a change of sign of the narrowest gap."""

import common
import numpy as np
import scipy
from scipy.integrate import solve_ivp


def prepare(scenario, setting):
    alpha, beta = np.array(scenario["forcing"]).T
    n, d = len(alpha), scenario["spacing"]
    w2, big_w = scenario["natural_frequency"] ** 2, scenario["forcing_frequency"]
    ends = np.empty(n + 2)
    ends[0], ends[-1] = 0.0, 0.0

    def motion(t, y):
        push = alpha * np.cos(big_w * t) + beta * np.sin(big_w * t)
        return np.concatenate((y[n:], push - w2 * y[:n]))

    def widths(y):
        ends[1:-1] = y[:n]
        return d + np.diff(ends)

    # One function of the narrowest gap costs less than one function for each gap.
    def narrowest(t, y):
        return widths(y).min()

    narrowest.terminal, narrowest.direction = True, -1

    def run(t, u, v, until, first):
        impacts, y = [], np.concatenate((u, v))
        while t < until:
            result = solve_ivp(
                motion, (t, until), y, "DOP853", events=narrowest,
                rtol=setting["tol"], atol=setting["tol"] / 1e3,
            )  # fmt: skip
            if result.status != 1:
                break
            t, y = result.t_events[0][0], result.y_events[0][0]
            gap = int(widths(y).argmin())
            impacts.append((t, gap))
            if first:
                break
            common.bounce(y[:n], y[n:], gap, scenario)
        return impacts

    return run


NOTE = "right-hand side and event in Python"

if __name__ == "__main__":
    settings = [{"tol": 1e-6}, {"tol": 1e-10}, {"tol": 1e-13}]
    common.main("SciPy DOP853", scipy.__version__, settings, prepare, NOTE)
