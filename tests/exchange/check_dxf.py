"""Ask ezdxf whether DXF files written by Batten hold what they should.

    check_dxf.py FOLDER

For each NAME.dxf of the folder, NAME.json is what `batten inspect` prints of the curves that were
exported, in their order. Of every drawing is asked that

* the audit finds nothing to complain of and nothing to mend,
* the drawing is in the unit of the document, and in none where it has none,
* there is one SPLINE a curve, on clamped knots that start at 0, with the clamped vertices and
  weights to the last digit, and with the points of the float polygon's curve,
* every polyline is on a layer of its own and holds the vertices of its polygon to the last digit.

It needs what requirements.txt lists, and ends with 1 if anything is wrong.
"""

import json
import pathlib
import sys

import ezdxf
import numpy as np
from float_curve import curve_points, in_space
from scipy.interpolate import BSpline

UNITS = {None: 0, "in": 1, "mm": 4, "cm": 5, "m": 6}  # as $INSUNITS counts them
SAMPLES = 257
TOLERANCE = 1e-11  # of the curve's size
HIGHEST_EZDXF_DEGREE = 10  # ezdxf's compiled evaluation stops here
POLYGONS = {" float polygon": "float", " closed polygon": "clamped"}


def ezdxf_points(spline, last):
    tool = spline.construction_tool()
    return np.array([tuple(tool.point(t)) for t in np.linspace(0.0, last, SAMPLES)])


def scipy_points(spline, last):
    vertices = np.asarray(spline.control_points)
    weights = np.asarray(list(spline.weights) or np.ones(len(vertices)))
    homogeneous = np.column_stack([vertices * weights[:, None], weights])
    curve = BSpline(np.asarray(spline.knots), homogeneous, spline.dxf.degree)
    values = curve(np.linspace(0.0, last, SAMPLES))
    return values[:, :3] / values[:, 3:]


def spline_problems(spline, curve):
    degree, knots = spline.dxf.degree, np.asarray(spline.knots)
    vertices = in_space(curve["clamped"])
    if curve["periodic"]:
        vertices[-1] = vertices[0]
    last = curve["domain"][1]
    inner = np.arange(1.0, last)
    clamped = np.concatenate([np.zeros(degree + 1), inner, np.full(degree + 1, last)])
    if degree != curve["degree"]:
        yield f"degree {degree} instead of {curve['degree']}"
    if not np.array_equal(knots, clamped):
        yield f"the knots are {knots}"
    if not np.array_equal(np.asarray(spline.control_points), vertices):
        yield "the vertices differ from the clamped ones"
    if list(spline.weights) != (curve["clamped_weights"] or []):
        yield "the weights differ"
    if spline.dxf.n_knots != len(knots) or spline.dxf.n_control_points != len(vertices):
        yield "the counts are wrong"
    evaluations = {"scipy": scipy_points}
    if degree <= HIGHEST_EZDXF_DEGREE:
        evaluations["ezdxf"] = ezdxf_points
    expected = curve_points(curve, SAMPLES)
    size = np.ptp(in_space(curve["float"]), axis=0).max()
    for name, points in evaluations.items():
        error = np.abs(points(spline, last) - expected).max() / size
        if not error <= TOLERANCE:
            yield f"evaluated by {name}, the curve is off by {error:.2e} of its size"


def polyline_vertices(entity):
    if entity.dxftype() == "LWPOLYLINE":
        return in_space([point[:2] for point in entity.get_points()]), entity.closed
    return np.array([tuple(vertex.dxf.location) for vertex in entity.vertices]), entity.is_closed


def polyline_problems(entity, base, curve):
    for suffix, key in POLYGONS.items():
        if entity.dxf.layer == base + suffix:
            vertices, closed = polyline_vertices(entity)
            if not np.array_equal(vertices, in_space(curve[key])):
                yield f"the {key} polygon's vertices differ"
            if closed != (curve["periodic"] and key == "float"):
                yield f"the {key} polygon is {'closed' if closed else 'open'}"
            return
    yield f"a polyline is on layer {entity.dxf.layer!r}"


def problems(path, unit, curves):
    drawing = ezdxf.readfile(path)
    audit = drawing.audit()
    for entry in [*audit.errors, *audit.fixes]:
        yield f"audit: {entry.message}"
    if drawing.header.get("$INSUNITS") != UNITS[unit] or drawing.units != UNITS[unit]:
        yield f"the drawing is in unit {drawing.units}, not in {unit}"
    if drawing.header.get("$MEASUREMENT") != (0 if unit == "in" else 1):
        yield "the drawing is metric where it is not, or the other way"
    model = drawing.modelspace()
    splines = model.query("SPLINE")
    if len(splines) != len(curves):
        yield f"{len(splines)} splines for {len(curves)} curves"
        return
    bases = [spline.dxf.layer for spline in splines]
    polylines = model.query("LWPOLYLINE POLYLINE")
    layers = bases + [polyline.dxf.layer for polyline in polylines]
    if len({layer.lower() for layer in layers}) != len(layers):
        yield "two entities share a layer"
    for layer in layers:
        if layer not in drawing.layers:
            yield f"layer {layer!r} is not defined"
    if len(polylines) != len(POLYGONS) * len(curves):
        yield f"{len(polylines)} polylines for {len(curves)} curves"
    for number, (spline, curve) in enumerate(zip(splines, curves), start=1):
        for problem in spline_problems(spline, curve):
            yield f"curve {number}: {problem}"
    for index, polyline in enumerate(polylines):
        number = index // len(POLYGONS)
        for problem in polyline_problems(polyline, bases[number], curves[number]):
            yield f"curve {number + 1}: {problem}"


def main(folder):
    expected = sorted(pathlib.Path(folder).glob("*.json"))
    wrong = 0
    for path in expected:
        inspected = json.loads(path.read_text(encoding="utf-8"))
        curves, unit = inspected["curves"], inspected["unit"]
        found = list(problems(path.with_suffix(".dxf"), unit, curves))
        wrong += bool(found)
        for problem in found:
            print(f"{path.stem}: {problem}")
        if not found:
            count = "1 curve" if len(curves) == 1 else f"{len(curves)} curves"
            print(f"{path.stem}: {count} as it should be")
    return 1 if wrong or not expected else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
