#!/usr/bin/env python3
"""Screenshots off-screen through EGL against small path-traced references.

  screenshots.py DAYLIT WORK --list             the cases by name
  screenshots.py DAYLIT WORK --prepare          makes and bakes the scenes in WORK
  screenshots.py DAYLIT WORK --case NAME        one test; pictures land in WORK
  screenshots.py DAYLIT WORK --day              a day's frames, drawn by one renderer, against shots of their hours
  screenshots.py DAYLIT WORK --renew [NAME ...] path-traces references anew (all of them without a name)

The references lie in references/ beside this file; each EXR's header holds the command and the standard error that made
it. A missing reference is a failure. On failure WORK holds NAME.exr, NAME.reference.exr and NAME.difference.png.
"""
import json
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
SIZE = "160x90"  # where a case says no other
SAMPLES = "8"  # along a pixel side: at this size most pixels hold an edge, and a sky seen through lead is 1000 times the wall
DAY_APART = 6  # of 255: the sun's cascades keep their place from frame to frame, so shadows' edges move by parts of a texel
TABLE = json.loads((HERE / "cases.json").read_text())
daylit, work = sys.argv[1], pathlib.Path(sys.argv[2])


def cases():
    for row in TABLE["cases"]:
        for hour in row["hours"]:
            yield row | {"hour": hour, "name": f"{row['scene']}-{row['camera']}-{hour:02d}-{row['show']}"}


def run(*arguments):
    result = subprocess.run([daylit, *map(str, arguments)], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"daylit {' '.join(map(str, arguments))}\nended with {result.returncode}: {result.stderr}")
    return result.stdout


def scene_file(name):
    return work / f"{name}.glb"


def light_file(name):
    return work / f"{name}.daylit"


def prepare(names, bake=True):
    work.mkdir(parents=True, exist_ok=True)
    for name in names:
        run("make", name, "-o", scene_file(name))
        if bake and "bake" in TABLE["scenes"][name]:
            run("bake", scene_file(name), "-o", light_file(name), *TABLE["scenes"][name]["bake"])


def view(case):
    return ["--camera", case["camera"], "--hour", case["hour"], "--size", case.get("size", SIZE), "--show", case["show"]]


def renew(case):
    target = HERE / "references" / f"{case['name']}.exr"
    target.parent.mkdir(exist_ok=True)
    run("reference", scene_file(case["scene"]), "-o", target, *view(case), "--spp", case["spp"])
    print(f"renewed {target.name}", flush=True)


def problems(case, measures):
    """What is wrong by the case's limits. Where the reference is black no ratio to it says anything: there `darkness`
    is the most that the picture's mean luminance may be, in cd/m^2, so that a leak of light shows."""
    found = []
    if measures["nan_count"]:
        found.append(f"{measures['nan_count']} channels are no numbers")
    if "darkness" in case:
        limits = {"mean_a": case["darkness"], "mean_b": case["darkness"]}
    else:
        limits = {"bias": case["bias"], "flip_mean": case["flip"]}
    for name, limit in limits.items():
        if measures[name] is None or not abs(measures[name]) <= limit:
            found.append(f"{name} is {measures[name]}, beyond {limit}")
    return found


def test(case):
    reference = HERE / "references" / f"{case['name']}.exr"
    if not reference.exists():
        sys.exit(f"{reference} is missing; make it with: tests/images/screenshots.py DAYLIT WORK --renew {case['name']}")
    ours = work / f"{case['name']}.exr"
    difference = work / f"{case['name']}.difference.png"
    light = ["--light", light_file(case["scene"])] if light_file(case["scene"]).exists() else []
    run("shot", scene_file(case["scene"]), "-o", ours, *light, *view(case), "--context", "egl",
        "--samples", SAMPLES)
    measures = json.loads(run("compare", ours, reference, "-o", difference, "--json"))
    print(case["name"], {name: measures[name] for name in ("bias", "flip_mean", "mean_a", "mean_b")})
    found = problems(case, measures)
    if found:
        shutil.copy(reference, work / f"{case['name']}.reference.exr")
        sys.exit(f"FAILED: {'; '.join(found)}\nlook at {ours}, its .reference.exr and {difference}")


def test_day():
    level, folder = scene_file("koldinghus"), work / "day"
    where = ["--light", light_file("koldinghus"), "--camera", "hall", "--size", SIZE]
    run("day", level, "-o", folder, "--from", "5", "--to", "18", "--every", "6h", *where)
    frames = sorted(folder.glob("??h??.png"))
    if len(frames) != 3:
        sys.exit(f"{folder} holds {[f.name for f in frames]} instead of three frames")
    for frame in frames:
        shot = frame.with_name(f"shot-{frame.name}")
        run("shot", level, "-o", shot, "--hour", frame.stem.replace("h", ":"), *where)
        most = json.loads(run("compare", frame, shot, "--json"))["max_abs_8bit"]
        print(f"{frame.stem}: at most {most}/255 apart")
        if most > DAY_APART:
            sys.exit(f"{frame} differs from {shot} by {most}/255")


def main(mode, names):
    table = {case["name"]: case for case in cases()}
    unknown = [name for name in names if name not in table]
    if unknown:
        sys.exit(f"no case {', '.join(unknown)}; there are {', '.join(table)}")
    if mode == "--list":
        print(";".join(table), end="")
    elif mode == "--prepare":
        prepare(TABLE["scenes"])
    elif mode == "--day":
        test_day()
    elif mode == "--renew":
        chosen = [table[name] for name in names] or list(table.values())
        prepare({case["scene"] for case in chosen}, bake=False)
        for case in chosen:
            renew(case)
    elif mode == "--case" and len(names) == 1:
        test(table[names[0]])
    else:
        sys.exit(__doc__)


main(sys.argv[3] if len(sys.argv) > 3 else "", sys.argv[4:])
