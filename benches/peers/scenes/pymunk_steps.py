"""pymunk (Chipmunk): fixed steps, and impulses at contacts of its own discs.

A step moves the bodies, then changes their velocities by `velocity_func`, then solves for impulses:
forces that depend on places act there, at the end of the step.
"""

import sys

import common
import pymunk

NAME, VERSION = "pymunk", pymunk.version
SETTINGS = [("h=1e-3", 1e-3), ("h=1e-4", 1e-4)]
RADIUS = 0.5  # gaps are counted between rims


def simulate(case, h, hit):
    if case.time + h == case.time:
        raise common.Refused
    pitch = case.d + 2.0 * RADIUS
    space = pymunk.Space()
    space.collision_slop = 0.0
    bodies = []

    def driven(j):
        rest = case.places[j - 1] + 2.0 * RADIUS * j

        def change(body, gravity, damping, dt):
            pull = drive[j - 1] - case.w2 * (body.position.x - rest)
            body.velocity = body.velocity.x + dt * pull, 0.0

        return change

    for j in range(case.n + 2):
        wall = j in (0, case.n + 1)
        body = space.static_body if wall else pymunk.Body(1.0, float("inf"))
        disc = pymunk.Circle(body, RADIUS, (pitch * j, 0.0) if wall else (0.0, 0.0))
        # Chipmunk multiplies the elasticities of the discs.
        disc.elasticity, disc.number, disc.collision_type = case.r**0.5, j, 1
        if not wall:
            body.position = case.x[j - 1] + 2.0 * RADIUS * j, 0.0
            body.velocity = case.v[j - 1], 0.0
            body.velocity_func = driven(j)
            space.add(body)
            bodies.append(body)
        space.add(disc)
    before, touched = case.v, []
    t, steps, drive = case.time, 0, ()

    def begin(arbiter, space, data):
        if arbiter.is_first_contact:
            touched.append(min(shape.number for shape in arbiter.shapes))

    space.on_collision(1, 1, post_solve=begin)
    while t < case.until:
        steps += 1
        t = case.time + steps * h
        drive = case.force(t, case.places)
        space.step(h)
        opening = case.opening(before)
        for gap in sorted(touched):
            hit(t, gap, -opening[gap])
        touched.clear()
        before = [body.velocity.x for body in bodies]


if __name__ == "__main__":
    common.main(sys.modules[__name__])
