"""Siconos: event-driven with LSODAR, and Moreau-Jean time stepping, as in its examples of the ball.

Its contacts are unilateral constraints with Newton's impact law, so rest needs no setting.
"""

import os
import subprocess
import sys
from pathlib import Path

import common
import numpy as np
import siconos.kernel as sk

NAME = "Siconos"
# Its module does not say.
VERSION = subprocess.check_output(["dpkg-query", "-W", "-f", "${Version}", "python3-siconos"], text=True).split("+")[0]
SETTINGS = [
    ("event-driven, LSODAR", None),
    ("Moreau-Jean, h=1e-3", 1e-3),
    ("Moreau-Jean, h=1e-4", 1e-4),
]
GRID = 0.1  # from one event of its grid to the next, in event-driven runs

# The drive: z holds the number of frequencies, then for each of them itself and the amplitudes of
# all masses; then constant forces.
PLUGIN = """
#include <math.h>
void drive(double t, unsigned n, double *f, unsigned size, double *z)
{
    int frequencies = z[0];
    const double *at = z + 1, *constant = z + 1 + frequencies * (1 + 2 * n);
    for (unsigned j = 0; j < n; j++)
        f[j] = constant[j];
    for (int k = 0; k < frequencies; k++, at += 1 + 2 * n)
        for (unsigned j = 0; j < n; j++)
            f[j] += at[1 + j] * cos(at[0] * t) + at[1 + n + j] * sin(at[0] * t);
}
"""


def plugin():
    """Compiles the drive where Siconos looks for it: the current folder."""
    folder = Path(__file__).resolve().parents[3] / "target" / "peers" / "siconos"
    folder.mkdir(parents=True, exist_ok=True)
    os.chdir(folder)
    Path("ChainPlugin.c").write_text(PLUGIN)
    command = ["cc", "-O2", "-shared", "-fPIC", "-o", "ChainPlugin.so", "ChainPlugin.c", "-lm"]
    subprocess.run(command, check=True, stdout=sys.stderr)


plugin()


def model(case, until):
    """The chain and its gaps."""
    n = case.n
    masses = sk.LagrangianLinearTIDS(case.x.copy(), case.v.copy(), np.eye(n))
    masses.setKPtr(case.w2 * np.eye(n))
    z = [[len(case.frequencies)]]
    for k, frequency in enumerate(case.frequencies):
        z += [[frequency], case.alpha[k], case.beta[k]]
    z = np.concatenate([*z, case.w2 * case.places])
    masses.setzPtr(z)
    masses.setComputeFExtFunction("./ChainPlugin", "drive")
    chain = sk.NonSmoothDynamicalSystem(case.time, until)
    chain.insertDynamicalSystem(masses)
    gaps = []
    for gap in range(n + 1):
        row = np.zeros((1, n))
        if gap > 0:
            row[0, gap - 1] = -1.0
        if gap < n:
            row[0, gap] = 1.0
        end = [case.d * (n + 1) if gap == n else 0.0]
        law, relation = sk.NewtonImpactNSL(case.r), sk.LagrangianLinearTIR(row, end)
        gaps.append(sk.Interaction(law, relation))
        chain.link(gaps[-1], masses)
    return chain, masses, gaps, z


def simulate(case, h, hit):
    # Event-driven runs end at the last event of the grid.
    until = case.until + 2 * GRID if h is None else case.until
    chain, masses, gaps, z = model(case, until)  # z must live as long as the masses
    if h is None:
        return events(case, chain, masses, gaps, hit)
    steps = sk.TimeDiscretisation(case.time, h)
    simulation = sk.TimeStepping(chain, steps, sk.MoreauJeanOSI(0.5), sk.LCP())
    while simulation.hasNextEvent():
        before = masses.velocity().copy()
        simulation.computeOneStep()
        # Contacts are those that the velocities before it shut by the middle of the step.
        report(case, simulation.nextTime() - 0.5 * h, before, gaps, hit)
        simulation.nextStep()


def events(case, chain, masses, gaps, hit):
    # Events of the grid hold up nothing, and LSODAR has fewer steps from one to the next.
    simulation = sk.EventDriven(chain, sk.TimeDiscretisation(case.time, GRID))
    integrator = sk.LsodarOSI()
    simulation.insertIntegrator(integrator)
    simulation.insertNonSmoothProblem(sk.LCP(), sk.SICONOS_OSNSP_ED_IMPACT)
    simulation.insertNonSmoothProblem(sk.LCP(), sk.SICONOS_OSNSP_ED_SMOOTH_ACC)
    simulation.initialize()
    integrator.setMaxNstep(100_000)
    while simulation.hasNextEvent():
        simulation.advanceToEvent()
        before = masses.velocity().copy()
        simulation.processEvents()
        if np.any(before != masses.velocity()):
            report(case, simulation.startingTime(), before, gaps, hit)


def report(case, time, before, gaps, hit):
    """Reports the gaps with an impulse, by how fast they closed before."""
    for gap, opening in enumerate(case.opening(before)):
        if gaps[gap].lambda_(1)[0] > 0.0 and opening < 0.0:
            hit(time, gap, -opening)


if __name__ == "__main__":
    common.main(sys.modules[__name__])
