#!/usr/bin/env python3
"""Edit the selected paths of Inkscape in Batten.

The paths go to a temporary SVG, 1 : 1 in millimetres. Batten edits it, and what it saves comes back into the
same paths: style, layer, label and transform stay.
"""

import copy
import os
import re
import shutil
import subprocess
import tempfile
from xml.sax.saxutils import quoteattr

import inkex

SAVED, NOT_SAVED = 0, 3
ROUNDING = 1e-12  # of the largest coordinate
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
SVG = "http://www.w3.org/2000/svg"
PIXEL = 25.4 / 96
# Millimetres of the units that a width can have.
UNITS = {"": PIXEL, "px": PIXEL, "mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "pt": 25.4 / 72, "pc": 25.4 / 6}


def number(value):
    """Write a number with all its digits: inkex itself would write six."""
    text = repr(float(value))
    return text[:-2] if text.endswith(".0") else text


def path_data(path):
    """Write a path with all digits."""
    return " ".join(
        " ".join([command.letter, *map(number, command.args)]) for command in path.to_absolute()
    )


def whole_transform(element):
    """Compose the transforms of an element and all around it. The property of inkex would round the attributes."""
    whole = inkex.Transform()
    while element is not None:
        whole = inkex.Transform(element.get("transform")) @ whole
        element = element.getparent()
    return whole


def path_of(element):
    return inkex.Path(element.get("d") or "").to_absolute()


def matrix(transform):
    return "matrix({})".format(" ".join(map(number, transform.to_hexad())))


def user_unit(svg):
    """Return the millimetres of a user unit: the width of the page by that of its view box."""
    found = re.fullmatch(r"\s*([-+.0-9eE]+)\s*([a-z]*)\s*", svg.get("width") or "")
    view_box = [float(it) for it in re.split(r"[\s,]+", (svg.get("viewBox") or "").strip()) if it]
    if not found or found[2] not in UNITS or len(view_box) != 4 or not view_box[2] > 0:
        return PIXEL
    width = float(found[1])
    # Page and view box of one size have exactly one unit.
    ratio = 1.0 if width == view_box[2] else width / view_box[2]
    return ratio * UNITS[found[2]] or PIXEL


def drawing(paths, unit):
    """Write an SVG of the paths alone. The data of each path goes as it is, below its whole transform."""
    lines = [
        # A view box that begins at 0 0 would move the origin.
        f'<svg xmlns="{SVG}" xmlns:inkscape="{INKSCAPE}" width="{number(1000 * unit)}mm" '
        f'height="{number(1000 * unit)}mm" viewBox="-1 -1 1000 1000">'
    ]
    for path in paths:
        name = quoteattr(path.get_id())
        lines.append(
            f'<g transform="{matrix(whole_transform(path))}">'
            f"<path id={name} inkscape:label={name} d={quoteattr(path.get('d') or '')}/></g>"
        )
    return "\n".join([*lines, "</svg>", ""])


def edited(file, unit):
    """Read the names and paths of a saved file, in user units."""
    back = inkex.Transform(scale=1 / unit)
    found = []
    for element in inkex.load_svg(file).getroot().iter(f"{{{SVG}}}path"):
        name = element.get(f"{{{INKSCAPE}}}label") or element.get("id")
        # Batten writes millimetres.
        path = path_of(element).transform(whole_transform(element))
        found.append((name, path.transform(back)))
    return found


def comes_back_as(path):
    """Return a test for the names under which a path comes back. Batten numbers the parts of a path from the second
    on, and the pieces of one with arcs."""
    data = path_of(path)
    name = path.get_id()
    parts = sum(command.letter == "M" for command in data)
    if any(command.letter == "A" for command in data):
        return re.compile(re.escape(name) + r"( \d+)*").fullmatch
    return {name, *(f"{name} {part}" for part in range(2, parts + 1))}.__contains__


class EditInBatten(inkex.EffectExtension):
    """The extension."""

    is_changed = False

    def has_changed(self, ret):
        """Without a change nothing is written: Inkscape keeps the document as it is."""
        return self.is_changed

    def add_arguments(self, pars):
        pars.add_argument("--program", default="")

    def program(self):
        """Find Batten: as set in the dialog, by the variable BATTEN, or in the folders for programs."""
        set_here = self.options.program
        if set_here and os.path.isfile(set_here):
            return set_here
        return os.environ.get("BATTEN") or shutil.which("batten")

    def effect(self):
        paths = list(self.svg.selection.filter(inkex.PathElement))
        if not paths:
            return inkex.errormsg("Select one or more paths first. Path > Object to Path makes paths of shapes.")
        program = self.program()
        if not program:
            return inkex.errormsg("Batten is not found: set its place in the dialog or in the variable BATTEN.")
        unit = user_unit(self.svg)
        with tempfile.TemporaryDirectory(prefix="batten-") as folder:
            file = os.path.join(folder, "inkscape.svg")
            with open(file, "w", encoding="utf-8") as out:
                out.write(drawing(paths, unit))
            try:
                run = subprocess.run(
                    [program, "edit", "--alone", file], stderr=subprocess.PIPE, text=True, check=False
                )
            except OSError as error:
                return inkex.errormsg(f"Batten does not start: {error}")
            if run.returncode == NOT_SAVED:
                return None
            if run.returncode != SAVED:
                return inkex.errormsg(run.stderr or f"Batten has ended with {run.returncode}. Nothing is changed.")
            return self.take_back(paths, edited(file, unit))

    def take_back(self, paths, results):
        """Put the results into their paths by name; new ones take the places of missing ones, then become paths."""
        tests = [comes_back_as(path) for path in paths]
        new = [path for name, path in results if not any(test(name) for test in tests)]
        for target, is_own in zip(paths, tests):
            own = [path for name, path in results if is_own(name)]
            if not own and new:
                own = [new.pop(0)]
            if own and put(target, own):
                self.is_changed = True
        for path in new:
            added = copy.deepcopy(paths[0])
            paths[0].addnext(added)
            added.set_random_id()
            put(added, [path])
            self.is_changed = True


def nodes(path):
    """List the numbers of a path as cubic Béziers."""
    return [number for part in path.to_superpath() for node in part for point in node for number in point]


def is_same(path, other):
    """Tell whether two paths are the same but for rounding."""
    first, second = nodes(path), nodes(other)
    size = max(map(abs, first), default=0.0)
    return len(first) == len(second) and all(abs(a - b) <= ROUNDING * size for a, b in zip(first, second))


def put(target, paths):
    """Set the data of a path from paths in user units; its transform stays. A path that has not changed keeps its
    text. Tell whether it has changed."""
    inverse = -whole_transform(target)
    data = " ".join(path_data(path.transform(inverse)) for path in paths)
    if is_same(path_of(target), inkex.Path(data)):
        return False
    target.set("d", data)
    for attribute in ("sodipodi:nodetypes", "inkscape:original-d", "inkscape:path-effect"):
        target.pop(attribute, None)
    return True


if __name__ == "__main__":
    EditInBatten().run()
