#!/usr/bin/env python3
"""Makes the mesh files of scenes/: make_meshes.py FOLDER. The same bytes on every machine."""

import math
import struct
import sys
from pathlib import Path


def rounded(point):
    """To 0.01 mm, far above what machines' sines differ by; -0 is 0."""
    return tuple(round(c, 5) + 0.0 for c in point)


def write_ply(path, vertices, triangles):
    header = f"""ply
format binary_little_endian 1.0
element vertex {len(vertices)}
property float x
property float y
property float z
element face {len(triangles)}
property list uchar ushort vertex_indices
end_header
"""
    body = b"".join(struct.pack("<3f", *rounded(v)) for v in vertices)
    body += b"".join(struct.pack("<B3H", 3, *t) for t in triangles)
    Path(path).write_bytes(header.encode() + body)


def grid(rows, columns, around):
    """Triangles between rows of `columns` vertices that close; `around`: the last row joins the first."""
    triangles = []
    for i in range(rows if around else rows - 1):
        for j in range(columns):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            c, d = (i + 1) % rows * columns + j, (i + 1) % rows * columns + (j + 1) % columns
            triangles += [(a, c, d), (a, d, b)]
    return triangles


def cross(a, b):
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


def unit(a):
    size = math.sqrt(sum(c * c for c in a))
    return tuple(c / size for c in a)


def knot(rows=140, columns=14, radius=0.16):
    """A tube around a trefoil knot that lies flat and reaches up to y = 1."""

    def centre(t):
        r = 0.62 + 0.26 * math.cos(3 * t)
        return (r * math.cos(2 * t), 0.5 + 0.3 * math.sin(3 * t), r * math.sin(2 * t))

    vertices = []
    for i in range(rows):
        t = 2 * math.pi * i / rows
        along = unit(tuple(b - a for a, b in zip(centre(t - 1e-4), centre(t + 1e-4))))
        out = unit(cross(along, cross((math.cos(2 * t), 0, math.sin(2 * t)), along)))
        side = cross(along, out)
        for j in range(columns):
            angle = 2 * math.pi * j / columns
            vertices.append(
                tuple(c + radius * (math.cos(angle) * o + math.sin(angle) * s) for c, o, s in zip(centre(t), out, side))
            )
    return vertices, [(a, d, c) for a, c, d in grid(rows, columns, around=True)]


def goblet(columns=48):
    """A wine glass with a wall, turned from an outline that begins and ends on the axis."""
    outside = [(0.36, 0.0), (0.36, 0.015), (0.2, 0.035), (0.07, 0.06), (0.045, 0.12), (0.04, 0.25), (0.045, 0.4),
               (0.08, 0.46), (0.18, 0.51), (0.28, 0.58), (0.35, 0.68), (0.385, 0.8), (0.385, 0.92), (0.36, 1.06),
               (0.33, 1.18)]
    inside = [(0.318, 1.19), (0.307, 1.18), (0.335, 1.06), (0.36, 0.92), (0.36, 0.8), (0.327, 0.69), (0.26, 0.6),
              (0.17, 0.54), (0.08, 0.51)]
    rows = outside + inside
    vertices = [
        (r * math.cos(2 * math.pi * j / columns), y, -r * math.sin(2 * math.pi * j / columns))
        for r, y in rows
        for j in range(columns)
    ]
    triangles = [(a, d, c) for a, c, d in grid(len(rows), columns, around=False)]
    foot, bottom = len(vertices), len(vertices) + 1
    vertices += [(0, 0, 0), (0, 0.5, 0)]
    last = (len(rows) - 1) * columns
    for j in range(columns):
        k = (j + 1) % columns
        triangles += [(foot, k, j), (bottom, last + j, last + k)]
    return vertices, triangles


class Furniture:
    """An OBJ of boxes."""

    def __init__(self):
        self.lines, self.count = ["# made by tests/tools/make_meshes.py"], 0

    def material(self, name):
        self.lines.append(f"usemtl {name}")

    def box(self, low, high):
        for i in range(8):
            corner = rounded(tuple((high if i >> axis & 1 else low)[axis] for axis in range(3)))
            self.lines.append("v " + " ".join(f"{c:g}" for c in corner))
        for side in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            self.lines.append("f " + " ".join(str(self.count + 1 + i) for i in side))
        self.count += 8

    def write(self, path):
        Path(path).write_text("\n".join(self.lines) + "\n")


def table():
    f = Furniture()
    f.material("wood")
    f.box((-0.8, 0.72, -0.45), (0.8, 0.76, 0.45))
    f.material("steel")
    for x in (-0.74, 0.68):
        for z in (-0.39, 0.33):
            f.box((x, 0, z), (x + 0.06, 0.72, z + 0.06))
    return f


def chair():
    f = Furniture()
    f.material("wood")
    f.box((-0.22, 0.43, -0.22), (0.22, 0.47, 0.22))
    for y in (0.58, 0.7, 0.82):
        f.box((-0.2, y, -0.215), (0.2, y + 0.07, -0.195))
    f.material("steel")
    for x in (-0.22, 0.19):
        f.box((x, 0, 0.19), (x + 0.03, 0.43, 0.22))
        f.box((x, 0, -0.225), (x + 0.03, 0.43, -0.195))
        f.box((x, 0.47, -0.225), (x + 0.03, 0.9, -0.195))
    return f


def shelf():
    f = Furniture()
    f.material("wood")
    for x in (-0.5, 0.47):
        f.box((x, 0, -0.15), (x + 0.03, 1.8, 0.15))
    for y in (0.1, 0.5, 0.9, 1.3, 1.77):
        f.box((-0.47, y, -0.15), (0.47, y + 0.03, 0.15))
    f.material("books")
    x = -0.45
    for i in range(14):
        width, height = 0.03 + 0.02 * (i * 7 % 5) / 4, 0.22 + 0.1 * (i * 5 % 7) / 6
        f.box((x, 0.93, -0.1), (x + width, 0.93 + height, 0.1))
        x += width + 0.003
    return f


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: make_meshes.py FOLDER")
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    write_ply(folder / "knot.ply", *knot())
    write_ply(folder / "goblet.ply", *goblet())
    table().write(folder / "table.obj")
    chair().write(folder / "chair.obj")
    shelf().write(folder / "shelf.obj")


main()
