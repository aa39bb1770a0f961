# SPDX-License-Identifier: BSD-3-Clause
"""OpenFOAM cases in ascii on meshes of boxes, as CFDEMcoupling leaves them, for judge_cases.py."""

import os

import numpy as np

HEAD = """FoamFile
{
    version     2.0;
    format      ascii;
    class       %s;
    location    "%s";
    object      %s;
}
"""


class FoamCase:
    """A box of n cells between `low` and `high` (x, y, z), cells in blockMesh's order."""

    def __init__(self, folder, low, high, n):
        self.folder, self.n = folder, n
        planes = [np.linspace(a, b, m + 1) for a, b, m in zip(low, high, n)]
        self.centres = np.stack([c.ravel(order="F") for c in np.meshgrid(
            *[(p[1:] + p[:-1]) / 2 for p in planes], indexing="ij")], axis=1)
        self.planes = planes
        self.write_mesh()

    def write(self, name, kind, body):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w") as file:
            file.write(HEAD % (kind, os.path.dirname(name), os.path.basename(name)) + body)

    def write_list(self, name, kind, rows):
        self.write("constant/polyMesh/" + name, kind, f"{len(rows)}\n(\n" + "\n".join(rows) + "\n)\n")

    def write_mesh(self):
        nx, ny, nz = self.n

        def point(i, j, k):
            return i + (nx + 1) * (j + (ny + 1) * k)

        def cell(i, j, k):
            return i + nx * (j + ny * k)

        def face(axis, i, j, k):  # the lower side of cell (i, j, k)
            a, b = [(1, 2), (2, 0), (0, 1)][axis]
            corners = []
            for da, db in ((0, 0), (1, 0), (1, 1), (0, 1)):
                at = [i, j, k]
                at[a] += da
                at[b] += db
                corners.append(point(*at))
            return corners

        inner, outer = [], []
        for k in range(nz):
            for j in range(ny):
                for i in range(nx):
                    for axis in range(3):
                        upper = [i, j, k]
                        upper[axis] += 1
                        if upper[axis] < self.n[axis]:
                            inner.append((cell(i, j, k), cell(*upper), face(axis, *upper)))
                        else:
                            outer.append((cell(i, j, k), face(axis, *upper)))
                        if [i, j, k][axis] == 0:
                            outer.append((cell(i, j, k), face(axis, i, j, k)[::-1]))
        faces = [f[2] for f in inner] + [f[1] for f in outer]
        self.write_points()
        self.write_list("faces", "faceList", ["4(%d %d %d %d)" % tuple(f) for f in faces])
        self.write_list("owner", "labelList", [str(f[0]) for f in inner + outer])
        self.write_list("neighbour", "labelList", [str(f[1]) for f in inner])
        self.write("constant/polyMesh/boundary", "polyBoundaryMesh",
                   "1\n(\nwalls { type wall; nFaces %d; startFace %d; }\n)\n" % (len(outer), len(inner)))

    def write_points(self, lean=0):
        """Cells that lean along x by `lean` times their height are no boxes."""
        x, y, z = self.planes
        self.write_list("points", "vectorField",
                        [f"({a + lean * c:.12g} {b:.12g} {c:.12g})" for c in z for b in y for a in x])

    def field(self, time, name, values, dimensions):
        values = np.asarray(values)
        if values.ndim == 0:
            kind, rows = "volScalarField", f"uniform {values:.9g}"
        else:
            vector = values.ndim == 2
            kind = "volVectorField" if vector else "volScalarField"
            text = [("(%.9g %.9g %.9g)" % tuple(v)) if vector else "%.9g" % v for v in values]
            rows = (f"nonuniform List<{'vector' if vector else 'scalar'}>\n{len(text)}\n(\n"
                    + "\n".join(text) + "\n)\n")
        self.write(f"{time}/{name}", kind,
                   f"dimensions [{dimensions}];\ninternalField {rows};\nboundaryField\n{{\n}}\n")


def random_gas(case, time, seed, up=2, kinematic=True, temperature=True, voidage="voidfraction"):
    """Rough fields: what is averaged wrongly shows."""
    rng = np.random.default_rng(seed)
    count = len(case.centres)
    height = case.centres[:, up]
    eps = rng.uniform(0.4, 1, count)
    case.field(time, voidage, 1 - eps if voidage == "alpha.particles" else eps, "0 0 0 0 0 0 0")
    case.field(time, "U", rng.normal(0, 1, (count, 3)) + 5 * np.eye(3)[up], "0 1 -1 0 0 0 0")
    pressure = rng.normal(0, 20, count) + 900 * (height.max() - height)
    case.field(time, "p", pressure, "0 2 -2 0 0 0 0" if kinematic else "1 -1 -2 0 0 0 0")
    if temperature:
        case.field(time, "T", rng.uniform(300, 400, count), "0 0 0 1 0 0 0")
