"""Edit the active curve object of Blender in Batten.

The splines go to a temporary JSON file in the coordinates of the world. Batten edits it, and what it saves comes
back as the splines of the same object: name, collections, materials and transform stay.
"""

import json
import os
import shutil
import subprocess
import tempfile

import bpy

bl_info = {
    "name": "Edit in Batten",
    "author": "The Batten authors",
    "version": (0, 1, 0),
    "blender": (3, 6, 0),
    "location": "Object > Edit in Batten",
    "description": "Edit curves by their float S-polygons",
    "category": "Object",
}

SAVED, NOT_SAVED = 0, 3
HIGHEST = 5  # the degree of Blender's NURBS
TOLERANCE = 1e-5  # of the size: where curves become chains of Béziers; single precision has 6e-8
MOST_HALVINGS = 12


# Splines of Blender as B-splines: dictionaries as in the file.

def clamped(points, degree):
    """Return clamped, even knots."""
    inner = len(points) - degree
    return [min(max(place - degree, 0), inner) + 0.0 for place in range(len(points) + degree + 1)]


def bezier_chain(name, points):
    """Return a chain of cubics: every third point is a knot."""
    pieces = (len(points) - 1) // 3
    knots = [0.0] + [float(place) for place in range(pieces + 1) for _ in range(3)] + [float(pieces)]
    return {"name": name, "degree": 3, "knots": knots, "points": points, "weights": None, "periodic": False}


def of_spline(spline, name, place):
    """Return a spline, placed by a function; None if it has no length."""
    if spline.type == "BEZIER":
        nodes = list(spline.bezier_points)
        if spline.use_cyclic_u:
            nodes.append(nodes[0])
        points = []
        for before, after in zip(nodes, nodes[1:]):
            points += [place(before.co), place(before.handle_right), place(after.handle_left)]
        points.append(place(nodes[-1].co))
        return bezier_chain(name, points) if len(nodes) > 1 else None
    points = [place(point.co) for point in spline.points]
    weights = [point.co[3] for point in spline.points]
    degree = min(spline.order_u - 1, len(points) - 1) if spline.type == "NURBS" else 1
    if degree < 1:
        return None
    knots = clamped(points, degree)
    if spline.use_cyclic_u and degree == 1:
        points, weights = points + points[:1], weights + weights[:1]
        knots = clamped(points, degree)
    elif spline.use_cyclic_u:
        points, weights = points + points[:degree], weights + weights[:degree]
        knots = [float(place) for place in range(len(points) + degree + 1)]
    elif spline.type == "NURBS" and not spline.use_endpoint_u:
        knots = [float(place) for place in range(len(points) + degree + 1)]
    is_rational = spline.type == "NURBS" and any(weight != weights[0] for weight in weights)
    return {"name": name, "degree": degree, "knots": knots, "points": points,
            "weights": weights if is_rational else None, "periodic": bool(spline.use_cyclic_u and degree > 1)}


# B-splines as splines of Blender.

def evaluated(curve, parameter):
    """Return the point and the derivative at a parameter, by de Boor's algorithm in homogeneous coordinates."""
    degree, knots = curve["degree"], curve["knots"]
    weights = curve["weights"] or [1.0] * len(curve["points"])
    span = max(place for place in range(degree, len(weights)) if knots[place] <= parameter or place == degree)
    while span > degree and knots[span] == knots[span + 1]:
        span -= 1
    level = [[*(value * weights[place] for value in curve["points"][place]), weights[place]]
             for place in range(span - degree, span + 1)]
    slope = [0.0] * 4
    for step in range(1, degree + 1):
        below = level
        level = []
        for place in range(degree - step + 1):
            first = span - degree + step + place
            low, high = knots[first], knots[first + degree - step + 1]
            share = (parameter - low) / (high - low)
            level.append([(1 - share) * a + share * b for a, b in zip(below[place], below[place + 1])])
            if step == degree:
                slope = [degree * (b - a) / (high - low) for a, b in zip(below[0], below[1])]
    *point, weight = level[0]
    point = [value / weight for value in point]
    return point, [(slope[axis] - point[axis] * slope[3]) / weight for axis in range(3)]


def distance(first, second):
    return sum((a - b) ** 2 for a, b in zip(first, second)) ** 0.5


def size_of(curve):
    return max(max(axis) - min(axis) for axis in zip(*curve["points"])) or 1.0


def cubics(curve):
    """Return the points of a chain of cubics near a curve: halved until three points between are near enough."""
    degree, knots = curve["degree"], curve["knots"]
    limit = TOLERANCE * size_of(curve)
    ends = sorted(set(knots[degree:len(curve["points"]) + 1]))
    points = [evaluated(curve, ends[0])[0]]
    stack = [(low, high, 0) for low, high in reversed(list(zip(ends, ends[1:])))]
    while stack:
        low, high, halvings = stack.pop()
        # The derivatives of this piece, also where the next one has others.
        inset = 1e-9 * (high - low)
        (start, out), (end, into) = evaluated(curve, low), evaluated(curve, high - inset)
        end = evaluated(curve, high)[0] if high == ends[-1] else end
        third = (high - low) / 3
        corners = [start, [a + third * b for a, b in zip(start, out)],
                   [a - third * b for a, b in zip(end, into)], end]
        off = max(distance(bezier_point(corners, share), evaluated(curve, low + share * (high - low))[0])
                  for share in (0.25, 0.5, 0.75))
        if off > limit and halvings < MOST_HALVINGS:
            middle = (low + high) / 2
            stack += [(middle, high, halvings + 1), (low, middle, halvings + 1)]
        else:
            points += corners[1:]
    return points


def bezier_point(corners, share):
    rest = 1 - share
    factors = (rest ** 3, 3 * rest * rest * share, 3 * rest * share * share, share ** 3)
    return [sum(factor * corner[axis] for factor, corner in zip(factors, corners)) for axis in range(3)]


def form_of(curve):
    """Tell as what Blender holds a curve: as a spline of its own kind, or as a chain of cubics near it."""
    degree, knots, points = curve["degree"], curve["knots"], curve["points"]
    steps = [high - low for low, high in zip(knots, knots[1:])]
    step = knots[degree + 1] - knots[degree]
    is_even = all(abs(it - step) <= 1e-9 * abs(step) for it in steps)
    expected = [knots[degree] + step * it for it in clamped(points, degree)]
    is_clamped = all(abs(a - b) <= 1e-9 * abs(step) for a, b in zip(knots, expected))
    if degree == 1 and is_clamped and not curve["weights"]:
        return "POLY"
    inner = knots[degree + 1:-degree - 1]
    is_chain = degree == 3 and not curve["weights"] and len(points) % 3 == 1 and all(
        inner[place] == inner[place + 1] == inner[place + 2] for place in range(0, len(inner) - 2, 3))
    if is_chain and knots[:4] == knots[:1] * 4 and knots[-4:] == knots[-1:] * 4 and len(inner) % 3 == 0:
        return "BEZIER"
    if 2 <= degree <= HIGHEST and (is_clamped or is_even):
        return "CLAMPED" if is_clamped else "EVEN"
    return "NEAR"


def add_spline(data, curve, place):
    """Add a curve to the splines of Blender, placed by a function."""
    form = form_of(curve)
    points = curve["points"]
    if form in ("BEZIER", "NEAR"):
        points = points if form == "BEZIER" else cubics(curve)
        spline = data.splines.new("BEZIER")
        is_closed = len(points) > 4 and distance(points[0], points[-1]) <= 1e-9 * size_of(curve)
        nodes = (len(points) - 1) // 3 + (0 if is_closed else 1)
        spline.bezier_points.add(nodes - 1)
        for number, node in enumerate(spline.bezier_points):
            node.handle_left_type = node.handle_right_type = "FREE"
            node.co = place(points[3 * number])
            # The outer handles of open ends are free: they repeat the ends.
            left = 3 * number - 1 if number or not is_closed else len(points) - 2
            node.handle_left = place(points[max(left, 0)])
            node.handle_right = place(points[min(3 * number + 1, len(points) - 1)])
        spline.use_cyclic_u = is_closed
        return spline
    spline = data.splines.new("POLY" if form == "POLY" else "NURBS")
    weights = curve["weights"] or [1.0] * len(points)
    spline.points.add(len(points) - 1)
    for corner, point, weight in zip(spline.points, points, weights):
        corner.co = (*place(point), weight)
    if form != "POLY":
        spline.order_u = curve["degree"] + 1
        spline.use_endpoint_u = form == "CLAMPED"
    return spline


def edit(program, curves):
    """Edit curves in Batten. Returns the results, or None if nothing was saved."""
    with tempfile.TemporaryDirectory(prefix="batten-") as folder:
        file = os.path.join(folder, "blender.json")
        with open(file, "w", encoding="utf-8") as out:
            json.dump({"unit": None, "curves": curves}, out)
        run = subprocess.run([program, "edit", "--alone", file], stderr=subprocess.PIPE, text=True, check=False)
        if run.returncode == NOT_SAVED:
            return None
        if run.returncode != SAVED:
            raise OSError(run.stderr.strip() or f"Batten has ended with {run.returncode}")
        with open(file, encoding="utf-8") as read:
            return json.load(read)["curves"]


def edit_object(target, program):
    """Edit a curve object. Returns whether it was saved."""
    matrix = target.matrix_world
    inverse = matrix.inverted()
    to_world = lambda at: [float(value) for value in matrix @ at.to_3d()]
    to_local = lambda at: tuple(inverse @ type(matrix.translation)(at))
    splines = enumerate(target.data.splines, 1)
    curves = [of_spline(spline, f"{target.name} {number}", to_world) for number, spline in splines]
    curves = [curve for curve in curves if curve]
    if not curves:
        raise OSError("The object has no curves")
    results = edit(program, curves)
    if results is None:
        return False
    if not results:
        raise OSError("Batten has returned no curves")
    material = target.data.splines[0].material_index
    target.data.splines.clear()
    target.data.dimensions = "3D"
    for curve in results:
        add_spline(target.data, curve, to_local).material_index = material
    return True


class BattenPreferences(bpy.types.AddonPreferences):
    """Where Batten is."""

    bl_idname = __name__
    program: bpy.props.StringProperty(name="Program", subtype="FILE_PATH", description="Empty: found by itself")

    def draw(self, _context):
        self.layout.prop(self, "program")


class OBJECT_OT_edit_in_batten(bpy.types.Operator):
    """Edit the curves in Batten: save there and close its window to take them back"""

    bl_idname = "object.edit_in_batten"
    bl_label = "Edit in Batten"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "CURVE" and context.mode == "OBJECT"

    def execute(self, context):
        addon = context.preferences.addons.get(__name__)
        set_here = addon.preferences.program if addon else ""
        program = set_here or os.environ.get("BATTEN") or shutil.which("batten")
        if not program:
            self.report({"ERROR"}, "Batten is not found: set its place in the preferences of this add-on")
            return {"CANCELLED"}
        try:
            is_saved = edit_object(context.object, program)
        except OSError as error:
            self.report({"ERROR"}, f"Nothing is changed: {error}")
            return {"CANCELLED"}
        return {"FINISHED"} if is_saved else {"CANCELLED"}


def menu(self, _context):
    self.layout.operator(OBJECT_OT_edit_in_batten.bl_idname)


def register():
    bpy.utils.register_class(BattenPreferences)
    bpy.utils.register_class(OBJECT_OT_edit_in_batten)
    bpy.types.VIEW3D_MT_object.append(menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(menu)
    bpy.utils.unregister_class(OBJECT_OT_edit_in_batten)
    bpy.utils.unregister_class(BattenPreferences)


if __name__ == "__main__":
    register()
