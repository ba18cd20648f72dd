"""Call the extension of Inkscape as Inkscape does, and check what comes back.

    check_inkscape.py BATTEN

In the place of the window is a script, which moves every curve by 1 mm to the right, through BATTEN's own reader
and writer, or ends without saving. Paths must move by 1 mm on the page, whatever their transforms and the unit of
the document; all else of the document must stay as it is.

It needs what requirements.txt lists, and ends with 1 if anything is wrong.
"""

import os
import pathlib
import subprocess
import sys
import tempfile

import inkex

from host import made_host

EXTENSION = pathlib.Path(__file__).parents[2] / "assets/hosts/inkscape/batten_edit.py"
TOLERANCE = 1e-12  # of the largest coordinate

DRAWING = """<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
     xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd" {page}>
<g inkscape:groupmode="layer" inkscape:label="Hull" id="layer" transform="translate(3.25,-7.5) rotate(20)">
<path id="deck" inkscape:label="The deck" style="fill:none;stroke:#ff0000" transform="scale(1.5,0.75)"
      d="M 10.123456789012345,20 C 30.1,5 50,60.000000123 70,40" sodipodi:nodetypes="cc"/>
<path id="chain" style="stroke:#00ff00" d="m 1,2 c 3,4 5,-6 7,8 c 1,2 3,1 4,-2"/>
</g>
<path id="two" d="M 5,5 C 6,9 9,9 12,4 M 20,5 C 26,9 29,9 32,4"/>
<path id="other" d="M 0,0 L 1,1"/>
</svg>
"""
PAGES = {
    "mm": ('width="210mm" height="297mm" viewBox="0 0 210 297"', 1.0),
    "pixels": ('width="400" height="300"', 25.4 / 96),
    "scaled": ('width="10in" height="5in" viewBox="20 30 500 250"', 254 / 500),
}

failures = []


def check(condition, what):
    if not condition:
        failures.append(what)
        print("wrong:", what)


class Call:
    """A call of the extension."""

    def __init__(self, folder, does, page, ids, program=None):
        source = folder / "drawing.svg"
        source.write_text(DRAWING.format(page=PAGES[page][0]))
        environment = dict(os.environ, DOES=does, BATTEN=str(folder / "host"), PATH="/usr/bin:/bin")
        command = [sys.executable, str(EXTENSION), *(f"--id={it}" for it in ids)]
        if program is not None:
            environment.pop("BATTEN")
            command.append(f"--program={program}")
        self.run = subprocess.run([*command, str(source)], capture_output=True, env=environment, check=False)
        self.told = self.run.stderr.decode()
        self.before = inkex.load_svg(str(source)).getroot()
        # Inkscape takes no output for no change.
        self.after = inkex.load_svg(self.run.stdout).getroot() if self.run.stdout else self.before

    def path(self, root, name):
        return root.getElementById(name)

    def numbers(self, root, name):
        """List the nodes of a path on the page."""
        path = element = self.path(root, name)
        placed = inkex.Path(path.get("d")).to_absolute()
        while element is not None:
            placed = placed.transform(inkex.Transform(element.get("transform")))
            element = element.getparent()
        return [value for part in placed.to_superpath() for node in part for point in node for value in point]

    def has_moved(self, name, step):
        before, after = self.numbers(self.before, name), self.numbers(self.after, name)
        size = max(map(abs, before))
        expected = [value + (step if place % 2 == 0 else 0.0) for place, value in enumerate(before)]
        return len(before) == len(after) and all(
            abs(a - b) <= TOLERANCE * size for a, b in zip(after, expected)
        )

    def is_same(self, name, but=()):
        before, after = (dict(self.path(root, name).attrib) for root in (self.before, self.after))
        for attribute in but:
            before.pop(attribute, None), after.pop(attribute, None)
        parents = [self.path(root, name).getparent().get("id") for root in (self.before, self.after)]
        return before == after and parents[0] == parents[1]


def main(batten):
    nodetypes = inkex.addNS("nodetypes", "sodipodi")
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        host = made_host(folder, batten)
        for page, (_, unit) in PAGES.items():
            call = Call(folder, "move", page, ["deck", "chain", "two"])
            check(call.run.returncode == 0 and not call.told, f"{page}: {call.told}")
            for name in ("deck", "chain", "two"):
                check(call.has_moved(name, 1 / unit), f"{page}: {name} is not moved by 1 mm")
                check(call.is_same(name, ["d", nodetypes]), f"{page}: {name} has other attributes")
            check(call.is_same("other"), f"{page}: a path that is not selected has changed")
        for does in ("close", "fail", "kill"):
            call = Call(folder, does, "mm", ["deck"])
            check(all(call.is_same(it) for it in ("deck", "chain", "two", "other")), f"{does}: something has changed")
            check(bool(call.told) == (does != "close"), f"{does}: the message is “{call.told}”")
        check("the window has failed" in Call(folder, "fail", "mm", ["deck"]).told, "the failure is not told")
        call = Call(folder, "move:deck", "mm", ["deck", "chain"])
        check(call.has_moved("deck", 1.0) and call.is_same("chain"), "a path that was not edited has another text")
        call = Call(folder, "rename", "mm", ["deck"])
        check(call.has_moved("deck", 1.0), "a renamed curve does not come back into its path")
        call = Call(folder, "add", "mm", ["deck"])
        ids = [it.get_id() for it in call.after.iter(inkex.addNS("path", "svg"))]
        check(len(ids) == 5 and len(set(ids)) == 5, f"a new curve is no new path: {ids}")
        added = [it for it in ids if it not in ("deck", "chain", "two", "other")]
        check(len(added) == 1 and call.path(call.after, added[0]).getparent().get_id() == "layer", "another layer")
        check("Select" in Call(folder, "move", "mm", []).told, "nothing selected: no message")
        check("not found" in Call(folder, "move", "mm", ["deck"], program="").told, "no program: no message")
        call = Call(folder, "move", "mm", ["deck"], program=str(host))
        check(call.has_moved("deck", 1.0), "the program of the dialog is not used")
    print("Inkscape:", "failed" if failures else "all paths come back")
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
