"""heyoka: Taylor series of adaptive order, a terminal event for each gap by isolation of roots."""

import functools
import sys

import common
import heyoka as hy
import located
import numpy as np

EPS = float(np.finfo(float).eps)
NAME, VERSION = "heyoka", hy.__version__
DOUBT = "polynomial root finding during event detection failed"
SETTINGS = [("tol=2.2e-16", 0.0), ("tol=2.2e-16, stop=1e-12", 1e-12)]


@functools.cache
def integrator(n, frequencies):
    """One for all chains of as many masses; their numbers are its parameters, in the order in which
    `parameters` gives them."""
    count = 0

    def par(*shape):
        nonlocal count
        size = int(np.prod(shape))
        found = np.array([hy.par[i] for i in range(count, count + size)]).reshape(shape)
        count += size
        return found

    w2, d = par(1)[0], par(1)[0]
    frequency, alpha, beta = par(frequencies), par(frequencies, n), par(frequencies, n)
    P, L, shut = par(n, n), par(n + 1, n), par(n + 1)
    x = [hy.expression(f"x{j}") for j in range(n)]
    v = [hy.expression(f"v{j}") for j in range(n)]
    force = [-w2 * (x[j] - d * float(j + 1)) for j in range(n)]
    for k in range(frequencies):
        phase = frequency[k] * hy.time
        force = [force[j] + alpha[k, j] * hy.cos(phase) + beta[k, j] * hy.sin(phase) for j in range(n)]
    total = lambda row: hy.sum([row[j] * force[j] for j in range(n)])  # noqa: E731
    equations = [(x[j], v[j]) for j in range(n)] + [(v[j], total(P[j])) for j in range(n)]
    bodies = [hy.expression(0.0), *x, d * float(n + 1)]
    events = []
    for gap in range(n + 1):
        width = bodies[gap + 1] - bodies[gap]
        function = shut[gap] * total(L[gap]) + (1.0 - shut[gap]) * width
        events.append(hy.t_event(function, direction=hy.event_direction.negative))
    return hy.taylor_adaptive(equations, [0.0] * (2 * n), t_events=events, tol=EPS)


def simulate(case, stop, hit):
    n = case.n
    chain = integrator(n, len(case.frequencies))
    fixed = [[case.w2], [case.d], case.frequencies, case.alpha.ravel(), case.beta.ravel()]

    def advance(t, x, v, contact):
        matrices = [contact.P.ravel(), contact.L.ravel(), contact.shut.astype(float)]
        chain.pars[:] = np.concatenate([*fixed, *matrices])
        chain.reset_cooldowns()  # of events before the state was changed
        chain.time = t
        chain.state[:n], chain.state[n:] = x, v
        result = chain.propagate_until(case.until)[0]
        t, x, v = chain.time, chain.state[:n].copy(), chain.state[n:].copy()
        if result == hy.taylor_outcome.time_limit:
            return t, x, v, None
        gap = -int(result) - 1
        if not 0 <= gap <= n:
            raise common.Warned(str(result))
        return t, x, v, gap

    # A root at the very start is not isolated: gaps open by a rounding, at the wall by less.
    located.simulate(case, stop, advance, hit, width=1e-100)


if __name__ == "__main__":
    common.main(sys.modules[__name__])
