"""Ask independent readers whether what the presets for programs write and lose is what they say.

    check_presets.py BATTEN FOLDER

A document of planar curves of degrees 1 to 9, rational, periodic and space ones is written with each of the nine
presets. ezdxf, OpenCascade, openNURBS and, for SVG and GLIF, a reader of their own here read it: every curve that
is not named as left out must be there, off by no more than the message says, otherwise within 1e-11 of its size.

It needs what requirements.txt lists, and ends with 1 if anything is wrong.
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import ezdxf
import inkex
import numpy as np
from check_kernels import by_opencascade, by_opennurbs
from check_points import from_polyline
from float_curve import curve_points, in_space
from scipy.interpolate import BSpline

EXACT = 1e-11  # of the size
SAMPLING = 1e-6  # of the size: what a polyline of so many samples is off
SAMPLES = 201
DENSE = 4001


def vertices(count, height):
    angles = [2 * math.pi * it / count for it in range(count)]
    return [[(60 + 9 * math.cos(3 * a)) * math.cos(a), 45 * math.sin(a), height * it] for it, a in enumerate(angles)]


def curve(name, degree, height=0.0, rational=False, periodic=False):
    points = vertices(max(9, degree + 3), height)
    return {
        "name": name,
        "degree": degree,
        "polygon": "float",
        "vertices": points if height else [it[:2] for it in points],
        "weights": [1.0 + 0.3 * (it % 3) for it in range(len(points))] if rational else None,
        "periodic": periodic,
    }


CURVES = [
    *(curve(f"plane {degree}", degree) for degree in range(1, 10)),
    curve("rational 2", 2, rational=True),
    curve("rational 5", 5, rational=True),
    curve("periodic 3", 3, periodic=True),
    curve("periodic 6", 6, periodic=True),
    curve("space 3", 3, height=4.0),
    curve("space 7", 7, height=4.0, rational=True),
]
SPACE = {it["name"] for it in CURVES if it["name"].startswith("space")}


def by_ezdxf(path):
    drawing = ezdxf.readfile(path)
    if drawing.audit().has_issues:
        raise ValueError("ezdxf's audit complains")
    found = []
    for spline in drawing.modelspace().query("SPLINE"):
        points = np.array(spline.control_points)
        weights = np.array(spline.weights) if len(spline.weights) else np.ones(len(points))
        homogeneous = np.column_stack([points * weights[:, None], weights])
        knots, degree = np.array(spline.knots), spline.dxf.degree
        values = BSpline(knots, homogeneous, degree)(np.linspace(knots[degree], knots[-degree - 1], SAMPLES))
        found.append((degree, values[:, :3] / values[:, 3:]))
    return found


def bezier(points):
    """Evaluate a Bézier at even parameters."""
    points = np.asarray(points, dtype=float)
    degree, t = len(points) - 1, np.linspace(0, 1, 1025)[:, None]
    return sum(math.comb(degree, it) * t**it * (1 - t) ** (degree - it) * points[it] for it in range(degree + 1))


def by_svg(path):
    found = []
    for element in ElementTree.parse(path).getroot().iter("{http://www.w3.org/2000/svg}path"):
        at, start, points = None, None, []
        for command in inkex.Path(element.get("d")).to_absolute():
            places = [(command.args[it], command.args[it + 1]) for it in range(0, len(command.args), 2)]
            if command.letter == "M":
                at = start = places[-1]
            elif command.letter == "Z":
                if at != start:
                    points.append(bezier([at, start]))
            elif command.letter in "LQC":
                points.append(bezier([at, *places]))
                at = places[-1]
            else:
                raise ValueError(f"a command {command.letter}")
        found.append((3, in_space(np.concatenate(points))))
    return found


def by_glif(path):
    found = []
    for contour in ElementTree.parse(path).getroot().iter("contour"):
        points = [(float(it.get("x")), float(it.get("y")), it.get("type")) for it in contour.iter("point")]
        if points[0][2] != "move":
            points.append(points[0])
        at, run, places = points[0][:2], [], []
        for x, y, kind in points[1:]:
            run.append((x, y))
            if kind:
                places.append(bezier([at, *run]))
                at, run = (x, y), []
        found.append((3, in_space(np.concatenate(places))))
    return found


def any_degree(read):
    return lambda path: [(None, points) for points in read(path)]


PRESETS = {
    "autocad": ("dxf", by_ezdxf, None),
    "rhino": ("3dm", any_degree(by_opennurbs), None),
    "freecad": ("step", any_degree(by_opencascade), None),
    "fusion": ("dxf", by_ezdxf, None),
    "solidworks": ("igs", any_degree(by_opencascade), None),
    "librecad": ("dxf", by_ezdxf, 3),
    "inkscape": ("svg", by_svg, 3),
    "illustrator": ("svg", by_svg, 3),
    "glyphs": ("glif", by_glif, 3),
}


def told_of(lines, name, words):
    """The figure that a message on a curve says."""
    for line in lines:
        found = re.search(words, line)
        if found and (f"“{name}”" in line or "others" in line.split(": ")[1]):
            return float(found[1])
    return None


def problems(batten, path, preset, read, most, inspected):
    project = path.with_name("mixed.batten")
    done = subprocess.run([batten, "convert", str(project), str(path), "--preset", preset], capture_output=True, text=True)
    if done.returncode:
        yield done.stderr.strip()
        return
    lines = done.stderr.splitlines()
    found = read(path)
    planar = preset in ("inkscape", "illustrator", "glyphs")
    left_out = SPACE if planar else set()
    told = [line for line in lines if "left out" in line]
    named = {name for line in told for name in re.findall("“(.*?)”", line)}
    if named != left_out:
        yield f"it says that {sorted(named)} are left out in place of {sorted(left_out)}"
    expected = [it for it in inspected if it["name"] not in left_out]
    pieces = len(found) - len(expected) + 1
    if path.suffix == ".igs" and pieces > 1:
        # OpenCascade cuts the polyline, which comes first, at its corners.
        corners = np.concatenate([points for _, points in found[:pieces]])
        found = [(1, corners), *found[pieces:]]
    if len(found) != len(expected):
        yield f"{len(found)} curves of {len(expected)}"
        return
    for (degree, points), given in zip(found, expected):
        if degree is not None and degree > (most or given["degree"]):
            yield f"“{given['name']}” has degree {degree}"
        exact = curve_points(given, SAMPLES)
        size = np.ptp(exact, axis=0).max()
        off = told_of(lines, given["name"], r"off by at most ([-+.0-9e]+)")
        off = off or told_of(lines, given["name"], r"up to ([-+.0-9e]+) off")
        if planar or off is not None or len(points) != SAMPLES:
            dense = curve_points(given, DENSE)
            room = (off or 0.0) + SAMPLING * size
            error = max(from_polyline(points, dense), from_polyline(dense[::20], points))
            if not error <= room:
                yield f"“{given['name']}” is off by {error:.3g}, told {off}"
        elif not np.abs(points - exact).max() <= EXACT * size:
            yield f"“{given['name']}” is off by {np.abs(points - exact).max() / size:.2e} of its size"


def main(batten, folder):
    folder = pathlib.Path(folder)
    project = folder / "mixed.batten"
    document = {"format": "batten", "version": 2, "unit": "mm", "curves": CURVES}
    project.write_text(json.dumps(document), encoding="utf-8")
    done = subprocess.run([batten, "inspect", str(project)], capture_output=True, text=True, check=True)
    inspected = json.loads(done.stdout)["curves"]
    wrong = 0
    for preset, (extension, read, most) in PRESETS.items():
        path = folder / f"mixed-{preset}.{extension}"
        try:
            found = list(problems(batten, path, preset, read, most, inspected))
        except ValueError as error:
            found = [str(error)]
        wrong += bool(found)
        for problem in found:
            print(f"{preset}: {problem}")
    print(f"{len(PRESETS)} presets, {wrong} of them with problems")
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
