"""MuJoCo: fixed steps of RK4 and soft contacts whose damping gives the restitution.

Its manual sets restitution by a negative `solref`, stiffness k and damping of a contact, which lasts
π/√k, about ten or thirty steps here.
"""

import functools
import math
import sys

import common
import mujoco
import numpy as np

NAME, VERSION = "MuJoCo", mujoco.__version__
SETTINGS = [
    ("RK4, h=1e-3, k=1e5", (1e-3, 1e5)),
    ("RK4, h=1e-4, k=1e6", (1e-4, 1e6)),
    ("RK4, h=1e-4, k=1e7", (1e-4, 1e7)),
]
RADIUS = 0.1


@functools.cache
def damping(restitution, stiffness):
    """The damping with which a unit mass leaves a contact at that part of its speed, at least 0.02."""
    if restitution == 1.0:
        return 0.0

    def left(ratio):
        # x'' = -2 ratio x' - x from x = 0, x' = -1 until the contact would pull: speed at its end.
        if ratio > 1.0:
            return math.exp(-2.0 * ratio * math.acosh(ratio) / math.sqrt(ratio * ratio - 1.0))
        if ratio == 1.0:
            return math.exp(-2.0)
        w = math.sqrt(1.0 - ratio * ratio)
        end = math.atan2(2.0 * ratio * w, 2.0 * ratio * ratio - 1.0) / w
        return math.exp(-ratio * end)

    low, high = 0.0, 3.0  # of more the steps are too long
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if left(middle) > restitution else (low, middle)
    return 2.0 * high * math.sqrt(stiffness)


def model(case, h, stiffness):
    """Balls on a line, as far apart as the gaps and their diameters."""
    n, pitch = case.n, case.d + 2.0 * RADIUS
    bodies, pairs = [], []
    for j in range(n + 2):
        ball = f'<geom name="g{j}" type="sphere" size="{RADIUS}" mass="1" contype="0" conaffinity="0"/>'
        joint = "" if j in (0, n + 1) else f'<joint type="slide" axis="1 0 0" stiffness="{case.w2!r}"/>'
        bodies.append(f'<body pos="{pitch * j!r} 0 0">{joint}{ball}</body>')
        if j:
            # Both act on accelerations, so masses do not matter.
            soft = f"{-stiffness} {-damping(case.r, stiffness)}"
            pairs.append(f'<pair geom1="g{j - 1}" geom2="g{j}" condim="1" solref="{soft}" solimp="0.9999 0.9999 0.001"/>')
    option = f'<option timestep="{h}" gravity="0 0 0" integrator="RK4"/>'
    world = f"<worldbody>{''.join(bodies)}</worldbody><contact>{''.join(pairs)}</contact>"
    return mujoco.MjModel.from_xml_string(f"<mujoco>{option}{world}</mujoco>")


def simulate(case, value, hit):
    chain = model(case, *value)
    data = mujoco.MjData(chain)
    data.time = case.time
    data.qpos[:], data.qvel[:] = case.x - case.places, case.v
    if data.time + chain.opt.timestep == data.time:
        raise common.Refused
    inside, before = [False] * (case.n + 1), list(case.opening(case.v))
    while True:
        x, v = [0.0, *data.qpos.tolist(), 0.0], [0.0, *data.qvel.tolist(), 0.0]
        for gap in range(case.n + 1):
            width = case.d + x[gap + 1] - x[gap]
            # The step in which a contact begins is slowed by it, so speeds are those before it.
            if width <= 0.0 and not inside[gap] and before[gap] < 0.0:
                hit(data.time - width / before[gap], gap, -before[gap])
            inside[gap], before[gap] = width <= 0.0, v[gap + 1] - v[gap]
        if data.time >= case.until:
            return
        # The drive is constant within a step: that of its middle.
        data.qfrc_applied[:] = case.force(data.time + 0.5 * value[0], case.places)
        mujoco.mj_step(chain, data)
        if data.warning.number.any():
            raise common.Warned


if __name__ == "__main__":
    common.main(sys.modules[__name__])
