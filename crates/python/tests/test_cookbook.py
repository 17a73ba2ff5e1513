"""Runs the README, and each recipe of the cookbook, which is tested against the closed forms of the
Rust examples."""

import pathlib
import re
import runpy

import numpy

FOLDER = pathlib.Path(__file__).parents[1]


def test_readme():
    names = {}
    text = (FOLDER / "README.md").read_text("utf-8")
    for code in re.findall(r"```python\n(.*?)```", text, re.DOTALL):
        exec(code, names)
    assert len(names["oscillators"]) == 200 and len(names["gaps"]) == len(names["impacts"]) == 1000


def recipe(name, function, capsys):
    """Runs a recipe as a program, and returns its function."""
    path = FOLDER / "cookbook" / f"{name}.py"
    names = runpy.run_path(str(path), run_name="__main__")
    assert capsys.readouterr().out
    return names[function]


def period_one(amplitude, omega, r):
    """Speed of one impact in each period, κ, ν and the largest multiplier."""
    half = numpy.pi / omega
    kappa, nu = (1 + r) / 2 / numpy.tan(half), (1 - r) / 2 / omega
    squares = kappa**2 + nu**2
    speed = (numpy.sqrt(amplitude**2 * squares - nu**2 + 0j) - kappa) / squares
    slope = (omega**2 - 1) * kappa + omega**2 / speed.real
    trace = -2 * r * numpy.cos(2 * half) - (1 + r) * numpy.sin(2 * half) * slope
    return speed, kappa, nu, abs(abs(trace) / 2 + numpy.sqrt(trace**2 / 4 - r**2 + 0j))


def test_bifurcation(capsys):
    samples = recipe("bifurcation", "samples", capsys)
    for amplitude in [3.8, 2.7, 2.55, 2.45, 2.3]:
        speed, kappa, nu, multiplier = period_one(amplitude, 2.5, 0.5)
        after = (2 * numpy.pi - numpy.arctan2(nu * speed.real, -1 - kappa * speed.real)) / 2.5
        place = 1 + amplitude + speed.real * (kappa * numpy.cos(after) + 0.75 * numpy.sin(after))
        places = samples(amplitude)
        assert abs(places[2] - places[0]) < 1e-10
        assert (abs(places - place).max() < 1e-10) == (multiplier < 1)


def test_grazing(capsys):
    first_impact = recipe("grazing", "first_impact", capsys)
    for excess in 0.1 ** numpy.arange(1, 11):
        [time], [speed] = first_impact(excess)
        assert abs(speed / (1.5 * numpy.sqrt(excess * (2 + excess))) - 1) < 1e-15 / excess
        assert abs(time - numpy.arccos(-1 / (1 + excess)) / 1.5) < 1e-15 / numpy.sqrt(excess)
        assert len(first_impact(-excess)[0]) == 0


def test_saltation(capsys):
    multiplier = period_one(14.2 / 5.25, 2.5, 0.5)[3]
    exponent = recipe("saltation", "exponent", capsys)(-14.2)
    assert abs(exponent - numpy.log(multiplier) * 2.5 / (2 * numpy.pi)) < 1e-9


def test_chattering(capsys):
    chatter = recipe("chattering", "chatter", capsys)
    *impacts, stick = chatter(0.0)
    speeds = numpy.sqrt(1.02**2 - 1) * 0.5 ** numpy.arange(len(impacts) + 1)
    times = numpy.arccos(1 / 1.02) + numpy.cumsum([0, *2 * numpy.arctan(speeds[1:])])
    assert max(abs([impact["closing_speed"] for impact in impacts] - speeds[:-1])) < 1e-15
    assert max(abs([impact["time"] for impact in impacts] - times[:-1])) < 1e-14
    assert stick["kind"] == "stick" and abs(stick["time"] - times[-1]) < 4 * speeds[-1] < 4e-9
    [release] = [event for event in chatter(2.0) if event["kind"] == "release"]
    assert abs(release["time"] - 4 * numpy.pi / 3) < 1e-14


def test_branch(capsys):
    up = numpy.arange(0.05, 1.2, 0.1)
    speeds = recipe("branch", "sweep", capsys)([*up, *up[::-1]]).reshape(2, -1)
    expected = period_one(up, 1.5, 0.8)[0]
    expected = numpy.where(expected.imag == 0, expected.real, 0.0)
    assert abs(speeds[0] - numpy.where(up > 1, expected, 0.0)).max() < 1e-8
    # Below the fold impacts die out slowly.
    assert (abs(speeds[1, ::-1] - expected) < numpy.where(expected > 0, 1e-8, 0.01)).all()
