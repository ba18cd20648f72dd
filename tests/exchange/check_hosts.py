"""Check what the scripts for Rhino and Blender send to Batten and take back, without these programs.

    check_hosts.py BATTEN

The script for Rhino works on objects of rhino3dm, which has the classes of RhinoCommon. The add-on of Blender works on
splines made here. In the place of the window is a script that moves every curve by 1 in x, through BATTEN's own
reader and writer, or ends without saving.

It needs what requirements.txt lists, and ends with 1 if anything is wrong.
"""

import importlib.util
import os
import pathlib
import sys
import tempfile
import types

import numpy as np
import rhino3dm
from scipy.interpolate import BSpline

from host import made_host

HOSTS = pathlib.Path(__file__).parents[2] / "assets/hosts"
ROUNDING = 1e-12
SINGLE = 1e-6  # of single precision, with a margin

failures = []


def check(condition, what):
    if not condition:
        failures.append(what)
        print("wrong:", what)


def script(folder):
    spec = importlib.util.spec_from_file_location(f"{folder}_batten", HOSTS / folder / "batten_edit.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def raises(call):
    try:
        call()
    except OSError as error:
        return str(error)
    return None


# Rhino.

def rhino_curve(rows, degree=3):
    points = rhino3dm.Point3dList([rhino3dm.Point3d(*row) for row in rows])
    return rhino3dm.NurbsCurve.Create(False, degree, points)


def sampled(curve):
    domain = curve.Domain
    points = [curve.PointAt(float(it)) for it in np.linspace(domain.T0, domain.T1, 33)]
    return np.array([[it.X, it.Y, it.Z] for it in points])


def check_rhino():
    rhino = script("rhino")
    rows = [(0, 0, 0), (1, 2, 0.5), (3, 2, 1), (4, 0, 0), (6, -1, 0.25)]
    circle = rhino3dm.Circle(rhino3dm.Point3d(1, 2, 0), 3.0)
    arc = rhino3dm.ArcCurve.CreateFromCircle(circle) if hasattr(rhino3dm.ArcCurve, "CreateFromCircle") else None
    shapes = [rhino_curve(rows), rhino_curve(rows[:4])] + ([arc] if arc else [])
    labels = ["deck", "", ""][: len(shapes)]
    names = rhino.names_for(labels)
    check(names == ["deck", "curve", "curve 2"][: len(shapes)], f"Rhino: the names are {names}")
    check(rhino.names_for(["a", "a 2", "a"]) == ["a", "a 2", "a 3"], "Rhino: names collide")
    curves = list(zip(names, shapes))
    for unit, step in (("Millimeters", 1.0), ("Inches", 1.0), ("Feet", 1 / 304.8)):
        os.environ["DOES"] = "move"
        system = getattr(rhino3dm.UnitSystem, unit)
        results = rhino.edit(rhino3dm, system, curves)
        own, new = rhino.paired(names, results)
        check(not new and all(own), f"Rhino, {unit}: {[name for name, _ in results]} came back")
        for name, before, after in zip(names, shapes, own):
            expected = sampled(before.ToNurbsCurve()) + [step, 0, 0]
            off = np.abs(sampled(after) - expected).max() if after else np.inf
            check(off < 1e-9, f"Rhino, {unit}: {name} is {off} off")
    millimetres = rhino3dm.UnitSystem.Millimeters
    os.environ["DOES"] = "close"
    check(rhino.edit(rhino3dm, millimetres, curves) is None, "Rhino: what was not saved comes back")
    for does, told in (("fail", "the window has failed"), ("kill", "ended with -9")):
        os.environ["DOES"] = does
        message = raises(lambda: rhino.edit(rhino3dm, millimetres, curves))
        check(message and told in message, f"Rhino, {does}: the message is {message}")
    results = [("b", 1), ("new", 2), ("more", 3)]
    check(rhino.paired(["a", "b"], results) == ([2, 1], [3]), "Rhino: curves are paired wrongly")


# Blender.

class Vector(tuple):
    """As much of mathutils.Vector as the add-on uses."""

    def __new__(cls, values):
        return super().__new__(cls, values)

    def to_3d(self):
        return Vector(self[:3])


class Matrix:
    """A scale and a step."""

    def __init__(self, scale, step):
        self.scale, self.translation = np.array(scale), Vector(step)

    def __matmul__(self, at):
        return Vector(self.scale * np.array(at) + np.array(self.translation))

    def inverted(self):
        return Matrix(1 / self.scale, -np.array(self.translation) / self.scale)


class Points(list):
    def __init__(self, width):
        super().__init__()
        self.width = width
        self.add(1)

    def add(self, count):
        zero = Vector([0.0] * self.width)
        self += [types.SimpleNamespace(co=zero, handle_left=zero, handle_right=zero) for _ in range(count)]


class Splines(list):
    def new(self, kind):
        spline = types.SimpleNamespace(type=kind, use_cyclic_u=False, use_endpoint_u=False, order_u=4, material_index=0)
        spline.points, spline.bezier_points = Points(4), Points(3)
        self.append(spline)
        return spline


def nurbs(splines, rows, order=4, weights=None, endpoint=True, cyclic=False):
    spline = splines.new("NURBS")
    spline.order_u, spline.use_endpoint_u, spline.use_cyclic_u = order, endpoint, cyclic
    spline.points.add(len(rows) - 1)
    for place, (point, row) in enumerate(zip(spline.points, rows)):
        point.co = Vector([*row, weights[place] if weights else 1.0])
    return spline


def bezier(splines, nodes):
    spline = splines.new("BEZIER")
    spline.bezier_points.add(len(nodes) - 1)
    for point, (left, at, right) in zip(spline.bezier_points, nodes):
        point.handle_left, point.co, point.handle_right = Vector(left), Vector(at), Vector(right)
    return spline


def blender_points(blender, spline):
    """Sample a spline in local coordinates, independently of the add-on's own evaluation."""
    curve = blender.of_spline(spline, "curve", lambda at: [float(value) for value in at[:3]])
    weights = np.array(curve["weights"] or np.ones(len(curve["points"])))
    homogeneous = np.column_stack([np.array(curve["points"]) * weights[:, None], weights])
    degree, knots = curve["degree"], np.array(curve["knots"])
    ends = knots[degree], knots[len(weights)]
    values = BSpline(knots, homogeneous, degree)(np.linspace(*ends, 101))
    return values[:, :3] / values[:, 3:]


def check_blender():
    bpy = types.ModuleType("bpy")
    bpy.types = types.SimpleNamespace(AddonPreferences=object, Operator=object)
    bpy.props = types.SimpleNamespace(StringProperty=lambda **_: None)
    sys.modules["bpy"] = bpy
    blender = script("blender")
    rows = [(0, 0, 0), (1, 2, 0.5), (3, 2, 1), (4, 0, 0), (6, -1, 0.25), (7, 1, 0)]
    chain = [((-1, 0, 0), (0, 0, 0), (1, 1, 0)), ((2, 3, 0), (3, 3, 0), (4, 2, 0)), ((5, 0, 0), (6, 0, 0), (7, 0, 0))]
    makers = {
        "clamped": lambda splines: nurbs(splines, rows),
        "even": lambda splines: nurbs(splines, rows, endpoint=False),
        "degree 5": lambda splines: nurbs(splines, rows, order=6),
        "rational": lambda splines: nurbs(splines, rows, weights=[1, 2, 1, 0.5, 1, 1]),
        "cyclic": lambda splines: nurbs(splines, rows, cyclic=True),
        "Bézier": lambda splines: bezier(splines, chain),
    }
    program = os.environ["BATTEN"]
    for kind, make in makers.items():
        splines = Splines()
        before = blender_points(blender, make(splines))
        matrix = Matrix([2.0, 2.0, 2.0], [5.0, -3.0, 1.0])
        data = types.SimpleNamespace(splines=splines, dimensions="2D")
        target = types.SimpleNamespace(name="Curve", matrix_world=matrix, data=data)
        os.environ["DOES"] = "close"
        check(not blender.edit_object(target, program) and len(splines) == 1, f"Blender, {kind}: not saved, but changed")
        os.environ["DOES"] = "move"
        check(blender.edit_object(target, program), f"Blender, {kind}: it is not saved")
        check(len(splines) == 1, f"Blender, {kind}: {len(splines)} splines")
        # 1 in the world is 1/2 here.
        off = np.abs(blender_points(blender, splines[0]) - before - [0.5, 0, 0]).max()
        check(off < 1e-9, f"Blender, {kind}: {off} off")
    rng = np.random.default_rng(1)
    for degree in (6, 9):
        points = np.cumsum(rng.uniform(0.5, 1.5, (degree + 6, 3)), axis=0).tolist()
        curve = {"name": "high", "degree": degree, "points": points, "weights": None, "periodic": False,
                 "knots": blender.clamped(points, degree)}
        check(blender.form_of(curve) == "NEAR", f"Blender: degree {degree} is {blender.form_of(curve)}")
        splines = Splines()
        blender.add_spline(types.SimpleNamespace(splines=splines), curve, lambda at: Vector(at))
        exact = BSpline(curve["knots"], np.array(points), degree)(np.linspace(0, len(points) - degree, 2001))
        found = blender_points(blender, splines[0])
        off = max(np.linalg.norm(exact - it, axis=1).min() for it in found)
        limit = 10 * blender.TOLERANCE * blender.size_of(curve) + np.linalg.norm(np.diff(exact, axis=0), axis=1).max() / 2
        check(off < limit, f"Blender: degree {degree} is {off} off")
        for parameter in (0.0, 0.3, 1.0, 2.5, len(points) - degree):
            own, slope = blender.evaluated(curve, parameter)
            spline = BSpline(curve["knots"], np.array(points), degree)
            check(np.allclose(own, spline(parameter), atol=1e-12), f"Blender: a point at {parameter}")
            check(np.allclose(slope, spline.derivative()(parameter), atol=1e-9), f"Blender: a slope at {parameter}")


def main(batten):
    with tempfile.TemporaryDirectory() as temporary:
        os.environ["BATTEN"] = str(made_host(temporary, batten))
        check_rhino()
        check_blender()
    print("Rhino and Blender:", "failed" if failures else "all curves come back")
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
