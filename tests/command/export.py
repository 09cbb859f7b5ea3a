#!/usr/bin/env python3
"""bake --export-glb and --keep-uv2 from end to end: the exported scene loads, looks the same, and its layout is kept.

Usage: export.py DAYLIT WORK_FOLDER
"""
import csv
import json
import pathlib
import shutil
import subprocess
import sys

daylit, work = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
scene, exported = work / "rooms.glb", work / "exported.glb"


def run(*arguments):
    result = subprocess.run([daylit, *map(str, arguments)], capture_output=True, text=True, timeout=600)
    assert result.returncode == 0, f"{arguments}: status {result.returncode}\n{result.stderr}"
    return result.stdout


def bake(level, *more):
    about = json.loads(run("bake", level, "--parts", "lightmap", "--error", "0.3", "--hours", "12-12", "--json", *more))
    return about["lightmap"], next(part["why"] for part in about["parts"] if part["part"] == "lightmap")


def light(level, name):
    run("points", level, "--in", work / "points.csv", "--hour", "12", "--method", "lightmap", "--light",
        level.with_suffix(".daylit"), "-o", work / name)
    return [float(row[7]) for row in list(csv.reader((work / name).open()))[1:]]


run("make", "two_rooms", "-o", scene)
before, _ = bake(scene, "--export-glb", exported)
run("check", exported)
after, why = bake(exported, "--keep-uv2")
assert "kept as one layout" in why, why
assert (before["width"], before["height"]) == (after["width"], after["height"]), (before, after)

run("points", scene, "--sample", "surface", "--count", "200", "-o", work / "points.csv")
ours, theirs = light(scene, "ours.csv"), light(exported, "theirs.csv")
mean = sum(ours) / len(ours)
assert mean > 100
difference = (sum((a - b) ** 2 for a, b in zip(ours, theirs)) / len(ours)) ** 0.5 / mean
assert difference < 0.1, difference  # the same texels, with other rays

for level in (scene, exported):
    run("shot", level, "-o", level.with_suffix(".png"), "--size", "160x90", "--hour", "12", "--ev", "10", "--show", "direct")
shots = json.loads(run("compare", scene.with_suffix(".png"), exported.with_suffix(".png"), "--json"))
assert shots["max_abs"] == 0, shots
print("the exported scene looks the same, and its layout is kept")
