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


def test_an_ensemble_is_at_its_closed_form():
    amplitudes = numpy.linspace(1.1, 4.0, 50)
    balls = [ball(initial={"free": [[0.0, a]]}) for a in amplitudes]
    until = lambda t: (t / numpy.arcsin(1 / amplitudes) + 1) // 2
    distinct, impacts = impact_chain.ensemble(balls, 70.0, transient=50.0)
    assert impacts.tolist() == (until(70.0) - until(50.0)).tolist()
    assert distinct.tolist() == [2] * 50 and distinct.dtype == impacts.dtype == numpy.int64


def test_an_ensemble_of_any_scenarios_counts_what_single_runs_do():
    own = impact_chain.Scenario
    start = {"at": {"positions": [0.5, 1.0], "velocities": [0.3, -1.0]}}
    pressed = {"walls": [0, 9], "places": [-0.1, 2.0], "restitution": 0.0, "initial": start}
    forces = numpy.linspace(0.5, 2.0, 20)
    scenarios = [own(forcing=[[a, 0], [0, -a]], **pressed) for a in forces]
    scenarios += [own(forcing=[[0.9, 0.1]], restitution=r, walls=[0, 1.5 + r]) for r in [0.4, 0.9]]
    scenarios += [own(forcing=[[[1, 0]], [[0, 1]]], forcing_frequencies=[2.5, 0.7])]
    scenarios += [own(forcing=[[a, 0], [-a, 0], [0, a]], boundary="ring") for a in forces[:5]]
    distinct, impacts = impact_chain.ensemble(scenarios, 50.0, transient=20.0)
    assert impacts.all()
    for scenario, gaps, number in zip(scenarios, distinct, impacts, strict=True):
        t, gap, _ = impact_chain.impacts(scenario, 50.0)
        assert (gaps, number) == (len(set(gap[t > 20.0])), (t > 20.0).sum())
    assert [len(counts) for counts in impact_chain.ensemble([], 50.0)] == [0, 0]


def test_a_drawn_ensemble_counts_what_single_runs_do():
    draw = lambda i, **fields: impact_chain.Scenario.draw(0.3, i, masses=10, seed=1, **fields)
    scenarios = [draw(i, restitution=0.7) for i in range(20)]
    distinct, impacts = impact_chain.ensemble(scenarios, 50.0, transient=20.0)
    for i, scenario in enumerate(scenarios):
        t, gap, _ = impact_chain.impacts(scenario, 50.0)
        assert distinct[i] == len(set(gap[t > 20.0]))
        # Side by side impacts are the same until rounding parts them.
        assert abs(impacts[i] - (t > 20.0).sum()) <= 2
    far = draw(3, walls=[-5, 16], initial="random").to_dict()
    assert far["walls"] == [-5, 16] and far["forcing"] == scenarios[3].to_dict()["forcing"]
    overlapping = [draw(i, initial="random", spacing=0.1) for i in range(20)]
    assert impact_chain.ensemble(overlapping, 50.0)[0].tolist() == [-1] * 20


def test_a_run_goes_on_from_a_state_at_its_time():
    chain = impact_chain.Scenario.draw(0.4, 1, masses=5)
    t, gap, _ = impact_chain.impacts(chain, 20.0)
    x, v = impact_chain.states(chain, [7.3])
    on, gaps, _ = impact_chain.impacts(chain, 20.0, start=(7.3, x[0], v[0]))
    assert len(on) > 5 and gaps.tolist() == gap[t > 7.3].tolist()
    assert abs(on - t[t > 7.3]).max() < 1e-9
    x, v = impact_chain.states(chain, [8.0], start=(7.3, x[0], v[0]))
    assert abs(x - impact_chain.states(chain, [8.0])[0]).max() < 1e-11
    with pytest.raises(ValueError, match="until: 7.0 is out of range; give a number from 8.0"):
        impact_chain.impacts(chain, 7.0, start=(8.0, x[0], v[0]))


def test_a_scenario_is_its_json():
    scenario = impact_chain.Scenario.draw(0.2, 3, masses=4)
    assert scenario.to_dict() == json.loads(scenario.to_json())
    unpickled = pickle.loads(pickle.dumps(scenario))
    for again in [impact_chain.Scenario(**scenario.to_dict()), unpickled]:
        assert again == scenario and again.to_json() == scenario.to_json()
    assert scenario != impact_chain.Scenario.draw(0.2, 4, masses=4)


def test_errors_name_the_field():
    with pytest.raises(ValueError, match="restitution: 1.5 is out of range; give a number from"):
        ball(restitution=1.5)
    with pytest.raises(ValueError, match="at: .* give rising times"):
        impact_chain.states(ball(), [5.0, 1.0])
    with pytest.raises(ValueError, match="at: 5.0 is out of range; give a number from 7.0"):
        impact_chain.states(ball(), 5.0, start=(7.0, [1.0], [0.0]))
    with pytest.raises(ValueError, match="transient: 5.0 is out of range; give a number from 0"):
        impact_chain.ensemble([ball()], 3.0, transient=5.0)
    with pytest.raises(TypeError, match="scenarios"):
        impact_chain.ensemble(ball(), 3.0)
    with pytest.raises(ValueError, match="until: "):
        impact_chain.impacts(ball(), float("nan"))
    with pytest.raises(ValueError, match="length: unknown field"):
        impact_chain.Scenario.draw(0.1, length=3)
    with pytest.raises(ValueError, match="seed: -1; give a whole number"):
        impact_chain.Scenario.draw(0.1, seed=-1)
    with pytest.raises(ValueError, match="initial: 'free'; give \"rest\", \"zero\" or \"random\""):
        impact_chain.Scenario.draw(0.1, initial="free")
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
        impact_chain.ensemble([impact_chain.Scenario.draw(0.3)] * 10**5, 1e5)
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        impact_chain.impacts(impact_chain.Scenario.draw(0.3), 1e9)
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        impact_chain.states(impact_chain.Scenario.draw(0.3), [1e9])
