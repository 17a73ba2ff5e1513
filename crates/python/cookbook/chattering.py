"""A mass that is pressed to a wall chatters, sticks, and is released as the contact force ends."""

import impact_chain


def chatter(force):
    """The events up to t = 5 from rest at 0.02.

    Parameters
    ----------
    force : float
        The acceleration at the wall is -1 - force cos(t/2).

    Returns
    -------
    list of dict, see `impact_chain.events`
    """
    chain = impact_chain.Scenario(
        forcing=[[-force, 0]], forcing_frequency=0.5, restitution=0.5, places=[-1],
        walls=[0, 100], initial={"at": {"positions": [0.02], "velocities": [0]}})
    return impact_chain.events(chain, 5.0)


if __name__ == "__main__":
    for event in chatter(2.0):
        print(event)
