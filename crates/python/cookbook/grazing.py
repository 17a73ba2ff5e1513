"""The first impact as an amplitude passes the one that grazes: a square root of the excess."""

import impact_chain
import numpy


def first_impact(excess, omega=1.5):
    """The first impact in a period, if any.

    Parameters
    ----------
    excess : float
        The amplitude of the response is 1 + excess, and the wall at distance 1.

    Returns
    -------
    time, closing_speed : ndarray, shape (1,) or (0,)
    """
    chain = impact_chain.Scenario(
        forcing=[[(1 + excess) * (1 - omega**2), 0]], forcing_frequency=omega,
        walls=[0, 100], initial="zero")
    time, _, speed = impact_chain.impacts(chain, 2 * numpy.pi / omega)
    return time[:1], speed[:1]


if __name__ == "__main__":
    for excess in [-1e-4, 1e-10, 1e-8, 1e-6, 1e-4]:
        print(excess, *first_impact(excess))
