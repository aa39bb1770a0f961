# SPDX-License-Identifier: BSD-3-Clause
"""Holds `bedscope info --json --full` of OpenFOAM cases against VTK's own reader.

Usage: judge_openfoam.py BEDSCOPE CASE...; cases that are not there are left out. Exit code 77: VTK
or numpy is not there. VTK 9.1 keeps fields as float, so numbers agree to 1e-6; it does not read
surface fields, volVectorField::Internal with a name of two colons, or times that only have clouds.
"""

import csv
import json
import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
    from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader
except ImportError:
    sys.exit(77)


def vtk_case(folder, times):
    """Of each field all values of all times, and the volume of the cells at the first time."""
    reader = vtkOpenFOAMReader()
    reader.SetFileName(os.path.join(folder, "x.foam"))  # need not be there
    reader.SetSkipZeroTime(False)
    reader.UpdateInformation()
    reader.EnableAllCellArrays()
    named = vtk_to_numpy(reader.GetTimeValues())  # by the directories, not by uniform/time
    assert np.allclose(named, times, rtol=1e-6, atol=0), (named, times)
    fields, volume = {}, None
    for time in named:
        reader.UpdateTimeStep(time)
        grid = reader.GetOutput().GetBlock(0)
        if volume is None:
            sizes = vtkCellSizeFilter()
            sizes.SetInputData(grid)
            sizes.Update()
            volume = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume")).sum()
        data = grid.GetCellData()
        for k in range(data.GetNumberOfArrays()):
            values = vtk_to_numpy(data.GetArray(k)).reshape(grid.GetNumberOfCells(), -1)
            fields.setdefault(data.GetArrayName(k), []).append(values)
    return fields, volume


def judge(program, folder):
    told = subprocess.run([program, "info", "--json", "--full", folder], check=True,
                          capture_output=True, text=True)
    info = json.loads(told.stdout)
    fields, volume = vtk_case(folder, info["times"])
    # VTK cuts warped faces and polyhedra in its own way: off by 0.14 % of a bed whose walls are flat.
    tolerance = 1e-5 if info["mesh"]["kind"] == "rectilinear" else 2e-3
    assert abs(info["mesh"]["volume"] / volume - 1) < tolerance, (info["mesh"]["volume"], volume)
    judged = 0
    for field in info["fields"]:
        parts = fields.get(field["name"])
        if parts is None or len(parts) != field["times"]:
            continue  # VTK passes over it, or repeats it at times that lack it
        values = np.concatenate(parts).astype(float)
        scale = np.abs(values).max() + 1e-30
        order = [0, 1, 2, 3, 4, 5, 6, 7, 8][:values.shape[1]]
        if values.shape[1] == 6:  # VTK: xx yy zz xy yz xz; OpenFOAM: xx xy xz yy yz zz
            order = [0, 3, 5, 1, 4, 2]
        for got, column in zip(field["ranges"], values[:, order].T):
            for key, number in (("min", column.min()), ("max", column.max()),
                                ("mean", column.mean())):
                assert abs(got[key] - number) <= 1e-6 * scale, (field["name"], key, got, number)
        judged += 1
    return judged


def numbers(path):
    """Of an ascii list of scalars."""
    with open(path) as file:
        text = file.read()
    return np.array(text[text.index("(", text.rindex("}")) + 1:text.rindex(")")].split(), float)


def judge_cloud(program, folder, cloud, times):
    """Times, number and volume of the parcels through `analyse`, from the files of d alone."""
    with tempfile.TemporaryDirectory() as place:
        subprocess.run([program, "analyse", folder, "-o", place, "--tables-only", "--quiet"],
                       check=True)
        with open(os.path.join(place, "tables", "inventory.csv")) as file:
            rows = [row for row in csv.DictReader(file) if row["type"] == "all"]
    info = json.loads(subprocess.run([program, "info", "--json", folder], check=True,
                                     capture_output=True, text=True).stdout)
    box = np.prod(np.subtract(info["bounds"]["max"], info["bounds"]["min"]))
    assert np.allclose([float(row["time [s]"]) for row in rows], [float(t) for t in times])
    for row, time in zip(rows, times):
        d = numbers(os.path.join(folder, time, "lagrangian", cloud, "d"))
        assert int(row["particles"]) == len(d)
        holdup = np.sum(np.pi / 6 * d**3) / box
        assert abs(float(row["holdup [-]"]) / holdup - 1) < 1e-12, (row, holdup)


judged = {case: judge(sys.argv[1], case) for case in sys.argv[2:] if os.path.isdir(case)}
print(judged)
if not judged:
    sys.exit(77)
assert all(judged.values())
for case in judged:
    if case.endswith("of_ascii"):
        judge_cloud(sys.argv[1], case, "kinematicCloud", ["0.001", "0.002", "0.003"])
