#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the meshes of the studies beside this file: python3 make_meshes.py

sphere_N.inc   thick sphere, radii 10 and 20 mm, N layers: hexahedra of a cube blown up (all angles
               alike), six tetrahedra each, the triangles of the inner surface
sphere_N.obj   its closed surface, groups `inner` and `outer`
cook_N.inc     Cook's membrane, 12 mm thick, N x N x N/4 cells: the nodes of a grid, x fastest
cook_N.obj     its closed surface, one cell longer at the wall; group `tip` is the loaded edge
twist_N.inc    a column of 10 x 10 x 40 mm in N x N x 4N cells, twisted by half a turn: where a grid's
               nodes are
twist_points_N.inc   the same for a particle in every cell and one layer more at both ends
rod_N.inc      a rod, radius 5 mm and 10 mm long, in N x N x N cells, twisted by a quarter turn: where a
               grid's nodes are, and where they were
rod_points_N.inc   the same for a particle in every cell and one layer more at both ends, with the
               hull of all of them
cap_N_M.inc    a corneal cap (anterior radius 7.8 mm, half-chord 5.65 mm, 0.58 mm thick) in N x N x M
               cells: the nodes of a grid, apex at the origin, and what holds its rim
lame_NU.inc    a measure: the displacement field at 60 points in its wall against Lame's, for a pressure
               of 100 Pa inside and E = 10 kPa
"""
import itertools
import math
import os

FOLDER = os.path.dirname(os.path.abspath(__file__))
LICENCE = "SPDX-License-Identifier: Apache-2.0"


def write(name, text):
    with open(os.path.join(FOLDER, name), "w") as file:
        file.write(text)


def listed(rows):
    return "\n".join(" ".join(str(v) for v in row) for row in rows)


def number(value):
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def six_tetrahedra(h):
    """Cones from the lowest node over the faces that do not have it, each cut from its own lowest
    node: neighbours agree on the cut of the face between them."""
    faces = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    lowest = min(h)
    tetrahedra = []
    for face in faces:
        nodes = [h[i] for i in face]  # counter-clockwise seen from outside
        if lowest in nodes:
            continue
        first = nodes.index(min(nodes))
        a, b, c, d = (nodes[(first + k) % 4] for k in range(4))
        tetrahedra += [(lowest, a, b, c), (lowest, a, c, d)]
    return tetrahedra


def blown_up_cube(n):
    """Unit vectors and outward quads of a cube's surface of n x n squares a face."""
    numbers, directions = {}, []

    def node(p):
        if p not in numbers:
            numbers[p] = len(directions)
            d = [math.tan(math.pi / 4 * (2 * c / n - 1)) for c in p]
            size = math.sqrt(sum(c * c for c in d))
            directions.append([c / size for c in d])
        return numbers[p]

    quads = []
    for axis, side in itertools.product(range(3), (0, n)):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for i, j in itertools.product(range(n), range(n)):
            corners = []
            for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p = [0, 0, 0]
                p[axis], p[u], p[v] = side, i + du, j + dv
                corners.append(node(tuple(p)))
            quads.append(corners if side else corners[::-1])
    return directions, quads


def halves(quad):
    a, b, c, d = quad
    return [(a, b, c), (a, c, d)]


def thick_sphere(layers, inner=10.0, outer=20.0):
    n = 2 * layers
    directions, quads = blown_up_cube(n)
    count = len(directions)
    radii = [inner + (outer - inner) * k / layers for k in range(layers + 1)]
    position = [[number(r * c) for c in d] for r in radii for d in directions]
    hexahedra = [[k * count + s for s in q] + [(k + 1) * count + s for s in q]
                 for k in range(layers) for q in quads]
    inwards = [t[::-1] for q in quads for t in halves(q)]
    outwards = [tuple(count + s for s in t) for q in quads for t in halves(q)]
    tetrahedra = [t for h in hexahedra for t in six_tetrahedra(h)]
    write(f"sphere_{layers}.inc", f"""<?xml version="1.0"?>
<!-- {LICENCE} -->
<!-- Thick sphere in {layers} layers of {n} x {n} hexahedra a side, made by make_meshes.py. -->
<Node name="Group">
<MeshTopology name="mesh" triangles="
{listed(inwards)}" position="
{listed(position)} mm" hexahedra="
{listed(hexahedra)}" tetrahedra="
{listed(tetrahedra)}"/>
</Node>
""")
    surface = [[number(r * c) for c in d] for r in (inner, outer) for d in directions]
    lines = [f"# {LICENCE}", "# Surface of the thick sphere, mm, made by make_meshes.py."]
    lines += ["v " + " ".join(p) for p in surface]
    for group, triangles in (("inner", inwards), ("outer", outwards)):
        lines += [f"g {group}"] + ["f " + " ".join(str(i + 1) for i in t) for t in triangles]
    write(f"sphere_{layers}.obj", "\n".join(lines) + "\n")


def cook_place(i, j, k, n):
    """Node of n x n x n/4 cells; to the left of the wall the membrane goes on as high as it is there."""
    x, s = 48 * i / n, max(0, i) / n
    low, high = 44 * s, 44 + 16 * s
    return x, low + (high - low) * j / n, 48 * k / n


def box_surface(first, last):
    """Outward quads of the cells between two corners of a grid, with the side they are on."""
    for axis, side in itertools.product(range(3), (0, 1)):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for i, j in itertools.product(range(first[u], last[u]), range(first[v], last[v])):
            quad = []
            for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p = [0, 0, 0]
                p[axis], p[u], p[v] = (last if side else first)[axis], i + du, j + dv
                quad.append(tuple(p))
            yield (axis, side), quad if side else quad[::-1]


def cook(n):
    nodes = [cook_place(i, j, k, n) for k in range(n // 4 + 1) for j in range(n + 1)
             for i in range(n + 1)]
    write(f"cook_{n}.inc", f"""<?xml version="1.0"?>
<!-- {LICENCE} -->
<!-- Nodes of Cook's membrane, {n} x {n} x {n // 4} cells, made by make_meshes.py. -->
<Node name="Group">
<MechanicalObject name="state" position="
{listed([number(c) for c in p] for p in nodes)} mm"/>
</Node>
""")
    numbers, groups = {}, {"tip": [], "rest": []}
    for side, quad in box_surface((-1, 0, 0), (n, n, n // 4)):
        corners = [numbers.setdefault(p, len(numbers)) for p in quad]
        groups["tip" if side == (0, 1) else "rest"] += halves(corners)
    lines = [f"# {LICENCE}", "# Surface of Cook's membrane, mm, made by make_meshes.py."]
    lines += ["v " + " ".join(number(c) for c in cook_place(*p, n)) for p in numbers]
    for group, triangles in groups.items():
        lines += [f"g {group}"] + ["f " + " ".join(str(i + 1) for i in t) for t in triangles]
    write(f"cook_{n}.obj", "\n".join(lines) + "\n")


def twist(n):
    """The column's grid, or its particles: where half a turn, spread evenly, takes them."""
    def turned(x, y, z):
        angle = math.pi * min(max(z / 40, 0), 1)
        c, s = math.cos(angle), math.sin(angle)
        return number(c * x - s * y), number(s * x + c * y), number(z)

    h = 10 / n
    nodes = [turned(h * i - 5, h * j - 5, h * k)
             for k in range(4 * n + 1) for j in range(n + 1) for i in range(n + 1)]
    particles = [turned(h * (i + 0.5) - 5, h * (j + 0.5) - 5, h * (k - 0.5))
                 for k in range(4 * n + 2) for j in range(n) for i in range(n)]
    for name, source, places in (("twist", "grid", nodes), ("twist_points", "particles", particles)):
        write(f"{name}_{n}.inc", f"""<?xml version="1.0"?>
<!-- {LICENCE} -->
<!-- A column of {n} x {n} x {4 * n} cells twisted by half a turn, made by make_meshes.py. -->
<Node name="Group">
<MechanicalObject name="state" rest_position="@{source}.position" position="
{listed(places)} mm"/>
</Node>
""")


def on_disc(i, j, n, radius=5.0):
    """A square of n x n cells drawn onto a disc, rounded as it is written."""
    x, y = 2 * i / n - 1, 2 * j / n - 1
    return (round(radius * x * math.sqrt(1 - y * y / 2), 4),
            round(radius * y * math.sqrt(1 - x * x / 2), 4))


def rod_particles(n, levels):
    """Middle and volume of the cells, layer by layer from one below the rod to one above it."""
    particles, volumes = [], []
    for k, j, i in itertools.product(range(n + 2), range(n), range(n)):
        a, b, c, d = (on_disc(i + di, j + dj, n) for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)))
        area = ((c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1])) / 2
        particles.append([sum(p[axis] for p in (a, b, c, d)) / 4 for axis in (0, 1)] +
                         [(levels[k] + levels[k + 1]) / 2])
        volumes.append(area * (levels[k + 1] - levels[k]))
    return particles, volumes


def rod(n, length=10.0, turn=math.pi / 2):
    levels = [round(length * k / n, 4) for k in range(-1, n + 2)]

    def turned(x, y, z):
        angle = turn * min(max(z / length, 0), 1)
        c, s = math.cos(angle), math.sin(angle)
        return c * x - s * y, s * x + c * y, z

    def state(places):
        rest = listed([number(c) for c in p] for p in places)
        return (f'<MechanicalObject name="state" rest_position="\n{rest} mm" position="\n' +
                listed([number(c) for c in turned(*p)] for p in places) + ' mm"/>')

    nodes = [(*on_disc(i, j, n), z)
             for z in levels[1:-1] for j in range(n + 1) for i in range(n + 1)]
    write(f"rod_{n}.inc", f"""<?xml version="1.0"?>
<!-- {LICENCE} -->
<!-- Nodes of a twisted rod, {n} x {n} x {n} cells, made by make_meshes.py. -->
<Node name="Group">
{state(nodes)}
</Node>
""")
    particles, volumes = rod_particles(n, levels)
    numbers, triangles = {}, []
    for _, quad in box_surface((0, 0, -1), (n, n, n + 1)):
        triangles += halves([numbers.setdefault(p, len(numbers)) for p in quad])
    hull = [[number(c) for c in (*on_disc(i, j, n), levels[k + 1])] for i, j, k in numbers]
    write(f"rod_points_{n}.inc", f"""<?xml version="1.0"?>
<!-- {LICENCE} -->
<!-- Particles of a twisted rod, {n} x {n} x {n + 2}, and their hull, made by make_meshes.py. -->
<Node name="Group">
{state(particles)}
<MeshTopology name="hull" position="
{listed(hull)} mm" triangles="
{listed(triangles)}"/>
<MLSForceField name="elasticity" surface="@hull" youngModulus="10 kPa" poissonRatio="0.499" material="stableNeoHookean"
               supportCount="14" gradient="consistent" volume="
{' '.join(f'{v:.10f}' for v in volumes)} mm^3"/>
</Node>
""")


def cap(n, layers, radius=7.8, half_chord=5.65, thickness=0.58):
    widest = math.asin(half_chord / radius)
    nodes, rim = [], []
    for k, j, i in itertools.product(range(layers + 1), range(n + 1), range(n + 1)):
        x, y = 2 * i / n - 1, 2 * j / n - 1  # a square drawn onto a disc
        u, v = x * math.sqrt(1 - y * y / 2), y * math.sqrt(1 - x * x / 2)
        from_axis = math.hypot(u, v)
        angle = widest * from_axis
        out = radius - thickness * (1 - k / layers)
        across = out * math.sin(angle) / from_axis if from_axis > 0 else 0
        if i in (0, n) or j in (0, n):
            rim.append(len(nodes))
        nodes.append((across * u, across * v, out * math.cos(angle) - radius))
    write(f"cap_{n}_{layers}.inc", f"""<?xml version="1.0"?>
<!-- {LICENCE} -->
<!-- Nodes of a corneal cap, {n} x {n} x {layers} cells, made by make_meshes.py. -->
<Node name="Group">
<MechanicalObject name="state" position="
{listed([number(c) for c in p] for p in nodes)} mm"/>
<FixedProjectiveConstraint name="limbus" indices="{' '.join(str(i) for i in rim)}"/>
</Node>
""")


def lame(name, nu, pressure=100.0, young=1e4, inner=10.0, outer=20.0):
    def displacement(r):
        cubes = pressure * inner**3 / (outer**3 - inner**3)
        return cubes / young * ((1 - 2 * nu) * r + (1 + nu) * outer**3 / (2 * r**2))

    directions = []
    for k in range(12):  # evenly over the sphere, along no axis of the meshes
        z, angle = 1 - (2 * k + 1) / 12, 2.399963 * k + 0.5
        across = math.sqrt(1 - z * z)
        directions.append((across * math.cos(angle), across * math.sin(angle), z))
    radii = (11, 13, 15, 17, 19)
    points = [[number(r * c) for c in d] for r in radii for d in directions]
    wanted = [[f"{1000 * displacement(r) * c:.4f}" for c in d] for r in radii for d in directions]
    write(f"{name}.inc", f"""<?xml version="1.0"?>
<!-- {LICENCE} -->
<!-- Lame's displacements in a thick sphere, Poisson's ratio {nu}, made by make_meshes.py. -->
<Node name="Group">
<Measure name="field" state="/sphere/state" source="Lame" points="
{listed(points)} mm" reference="
{listed(wanted)} um"/>
</Node>
""")


for wall in (2, 3, 4, 5):
    thick_sphere(wall)
for cells in (8, 12, 16, 24):
    cook(cells)
for across in (2, 4, 6, 8):
    twist(across)
for across in (4, 6, 8, 10):
    rod(across)
for cells in ((16, 2), (20, 3), (24, 4)):
    cap(*cells)
lame("lame_0300", 0.3)
lame("lame_0499", 0.499)
