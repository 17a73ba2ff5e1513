"""heyoka: Taylor series compiled with LLVM, terminal events by isolation of polynomial roots."""

import common
import heyoka as hy
import numpy as np


def prepare(scenario, setting):
    forcing = scenario["forcing"]
    n, d = len(forcing), scenario["spacing"]
    w, big_w = scenario["natural_frequency"], scenario["forcing_frequency"]
    u = [hy.expression(f"u{j}") for j in range(n)]
    v = [hy.expression(f"v{j}") for j in range(n)]
    cos, sin = hy.cos(big_w * hy.time), hy.sin(big_w * hy.time)
    equations = [(u[j], v[j]) for j in range(n)]
    equations += [
        (v[j], alpha * cos + beta * sin - w * w * u[j]) for j, (alpha, beta) in enumerate(forcing)
    ]
    impacts, stop = [], [False]

    def hit(gap):
        def callback(integrator, sign):
            impacts.append((integrator.time, gap))
            common.bounce(*halves, gap, scenario)
            return not stop[0]

        return callback

    widths = [d + u[0], *(d + u[k] - u[k - 1] for k in range(1, n)), d - u[n - 1]]
    events = [
        hy.t_event(width, callback=hit(gap), direction=hy.event_direction.negative)
        for gap, width in enumerate(widths)
    ]
    tol = {} if setting["tol"] == EPS else {"tol": setting["tol"]}
    # Unrolled code is the fastest, but takes minutes to compile when there are many masses.
    integrator = hy.taylor_adaptive(
        equations, [0.0] * (2 * n), t_events=events, compact_mode=n > 40, **tol
    )

    # Items of a view are read and written faster than those of an array.
    state = memoryview(integrator.state)
    halves = state[:n], state[n:]

    def run(t, u0, v0, until, first):
        impacts.clear()
        stop[0] = first
        integrator.reset_cooldowns()
        integrator.time = t
        integrator.state[:n] = u0
        integrator.state[n:] = v0
        integrator.propagate_until(until)
        return list(impacts)

    return run


EPS = float(np.finfo(float).eps)
NOTE = "one Python call at each impact"

if __name__ == "__main__":
    common.main("heyoka", hy.__version__, [{"tol": 1e-9}, {"tol": EPS}], prepare, NOTE)
