# SPDX-License-Identifier: BSD-3-Clause
"""Cases for bedscope-coupled, small and made on the spot: a box of gas and a list of spheres."""
import csv
import json
import math
import os
import pathlib
import subprocess

PROGRAM = os.environ.get("BEDSCOPE_COUPLED", "bedscope-coupled")
ENV = dict(os.environ, WM_PROJECT_DIR=os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam"),
           OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
HEADER = "FoamFile {{ version 2.0; format ascii; class {0}; object {1}; }}\n"
PATCHES = {"left": "(0 4 7 3)", "right": "(1 2 6 5)", "front": "(0 1 5 4)", "back": "(3 7 6 2)",
           "inlet": "(0 3 2 1)", "outlet": "(4 5 6 7)"}
SIDES = ["left", "right", "front", "back"]

RISER = dict(density=2500.0, kn=1600.0, kt=514.0, restitution=0.96, wall_restitution=0.86, friction=0.15)


def dashpot(kn, mass, e):
    """LIGGGHTS' gamman of hooke/stiffness: per unit of effective mass [1/s]."""
    return -2 * math.log(e) * math.sqrt(kn / mass) / math.sqrt(math.pi**2 + math.log(e) ** 2)


class Case:
    def __init__(self, folder, size, cells, **options):
        self.folder, self.size, self.cells = pathlib.Path(folder), size, cells
        self.gas = dict(density=1.2, viscosity=1.8e-5)
        self.gravity, self.drag = 9.81, "beetstra"
        self.velocity, self.side_walls = 0.0, "slip"
        self.dt, self.dem_steps, self.end = 1e-4, 10, 0.1
        self.write_interval = None
        self.spheres = []  # (type, diameter, density, x, y, z[, vx, vy, vz])
        self.contacts = dict(RISER)
        self.moving, self.walls = True, True
        self.extra, self.start, self.dem, self.fields = "", "", "", {}
        self.heat, self.temperature = None, (300.0, 300.0)
        self.margin, self.dump_every = 0.0, 0
        self.schemes = {"U": "Gauss linearUpwind grad(U)", "T": "Gauss upwind"}
        self.closed, self.tolerance = False, 1e-9
        for key, value in options.items():
            if not hasattr(self, key):
                raise KeyError(key)
            setattr(self, key, value)

    def write(self):
        f = self.folder
        for name in ("DEM/post", "CFD/system", "CFD/constant", "CFD/0"):
            (f / name).mkdir(parents=True, exist_ok=True)
        self.put("CFD/system/blockMeshDict", "dictionary", self.mesh())
        end, dt = self.end, self.dt
        self.put("CFD/system/controlDict", "dictionary", f"""
application bedscope-coupled; startFrom startTime; startTime 0; stopAt endTime; endTime {end}; deltaT {dt};
writeControl runTime; writeInterval {self.write_interval or end}; writeFormat ascii; writePrecision 10;
timeFormat general; timePrecision 8; runTimeModifiable no;""")
        self.put("CFD/system/fvSchemes", "dictionary", f"""
ddtSchemes {{ default Euler; }} gradSchemes {{ default Gauss linear; }}
divSchemes {{ default Gauss linear; div(alphaPhi,U) {self.schemes['U']}; div(alphaPhi,T) {self.schemes['T']}; }}
laplacianSchemes {{ default Gauss linear orthogonal; }} interpolationSchemes {{ default linear; }}
snGradSchemes {{ default orthogonal; }}""")
        self.put("CFD/system/fvSolution", "dictionary", f"""
solvers
{{
    p {{ solver GAMG; smoother GaussSeidel; nFinestSweeps 1; nCellsInCoarsestLevel 50; directSolveCoarsest true; tolerance {self.tolerance}; relTol 0.02; }}
    pFinal {{ $p; tolerance {self.tolerance / 10}; relTol 0; }}
    U {{ solver smoothSolver; smoother symGaussSeidel; tolerance {self.tolerance}; relTol 0; }}
    T {{ solver PBiCGStab; preconditioner DILU; tolerance {self.tolerance}; relTol 0; }}
}}
cache {{ grad(U); }}
PISO {{ nCorrectors 2; nNonOrthogonalCorrectors 0; pRefCell 0; pRefValue 0; }}""")
        self.put("CFD/system/decomposeParDict", "dictionary",
                 "numberOfSubdomains 2; method simple; simpleCoeffs { n (1 1 2); delta 0.001; }")
        self.put("CFD/constant/coupledProperties", "dictionary", f"""
title "verification";
gas {{ density {self.gas['density']}; viscosity {self.gas['viscosity']}; }}
gravity (0 0 {-self.gravity}); drag {self.drag}; demSteps {self.dem_steps};
{self.heat or ''}
{self.extra}""")
        u = f"uniform (0 0 {self.velocity})"
        walls = "".join(f"{s} {{ type {self.side_walls}; }} " for s in SIDES)
        inlet = (f"inlet {{ type interstitialInletVelocity; inletVelocity {u}; alpha voidfraction; value {u}; }}\n"
                 "outlet { type pressureInletOutletVelocity; value uniform (0 0 0); }")
        if self.closed:
            inlet = "inlet { type slip; } outlet { type slip; }"
        self.field("U", "volVectorField", "[0 1 -1 0 0 0 0]", u, inlet + walls)
        fixed = "{ type fixedFluxExtrapolatedPressure; value uniform 0; } "
        self.field("p", "volScalarField", "[0 2 -2 0 0 0 0]", "uniform 0",
                   "inlet " + fixed + "".join(s + " " + fixed for s in SIDES) +
                   ("outlet " + fixed if self.closed else "outlet { type fixedValue; value uniform 0; }"))
        flat = "".join(f"{s} {{ type zeroGradient; }} " for s in PATCHES)
        self.field("voidfraction", "volScalarField", "[0 0 0 0 0 0 0]", "uniform 1", flat)
        if self.heat:
            start, entering = self.temperature
            self.field("T", "volScalarField", "[0 0 0 1 0 0 0]", f"uniform {start}",
                       flat.replace("inlet { type zeroGradient;", f"inlet {{ type fixedValue; value uniform {entering};"))
        self.write_dem()
        (f / "CFD/log.blockMesh").write_text(self.shell("blockMesh", "-case", "CFD"))
        return self

    def mesh(self):
        x, y, z = self.size
        corners = [(a, b, c) for c in (0, z) for a, b in ((0, 0), (x, 0), (x, y), (0, y))]
        kind = lambda name: "wall" if name in SIDES else "patch"
        return ("convertToMeters 1;\nvertices (" + " ".join("(%.12g %.12g %.12g)" % c for c in corners) + ");\n"
                + "blocks (hex (0 1 2 3 4 5 6 7) (%d %d %d) simpleGrading (1 1 1));\nedges ();\n" % self.cells
                + "boundary (" + "".join(f"{n} {{ type {kind(n)}; faces ({q}); }} " for n, q in PATCHES.items()) + ");")

    def write_dem(self):
        types = max([s[0] for s in self.spheres] + [1])
        wall = types + 1
        c, x, y, z = self.contacts, *self.size
        smallest = min([s[1] for s in self.spheres] + [1e9])
        m = self.margin or 2 * smallest
        data = ["spheres\n", f"{len(self.spheres)} atoms", f"{wall} atom types",
                f"{-m} {x + m} xlo xhi", f"{-m} {y + m} ylo yhi", f"{-m} {z + m} zlo zhi", "", "Atoms", ""]
        data += ["%d %d %.17g %.17g %.17g %.17g %.17g" % (n, *s[:6]) for n, s in enumerate(self.spheres, 1)]
        if any(len(s) > 6 for s in self.spheres):
            data += ["", "Velocities", ""]
            data += ["%d %.17g %.17g %.17g 0 0 0" % (n, *(s[6:9] if len(s) > 6 else (0, 0, 0)))
                     for n, s in enumerate(self.spheres, 1)]
        (self.folder / "DEM/particles.data").write_text("\n".join(data) + "\n")

        mass = {}
        for t, d, rho, *_ in self.spheres:
            mass.setdefault(t, rho * math.pi / 6 * d**3)
        def pairs(f):
            return " ".join("%.12g" % f(i, j) for i in range(1, wall + 1) for j in range(1, wall + 1))
        def gamma(i, j):
            inverse = sum(1 / mass[k] for k in (i, j) if k in mass) or 1 / min(mass.values(), default=1)
            e = c["wall_restitution"] if wall in (i, j) else c["restitution"]
            return dashpot(c["kn"], 1 / inverse, e)
        properties = {"coefficientRestitution": lambda i, j: c["restitution"], "kn": lambda i, j: c["kn"],
                      "kt": lambda i, j: c["kt"], "gamman": gamma, "gammat": lambda i, j: 0.0,
                      "coefficientFriction": lambda i, j: c["friction"]}
        text = f"""# LIGGGHTS 3.8.0
variable resumed index 0
variable restart index none
atom_style granular
atom_modify map array sort 0 0
communicate single vel yes
boundary f f f
newton off
units si
processors 1 1 *
if "${{resumed}} == 0" then "read_data DEM/particles.data" else "read_restart ${{restart}}"
neighbor {0.5 * smallest:g} bin
neigh_modify delay 0 binsize {max(2 * smallest, max(self.size) / 60):g}
"""
        for name, value in properties.items():
            text += f"fix {name} all property/global {name} peratomtypepair {wall} {pairs(value)}\n"
        if self.heat:
            capacity, conductivity = self.heat_solid
            text += f"fix cp all property/global thermalCapacity peratomtype {' '.join([str(capacity)] * wall)}\n"
            text += f"fix kp all property/global thermalConductivity peratomtype {' '.join([str(conductivity)] * wall)}\n"
        text += f"""pair_style gran model hooke/stiffness tangential history
pair_coeff * *
timestep {self.dt / self.dem_steps:.12g}
"""
        if self.gravity:
            text += f"fix gravity all gravity {self.gravity} vector 0 0 -1\n"
        if self.walls:
            for axis, high in zip("xyz", self.size):
                for at in (0, high):
                    if axis == "z" and at and self.walls != "lid":
                        continue
                    text += (f"fix wall_{axis}{'1' if at else '0'} all wall/gran model hooke/stiffness tangential history "
                             f"primitive type {wall} {axis}plane {at:.12g}\n")
        text += "fix cfd all couple/cfd couple_every 1000000 mpi\nfix drag all couple/cfd/force\n"
        if self.heat:
            text += (f"fix heat all heat/gran initial_temperature {self.solid_start}\n"
                     f"fix convection all couple/cfd/convection T0 {self.solid_start}\n")
        if self.moving:
            text += "fix integrate all nve/sphere\n"
        if self.start:
            text += 'if "${resumed} == 0" then ' + " ".join(f'"{line}"' for line in self.start.splitlines()) + "\n"
        text += self.dem
        if self.dump_every:
            text += (f"dump d all custom {self.dump_every} DEM/post/dump*.liggghts id type x y z vx vy vz radius\n"
                     'dump_modify d format "%d %d %.10g %.10g %.10g %.10g %.10g %.10g %.10g"\n')
        (self.folder / "DEM/in.liggghts").write_text(text)

    heat_solid, solid_start = (1000.0, 1.0), 300.0

    def put(self, path, kind, text):
        (self.folder / path).write_text(HEADER.format(kind, pathlib.Path(path).name) + text + "\n")

    def field(self, name, kind, dimensions, inside, patches):
        self.put(f"CFD/0/{name}", kind,
                 f"dimensions {dimensions};\ninternalField {inside};\nboundaryField\n{{\n{patches}\n}}")

    def shell(self, *words):
        done = subprocess.run(words, cwd=self.folder, env=ENV, text=True, capture_output=True)
        if done.returncode:
            raise RuntimeError(f"{words}: exit {done.returncode}\n{done.stdout[-1500:]}{done.stderr[-1500:]}")
        return done.stdout

    def run(self, *options, ranks=1, decompose=True):
        if ranks > 1 and decompose:
            self.shell("decomposePar", "-case", "CFD", "-force")
        if ranks > 1:  # a rank that waits gives its core away: other tests run beside it
            return self.shell("mpirun", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1",
                              "-n", str(ranks), PROGRAM, *options)
        return self.shell(PROGRAM, *options)

    def history(self):
        with open(self.folder / "history.csv") as file:
            return [{k.split(" [")[0]: float(v) for k, v in row.items()} for row in csv.DictReader(file)]

    def record(self):
        return json.loads((self.folder / "run.json").read_text())

    def read_field(self, time, name):
        """Cell values of an ascii field, a list of numbers or of tuples."""
        text = (self.folder / f"CFD/{time}/{name}").read_text()
        inner = text.split("internalField")[1]
        count = math.prod(self.cells)
        if inner.lstrip().startswith("uniform"):
            value = inner.split("uniform")[1].split(";")[0].strip()
            return [self.number(value)] * count
        body = inner.split("(", 1)[1].split("\n)\n")[0].strip().splitlines()
        return [self.number(line) for line in body]

    @staticmethod
    def number(text):
        text = text.strip()
        return tuple(map(float, text[1:-1].split())) if text.startswith("(") else float(text)

    def dump(self, step):
        """Rows of a dump as dicts, by id."""
        lines = (self.folder / f"DEM/post/dump{step}.liggghts").read_text().splitlines()
        at = next(n for n, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
        names = lines[at].split()[2:]
        rows = [dict(zip(names, map(float, line.split()))) for line in lines[at + 1:]]
        return {int(row["id"]): row for row in rows}
