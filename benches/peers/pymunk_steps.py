"""pymunk (Chipmunk): a physics engine with fixed time steps and impulses at contacts."""

import math

import common
import pymunk

R = 0.5  # radius of the discs; gaps are counted between their rims


def prepare(scenario, setting):
    forcing = scenario["forcing"]
    n, d, h = len(forcing), scenario["spacing"], setting["h"]
    w2, big_w = scenario["natural_frequency"] ** 2, scenario["forcing_frequency"]
    elasticity = scenario["restitution"] ** 0.5  # the engine multiplies those of the two discs
    places = [j * (d + 2 * R) for j in range(n + 2)]

    def run(t, u, v, until, first):
        space = pymunk.Space()
        space.collision_slop = 0.0
        bodies = [pymunk.Body(1.0, float("inf")) for _ in range(n)]
        bodies = [space.static_body, *bodies, space.static_body]
        impacts, drive = [], (0.0, 0.0)

        def driven(j):
            alpha, beta = forcing[j - 1]

            def change(body, gravity, damping, dt):
                c, s = drive
                force = alpha * c + beta * s - w2 * (body.position.x - places[j])
                body.velocity = body.velocity.x + dt * force, 0.0

            return change

        for j, body in enumerate(bodies):
            wall = j in (0, n + 1)
            disc = pymunk.Circle(body, R, (places[j], 0) if wall else (0, 0))
            disc.elasticity, disc.number, disc.collision_type = elasticity, j, 1
            if not wall:
                body.position, body.velocity = (places[j] + u[j - 1], 0.0), (v[j - 1], 0.0)
                # Called after the step of the places: forces are those at the end of a step.
                body.velocity_func = driven(j)
                space.add(body)
            space.add(disc)

        def hit(arbiter, space, data):
            if arbiter.is_first_contact:
                impacts.append((t, min(shape.number for shape in arbiter.shapes)))

        space.on_collision(1, 1, post_solve=hit)
        cos, sin = math.cos, math.sin
        while t < until and not (first and impacts):
            t += h
            drive = cos(big_w * t), sin(big_w * t)
            space.step(h)
        return impacts

    return run


NOTE = "forces computed in Python at each step; a time is known to one step"

if __name__ == "__main__":
    steps = [{"h": 1e-2}]
    common.main("pymunk", pymunk.version, steps, prepare, NOTE, segments=False)
