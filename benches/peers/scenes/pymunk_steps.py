"""pymunk (Chipmunk): fixed steps, and impulses at contacts of its own discs."""

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
    for j in range(case.n + 2):
        wall = j in (0, case.n + 1)
        body = space.static_body if wall else pymunk.Body(1.0, float("inf"))
        disc = pymunk.Circle(body, RADIUS, (pitch * j, 0.0) if wall else (0.0, 0.0))
        # Chipmunk multiplies the elasticities of the discs.
        disc.elasticity, disc.number, disc.collision_type = case.r**0.5, j, 1
        if not wall:
            body.position = case.x[j - 1] + 2.0 * RADIUS * j, 0.0
            body.velocity = case.v[j - 1], 0.0
            space.add(body)
            bodies.append(body)
        space.add(disc)
    before, touched = case.v, []

    def begin(arbiter, space, data):
        if arbiter.is_first_contact:
            touched.append(min(shape.number for shape in arbiter.shapes))

    space.on_collision(1, 1, post_solve=begin)
    t, steps = case.time, 0
    while t < case.until:
        x = [body.position.x - 2.0 * RADIUS * j for j, body in enumerate(bodies, 1)]
        for body, force in zip(bodies, case.force(t, x), strict=True):
            body.apply_force_at_local_point((force, 0.0))
        space.step(h)
        steps += 1
        t = case.time + steps * h
        opening = case.opening(before)
        for gap in sorted(touched):
            hit(t, gap, -opening[gap])
        touched.clear()
        before = [body.velocity.x for body in bodies]


if __name__ == "__main__":
    common.main(sys.modules[__name__])
