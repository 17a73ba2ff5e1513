"""The baseline: classical Runge-Kutta in fixed steps, in plain Python with NumPy. A step at whose end a
gap is negative is halved to where the first gap becomes so."""

import sys

import common
import located
import numpy as np

NAME, VERSION = "RK4", f"in NumPy {np.__version__}"
SETTINGS = [("bisection, h=0.01, stop=1e-12", 1e-12)]
STEP = 0.01


def simulate(case, stop, hit):
    n = case.n

    def advance(t, x, v, contact):
        def motion(t, y):
            return np.concatenate((y[n:], contact.P @ case.force(t, y[:n])))

        def after(h):
            """The state a time h after t."""
            a = motion(t, y)
            b = motion(t + h / 2, y + h / 2 * a)
            c = motion(t + h / 2, y + h / 2 * b)
            return y + h / 6 * (a + 2 * b + 2 * c + motion(t + h, y + h * c))

        def least(h):
            """The least width of an open gap or force on a shut one, then, and its gap."""
            there = after(h)
            values = case.gaps(there[:n])
            if contact.shut.any():
                values = np.where(contact.shut, contact.L @ case.force(t + h, there[:n]), values)
            gap = int(values.argmin())
            return values[gap], gap

        y = np.concatenate((x, v))
        while t < case.until:
            h = min(STEP, case.until - t)
            if least(h)[0] < 0.0:
                low, high = 0.0, h
                while low < (middle := 0.5 * (low + high)) < high:
                    low, high = (low, middle) if least(middle)[0] < 0.0 else (middle, high)
                y, gap = after(high), least(high)[1]
                return t + high, y[:n], y[n:], gap
            y, t = after(h), t + h
        return t, y[:n], y[n:], None

    located.simulate(case, stop, advance, hit)


if __name__ == "__main__":
    common.main(sys.modules[__name__])
