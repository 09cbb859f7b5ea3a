#!/usr/bin/env python3
"""The figures of RESULTS.md, measured: prints Markdown tables.

  figures.py DAYLIT WORK [direct] [contexts] [cold] [renders] [lightmap] [views] [seen] [moved] [--shared FOLDER] [--hours 9,12]

direct    shot --show direct against reference --show direct: demo level and two shared scenes, 3 cameras, 3 hours
contexts  largest difference between EGL, OSMesa and GLFW on every camera of the demo level at 3 hours (needs a display)
cold      whole-process time of one shot of the demo level
renders   reference against the independent renders of the shared folder
lightmap  baked irradiance at random surface points against the reference
views     shot against reference, final and indirect, every named camera (medium.daylit in WORK, baked when missing);
          nrmse of indirect light also without the references' own noise
seen      frames drawn with the compressed lightmap that can be told from the uncompressed one's, every camera
moved     the cart with the teapot moved to ten spots: final light against the reference on its pixels (the same bake)
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
hours = (7, 12, 18)
if "--hours" in arguments:
    at = arguments.index("--hours")
    hours = tuple(float(hour) if '.' in hour else int(hour) for hour in arguments[at + 1].split(","))
    del arguments[at:at + 2]
if len(arguments) < 2:
    sys.exit(__doc__)
daylit, work = arguments[0], pathlib.Path(arguments[1])
wanted = arguments[2:] or ["direct", "contexts", "cold", "renders", "lightmap"]
work.mkdir(parents=True, exist_ok=True)
LEVEL = work / "koldinghus.glb"
LIGHT = work / "koldinghus.daylit"
MEDIUM = work / "medium.daylit"


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
        for hour in hours:
            stem = f"direct-{name.replace(' ', '-')}-{hour}"
            ours, reference = work / f"{stem}.exr", work / f"{stem}.reference.exr"
            view = [*where, "--hour", hour, "--size", "320x180", "--show", "direct"]
            run("shot", scene, "-o", ours, *view)
            told = json.loads(run("reference", scene, "-o", reference, *view, "--spp", 4096 if "treasury" in name else 512,
                                  "--json"))
            m = compare(ours, reference)
            print(f"| {name} | {hour} | {m['bias']:+.4f} | {m['flip_mean']:.4f} | {m['flip_p95']:.4f} "
                  f"| {told['relative_error']:.4f} |", flush=True)


def cameras():
    return [camera["name"] if isinstance(camera, dict) else camera
            for camera in json.loads(run("check", level(), "--json"))["cameras"]]


def contexts():
    print("| camera | hour | EGL - OSMesa | EGL - GLFW |\n|---|---|---|---|")
    for camera in cameras():
        for hour in hours:
            shots = {}
            for kind in ("egl", "osmesa", "glfw"):
                shots[kind] = work / f"context-{kind}.png"
                run("shot", LEVEL, "-o", shots[kind], "--camera", camera, "--hour", hour, "--size", "320x180",
                    "--ev", "10", "--context", kind)
            steps = [json.loads(run("compare", shots["egl"], shots[other], "--json"))["max_abs_8bit"]
                     for other in ("osmesa", "glfw")]
            print(f"| {camera} | {hour} | {steps[0]}/255 | {steps[1]}/255 |", flush=True)


def medium():
    if not MEDIUM.exists():
        run("bake", level(), "-o", MEDIUM, "--quality", "medium")
    return MEDIUM


def without_noise(ours, references, mean):
    """nrmse without the references' noise: that of two seeds is independent, so that the mean of the products of both
    differences is the square of our error alone, E[(o-a)(o-b)] = (|o-a|^2 + |o-b|^2 - |a-b|^2) / 2. Below zero by
    chance where the error is small against the noise."""
    apart = [compare(ours, reference)["mse"] for reference in references]
    square = (sum(apart) - compare(*references)["mse"]) / 2
    return (1 if square >= 0 else -1) * abs(square) ** 0.5 / mean


def views():
    print("| camera | hour | final: flip_mean | bias | s.e. | indirect: nrmse | without noise | bias | s.e. |\n"
          "|---|---|---|---|---|---|---|---|---|")
    for camera in cameras():
        for hour in hours:
            row = {}
            for show in ("final", "indirect"):
                ours = work / f"{camera}-{hour}-{show}.exr"
                references = [work / f"{camera}-{hour}-{show}.reference{seed}.exr" for seed in (1, 2)]
                view = ["--camera", camera, "--hour", hour, "--size", "160x90", "--show", show]
                run("shot", level(), "-o", ours, "--light", medium(), *view)
                for seed, reference in enumerate(references[:1 if show == "final" else 2], 1):
                    told = json.loads(run("reference", level(), "-o", reference, *view, "--spp", 512, "--seed", seed,
                                          "--json"))
                row[show] = compare(ours, references[0]) | {"error": told["relative_error"]}
            final, indirect = row["final"], row["indirect"]
            real = without_noise(ours, references, indirect["rmse"] / indirect["nrmse"])
            print(f"| {camera} | {hour} | {final['flip_mean']:.3f} | {final['bias']:+.3f} | {final['error']:.3f} "
                  f"| {indirect['nrmse']:.3f} | {real:.3f} | {indirect['bias']:+.3f} | {indirect['error']:.3f} |",
                  flush=True)


def seen():
    """In one picture a camera and hour; those of every 5 minutes are a matter of --hours."""
    folder = work / "seen"
    run("report", level(), "-o", folder, "--methods", "seen-frames", "--points", 1, "--spp", 4, "--picture-spp", 2,
        "--size", "320x180", "--quality", "medium", "--picture-hours", ",".join(map(str, hours)))
    report = json.loads((folder / "report.json").read_text())
    print("| camera | hour | pixels | flip_mean |\n|---|---|---|---|")
    for picture in report["runs"][0]["pictures"]:
        values = picture["values"]
        print(f"| {picture['view']} | {picture['hour']:g} | {values['yee_share'] * 320 * 180:.0f} "
              f"| {values['flip_mean']:.4f} |")
    print(report["findings"]["seen-frames"])


# Where the cart's wheels stand: hall, by its windows, doorway, courtyard in sun and shade, arcade, treasury.
SPOTS = ((-6, 0.3, 18), (4, 0.3, 17), (9, 0.3, 20.5), (-10, 0.3, 15), (6, 0.3, 13), (0, 0, 3), (-6, 0, -4), (5, 0, -12.4),
         (-8, 0, -12.4), (18.5, 0.3, 4.5))


def moved():
    try:
        import numpy
        import OpenImageIO
    except ImportError:
        sys.exit("moved: NOT RUN, Python's numpy and OpenImageIO are missing")

    def pixels(path):
        image = OpenImageIO.ImageInput.open(str(path))
        size = image.spec()
        return numpy.asarray(image.read_image(OpenImageIO.FLOAT)).reshape(size.height, size.width, -1)[:, :, :3]

    print("| spot | hour | nrmse on the cart | bias |\n|---|---|---|---|")
    for x, y, z in SPOTS:
        for hour in hours:
            view = ["--eye", f"{x - 1.6},{y + 1.3},{z - 1.2}", "--at", f"{x},{y + 0.55},{z}", "--fov", 50, "--hour", hour,
                    "--size", "160x120"]
            here, away = ["--move", f"rolling cart={x},{y},{z}"], ["--move", "rolling cart=0,-50,0"]
            shots = {name: work / f"moved-{name}.exr" for name in ("here", "away", "ours", "reference")}
            run("shot", level(), "-o", shots["here"], *view, *here, "--show", "depth")
            run("shot", level(), "-o", shots["away"], *view, *away, "--show", "depth")
            run("shot", level(), "-o", shots["ours"], *view, *here, "--light", medium())
            run("reference", level(), "-o", shots["reference"], *view, *here, "--spp", 512)
            image = {name: pixels(path) for name, path in shots.items()}
            cart = numpy.abs(image["here"][:, :, 0] - image["away"][:, :, 0]) > 0.02
            ours, truth = image["ours"][cart], image["reference"][cart]
            print(f"| {x}, {y}, {z} | {hour} | {numpy.sqrt(numpy.mean((ours - truth) ** 2)) / truth.mean():.3f} "
                  f"| {ours.mean() / truth.mean() - 1:+.3f} |", flush=True)


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
    for hour in hours:
        ours, reference = work / f"lightmap-{hour}.csv", work / f"reference-{hour}.csv"
        run("points", LEVEL, "--in", points, "--hour", hour, "--method", "lightmap", "--light", LIGHT, "-o", ours)
        run("points", LEVEL, "--in", points, "--hour", hour, "--method", "reference", "--spp", 1024, "-o", reference)
        m = json.loads(run("compare", ours, reference, "--json"))
        print(f"| {hour} | {m['nrmse']:.3f} | {m['bias']:+.4f} | {m['p95']:.3f} |", flush=True)


for figure in wanted:
    print(f"\n### {figure}\n")
    {"direct": direct, "contexts": contexts, "cold": cold, "renders": renders, "lightmap": lightmap,
     "views": views, "seen": seen, "moved": moved}[figure]()
