"""Run the add-on of Blender in Blender: see README.md.

The variable PROGRAM names the built Batten. It ends with 1 if anything is wrong.
"""

import importlib.util
import os
import pathlib
import sys
import tempfile
import traceback

import bpy

HERE = pathlib.Path(__file__).parent.resolve()
ADDON = HERE.parents[1] / "assets/hosts/blender/batten_edit.py"
TOLERANCE = 1e-5  # Blender has single precision.


def corners(target):
    spline = target.data.splines[0]
    return [target.matrix_world @ point.co.to_3d() for point in spline.points]


def check():
    sys.path.insert(0, str(HERE))
    from host import made_host

    spec = importlib.util.spec_from_file_location("batten_edit", ADDON)
    addon = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(addon)
    addon.register()
    data = bpy.data.curves.new("Deck", "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("NURBS")
    rows = [(0, 0, 0), (1, 2, 0.5), (3, 2, 1), (4, 0, 0), (6, -1, 0.25)]
    spline.points.add(len(rows) - 1)
    for point, row in zip(spline.points, rows):
        point.co = (*row, 1)
    spline.order_u, spline.use_endpoint_u = 4, True
    target = bpy.data.objects.new("Deck", data)
    bpy.context.collection.objects.link(target)
    target.location, target.rotation_euler, target.scale = (5, -3, 2), (0.3, 0.2, 0.1), (2, 2, 2)
    bpy.context.view_layer.objects.active = target
    bpy.context.view_layer.update()
    before = corners(target)
    with tempfile.TemporaryDirectory() as folder:
        os.environ["BATTEN"] = str(made_host(folder, os.environ["PROGRAM"]))
        os.environ["DOES"] = "close"
        assert bpy.ops.object.edit_in_batten() == {"CANCELLED"}, "not saved, but changed"
        os.environ["DOES"] = "move"
        assert bpy.ops.object.edit_in_batten() == {"FINISHED"}, "it is not saved"
    after = corners(target)
    assert len(after) == len(before) and target.name == "Deck", "another object"
    off = max((a - b).length - 1 for a, b in zip(after, before))
    assert abs(off) < TOLERANCE, off
    assert all(abs(a.x - b.x - 1) < TOLERANCE for a, b in zip(after, before)), "another direction"
    print("Blender: all curves come back")


try:
    check()
    code = 0
except BaseException:
    traceback.print_exc()
    code = 1
sys.stdout.flush()
os._exit(code)
