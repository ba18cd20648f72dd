#! python 3
"""Edit the selected curves of Rhino 8 in Batten.

The curves go to a temporary 3DM file as NURBS. Batten edits it, and what it saves replaces the same objects: layer,
name and attributes stay.
"""

import os
import shutil
import subprocess
import tempfile

SAVED, NOT_SAVED = 0, 3
VERSION = 7  # of the temporary file
MILLIMETRES = {"Microns": 1e-3, "Millimeters": 1.0, "Centimeters": 10.0, "Decimeters": 100.0, "Meters": 1000.0,
               "Kilometers": 1e6, "Microinches": 25.4e-6, "Mils": 0.0254, "Inches": 25.4, "Feet": 304.8,
               "Yards": 914.4, "Miles": 1609344.0}


def unit_size(unit):
    """Return the millimetres of a unit system; None where it has no size."""
    return MILLIMETRES.get(str(unit).split(".")[-1])


def names_for(labels):
    """Give each curve a name of its own, from the names of the objects."""
    names, taken = [], set()
    for label in labels:
        base = name = label or "curve"
        number = 1
        while name in taken:
            number += 1
            name = f"{base} {number}"
        taken.add(name)
        names.append(name)
    return names


def send(library, file, unit, curves):
    """Write pairs of name and curve to a file. `library` is RhinoCommon, or rhino3dm, which has the same classes."""
    model = library.File3dm()
    model.Settings.ModelUnitSystem = unit
    for name, curve in curves:
        attributes = library.ObjectAttributes()
        attributes.Name = name
        model.Objects.Add(curve.ToNurbsCurve(), attributes)
    if not model.Write(file, VERSION):
        raise OSError(f"{file} cannot be written")


def receive(library, file, unit):
    """Read pairs of name and curve, in a unit."""
    model = library.File3dm.Read(file)
    if model is None:
        raise OSError(f"{file} cannot be read")
    sizes = unit_size(model.Settings.ModelUnitSystem), unit_size(unit)
    factor = 1.0 if None in sizes else sizes[0] / sizes[1]
    found = []
    for item in model.Objects:
        curve = item.Geometry.ToNurbsCurve() if hasattr(item.Geometry, "ToNurbsCurve") else None
        if curve is None:
            continue
        if factor != 1.0:
            curve.Scale(factor)
        found.append((item.Attributes.Name, curve))
    return found


def paired(names, results):
    """Return the curve of each name, or None, and the curves that are left: they first take missing places."""
    found = dict(results)
    own = [found.get(name) for name in names]
    new = [curve for name, curve in results if name not in names]
    for place, curve in enumerate(own):
        if curve is None and new:
            own[place] = new.pop(0)
    return own, new


def edit(library, unit, curves):
    """Edit pairs of name and curve in Batten. Returns the results, or None if nothing was saved."""
    program = os.environ.get("BATTEN") or shutil.which("batten")
    if not program:
        raise OSError("Batten is not found: set the variable BATTEN to its place")
    with tempfile.TemporaryDirectory(prefix="batten-") as folder:
        file = os.path.join(folder, "rhino.3dm")
        send(library, file, unit, curves)
        run = subprocess.run([program, "edit", "--alone", file], stderr=subprocess.PIPE, text=True, check=False)
        if run.returncode == NOT_SAVED:
            return None
        if run.returncode != SAVED:
            raise OSError(run.stderr.strip() or f"Batten has ended with {run.returncode}")
        return receive(library, file, unit)


def main():
    import Rhino
    import rhinoscriptsyntax as rs
    import scriptcontext

    class Library:
        File3dm = Rhino.FileIO.File3dm
        ObjectAttributes = Rhino.DocObjects.ObjectAttributes

    document = scriptcontext.doc
    ids = rs.GetObjects("Curves to edit in Batten", rs.filter.curve, preselect=True)
    if not ids:
        return
    objects = [document.Objects.FindId(it) for it in ids]
    names = names_for([it.Attributes.Name for it in objects])
    curves = [(name, it.Geometry) for name, it in zip(names, objects)]
    try:
        results = edit(Library, document.ModelUnitSystem, curves)
    except OSError as error:
        Rhino.RhinoApp.WriteLine(f"Nothing is changed: {error}")
        return
    if results is None:
        return
    own, new = paired(names, results)
    record = document.BeginUndoRecord("Edit in Batten")
    try:
        for item, curve in zip(objects, own):
            # Replacing keeps the attributes.
            if curve is not None:
                document.Objects.Replace(item.Id, curve)
        for curve in new:
            document.Objects.AddCurve(curve, objects[0].Attributes)
    finally:
        document.EndUndoRecord(record)
    document.Views.Redraw()


if __name__ == "__main__":
    main()
