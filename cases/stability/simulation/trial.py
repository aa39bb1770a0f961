# SPDX-License-Identifier: BSD-3-Clause
"""A scene that is checked, made into decks and run, with what came out: all as a user does it.

The programs are `bedscope`, `bedscope-coupled`, Debian's `liggghts` and `blockMesh`; BEDSCOPE and BEDSCOPE_COUPLED
name the first two where they are not on the path.
"""
import json
import math
import os
import pathlib
import re
import shutil
import subprocess

BEDSCOPE = os.environ.get("BEDSCOPE", "bedscope")
COUPLED = os.environ.get("BEDSCOPE_COUPLED", "bedscope-coupled")
ENV = dict(os.environ, WM_PROJECT_DIR=os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam"),
           OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def have_liggghts():
    return shutil.which("liggghts") is not None


def have_coupled():
    return shutil.which(COUPLED) is not None and shutil.which("blockMesh") is not None


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    if isinstance(value, float):
        return repr(float(value))
    return json.dumps(value)


class Trial:
    """A scene in a folder of its own; `tables` are those of docs/scenes.md, `species` one or a list of them."""

    def __init__(self, folder, **tables):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        species = tables.pop("species")
        if isinstance(species, dict):
            species = [species]
        self.tables = dict(tables, species=species)
        self.scene = self.folder / "scene.toml"
        self.scene.write_text("".join(f"{k} = {toml(v)}\n" for k, v in self.tables.items()))
        self.case = self.folder / "case"

    def shell(self, *words, where=None, fails=False):
        done = subprocess.run([str(w) for w in words], cwd=where, env=ENV, capture_output=True, text=True,
                              errors="replace")
        if done.returncode and not fails:
            raise RuntimeError(f"{words}: exit {done.returncode}\n{done.stdout[-1500:]}{done.stderr[-1500:]}")
        return done

    def check(self):
        """What `bedscope case check` says: its numbers, and its limits by name."""
        told = json.loads(self.shell(BEDSCOPE, "case", "check", self.scene, "--json").stdout)
        return told["numbers"], {limit["name"]: limit for limit in told["limits"]}

    def warned(self, *names):
        """Whether a limit of these names is passed; every one of them must be there."""
        limits = self.check()[1]
        return any(not limits[name]["ok"] for name in names)

    def make(self):
        self.shell(BEDSCOPE, "case", "make", self.scene, "-o", self.case, "--quiet", "--force")
        return self

    def run_particles(self):
        """LIGGGHTS alone. It may fail: particles that are lost are missing in the dumps."""
        return self.shell("liggghts", "-in", "DEM/in.liggghts", where=self.case, fails=True)

    def run_coupled(self):
        """The coupled solver; its exit code is 2 where the gas blew up or particles were lost."""
        properties = self.case / "CFD/constant/coupledProperties"  # these runs are too short to be gone on with
        properties.write_text(re.sub(r"checkpoint [^;]*;", "checkpoint 0;", properties.read_text()))
        self.shell("blockMesh", "-case", "CFD", where=self.case)
        return self.shell(COUPLED, where=self.case, fails=True)

    def change(self, file, old, new):
        path = self.case / file
        text = path.read_text()
        if old not in text:
            raise RuntimeError(f"{path}: no '{old}'")
        path.write_text(text.replace(old, new))

    def move(self, to):
        """Puts the spheres of the deck elsewhere: to(x, y, z), in the order of their ids."""
        path = self.case / "DEM/particles.data"
        head, atoms, rest = re.match(r"(.*?\nAtoms\n\n)(.*?)(\n\n.*|\n)$", path.read_text(), re.S).groups()
        rows = []
        for row in atoms.splitlines():
            words = row.split()
            rows.append(" ".join(words[:4] + [repr(x) for x in to(*map(float, words[4:7]))]))
        path.write_text(head + "\n".join(rows) + rest)

    def throw(self, velocity):
        """Gives each sphere of the deck another velocity: velocity(). The scene must have given them one."""
        path = self.case / "DEM/particles.data"
        head, rows = path.read_text().split("\nVelocities\n\n")
        rows = [" ".join([row.split()[0]] + [repr(v) for v in velocity()] + ["0 0 0"]) for row in rows.splitlines()]
        path.write_text(head + "\nVelocities\n\n" + "\n".join(rows) + "\n")

    def steps(self):
        found = (re.fullmatch(r"dump(\d+)\.liggghts_run", p.name) for p in (self.case / "DEM/post").iterdir())
        return sorted(int(m.group(1)) for m in found if m)

    def dump(self, step):
        """Rows of a dump as dicts, by id."""
        lines = (self.case / f"DEM/post/dump{step}.liggghts_run").read_text().splitlines()
        names = lines[8].split()[2:]
        rows = [dict(zip(names, map(float, line.split()))) for line in lines[9:]]
        return {int(row["id"]): row for row in rows}

    def times(self):
        """Of the fields that were written, and their folders: a name may be rounded."""
        folders = (p for p in (self.case / "CFD").iterdir() if re.fullmatch(r"[0-9.e-]+", p.name) and p.name != "0")
        return {float(p.name): p for p in sorted(folders, key=lambda p: float(p.name)) if (p / "U").exists()}

    def field(self, time, name):
        """Cell values of an ascii field in the order of the mesh, numbers or tuples."""
        near = min(self.times().items(), key=lambda item: abs(item[0] - time))
        if abs(near[0] / time - 1) > 1e-6:
            raise RuntimeError(f"{self.case}: no fields at {time} s")
        text = (near[1] / name).read_text()
        inner = text.split("internalField")[1]
        count = math.prod(self.tables["numerics"]["grid"])
        if inner.lstrip().startswith("uniform"):
            return [self.number(inner.split("uniform")[1].split(";")[0].strip())] * count
        body = inner.split("(", 1)[1].split(";")[0].rstrip()[:-1]
        return [self.number(word) for word in re.findall(r"\([^()]*\)|[^\s()]+", body)]

    @staticmethod
    def number(word):
        return tuple(map(float, word[1:-1].split())) if word.startswith("(") else float(word)

    def ascii_fields(self):
        self.change("CFD/system/controlDict", "writeFormat       binary;", "writeFormat       ascii;")
        return self

    def record(self):
        return json.loads((self.case / "run.json").read_text())
