"""Ask an independent reader whether tables of points written by Batten hold what they should.

    check_points.py BATTEN FOLDER

For each NAME.batten of the folder, NAME.json is what `batten inspect` prints of it. Of the first curves of each, 60
in all, Batten writes points as .csv, .dat and .xyz: so many, and so near to the curve. NumPy reads them, and SciPy
evaluates the curve from its float polygon: every point must lie on the curve within 1e-12 of its size, both ends
must be there, and no place of the curve may be farther from the polyline than the chord tolerance.

It needs what requirements.txt lists, and ends with 1 if anything is wrong.
"""

import json
import pathlib
import sys

import numpy as np
from check_kernels import run
from float_curve import evaluated, in_space

CURVES = 60
POINTS = 101
ON_CURVE = 1e-12  # of the size
CHORD = 1e-3  # of the size
SAMPLES = 4001
STARTS = 3
STEPS = 8


def table(path):
    """Read the rows of numbers of a file, whatever is above them."""
    rows = []
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            row = [float(it) for it in line.replace(",", " ").split()]
        except ValueError:
            continue
        if len(row) in (2, 3):
            rows.append(row)
    return in_space(rows)


def distances(point, places, us, points):
    """The distances of places from the curve: from the nearest samples on, by steps along the tangent."""
    squares = ((points[None, :, :] - places[:, None, :]) ** 2).sum(axis=2)
    starts = np.argsort(squares, axis=1)[:, :STARTS]
    least = np.sqrt(squares.min(axis=1))
    step = 1e-6 * (us[-1] - us[0])
    for start in starts.T:
        u = us[start]
        for _ in range(STEPS):
            low, high = np.maximum(u - step, us[0]), np.minimum(u + step, us[-1])
            tangents = (point(high) - point(low)) / (high - low)[:, None]
            along = ((places - point(u)) * tangents).sum(axis=1)
            u = np.clip(u + along / (tangents**2).sum(axis=1), us[0], us[-1])
            least = np.minimum(least, np.linalg.norm(point(u) - places, axis=1))
    return least


def from_polyline(places, corners):
    """The largest distance of places from a polyline."""
    starts, steps = corners[:-1], np.diff(corners, axis=0)
    squares = np.maximum((steps**2).sum(axis=1), np.finfo(float).tiny)
    farthest = 0.0
    for place in places:
        share = np.clip(((place - starts) * steps).sum(axis=1) / squares, 0.0, 1.0)
        off = np.linalg.norm(starts + share[:, None] * steps - place, axis=1).min()
        farthest = max(farthest, off)
    return farthest


def problems(curve, found, chord):
    point = evaluated(curve)
    us = np.linspace(*curve["domain"], SAMPLES)
    points = point(us)
    size = np.ptp(points, axis=0).max()
    off = distances(point, found, us, points).max() / size
    if not off <= ON_CURVE:
        yield f"a point is {off:.2e} of the size off the curve"
    ends = max(np.abs(found[0] - points[0]).max(), np.abs(found[-1] - points[-1]).max()) / size
    if not ends <= ON_CURVE:
        yield f"the ends are {ends:.2e} of the size off"
    if chord is None and len(found) != POINTS:
        yield f"{len(found)} points in place of {POINTS}"
    if chord is not None:
        farthest = from_polyline(points[::10], found)
        if not farthest <= chord * (1 + 1e-9):
            yield f"the curve is {farthest / chord:.3f} times the tolerance off the polyline"


def main(batten, folder):
    wrong, count = 0, 0
    projects = sorted(pathlib.Path(folder).glob("degree*.batten"))
    each = -(-CURVES // max(len(projects), 1))
    for project in projects:
        inspected = json.loads(project.with_suffix(".json").read_text(encoding="utf-8"))
        for number, curve in enumerate(inspected["curves"][:each]):
            if count == CURVES:
                break
            count += 1
            size = float(np.ptp(in_space(curve["float"]), axis=0).max())
            found = []
            for extension, chord in (("csv", None), ("dat", None), ("xyz", None), ("csv", CHORD * size)):
                path = project.with_name(f"{project.stem}-{number}-points.{extension}")
                how = ["--points", POINTS] if chord is None else ["--chord", repr(chord)]
                try:
                    run(batten, "convert", project, path, "--item", number + 1, *how)
                    found += [f"{extension} {how[0]}: {it}" for it in problems(curve, table(path), chord)]
                except ValueError as error:
                    found.append(f"{extension} {how[0]}: {error}")
            wrong += bool(found)
            for problem in found:
                print(f"{project.stem}, curve {number + 1}: {problem}")
    print(f"{count} curves as tables of points, {wrong} of them with problems")
    return 1 if wrong or count < CURVES else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
