"""SUNDIALS CVODE through scikit-sundae: Adams multistep, events at changes of sign."""

import common
import numpy as np
import sksundae
from sksundae.cvode import CVODE


def prepare(scenario, setting):
    alpha, beta = np.array(scenario["forcing"]).T
    n, d = len(alpha), scenario["spacing"]
    w2, big_w = scenario["natural_frequency"] ** 2, scenario["forcing_frequency"]

    # Displacement and velocity of each mass side by side: the Jacobian is then a narrow band.
    def motion(t, y, rate):
        rate[::2] = y[1::2]
        rate[1::2] = alpha * np.cos(big_w * t) + beta * np.sin(big_w * t) - w2 * y[::2]

    def widths(t, y, events):
        u = y[::2]
        events[0], events[n] = d + u[0], d - u[-1]
        np.subtract(u[1:], u[:-1], out=events[1:n])
        events[1:n] += d

    widths.terminal, widths.direction = [True] * (n + 1), [-1] * (n + 1)
    solver = CVODE(
        motion, method="Adams", linsolver="band", lband=1, uband=1, rtol=setting["tol"],
        atol=setting["tol"], eventsfn=widths, num_events=n + 1, max_num_steps=100_000,
    )  # fmt: skip

    def run(t, u, v, until, first):
        impacts, y = [], np.empty(2 * n)
        y[::2], y[1::2] = u, v
        while t < until:
            solver.init_step(t, y)
            result = solver.step(until)
            if not result.success:
                raise RuntimeError(result.message)
            if result.status != EVENT:
                break
            t, y = result.t, np.array(result.y)
            gap = int(np.flatnonzero(result.i_events[-1])[0])
            impacts.append((t, gap))
            if first:
                break
            common.bounce(y[::2], y[1::2], gap, scenario)
        return impacts

    return run


EVENT = 2
NOTE = "right-hand side and events in Python"

if __name__ == "__main__":
    version = f"{sksundae.SUNDIALS_VERSION}, scikit-sundae {sksundae.__version__}"
    settings = [{"tol": 1e-6}, {"tol": 1e-10}, {"tol": 1e-12}]
    common.main("SUNDIALS CVODE", version, settings, prepare, NOTE)
