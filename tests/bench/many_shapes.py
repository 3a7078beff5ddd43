"""Scenes of many spheres or triangles, as text to follow that of an empty room 10 m across about (5, 0, 0)."""

import math
import random

MATERIAL = '\n[material.many]\ntype = "lambertian"\nreflectance = [0.6, 0.6, 0.6]\n'
CENTRE = (5.0, 0.0, 0.0)


def spheres(count):
    """Spheres at random places; the sum of their cross-sections does not depend on their number."""
    place = random.Random(1)
    radius = 1.5 / math.sqrt(count)
    text = MATERIAL
    for i in range(count):
        c = [CENTRE[0] + place.uniform(-4, 4), CENTRE[1] + place.uniform(-3, 3), CENTRE[2] + place.uniform(-4, 4)]
        text += (f'[[sphere]]\nname = "s{i}"\nmaterial = "many"\nradius = {radius!r}\n'
                 f"center = [{c[0]!r}, {c[1]!r}, {c[2]!r}]\n")
    return text


# Triangles: rings and points on a ring of a globe, which has 2 * points * rings triangles. One of 4 is a tetrahedron.
GLOBES = {4: None, 8: (1, 4), 20: (2, 5), 48: (3, 8), 100: (5, 10), 252: (9, 14), 500: (10, 25), 1000: (20, 25), 2000: (20, 50)}


def mesh(triangles, convex):
    """A closed globe of 3 m radius. Where it is not convex, each vertex is drawn in by up to a fifth and the pole until
    there is a dent; a tetrahedron is always convex."""
    pull = random.Random(2)
    if GLOBES[triangles] is None:
        unit = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
        faces = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
        unit = [tuple(c / math.sqrt(3) for c in v) for v in unit]
    else:
        rings, points = GLOBES[triangles]
        unit = [(0, 1, 0)]
        for r in range(1, rings + 1):
            theta = math.pi * r / (rings + 1)
            # Turned from ring to ring, so that no four vertices lie in one plane.
            turns = [(p + 0.5 * r) / points for p in range(points)]
            unit += [(math.sin(theta) * math.cos(math.tau * t), math.cos(theta), math.sin(theta) * math.sin(math.tau * t))
                     for t in turns]
        unit.append((0, -1, 0))
        last = len(unit) - 1

        def at(ring, point):
            return 1 + (ring - 1) * points + point % points

        faces = []
        for p in range(points):
            faces.append((0, at(1, p + 1), at(1, p)))
            faces.append((last, at(rings, p), at(rings, p + 1)))
            for r in range(1, rings):
                faces.append((at(r, p), at(r, p + 1), at(r + 1, p)))
                faces.append((at(r, p + 1), at(r + 1, p + 1), at(r + 1, p)))
    radii = [3.0 if convex else 3.0 * pull.uniform(0.8, 1.0) for _ in unit]
    if not convex and GLOBES[triangles] is not None:
        radii[0] = 3.0 * (math.cos(math.pi / (rings + 1)) - 0.3)
    vertices = []
    for v, radius in zip(unit, radii):
        vertices.append([c + radius * x for c, x in zip(CENTRE, v)])
    return (MATERIAL + f'[[mesh]]\nname = "globe"\nmaterial = "many"\nvertices = {vertices}\n'
            f"triangles = {[list(f) for f in faces]}\n")
