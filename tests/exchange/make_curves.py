"""Write projects with curves of every kind, for the check of exported drawings.

    make_curves.py FOLDER

One project for each degree from 1 to 25: planar and in space, polynomial and rational, open and
periodic, with few vertices and with many, in every unit of length and in none. The numbers are drawn
from a fixed seed.
"""

import json
import pathlib
import random
import sys

DEGREES = range(1, 26)
UNITS = [None, "mm", "cm", "m", "in"]
NAMES = ["plain", "Größe 3", "a/b:c", "名前", "x" * 300, "layer, with = signs", "plain"]


def curve(draw, degree, number):
    dimension = draw.choice([2, 3])
    count = degree + draw.choice([1, 2, degree, 3 * degree])
    rational = draw.random() < 0.5
    size = 10.0 ** draw.uniform(-3.0, 6.0)
    return {
        "name": NAMES[number % len(NAMES)],
        "degree": degree,
        "polygon": "float",
        "vertices": [[draw.uniform(-size, size) for _ in range(dimension)] for _ in range(count)],
        "weights": [draw.uniform(0.5, 2.0) for _ in range(count)] if rational else None,
        "periodic": draw.random() < 0.3,
    }


def main(folder):
    draw = random.Random(20)
    for degree in DEGREES:
        curves = [curve(draw, degree, number) for number in range(len(NAMES))]
        unit = UNITS[degree % len(UNITS)]
        project = {"format": "batten", "version": 2 if unit else 1, "curves": curves}
        if unit:
            project["unit"] = unit
        path = pathlib.Path(folder) / f"degree{degree}.batten"
        path.write_text(json.dumps(project), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
