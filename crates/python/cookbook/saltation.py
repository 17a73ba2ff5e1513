"""The Lyapunov exponent of an orbit with impacts, by the saltation matrix of each."""

import impact_chain
import numpy


def exponent(force, omega=2.5, r=0.5):
    """The largest exponent of a mass that hits the left wall, for times from 2500 to 5000.

    Parameters
    ----------
    force : float
        Amplitude of cos(omega t).
    """
    chain = impact_chain.Scenario(
        forcing=[[force, 0]], forcing_frequency=omega, restitution=r, walls=[0, 100])
    time, _, speed = impact_chain.impacts(chain, 5000.0)
    flights, kicks = numpy.diff(time), (1 + r) * (1 + force * numpy.cos(omega * time)) / speed
    deviation, growth = numpy.array([0.0, 1.0]), []
    for sin, cos, kick in zip(numpy.sin(flights), numpy.cos(flights), kicks[1:]):
        deviation = [[-r, 0], [-kick, -r]] @ ([[cos, sin], [-sin, cos]] @ deviation)
        growth.append(numpy.linalg.norm(deviation))
        deviation /= growth[-1]
    middle = len(time) // 2
    return numpy.log(growth[middle:]).sum() / (time[-1] - time[middle])


if __name__ == "__main__":
    print(f"largest exponent: {exponent(-14.2):.6f}")
