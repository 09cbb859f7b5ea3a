#!/usr/bin/env python3
"""Scenes and places that are hard to bake: a sound file, or one clear line, status 1 and nothing written.

Usage: bad_bakes.py DAYLIT WORK_FOLDER
"""
import json
import os
import pathlib
import resource
import shutil
import signal
import struct
import subprocess
import sys

daylit, work = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
work.chmod(0o777)
passed, failures = 0, []


def level(name, triangles, albedo=0.5, dynamic=False, uv2=None):
    """A .glb of a list of triangles, each three corners."""
    corners = [c for t in triangles for c in t]
    positions = struct.pack(f"<{3 * len(corners)}f", *(x for c in corners for x in c))
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [albedo] * 3 + [1], "metallicFactor": 0}}],
        "bufferViews": [{"buffer": 0, "byteLength": len(positions)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(corners), "type": "VEC3"}],
    }
    binary = positions
    if dynamic:
        document["nodes"][0]["extras"] = {"daylit": {"dynamic": True}}
    if uv2:
        uvs = struct.pack("<2f", *uv2) * len(corners)
        document["bufferViews"].append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(uvs)})
        document["accessors"].append({"bufferView": 1, "componentType": 5126, "count": len(corners), "type": "VEC2"})
        document["meshes"][0]["primitives"][0]["attributes"] |= {"TEXCOORD_0": 1, "TEXCOORD_1": 1}
        binary += uvs
    document["buffers"] = [{"byteLength": len(binary)}]
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    path = work / name
    path.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + len(binary)) +
                     struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary)
    return path


def quad(x=0.0, y=0.0, z=0.0, size=1.0):
    a, b, c, d = (x, y, z), (x, y, z + size), (x + size, y, z + size), (x + size, y, z)
    return [(a, b, c), (a, c, d)]


def run(*arguments, before=None):
    return subprocess.run([daylit, *map(str, arguments)], capture_output=True, text=True, timeout=300, preexec_fn=before)


def report(what, problems, result):
    global passed
    if problems:
        failures.append(f"{what}: {'; '.join(problems)}\n  status {result.returncode}, {result.stderr.strip()[-400:]}")
    else:
        passed += 1


def sound(what, scene, *options):
    """Bakes, and what was baked can be opened and says of every part why it is there or not."""
    baked = work / "sound.daylit"
    baked.unlink(missing_ok=True)
    result = run("bake", scene, "-o", baked, "--error", "1", "--every", "3h", *options)
    if result.returncode != 0:
        return report(what, ["was refused"], result)
    about = run("info", baked, "--json")
    problems = [] if about.returncode == 0 else ["info cannot read it"]
    if not problems and any(not part["why"] for part in json.loads(about.stdout)["parts"]):
        problems = ["a part does not say why"]
    report(what, problems, about)
    return json.loads(about.stdout) if not problems else None


def refused(what, mention, output, *arguments, before=None):
    """One line, status 1, and the output as it was."""
    content = output.read_bytes() if output.exists() else None
    result = run(*arguments, before=before)
    lines = [line for line in result.stderr.splitlines() if line.startswith("daylit: ")]
    problems = [] if result.returncode == 1 else ["status is not 1"]
    if len(lines) != 1:
        problems.append("not one line 'daylit: ...'")
    elif mention not in lines[0]:
        problems.append(f"the line does not mention '{mention}'")
    if (output.read_bytes() if output.exists() else None) != content:
        problems.append("the output was touched")
    left = [p.name for p in output.parent.iterdir() if "tmp" in p.name or "partial" in p.name] if output.parent.exists() else []
    if left:
        problems.append(f"left behind {left}")
    report(what, problems, result)


floor = level("floor.glb", quad(size=4.0))
about = sound("no static geometry", level("dynamic.glb", quad(), dynamic=True))
if about and any(part["part"] == "lightmap" and part["done"] for part in about["parts"]):
    failures.append("no static geometry: has a lightmap all the same")
sound("one triangle", level("triangle.glb", quad()[:1]))
sound("charts without area", level("flat.glb", quad() + [((0, 1, 0), (1, 1, 0), (2, 1, 0)), ((0, 1, 0),) * 3]))
sound("nothing but charts without area", level("nothing.glb", [((0, 1, 0), (1, 1, 0), (2, 1, 0)), ((0, 1, 0),) * 3]))
sound("overlapping charts", level("overlap.glb", quad() * 20 + quad(y=1e-7) * 20))
tiny = [t for i in range(100) for k in range(100) for t in quad(0.02 * i, 0.001 * ((i * 7 + k * 3) % 5), 0.02 * k, 0.001)]
sound("twenty thousand tiny charts", level("tiny.glb", tiny))
sound("a second UV set that is out of range", level("uv2.glb", quad(), uv2=(1e30, -7.0)))
kept = work / "kept.daylit"
for what, mention, scene in (("out of range", "outside 0 to 1", work / "uv2.glb"),
                             ("without area", "has a TEXCOORD_1 with area", level("uv2_point.glb", quad(), uv2=(0.5, 0.5))),
                             ("missing", "has a TEXCOORD_1 with area", floor)):
    refused(f"a second UV set to keep that is {what}", mention, kept, "bake", scene, "--keep-uv2", "-o", kept, "--error", "1")
refused("a layout exported without a lightmap", "no lightmap", work / "out.glb", "bake", work / "dynamic.glb", "-o", kept,
        "--export-glb", work / "out.glb", "--error", "1")
sound("polar night", floor, "--latitude", "89", "--date", "2026-12-21")
sound("polar day", floor, "--latitude", "89", "--date", "2026-06-21")
sound("no light at all", floor, "--sun", "none", "--sky", "none")
white = [t for y in (0.0, 1.0) for t in quad(y=y, size=3.0)]
sound("albedo 1", level("white.glb", white, albedo=1.0))

yesterday = work / "yesterday.daylit"
for previous in (None, b"yesterday's light"):
    if previous:
        yesterday.write_bytes(previous)

    def full_disk():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))

    refused("a full disk", "yesterday", yesterday, "bake", floor, "-o", yesterday, "--error", "1", "--every", "6h", before=full_disk)

locked = work / "locked"
locked.mkdir()
locked.chmod(0o555)


def nobody():
    if os.getuid() == 0:
        os.setgid(65534)
        os.setuid(65534)


can_read = subprocess.run(["test", "-x", daylit, "-a", "-r", str(floor)], preexec_fn=nobody).returncode == 0
if can_read:
    refused("a read-only folder", "locked", locked / "light.daylit", "bake", floor, "-o", locked / "light.daylit", before=nobody)
    refused("a report into a read-only folder", "locked", locked / "page" / "index.html", "report", floor, "-o", locked / "page",
            "--quick", before=nobody)
else:
    print("NOT RUN: a read-only folder (another user cannot read this build)")
locked.chmod(0o755)

other = level("other.glb", quad(size=5.0))
baked = work / "floor.daylit"
run("bake", floor, "-o", baked, "--error", "1", "--every", "6h")
refused("light of another scene", "other.glb", work / "x.png", "shot", other, "--light", baked, "-o", work / "x.png", "--size", "32x24")

print("\n".join(failures))
print(f"{passed} passed, {len(failures)} failed")
sys.exit(1 if failures else 0)
