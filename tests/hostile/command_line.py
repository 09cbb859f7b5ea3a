#!/usr/bin/env python3
"""Wrong files and wrong usage on the command line: one clear line, status 1 (usage: 2), nothing written, nothing lost.

Usage: command_line.py DAYLIT WORK_FOLDER
"""
import json
import pathlib
import shutil
import struct
import subprocess
import sys

daylit, work = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
passed, failures = 0, []


def daylit_run(*arguments):
    return subprocess.run([daylit, *map(str, arguments)], capture_output=True, text=True, timeout=120)


def glb(document, binary=b"", length=None):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    if binary:
        chunks += struct.pack("<II", len(binary), 0x004E4942) + binary
    return struct.pack("<III", 0x46546C67, 2, length or 12 + len(chunks)) + chunks


def triangle(positions=(0, 0, 0, 1, 0, 0, 0, 1, 0), **accessor):
    binary = struct.pack("<9f", *positions)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "thing"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [{"byteLength": len(binary)}], "bufferViews": [{"buffer": 0, "byteLength": len(binary)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [-1, -1, -1], "max": [1, 1, 1]} | accessor],
    }
    return document, binary


def write(name, content):
    path = work / name
    path.write_bytes(content)
    return path


def with_material_image(image):
    document, binary = triangle()
    document |= {"images": [{"uri": image}], "textures": [{"source": 0}],
                 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]}
    document["meshes"][0]["primitives"][0]["material"] = 0
    return glb(document, binary)


def cyclic():
    document, binary = triangle()
    document["nodes"] = [{"mesh": 0, "children": [1]}, {"children": [0]}]
    return glb(document, binary)


good = write("good.glb", glb(*triangle()))
broken = {
    "truncated.glb": glb(*triangle())[:60],
    "lying_length.glb": glb(*triangle(), length=100000),
    "empty.glb": b"",
    "text.glb": b"this is no glTF",
    "count.glb": glb(*triangle(count=1000)),
    "huge_count.glb": glb(*triangle(count=2**31 - 1)),
    "cyclic.glb": cyclic(),
    "nan.glb": glb(*triangle((0, 0, float("nan"), 1, 0, 0, 0, 1, 0))),
    "infinite.glb": glb(*triangle((0, 0, float("inf"), 1, 0, 0, 0, 1, 0))),
    "absent_image.glb": with_material_image("absent.png"),
    "empty_image.glb": with_material_image("empty.png"),
    "wrong_image.glb": with_material_image("text.png"),
}
write("empty.png", b"")
write("text.png", b"this is no picture")
write("text.exr", b"this is no picture")
write("text.csv", b"a,b\nc")
write("text.daylit", b"this is no baked file")
out = work / "out.png"


def expect(status, mention, *arguments, output=out):
    """Runs daylit; wants this status, one line on stderr that mentions the culprit, and an untouched output."""
    global passed
    before = output.read_bytes() if output.exists() else None
    result = daylit_run(*arguments)
    lines = [line for line in result.stderr.splitlines() if line.startswith("daylit: ")]
    problems = []
    if result.returncode != status:
        problems.append(f"status {result.returncode}, not {status}")
    if len(lines) != 1 or result.stderr.strip().splitlines()[-1:] != lines:
        problems.append("stderr does not end in one line 'daylit: ...'")
    elif mention not in lines[0]:
        problems.append(f"the line does not mention '{mention}'")
    if (output.read_bytes() if output.exists() else None) != before:
        problems.append(f"{output.name} was touched")
    left = [p.name for p in work.iterdir() if "tmp" in p.name or "partial" in p.name]
    if left:
        problems.append(f"left behind: {left}")
    if problems:
        failures.append(f"daylit {' '.join(map(str, arguments))}\n  {'; '.join(problems)}\n  {result.stderr.strip()}")
    else:
        passed += 1


for name, content in broken.items():
    expect(1, name, "check", write(name, content))
expect(1, "absent.glb", "check", work / "absent.glb")
expect(1, str(work), "check", work)

shot = ("shot", good, "-o", out, "--size", "32x24")
for previous in (None, b"yesterday's picture"):
    if previous:
        out.write_bytes(previous)
    expect(1, "absent.glb", "shot", work / "absent.glb", "-o", out)
    expect(1, "nan.glb", "shot", work / "nan.glb", "-o", out)
    expect(1, "nobody", *shot, "--camera", "nobody")
    for hour in ("24", "-1", "1e9", "25:00", "12:60"):
        expect(1, "--hour", *shot, "--hour", hour)
    for size in ("0x0", "100000x100000", "-5x5"):
        expect(1, "--size", "shot", good, "-o", out, "--size", size)
    expect(1, "absent.daylit", *shot, "--light", work / "absent.daylit")
    expect(1, "text.daylit", *shot, "--light", work / "text.daylit")
    expect(1, "absent.exr", *shot, "--sky", work / "absent.exr")
    expect(1, "text.exr", *shot, "--sky", work / "text.exr")
    expect(1, "--latitude", *shot, "--latitude", "91")
    expect(1, "--clouds", *shot, "--clouds", "2")
    expect(1, "--date", *shot, "--date", "2026-02-30")
    expect(1, "nothing", *shot, "--move", "nothing=0,0,0")
expect(2, "--hour", *shot, "--hour", "noon")
expect(2, "--size", "shot", good, "-o", out, "--size", "big")
expect(2, "--show", *shot, "--show", "sparkle")
expect(2, "--context", *shot, "--context", "vulkan")
expect(2, "--sky", *shot, "--sky", "green")
expect(2, "--volume-mode", *shot, "--volume-mode", "texel")
expect(2, "--nonsense", *shot, "--nonsense")
expect(2, "'frobnicate'", "frobnicate")
expect(2, "'frobnicate'", "frobnicate", "--help-me")
expect(2, "")
for option in ("--camera", "--light", "--latitude", "--samples", "--time", "--sky", "--move"):
    expect(2, option, *shot, option, "")
free = ("--eye", "0,0,3", "--at", "0,0,0")
expect(2, "--fov", *shot, "--fov", "40")
expect(2, "--fov", *shot, "--camera", "view", "--fov", "40")
for fov in ("0", "nan", "180"):
    expect(1, "--fov", *shot, *free, "--fov", fov)
expect(1, "--eye", *shot, "--eye", "1e9,0,0", "--at", "0,0,0")
expect(1, "--at", *shot, "--eye", "0,0,3", "--at", "0,-1e30,0")
for place in ("1e30,0,0", "0,-2e8,0", "0,nan,0", "inf,0,0", "0,0,0,1e300", "0,0,0,nan"):
    expect(1, "--move", *shot, "--move", f"thing={place}")
for time in ("nan", "inf", "1e300", "-1e7"):
    expect(1, "--time", *shot, "--time", time)
expect(1, "--hour", *shot, "--hour", "-0:30")
expect(1, "--sky", *shot, "--sky", "1e30,0,0")
expect(1, "--latitude: 1e+300", *shot, "--latitude", "1e300")
expect(1, "--unit: 1e-07", *shot, "--unit", "1e-7")
expect(2, "--sun-direction", *shot, "--sun-direction", "0,1,0", "--sun", "scene")
for part in ("lightmap", "volume", "dirmap", "antiradiance", "caustics"):
    expect(2, "--light", *shot, "--show", part)
for fps in ("0", "-1", "nan", "1e9"):
    expect(1, "--fps", "day", good, "-o", out, "--size", "32x24", "--fps", fps)
expect(2, "--list", "make", "--list", "furnace", "-o", out)
picture = work / "picture.exr"  # what is read is not written over
daylit_run("shot", good, "-o", picture, "--size", "32x16")
expect(1, "picture.exr", "compare", picture, picture, "-o", picture, output=picture)
expect(1, "picture.exr", "shot", good, "--sky", picture, "-o", picture, output=picture)
expect(1, "picture.exr", "reference", good, "--sky", picture, "-o", picture, output=picture)
expect(1, "good.glb", "bake", good, "-o", work / "x.daylit", "--export-glb", good, output=good)
for error in ("0", "-1", "nan", "2"):
    expect(1, "--error", "reference", good, "-o", work / "ref.exr", "--error", error, output=work / "ref.exr")
    expect(1, "--error", "bake", good, "-o", work / "x.daylit", "--error", error, output=work / "x.daylit")
for seed in ("-1", "1.5", "99999999999999999999"):
    expect(2, "--seed", "reference", good, "-o", work / "ref.exr", "--seed", seed, output=work / "ref.exr")
expect(1, "absent/out.png", "shot", good, "-o", work / "absent" / "out.png", "--size", "32x24")
expect(1, "out.xyz", "shot", good, "-o", work / "out.xyz", "--size", "32x24")
expect(1, "absent/ref.exr", "reference", good, "-o", work / "absent" / "ref.exr", "--size", "8x8", "--spp", "1")
expect(1, "nobody", "reference", good, "-o", work / "ref.exr", "--camera", "nobody", output=work / "ref.exr")
expect(1, "--spp", "reference", good, "-o", work / "ref.exr", "--spp", "0", output=work / "ref.exr")
expect(1, "absent/x.daylit", "bake", good, "-o", work / "absent" / "x.daylit")
for option, value in (("--volume-min-level", "21"), ("--volume-max-level", "-7"), ("--volume-geometry-level", "21"),
                      ("--volume-change", "0"), ("--volume-near", "-1"), ("--volume-error", "nan")):
    expect(1, option, "bake", good, "-o", work / "x.daylit", option, value, output=work / "x.daylit")
expect(2, "--volume-cells", "bake", good, "-o", work / "x.daylit", "--volume-cells", "many", output=work / "x.daylit")
expect(1, "text.daylit", "info", work / "text.daylit")
expect(1, "absent.exr", "compare", work / "absent.exr", good)
expect(1, "text.exr", "compare", work / "text.exr", work / "text.exr")
expect(1, "text.csv", "compare", work / "text.csv", work / "text.csv")
expect(1, "text.csv", "points", good, "--in", work / "text.csv", "--method", "reference", "-o", work / "p.csv")
for position, normal, what in (("0,1e30,0", "0,1,0", "point 1"), ("0,0,0", "0,0,0", "point 1"), ("0,nan,0", "0,1,0", "line 2")):
    far = write("far.csv", f"x,y,z,nx,ny,nz\n{position},{normal}\n".encode())
    expect(1, what, "points", good, "--in", far, "--method", "reference", "-o", work / "p.csv")
for part in ("lightmap", "volume", "dirmap", "antiradiance"):
    expect(2, "--light", "points", good, "--in", write("one.csv", b"0,1,0,0,1,0\n"), "--method", part, "-o", work / "p.csv")
expect(1, "nowhere", "make", "nowhere", "-o", work / "nowhere.glb")
expect(1, "absent/x.glb", "make", "furnace", "-o", work / "absent" / "x.glb")

print("\n".join(failures))
print(f"{passed} passed, {len(failures)} failed")
sys.exit(1 if failures else 0)
