"""An orbit as an amplitude moves slowly up and down again: each step goes on from the last state."""

import impact_chain
import numpy


def sweep(amplitudes, omega=1.5, periods=100):
    """The closing speed in the last period at each amplitude of the response, 0 without impact.

    Parameters
    ----------
    amplitudes : array_like
        In the order of the sweep; 1 grazes the wall.
    """
    initial, until, speeds = "rest", periods * 2 * numpy.pi / omega, []
    for amplitude in amplitudes:
        chain = impact_chain.Scenario(
            forcing=[[amplitude * (1 - omega**2), 0]], forcing_frequency=omega, walls=[0, 100],
            initial=initial)
        time, _, speed = impact_chain.impacts(chain, until)
        speeds.append(speed[time > 0.99 * until].max(initial=0.0))
        # The force has the same phase after whole periods, so each step starts at t = 0.
        x, v = impact_chain.states(chain, [until])
        initial = {"at": {"positions": x[0], "velocities": v[0]}}
    return numpy.array(speeds)


if __name__ == "__main__":
    up = numpy.arange(0.05, 1.2, 0.1)
    print(sweep([*up, *up[::-1]]))
