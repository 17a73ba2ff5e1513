"""The loop around a program that integrates to an event: impacts, and contact if it is wanted.

Without contact every impact bounces. With a stopping speed, as their users write it, gaps that are
shut and slower than that stay shut: masses in contact move with their mean acceleration, until the
force between them would pull. An impact that is slower is reported, and its gap then stays shut.
"""

from collections import deque

import common
import numpy as np

SHUT = 1e-12  # a gap as narrow as this is shut
MOST, WINDOW = 2000, 1e-6  # a run with more impacts within so short a time gives up


class Contact:
    """Which gaps stay shut, and what follows from it: a = P f for the accelerations, and L f for the
    forces that press on the gaps, where f are the forces on the masses."""

    def __init__(self, case, shut):
        n = case.n
        self.shut = np.array(shut, dtype=bool)
        self.P, self.L = np.zeros((n, n)), np.zeros((n + 1, n))
        first = 0  # bodies are the left wall, the masses 1 to n, and the right wall
        for last in range(n + 2):
            if last <= n and self.shut[last]:
                continue
            masses = np.arange(max(first, 1), min(last, n) + 1) - 1
            if first > 0 and last <= n:
                self.P[np.ix_(masses, masses)] = 1.0 / len(masses)
            relative = np.eye(n)[masses] - self.P[masses]  # rows: force less mass times acceleration
            for gap in range(first, last):  # shut gaps between these bodies
                behind = masses >= gap
                # What is not at a wall sums to zero on both sides; from a wall one counts away.
                self.L[gap] = -relative[behind].sum(0) if last <= n else relative[~behind].sum(0)
            first = last + 1


def settle(case, t, x, v, stop, hit):
    """Hits shut gaps that close until none does, the fastest first; returns the contact after it."""
    gaps = case.gaps(x)
    shut = gaps <= SHUT
    while True:
        closing = np.where(shut, -case.opening(v), 0.0)
        gap = int(closing.argmax())
        if closing[gap] <= stop:
            break
        hit(t, gap, closing[gap])
        case.bounce(v, gap)
    if stop == 0.0:
        return Contact(case, np.zeros(case.n + 1))
    held = shut & (np.abs(case.opening(v)) <= stop)
    v[:] = Contact(case, held).P @ v
    return pressed(case, t, x, held)


def pressed(case, t, x, held):
    """The contact of those of the held gaps that are pressed, freed one after the other."""
    while True:
        contact = Contact(case, held)
        pressing = np.where(held, contact.L @ case.force(t, x), 0.0)
        gap = int(pressing.argmin())
        if pressing[gap] >= 0.0:
            return contact
        held[gap] = False


def open_gaps(case, x, width):
    """Moves masses such that no gap is negative, and each is open by `width` or the next double."""
    n = case.n

    def wide(at):
        return max(width, np.spacing(abs(at))) if width else 0.0

    for j in range(n):
        left = x[j - 1] if j else 0.0
        x[j] = max(x[j], left + wide(left))
    for j in reversed(range(n)):
        right = x[j + 1] if j + 1 < n else case.d * (n + 1)
        x[j] = min(x[j], right - wide(right))


def simulate(case, stop, advance, hit, width=0.0):
    """Runs a case. `advance(t, x, v, contact)` integrates to the end or to the first event: the width
    of an open gap, or the force that presses on a shut one, falls below zero. It returns the time,
    positions, velocities, and the gap of the event, or none at the end. Before it starts again, gaps
    are `width` wide at least."""
    recent = deque(maxlen=MOST)

    def bounded(time, gap, speed):
        hit(time, gap, speed)
        recent.append(time)
        if len(recent) == MOST and time - recent[0] < WINDOW:
            raise common.GaveUp(f"after {MOST} impacts within {WINDOW:g}")

    t, x, v = case.time, case.x.copy(), case.v.copy()
    contact = settle(case, t, x, v, stop, bounded)
    while t < case.until:
        open_gaps(case, x, width)
        t, x, v, gap = advance(t, x, v, contact)
        if gap is None:
            break
        if contact.shut[gap]:
            held = contact.shut.copy()
            held[gap] = False
            contact = pressed(case, t, x, held)
        else:
            # The gap of the event is shut, whatever its last bits say.
            middle = x[gap - 1 : gap + 1].mean() if 0 < gap < case.n else None
            if middle is None:
                x[min(gap, case.n - 1)] = 0.0 if gap == 0 else case.d * (case.n + 1)
            else:
                x[gap - 1 : gap + 1] = middle
            closing = -case.opening(v)[gap]
            if 0.0 < closing <= stop:
                bounded(t, gap, closing)
            contact = settle(case, t, x, v, stop, bounded)
