"""A script in the place of Batten's window, for the tests of scripts that call `batten edit`."""

import pathlib

# The variable DOES says what it does: "move" moves every curve by 1 to the right, "move:NAME" those with NAME in their
# names; "add" and "rename" do more; "close" saves nothing, "fail" and "kill" end badly.
TEXT = """#!/usr/bin/env python3
import json, os, subprocess, sys
does = os.environ["DOES"]
assert sys.argv[1:3] == ["edit", "--alone"] and len(sys.argv) == 4, sys.argv
file = sys.argv[3]
if does == "close":
    sys.exit(3)
if does == "fail":
    print("the window has failed", file=sys.stderr)
    sys.exit(1)
project = file + ".batten"
subprocess.run([{batten!r}, "convert", file, project], check=True, stderr=subprocess.DEVNULL)
with open(project) as read:
    content = json.load(read)
moved = does.split(":")[1] if ":" in does else ""
for curve in content["curves"]:
    if moved in curve["name"]:
        for vertex in curve["vertices"]:
            vertex[0] += 1.0
for reference in content.get("references", []):
    if moved in reference["name"]:
        at = reference.get("translation") or [0.0, 0.0, 0.0]
        reference["translation"] = [at[0] + 1.0, *at[1:]]
if does == "add":
    content["curves"].append(dict(content["curves"][0], name="another"))
if does == "rename":
    content["curves"][0]["name"] = "another"
with open(project, "w") as out:
    json.dump(content, out)
subprocess.run([{batten!r}, "convert", project, file], check=True, stderr=subprocess.DEVNULL)
if does == "kill":
    os.kill(os.getpid(), 9)
"""


def made_host(folder, batten):
    """Write the script to a folder. It reads and writes files by a real program. Returns its path."""
    host = pathlib.Path(folder) / "host"
    host.write_text(TEXT.format(batten=str(pathlib.Path(batten).resolve())))
    host.chmod(0o755)
    return host
