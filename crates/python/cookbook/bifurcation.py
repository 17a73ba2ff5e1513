"""The bifurcation diagram of an impact oscillator, one mass before a wall."""

import impact_chain
import numpy


def samples(amplitude, omega=2.5, restitution=0.5):
    """Array of the places at 30 periods of the force after 2000.

    Parameters
    ----------
    amplitude : float
        Of the response; 1 grazes the wall.
    """
    chain = impact_chain.Scenario(
        forcing=[[amplitude * (1 - omega**2), 0]], forcing_frequency=omega,
        restitution=restitution, walls=[0, 100], initial="zero")
    positions, _ = impact_chain.states(chain, numpy.arange(2000, 2030) * 2 * numpy.pi / omega)
    return positions[:, 0]


if __name__ == "__main__":  # with matplotlib: pyplot.plot(amplitude, samples(amplitude), ".")
    for amplitude in numpy.arange(3.9, 1.0, -0.1):
        print(f"{amplitude:.1f}", samples(amplitude).round(4))
