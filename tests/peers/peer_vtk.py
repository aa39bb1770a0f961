# SPDX-License-Identifier: BSD-3-Clause
"""Peer for legacy VTK (binary and ASCII): VTK's own reader + numpy + scipy. `peer_vtk.py FOLDER OUT`"""

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOLegacy import vtkPolyDataReader

import products


def read(path):
    reader = vtkPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    particles = reader.GetOutput()
    points = vtk_to_numpy(particles.GetPoints().GetData()).astype(float)
    velocity = vtk_to_numpy(particles.GetPointData().GetArray("v"))
    radius = vtk_to_numpy(particles.GetPointData().GetArray("radius"))
    return points[:, 0], points[:, 2], velocity[:, 0], velocity[:, 2], radius


products.main(read)
