#!/usr/bin/env python3
"""The figures of RESULTS.md, measured: prints Markdown tables.

  figures.py DAYLIT WORK [direct] [contexts] [cold] [renders] [lightmap] [--shared FOLDER]

direct    shot --show direct against reference --show direct: demo level and two shared scenes, 3 cameras, 3 hours
contexts  largest difference between EGL, OSMesa and GLFW on every camera of the demo level at 3 hours (needs a display)
cold      whole-process time of one shot of the demo level
renders   reference against the independent renders of the shared folder
lightmap  baked irradiance at random surface points against the reference
"""
import json
import pathlib
import subprocess
import sys
import time

arguments = sys.argv[1:]
shared = pathlib.Path(__file__).resolve().parents[2].parent / "shared"
if "--shared" in arguments:
    at = arguments.index("--shared")
    shared = pathlib.Path(arguments[at + 1])
    del arguments[at:at + 2]
if len(arguments) < 2:
    sys.exit(__doc__)
daylit, work = arguments[0], pathlib.Path(arguments[1])
wanted = arguments[2:] or ["direct", "contexts", "cold", "renders", "lightmap"]
work.mkdir(parents=True, exist_ok=True)
HOURS = (7, 12, 18)
LEVEL = work / "koldinghus.glb"
LIGHT = work / "koldinghus.daylit"


def run(*command):
    result = subprocess.run([daylit, *map(str, command)], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"daylit {' '.join(map(str, command))}\nended with {result.returncode}: {result.stderr}")
    return result.stdout


def compare(a, b):
    return json.loads(run("compare", a, b, "-o", a.with_suffix(".difference.png"), "--json"))


def level():
    if not LEVEL.exists():
        run("make", "koldinghus", "-o", LEVEL)
    return LEVEL


def free(eye, at, fov):
    return ["--eye", eye, "--at", at, "--fov", fov]


def direct_views():
    for camera in ("hall", "courtyard", "treasury"):
        yield level(), f"koldinghus {camera}", ["--camera", camera]
    duplex = shared / "scenes/duplex-apartment/duplex-apartment.gltf"
    site = ["--latitude", "41.8744", "--longitude", "-87.6394", "--utc-offset", "-5"]
    for name, where in {"living": free("3.2,1.5,13.2", "5.2,1.0,19.8", 60), "garden": free("14,4,30", "4,1,12", 50),
                        "above": free("-12,12,28", "4,1,10", 45)}.items():
        yield duplex, f"duplex {name}", where + site
    room = shared / "scenes/living-room/living_room.glb"
    for name, where in {"door": free("0,0.5,11", "0,0,0", 50), "corner": free("4,2,6", "-4,-1,-2", 60),
                        "outside": free("9,7,18", "0,0,5", 50)}.items():
        yield room, f"living-room {name}", where


def direct():
    print("| view | hour | bias | flip_mean | flip_p95 | reference s.e. |\n|---|---|---|---|---|---|")
    for scene, name, where in direct_views():
        if not scene.exists():
            print(f"| {name} | | skipped: {scene} is missing |")
            continue
        for hour in HOURS:
            stem = f"direct-{name.replace(' ', '-')}-{hour}"
            ours, reference = work / f"{stem}.exr", work / f"{stem}.reference.exr"
            view = [*where, "--hour", hour, "--size", "320x180", "--show", "direct"]
            run("shot", scene, "-o", ours, *view)
            told = json.loads(run("reference", scene, "-o", reference, *view, "--spp", "4096" if "treasury" in name else "512", "--json"))
            m = compare(ours, reference)
            print(f"| {name} | {hour} | {m['bias']:+.4f} | {m['flip_mean']:.4f} | {m['flip_p95']:.4f} "
                  f"| {told['relative_error']:.4f} |", flush=True)


def contexts():
    cameras = [camera["name"] if isinstance(camera, dict) else camera
               for camera in json.loads(run("check", level(), "--json"))["cameras"]]
    print("| camera | hour | EGL - OSMesa | EGL - GLFW |\n|---|---|---|---|")
    for camera in cameras:
        for hour in HOURS:
            shots = {}
            for kind in ("egl", "osmesa", "glfw"):
                shots[kind] = work / f"context-{kind}.png"
                run("shot", LEVEL, "-o", shots[kind], "--camera", camera, "--hour", hour, "--size", "320x180",
                    "--ev", "10", "--context", kind)
            steps = [json.loads(run("compare", shots["egl"], shots[other], "--json"))["max_abs_8bit"]
                     for other in ("osmesa", "glfw")]
            print(f"| {camera} | {hour} | {steps[0]}/255 | {steps[1]}/255 |", flush=True)


def cold():
    level()
    light = ["--light", LIGHT] if LIGHT.exists() else []
    seconds = []
    for _ in range(5):
        start = time.monotonic()
        run("shot", LEVEL, "-o", work / "cold.png", *light, "--camera", "hall", "--hour", "12")
        seconds.append(time.monotonic() - start)
    print(f"cold start of shot to the written PNG, 1280x720: median {sorted(seconds)[2]:.2f} s, "
          f"{min(seconds):.2f} to {max(seconds):.2f} s")


def renders():
    sun = ["--sun-lux", "90000", "--materials", "lambert", "--bounces", "13"]
    duplex = (shared / "scenes/duplex-apartment/duplex-apartment.gltf",
              free("3.2,1.5,13.2", "5.2,1.0,19.8", 60) + ["--size", "240x150", "--sun-direction", "0.2,0.6,0.77"])
    room = (shared / "scenes/living-room/living_room.glb",
            free("0,0.5,11", "0,0,0", 50) + ["--size", "320x200", "--sun-direction", "0.3,0.6,0.74"])
    print("| render | bias | flip_mean | nrmse |\n|---|---|---|---|")
    for name, (scene, view), sky, show, spp in (
            ("duplex-final", duplex, "4000,4000,4000", "final", 1024), ("duplex-sun-direct", duplex, "none", "direct", 128),
            ("living-room-final", room, "4000,4000,4000", "final", 1024),
            ("living-room-sun-direct", room, "none", "direct", 256)):
        if not scene.exists():
            print(f"| {name} | skipped: {scene} is missing |")
            continue
        ours = work / f"{name}.exr"
        run("reference", scene, "-o", ours, *view, *sun, "--sky", sky, "--show", show, "--spp", spp)
        m = compare(ours, shared / "reference/renders" / f"{name}.exr")
        print(f"| {name} | {m['bias']:+.4f} | {m['flip_mean']:.4f} | {m['nrmse']:.4f} |", flush=True)


def lightmap():
    if not LIGHT.exists():
        start = time.monotonic()
        run("bake", level(), "-o", LIGHT, "--quality", "preview")
        print(f"bake --quality preview: {time.monotonic() - start:.0f} s, {LIGHT.stat().st_size / 1e6:.1f} MB\n")
    points = work / "points.csv"
    run("points", level(), "--sample", "surface", "--count", 2000, "--seed", 1, "-o", points)
    print("| hour | nrmse | bias | p95 |\n|---|---|---|---|")
    for hour in HOURS:
        ours, reference = work / f"lightmap-{hour}.csv", work / f"reference-{hour}.csv"
        run("points", LEVEL, "--in", points, "--hour", hour, "--method", "lightmap", "--light", LIGHT, "-o", ours)
        run("points", LEVEL, "--in", points, "--hour", hour, "--method", "reference", "--spp", 1024, "-o", reference)
        m = json.loads(run("compare", ours, reference, "--json"))
        print(f"| {hour} | {m['nrmse']:.3f} | {m['bias']:+.4f} | {m['p95']:.3f} |", flush=True)


for figure in wanted:
    print(f"\n### {figure}\n")
    {"direct": direct, "contexts": contexts, "cold": cold, "renders": renders, "lightmap": lightmap}[figure]()
