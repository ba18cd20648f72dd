"""Ask the kernels of other programs whether files written by Batten hold what they should.

    check_kernels.py BATTEN FOLDER

For each NAME.batten of the folder, NAME.json is what `batten inspect` prints of it. Batten writes its curves as
STEP (AP214 and AP242), IGES, BREP and 3DM, which OpenCascade and openNURBS read: every curve must be there,
within 1e-11 of its size at 201 points, and valid. Batten reads each file back, with float knots too: float knots
give the same float vertices to the last bit, clamped ones the same curve.

It needs what requirements.txt lists, and ends with 1 if anything is wrong.
"""

import json
import pathlib
import subprocess
import sys

import numpy as np
import rhino3dm
from float_curve import curve_points, in_space
from OCP.BRep import BRep_Builder
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepTools import BRepTools
from OCP.GeomAbs import GeomAbs_BSplineCurve
from OCP.IGESControl import IGESControl_Reader
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_EDGE
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Shape
from scipy.interpolate import BSpline

ROUNDING = 2.0**-51
TOLERANCE = 1e-11  # of a curve's size
BACK = 1e-12  # of the size, for curves read back from clamped knots
SAMPLES = 201
HIGHEST_EVALUATED = 20  # OpenCascade's own evaluation loses digits above
MILLIMETRES = {None: 1.0, "mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}


def edges(shape):
    found, explorer = [], TopExp_Explorer(shape, TopAbs_EDGE)
    while explorer.More():
        edge = TopoDS.Edge_s(explorer.Current()) if hasattr(TopoDS, "Edge_s") else TopoDS.Edge(explorer.Current())
        curve = BRepAdaptor_Curve(edge)
        if curve.GetType() == GeomAbs_BSplineCurve and curve.Degree() > HIGHEST_EVALUATED:
            found.append(points_of_poles(curve.BSpline()))
            explorer.Next()
            continue
        places = np.linspace(curve.FirstParameter(), curve.LastParameter(), SAMPLES)
        points = [curve.Value(place) for place in places]
        found.append(np.array([[p.X(), p.Y(), p.Z()] for p in points]))
        explorer.Next()
    return found


def points_of_poles(spline):
    """Evaluate what the kernel holds: its own evaluation is off by 1e-10 at degree 25."""
    if spline.IsPeriodic():
        spline.SetNotPeriodic()
    poles = [spline.Pole(index) for index in range(1, spline.NbPoles() + 1)]
    weights = np.array([spline.Weight(index) for index in range(1, len(poles) + 1)])
    poles = np.array([[p.X(), p.Y(), p.Z()] for p in poles])
    knots = []
    for index in range(1, spline.NbKnots() + 1):
        knots += [spline.Knot(index)] * spline.Multiplicity(index)
    homogeneous = np.column_stack([poles * weights[:, None], weights])
    places = np.linspace(spline.FirstParameter(), spline.LastParameter(), SAMPLES)
    values = BSpline(np.array(knots), homogeneous, spline.Degree())(places)
    return values[:, :3] / values[:, 3:]


def by_opencascade(path):
    if path.suffix == ".brep":
        shape = TopoDS_Shape()
        BRepTools.Read_s(shape, str(path), BRep_Builder())
        return edges(shape)
    reader = IGESControl_Reader() if path.suffix == ".igs" else STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    return edges(reader.OneShape())


def by_opennurbs(path):
    found = []
    for item in rhino3dm.File3dm.Read(str(path)).Objects:
        curve = item.Geometry
        if not curve.IsValid:
            raise ValueError("a curve is not valid")
        places = np.linspace(curve.Domain.T0, curve.Domain.T1, SAMPLES)
        points = [curve.PointAt(place) for place in places]
        found.append(np.array([[p.X, p.Y, p.Z] for p in points]))
    return found


READERS = {
    "step": (by_opencascade, True),
    "ap242": (by_opencascade, True),
    "igs": (by_opencascade, True),
    "brep": (by_opencascade, True),
    "3dm": (by_opennurbs, False),
}


def problems(extension, path, inspected):
    read, in_millimetres = READERS[extension]
    factor = MILLIMETRES[inspected["unit"]] if in_millimetres else 1.0
    found, curves = read(path), inspected["curves"]
    if extension == "igs" and all(curve["degree"] == 1 for curve in curves):
        return  # OpenCascade cuts these at their knots
    if len(found) != len(curves):
        yield f"{len(found)} curves of {len(curves)}"
        return
    for number, (points, curve) in enumerate(zip(found, curves), start=1):
        expected = factor * curve_points(curve, SAMPLES)
        size = np.ptp(expected, axis=0).max()
        error = np.abs(points - expected).max() / size
        if not error <= TOLERANCE:
            yield f"curve {number} is off by {error:.2e} of its size"


def run(batten, *arguments):
    done = subprocess.run([batten, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode:
        raise ValueError(done.stderr.strip())
    return done.stdout


def problems_back(batten, path, inspected, exact):
    back = path.with_name(path.name + ".batten")
    run(batten, "convert", path, back, "--from-format", path.suffix[1:])
    found = json.loads(run(batten, "inspect", back))["curves"]
    if len(found) != len(inspected["curves"]):
        yield f"{len(found)} curves read back of {len(inspected['curves'])}"
        return
    for number, (curve, given) in enumerate(zip(found, inspected["curves"]), start=1):
        if exact:
            same = all(curve[key] == given[key] for key in ("degree", "periodic", "weights"))
            found_float, given_float = in_space(curve["float"]), in_space(given["float"])
            # 3DM holds points times their weights: a division rounds.
            room = ROUNDING * np.abs(given_float) if path.suffix == ".3dm" and given["weights"] else 0.0
            if not same or np.any(np.abs(found_float - given_float) > room):
                yield f"curve {number} is not read back to the bit"
            continue
        if curve["periodic"] != given["periodic"]:
            yield f"curve {number} is {'periodic' if curve['periodic'] else 'open'} when read back"
            continue
        # BREP is always in millimetres.
        factor = MILLIMETRES[inspected["unit"]] if path.suffix == ".brep" else 1.0
        expected = factor * curve_points(given, SAMPLES)
        error = np.abs(curve_points(curve, SAMPLES) - expected).max() / np.ptp(expected, axis=0).max()
        if not error <= BACK:
            yield f"curve {number} is off by {error:.2e} of its size when read back"


def main(batten, folder):
    wrong = 0
    projects = sorted(pathlib.Path(folder).glob("*.batten"))
    projects = [path for path in projects if path.with_suffix(".json").exists()]
    for project in projects:
        inspected = json.loads(project.with_suffix(".json").read_text(encoding="utf-8"))
        found = []
        for extension in READERS:
            path = project.with_suffix("." + extension)
            try:
                run(batten, "convert", project, path)
                found += [f"{extension}: {it}" for it in problems(extension, path, inspected)]
                found += [f"{extension}: {it}" for it in problems_back(batten, path, inspected, False)]
            except ValueError as error:
                found.append(f"{extension}: {error}")
        for extension in ("step", "igs", "3dm", "json", "obj"):
            path = project.with_name(f"{project.stem}-float.{extension}")
            try:
                run(batten, "convert", project, path, "--polygon", "float")
                found += [f"{extension} on float knots: {it}" for it in problems_back(batten, path, inspected, True)]
            except ValueError as error:
                found.append(f"{extension} on float knots: {error}")
        wrong += bool(found)
        for problem in found:
            print(f"{project.stem}: {problem}")
    print(f"{len(projects)} projects, {wrong} of them with problems")
    return 1 if wrong or not projects else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
