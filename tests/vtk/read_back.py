#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a series that VTKExporter wrote with VTK's own reader and checks what is in it.

usage: read_back.py SERIES.pvd [--points N] [--cells N] [--frames N] [--field NAME[:COMPONENTS]]...

Every frame must have so many points and cells, finite coordinates and the named point fields with
finite values; the times must rise. Prints one line a frame; ends with 1 at the first difference.
"""
import argparse
import os
import sys
import xml.etree.ElementTree as ElementTree

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
import numpy


def fail(text):
    sys.exit(f"read_back: {text}")


def read(path):
    surface = path.endswith(".vtp")
    reader = vtkXMLPolyDataReader() if surface else vtkXMLUnstructuredGridReader()
    if not reader.CanReadFile(path):
        fail(f"{path}: VTK cannot read it")
    reader.SetFileName(path)
    reader.Update()
    if reader.GetErrorCode():
        fail(f"{path}: VTK error {reader.GetErrorCode()}")
    return reader.GetOutput()


def check(path, options):
    data = read(path)
    points, cells = data.GetNumberOfPoints(), data.GetNumberOfCells()
    if options.points is not None and points != options.points:
        fail(f"{path}: {points} points instead of {options.points}")
    if options.cells is not None and cells != options.cells:
        fail(f"{path}: {cells} cells instead of {options.cells}")
    if points == 0 or cells == 0:
        fail(f"{path}: {points} points, {cells} cells")
    if not numpy.isfinite(vtk_to_numpy(data.GetPoints().GetData())).all():
        fail(f"{path}: coordinates that are not finite")
    largest = {}
    for wanted in options.field:
        name, _, components = wanted.partition(":")
        array = data.GetPointData().GetArray(name)
        if array is None:
            fail(f"{path}: no field '{name}'")
        if components and array.GetNumberOfComponents() != int(components):
            fail(f"{path}: '{name}' has {array.GetNumberOfComponents()} components")
        values = vtk_to_numpy(array)
        if len(values) != points or not numpy.isfinite(values).all():
            fail(f"{path}: '{name}' has {len(values)} values, or some that are not finite")
        largest[name] = float(numpy.abs(values).max())
    return points, cells, largest


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("series")
    parser.add_argument("--points", type=int)
    parser.add_argument("--cells", type=int)
    parser.add_argument("--frames", type=int)
    parser.add_argument("--field", action="append", default=[])
    options = parser.parse_args()
    frames = ElementTree.parse(options.series).getroot().findall("./Collection/DataSet")
    if not frames or (options.frames is not None and len(frames) != options.frames):
        fail(f"{options.series}: {len(frames)} frames")
    before = None
    for frame in frames:
        time = float(frame.get("timestep"))
        if before is not None and time <= before:
            fail(f"{options.series}: time {time} after {before}")
        before = time
        path = os.path.join(os.path.dirname(options.series), frame.get("file"))
        points, cells, largest = check(path, options)
        print(f"{time:.6g} s: {points} points, {cells} cells, largest {largest}")


main()
