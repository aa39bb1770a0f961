#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""One cloud of 40 particles in every container that VTK 9.1 writes; the test knows the formulas.

Needs python3-vtk9. Blocks of 256 bytes, so that compressed arrays have several and a short last one.
"""
import os

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

os.chdir(os.path.dirname(os.path.abspath(__file__)))
N = 40
i = numpy.arange(N)


def array(name, values):
    result = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    result.SetName(name)
    return result


cloud = vtk.vtkPolyData()
points = vtk.vtkPoints()
points.SetData(array("Points", numpy.stack([0.01 * i, -0.02 * i, 1 / (i + 1)], 1).astype("f4")))
cloud.SetPoints(points)
cells = vtk.vtkCellArray()
for k in range(N):
    cells.InsertNextCell(1, [k])
cloud.SetVerts(cells)
for field in [
    array("id", (7 * i + 1).astype("i4")),
    array("type", (1 + i % 2).astype("i4")),
    array("v", numpy.stack([0.1 * i, -0.3 * i, numpy.sqrt(i)], 1)),
    array("radius", 0.001 + 1e-5 * i),
    array("f_Temp[0]", (300 + i / 3).astype("f4")),
    array("stress", numpy.arange(9 * N).reshape(N, 9) / 7),
    array("int8", (i - 100).astype("i1")),
    array("uint8", (i + 200).astype("u1")),
    array("int16", (-600 * i).astype("i2")),
    array("uint16", (1300 * i).astype("u2")),
    array("uint32", (80000000 * i).astype("u4")),
    array("int64", (-(2**53) - i).astype("i8")),
    array("uint64", (2**63 + 4096 * i.astype("u8")).astype("u8")),
]:
    cloud.GetPointData().AddArray(field)
time = array("TimeValue", numpy.array([0.125]))
cloud.GetFieldData().AddArray(time)

grid = vtk.vtkUnstructuredGrid()
grid.SetPoints(points)
grid.SetCells(vtk.VTK_VERTEX, cells)
grid.GetPointData().ShallowCopy(cloud.GetPointData())
grid.GetFieldData().AddArray(time)


def write(name, mode, compressor=None, base64=True, big=False, wide=False, data=cloud):
    is_grid = data.IsA("vtkUnstructuredGrid")
    writer = vtk.vtkXMLUnstructuredGridWriter() if is_grid else vtk.vtkXMLPolyDataWriter()
    writer.SetFileName(name)
    writer.SetInputData(data)
    getattr(writer, "SetDataModeTo" + mode)()
    getattr(writer, "SetCompressorTypeTo" + (compressor or "None"))()
    writer.SetEncodeAppendedData(base64)
    writer.SetBlockSize(256)
    if big:
        writer.SetByteOrderToBigEndian()
    (writer.SetHeaderTypeToUInt64 if wide else writer.SetHeaderTypeToUInt32)()
    writer.Write()


write("ascii.vtp", "Ascii")
write("ascii.vtu", "Ascii", data=grid)
write("inline.vtp", "Binary")
write("inline_wide.vtp", "Binary", wide=True)
write("inline_big_endian.vtp", "Binary", big=True)
write("inline_zlib.vtp", "Binary", "ZLib")
write("inline_zlib_wide_big_endian.vtu", "Binary", "ZLib", big=True, wide=True, data=grid)
write("inline_lz4.vtp", "Binary", "LZ4")
write("inline_lzma.vtp", "Binary", "LZMA")
write("appended_raw.vtp", "Appended", base64=False)
write("appended_raw_big_endian.vtp", "Appended", base64=False, big=True)
write("appended_base64.vtp", "Appended")
write("appended_base64_zlib.vtp", "Appended", "ZLib")
write("appended_raw_zlib_wide.vtu", "Appended", "ZLib", base64=False, wide=True, data=grid)
write("appended_raw_lz4.vtp", "Appended", "LZ4", base64=False)
write("appended_raw_lzma.vtp", "Appended", "LZMA", base64=False)
