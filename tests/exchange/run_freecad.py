"""Run the macro for FreeCAD in FreeCAD: see README.md.

The variable PROGRAM names the built Batten. It ends with 1 if anything is wrong.
"""

import os
import pathlib
import sys
import tempfile
import traceback

import FreeCAD
import Part

HERE = pathlib.Path(os.environ.get("CHECKS", "tests/exchange")).resolve()
MACRO = HERE.parents[1] / "assets/hosts/freecad/EditInBatten.FCMacro"
SAMPLES = 21
TOLERANCE = 1e-9


def sampled(edge):
    first, last = edge.ParameterRange
    steps = (first + (last - first) * place / (SAMPLES - 1) for place in range(SAMPLES))
    return [edge.valueAt(step) for step in steps]


def is_same(one, other):
    turned = max(abs(a - b) for a, b in zip(one.Rotation.Q, other.Rotation.Q))
    return (one.Base - other.Base).Length < 1e-12 and turned < 1e-12


def curve():
    spline = Part.BSplineCurve()
    poles = [(0, 0, 0), (1, 2, 0.5), (3, 2, 1), (4, 0, 0), (6, -1, 0.25)]
    spline.buildFromPolesMultsKnots([FreeCAD.Vector(*it) for it in poles], [4, 1, 4], [0, 1, 2], False, 3)
    return spline.toShape()


def check():
    sys.path.insert(0, str(HERE))
    from host import made_host

    macro = {"__name__": "macro"}
    exec(compile(MACRO.read_text(encoding="utf-8"), str(MACRO), "exec"), macro)
    document = FreeCAD.newDocument("check")
    item = document.addObject("Part::Feature", "Deck")
    item.Label = "The deck"
    item.Shape = curve()
    item.Placement = FreeCAD.Placement(FreeCAD.Vector(5, -3, 2), FreeCAD.Rotation(FreeCAD.Vector(1, 2, 3), 40))
    before, placement = sampled(item.Shape.Edges[0]), item.Placement
    with tempfile.TemporaryDirectory() as folder:
        os.environ["BATTEN"] = str(made_host(folder, os.environ["PROGRAM"]))
        os.environ["DOES"] = "close"
        assert macro["edit"](item) is None, "what was not saved comes back"
        os.environ["DOES"] = "fail"
        try:
            macro["edit"](item)
        except OSError as error:
            assert "the window has failed" in str(error), error
        else:
            raise AssertionError("a failure is not told")
        os.environ["DOES"] = "move"
        assert macro["edit"](item) is item, "another object"
        assert item.Label == "The deck" and is_same(item.Placement, placement), "label or placement"
        after = sampled(item.Shape.Edges[0])
        off = max((a - b - FreeCAD.Vector(1, 0, 0)).Length for a, b in zip(after, before))
        assert off < TOLERANCE, "%g off" % off
        line = document.addObject("Part::Line", "Line")
        document.recompute()
        added = macro["edit"](line)
        assert added is not None and added.Name != line.Name and len(added.Shape.Edges) == 1, "no new object"
    print("FreeCAD: all curves come back")


try:
    check()
    code = 0
except BaseException:
    traceback.print_exc()
    code = 1
sys.stdout.flush()
# FreeCAD ends with 0 whatever a script does, and may hang.
os._exit(code)
