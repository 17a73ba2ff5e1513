"""Tests the Python package against closed forms, and ensembles against single runs."""

import json
import pickle
import signal
import threading
import time

import impact_chain
import numpy
import pytest


def ball(**fields):
    """A mass at x = a sin t between walls at 0 and 2, without forcing."""
    fields = {"initial": {"free": [[0.0, 2.0]]}, "restitution": 1.0} | fields
    return impact_chain.Scenario(forcing=numpy.zeros((1, 2)), **fields)


def test_impacts_are_at_their_closed_form():
    t, gap, speed = impact_chain.impacts(ball(), 3.0)
    first = numpy.arcsin(0.5)
    assert gap.tolist() == [1, 0, 1] and gap.dtype == numpy.uint64
    assert abs(t - first * numpy.array([1, 3, 5])).max() < 1e-14
    assert abs(speed - numpy.sqrt(3)).max() < 1e-14


def test_states_and_events():
    x, v = impact_chain.states(ball(), [0.25, numpy.arcsin(0.5)])
    assert x.shape == v.shape == (2, 1)
    assert abs(x[0, 0] - 1 - 2 * numpy.sin(0.25)) < 1e-15
    assert abs(v[1, 0] + numpy.sqrt(3)) < 1e-14
    assert impact_chain.states(ball(), 0.25)[0] == x[:1]
    pressed = impact_chain.Scenario(
        forcing=[[0, 0]], places=[-50], walls=[0, 1e6], restitution=0.0,
        initial={"at": {"positions": [1], "velocities": [0]}})
    kinds = [event["kind"] for event in impact_chain.events(pressed, 10.0)]
    assert kinds[0] == "impact" and "stick" in kinds


def test_an_ensemble_counts_what_single_runs_do():
    chain = {"masses": 10, "restitution": 0.7}
    distinct, impacts = impact_chain.ensemble(0.3, 20, transient=20.0, window=30.0, seed=1, **chain)
    for i in range(20):
        scenario = impact_chain.Scenario.draw(0.3, i, seed=1, **chain)
        t, gap, _ = impact_chain.impacts(scenario, 50.0)
        assert distinct[i] == len(set(gap[t > 20.0]))
        assert abs(impacts[i] - (t > 20.0).sum()) <= 2


def test_a_run_goes_on_from_a_state_at_its_time():
    chain = impact_chain.Scenario.draw(0.4, 1, masses=5)
    t, gap, _ = impact_chain.impacts(chain, 20.0)
    x, v = impact_chain.states(chain, [7.3])
    on, gaps, _ = impact_chain.impacts(chain, 20.0, start=(7.3, x[0], v[0]))
    assert len(on) > 5 and gaps.tolist() == gap[t > 7.3].tolist()
    assert abs(on - t[t > 7.3]).max() < 1e-9
    x, v = impact_chain.states(chain, [8.0], start=(7.3, x[0], v[0]))
    assert abs(x - impact_chain.states(chain, [8.0])[0]).max() < 1e-11
    with pytest.raises(ValueError, match="7.0 is before the start at t = 8.0"):
        impact_chain.impacts(chain, 7.0, start=(8.0, x[0], v[0]))


def test_a_scenario_is_its_json():
    scenario = impact_chain.Scenario.draw(0.2, 3, masses=4)
    assert scenario.to_dict() == json.loads(scenario.to_json())
    for again in [impact_chain.Scenario(**scenario.to_dict()), pickle.loads(pickle.dumps(scenario))]:
        assert again == scenario and again.to_json() == scenario.to_json()
    assert scenario != impact_chain.Scenario.draw(0.2, 4, masses=4)


def test_errors_name_the_field():
    with pytest.raises(ValueError, match="restitution: 1.5 is out of range; give a number from"):
        ball(restitution=1.5)
    with pytest.raises(ValueError, match="at: give rising times"):
        impact_chain.states(ball(), [5.0, 1.0])
    with pytest.raises(ValueError, match="a window above 0"):
        impact_chain.ensemble(0.1, 1, window=-3.0)
    with pytest.raises(ValueError, match="until: "):
        impact_chain.impacts(ball(), float("nan"))
    with pytest.raises(ValueError, match="length: give one of masses, "):
        impact_chain.ensemble(0.1, 1, length=3)
    with pytest.raises(ValueError, match="realisations: -1; give a whole number"):
        impact_chain.ensemble(0.1, -1)
    with pytest.raises(ValueError, match="places: a number is not finite"):
        ball(places=[float("nan")])
    with pytest.raises(TypeError, match="restitution: .*complex"):
        ball(restitution=1j)
    with pytest.raises(ValueError, match=r"start: positions\[0\]: NaN is not finite"):
        impact_chain.impacts(ball(), 1.0, start=(0.0, [float("nan")], [0.0]))
    with pytest.raises(ValueError, match="start: positions: gap 0 starts overlapped by"):
        impact_chain.impacts(ball(), 1.0, start=(0.0, [-1.0], [0.0]))


def test_ctrl_c_ends_a_long_run():
    # A shell's background jobs ignore it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        impact_chain.ensemble(0.3, 10**7)
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        impact_chain.impacts(impact_chain.Scenario.draw(0.3), 1e9)
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        impact_chain.states(impact_chain.Scenario.draw(0.3), [1e9])
