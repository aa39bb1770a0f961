# SPDX-License-Identifier: BSD-3-Clause
"""Dumps of LIGGGHTS, a case of OpenFOAM and curves, written by hand: nothing of bedscope is used."""

import os

DIAMETER = 1.66e-3


class Run:
    """A run's folder of dumps; one snapshot a call."""

    def __init__(self, folder, top):
        self.folder, self.top = folder, top
        os.makedirs(folder, exist_ok=True)

    def snapshot(self, step, rows):
        """Rows: type, x, y, z, vz, temperature."""
        lines = [f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(rows)}\n"
                 f"ITEM: BOX BOUNDS ff ff ff\n0 0.07\n0 0.006\n0 {self.top}\n"
                 "ITEM: ATOMS id type x y z vx vy vz radius f_Temp[0] \n"]
        for k, (kind, x, y, z, vz, heat) in enumerate(rows):
            lines.append(f"{k + 1} {kind} {x:.9g} {y:.9g} {z:.9g} 0 0 {vz:.12g} {DIAMETER / 2} {heat:.12g} \n")
        with open(f"{self.folder}/dump{step}.liggghts_run", "w") as file:
            file.writelines(lines)


HEAD = "FoamFile\n{{\n    version 2.0;\n    format ascii;\n    class {};\n    location \"{}\";\n    object {};\n}}\n"


def foam_file(case, name, kind, body):
    path = f"{case}/{name}"
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write(HEAD.format(kind, os.path.dirname(name), os.path.basename(name)) + body)


def column_mesh(case, top, layers):
    """A column of one cell across, as many as `layers` high."""
    corners = [(x, y) for y in (0, 0.006) for x in (0, 0.07)]  # 0: --, 1: +-, 2: -+, 3: ++
    points = [f"({x} {y} {k * top / layers:.12g})" for k in range(layers + 1) for x, y in corners]

    def level(k, upwards):
        at = [4 * k, 4 * k + 1, 4 * k + 3, 4 * k + 2]
        return at if upwards else at[::-1]

    inner = [(k, k + 1, level(k + 1, True)) for k in range(layers - 1)]
    outer = [(0, level(0, False)), (layers - 1, level(layers, True))]
    for k in range(layers):
        for a, b in ((0, 1), (1, 3), (3, 2), (2, 0)):
            outer.append((k, [4 * k + a, 4 * k + b, 4 * k + 4 + b, 4 * k + 4 + a]))
    faces = [face for *_, face in inner] + [face for _, face in outer]
    lists = {"points": ("vectorField", points),
             "faces": ("faceList", ["4({} {} {} {})".format(*face) for face in faces]),
             "owner": ("labelList", [str(f[0]) for f in inner + outer]),
             "neighbour": ("labelList", [str(f[1]) for f in inner])}
    for name, (kind, rows) in lists.items():
        foam_file(case, "constant/polyMesh/" + name, kind,
                  f"{len(rows)}\n(\n" + "\n".join(rows) + "\n)\n")
    foam_file(case, "constant/polyMesh/boundary", "polyBoundaryMesh",
              f"1\n(\nwalls {{ type wall; nFaces {len(outer)}; startFace {len(inner)}; }}\n)\n")


def field(case, time, name, dimensions, values):
    kind = "vector" if isinstance(values[0], tuple) else "scalar"
    rows = ["({:.9g} {:.9g} {:.9g})".format(*v) if kind == "vector" else f"{v:.12g}" for v in values]
    foam_file(case, f"{time:g}/{name}", f"vol{kind.capitalize()}Field",
              f"dimensions [{dimensions}];\ninternalField nonuniform List<{kind}>\n{len(rows)}\n(\n"
              + "\n".join(rows) + "\n)\n;\nboundaryField\n{\n}\n")


def curve(folder, name, header, rows, uncertainty=0.0):
    """A reference with its sidecar; `uncertainty`: standard, of the ordinate."""
    os.makedirs(folder, exist_ok=True)
    with open(f"{folder}/{name}.csv", "w") as file:
        file.write(header + "\n")
        file.writelines(",".join(repr(v) for v in row) + "\n" for row in rows)
    with open(f"{folder}/{name}.toml", "w") as file:
        file.write('kind = "theory"\nmethod = "original"\nby = "formulas in cases/verification/make.py"\n'
                   f'abscissa_uncertainty = 0\nordinate_uncertainty = {uncertainty!r}\n')
