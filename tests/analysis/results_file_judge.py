# SPDX-License-Identifier: BSD-3-Clause
"""Reads results.h5 of results_file_test.cpp with h5py and with VTK's own reader.

Usage: results_file_judge.py h5py|vtk|both-grids|guide FILE. Exit code 77: the module is not there.
The numbers expected are those of example_result.hpp, computed here again.
"""

import os
import re
import sys

import numpy as np

cells = np.arange(12.0)  # of 3 (lateral) x 1 x 4 (up), lateral fastest
seeds = {"all": 0.31, 'type 1, "heavy"': 0.17}


def judge_h5py(path):
    import h5py

    with h5py.File(path) as file:
        assert list(file["runs"]) == ["1", "2"]
        assert file["runs/2"].attrs["label"] == "K/2 é"
        run = file["runs/1"]
        assert run.attrs["label"] == "K = 1" and run.attrs["mapping"] == "exact"
        assert list(run["types"].asstr()[:]) == list(seeds)
        assert run["problems"].asstr()[0] == "dump.3: cut after 17 of 20 particles"
        assert run["inputs"].shape == (0,)
        assert run["grid/cells"][:].tolist() == [3, 1, 4]
        assert run["grid/max"][:].tolist() == [0.07, 0.006, 0.5]
        assert run["window"].attrs["snapshots"] == 3 and run["window"].attrs["to"] == 0.3
        assert run["estimates/inventory"][:].tolist() == [0.31, 0.001]
        assert run["estimates/inventory"].attrs["unit"] == "kg"
        assert np.isnan(run["estimates/mean_bed_voidage"][1])

        for name, seed in seeds.items():
            species = run["species"][name]
            assert species.attrs["type"] == name
            axial = species["axial"]
            assert np.allclose(axial["z"], 0.1 + 0.1 * (np.arange(4) + 0.5), rtol=1e-15)
            assert np.array_equal(axial["holdup"], seed / (3 + np.arange(4)))
            assert np.isnan(axial["velocity_z"][0]) and axial["velocity_z"][1] == -seed / 7
            assert axial["mass_flux_z_ci95"].attrs["unit"] == "kg/m2/s"
            assert species["lateral/2"].attrs["height"] == 0.45
            assert np.array_equal(species["lateral/2/holdup"], (seed + 1) / (3 + np.arange(3)))
            fields = species["fields"]
            assert fields["holdup"].shape == (4, 3)
            assert np.array_equal(np.ravel(fields["holdup"]), seed + cells)
            assert np.isnan(fields["velocity_x"][1, 2]) and not np.isnan(fields["holdup"][1, 2])
            assert fields["velocity_x"].attrs["unit"] == "m/s"
            assert species["temperature_pdf"][:].tolist() == [0, 0.5, 1.5, 2]

        inventory = run["inventory"]
        heavy = inventory["type"].asstr()[:] == 'type 1, "heavy"'
        assert inventory["particles"][:][heavy].tolist() == [50000, 50001, 50002, 50003]
        assert inventory["solids_mass"].attrs["unit"] == "kg"
        assert run["occurrence/clusters"][:].tolist() == [1, 2, 1, 1]
        assert run["temperature"].attrs["to"] == 380

        clusters = run["clusters"]
        assert clusters.attrs["min_area"] == 60e-6
        assert clusters["snapshot"][:].tolist() == [1, 1, 2, 3]
        assert clusters["x"][3] == 0.03 + 0.001 * 3 and clusters["x"].attrs["unit"] == "m"
        begin = clusters["parents_begin"][:]
        parents = [clusters["parents"][a:b].tolist() for a, b in zip(begin, begin[1:])]
        assert parents == [[], [], [1, 2], []]
        contours = run["contours"]
        assert contours["begin"][:].tolist() == [0, 4, 8, 12, 16, 19]
        assert contours["cluster"][:].tolist() == [0, 1, 2, 3, 3]
        assert contours["points"][10].tolist() == [0.01, 2.2]
        assert run["frames/holdup"].shape == (2, 4, 3) and run["frames/holdup"][1, 0, 0] == 0.25

        assert np.isnan(file["runs/2/inventory/time"][:]).all()  # its time is not known
        assert np.isnan(file["runs/2/clusters/time"][:]).all()
        assert np.isnan(file["runs/2/inventory/solids_mass"][:]).all()


def image(path):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader = vtkHDFReader()
    assert reader.CanReadFile(path)
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    assert data.GetClassName() == "vtkImageData"
    arrays = data.GetPointData()
    values = {
        arrays.GetArrayName(i): vtk_to_numpy(arrays.GetArray(i)).copy()
        for i in range(arrays.GetNumberOfArrays())
    }
    return data, values


def judge_vtk(path):
    data, values = image(path)
    assert data.GetExtent() == (0, 2, 0, 1, 0, 3), data.GetExtent()
    low, high = np.array(data.GetBounds()).reshape(3, 2).T
    # the outer points: centres of the outer cells across and up, the walls in depth
    assert np.allclose(low, [0.07 / 6, 0, 0.15], rtol=1e-14)
    assert np.allclose(high, [0.07 * 5 / 6, 0.006, 0.45], rtol=1e-14)
    assert len(values) == 2 * 2 * 5, sorted(values)
    names = {"holdup [K = 1]": 0.31, 'holdup of type 1, "heavy" [K = 1]': 0.17}
    names |= {"holdup [K_2 é]": 0.31}
    for name, seed in names.items():
        for j in range(2):  # front and back
            got = values[name].reshape(4, 2, 3)[:, j, :].ravel()
            assert np.array_equal(got, seed + cells), (name, got)
    assert np.isnan(values["velocity_z [K = 1]"]).sum() == 2
    point = data.FindPoint(0.07 * 5 / 6, 0, 0.25)  # cell (2, 0, 1)
    assert values["mass_flux_z [K = 1]"][point] == 1000 * (0.31 + 5)


def judge_both_grids(path):
    _, first = image(path)
    data, second = image(path.replace(".h5", "_2.h5"))
    assert sorted(first) == sorted(n.replace("[other grid]", "[first]") for n in second)
    assert data.GetExtent() == (0, 2, 0, 1, 0, 1)
    values = second["holdup [other grid]"]  # 3-D: 3 x 2 x 2 cells
    assert np.array_equal(values, 0.31 + cells)
    import h5py

    with h5py.File(path) as file:
        assert file["runs/2/species/all/fields/holdup"].shape == (2, 2, 3)


def judge_guide(path):
    """Runs the examples of docs/results.md."""
    guide = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs", "results.md")
    with open(guide, encoding="utf-8") as text:
        examples = re.findall(r"^```python\n(.*?)^```", text.read(), re.M | re.S)
    assert len(examples) == 2
    os.chdir(os.path.dirname(path))
    for example in examples:
        exec(example, {})


judges = {"h5py": judge_h5py, "vtk": judge_vtk, "both-grids": judge_both_grids, "guide": judge_guide}
try:
    judges[sys.argv[1]](sys.argv[2])
except ImportError as missing:
    print(missing)
    sys.exit(77)
