#!/usr/bin/env python3
"""Walks in a real window: keys and mouse go in through xdotool, and what the screen shows is looked at.

    with_display walk.py DAYLIT WORK_FOLDER

Waits are for a state to be reached, with a generous end; nothing depends on how fast the machine draws.
"""
import base64
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import time

WIDTH, HEIGHT = 720, 420
PANEL = 304  # pixels at the left that the panel covers
PATIENCE = 60.0  # seconds
SHADERS = pathlib.Path(__file__).parents[2] / "shaders"
# Centres of the panel's rows, in pixels from the top; its font and paddings are Dear ImGui's own, the same everywhere.
ROW = {"hour": 17, "play": 40, "layer": 84, "exposure": 107, "clouds": 130, "place": 176, "cameras": 199, "passes": 222}
STEP, LINE = 23, 17  # from one control to the next, from one line of a list to the next
LEFT, RIGHT = 14, 192  # ends of a slider


# ---- a level: grass, a red box 5 m ahead, a wall behind it, a blue wheel that turns ------------------------------

def box(x0, x1, y0, y1, z0, z1):
    """Positions and normals of the six faces, as triangles."""
    faces = [((x0, y0, z0), (0, 0, z1 - z0), (0, y1 - y0, 0)), ((x1, y0, z0), (0, y1 - y0, 0), (0, 0, z1 - z0)),
             ((x0, y0, z0), (x1 - x0, 0, 0), (0, 0, z1 - z0)), ((x0, y1, z0), (0, 0, z1 - z0), (x1 - x0, 0, 0)),
             ((x0, y0, z0), (0, y1 - y0, 0), (x1 - x0, 0, 0)), ((x0, y0, z1), (x1 - x0, 0, 0), (0, y1 - y0, 0))]
    positions, normals = [], []
    for p, u, v in faces:
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        size = sum(c * c for c in n) ** 0.5
        for a, b in ((0, 0), (1, 0), (1, 1), (0, 0), (1, 1), (0, 1)):
            positions.append([p[i] + a * u[i] + b * v[i] for i in range(3)])
            normals.append([c / size for c in n])
    return positions, normals


def write_level(path):
    parts = [("grass", box(-30, 30, -1, 0, -30, 30), [0.15, 0.4, 0.12, 1]),
             ("box", box(-1, 1, 0, 2, -7, -5), [0.8, 0.05, 0.04, 1]),
             ("wall", box(-30, 30, 0, 3, -12, -11), [0.6, 0.6, 0.55, 1])]
    data, views, accessors, meshes, materials = b"", [], [], [], []
    for name, (positions, normals), color in parts:
        for values in (positions, normals):
            packed = b"".join(struct.pack("<3f", *v) for v in values)
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
            accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "type": "VEC3",
                              "count": len(values), "min": [min(v[i] for v in values) for i in range(3)],
                              "max": [max(v[i] for v in values) for i in range(3)]})
            data += packed
        materials.append({"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": color, "metallicFactor": 0, "roughnessFactor": 1}})
        meshes.append({"primitives": [{"attributes": {"POSITION": len(accessors) - 2, "NORMAL": len(accessors) - 1},
                                       "material": len(materials) - 1}]})
    nodes = [{"name": part[0], "mesh": i} for i, part in enumerate(parts)]
    nodes += [{"name": "ahead", "camera": 0, "translation": [0, 1.62, 0]},
              {"name": "aside", "camera": 0, "translation": [8, 1.62, -2], "rotation": [0, 0.5735764, 0, 0.8191520]}]
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes, "meshes": meshes, "materials": materials, "accessors": accessors, "bufferViews": views,
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.05}}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}))


def copy_shaders(folder):
    """Shaders of our own, to change while walking: DAYLIT_SHADER_DIR names what holds them."""
    shutil.copytree(SHADERS, folder / "live" / "shaders")
    return folder / "live" / "shaders" / "tonemap.frag"


# ---- the screen --------------------------------------------------------------------------------------------------

def screen(left=PANEL, right=WIDTH):
    """Rows of (b, g, r, x) bytes of the window; right of the panel unless told otherwise."""
    raw = pathlib.Path(os.environ["DAYLIT_TEST_SCREEN"]).read_bytes()
    header = struct.unpack(">25I", raw[:100])
    start, stride = header[0] + 12 * header[19], header[12]
    return [raw[start + y * stride + 4 * left:start + y * stride + 4 * right] for y in range(HEIGHT)]


def brightness(picture, channel=1):
    return sum(sum(row[channel::4]) for row in picture) / sum(len(row) // 4 for row in picture)


def red_share(picture):
    """Share of pixels that are clearly red: the box."""
    red = total = 0
    for row in picture[::2]:
        for b, g, r in zip(row[0::8], row[1::8], row[2::8]):
            red += r > 40 and r > 2 * g and r > 2 * b
            total += 1
    return red / total


def difference(a, b):
    """Share of pixels that differ; the mouse pointer is among them, since the screen includes it."""
    pixels = [(r[i:i + 3], s[i:i + 3]) for r, s in zip(a, b) for i in range(0, len(r), 4)]
    return sum(p != q for p, q in pixels) / len(pixels)


def until(what, condition):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.1)
    sys.exit(f"walk: waited in vain for {what}")


# ---- the window --------------------------------------------------------------------------------------------------

def xdotool(*arguments):
    return subprocess.run(["xdotool", *map(str, arguments)], check=True, capture_output=True, text=True).stdout.strip()


class Walk:
    def __init__(self, daylit, folder, *options):
        self.out = open(folder / "walk.out", "w+")
        self.process = subprocess.Popen(
            [daylit, "walk", "level.gltf", "--size", f"{WIDTH}x{HEIGHT}", "--hour", "12", "--ev", "13.5", *options],
            cwd=folder, stdout=self.out, stderr=subprocess.STDOUT,
            env=os.environ | {"DAYLIT_SHADER_DIR": str(folder / "live")})
        self.window = until("the window", self.find)
        xdotool("mousemove", WIDTH - 40, HEIGHT - 40)
        until("the first picture", lambda: brightness(screen()) > 20)

    def find(self):
        if self.process.poll() is not None:
            sys.exit(f"walk: ended with status {self.process.returncode}: {self.output()}")
        found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", " - daylit$"], capture_output=True,
                               text=True).stdout.split()
        return found[0] if found else None

    def title(self):
        return xdotool("getwindowname", self.window)

    def hour(self):
        hours, minutes = self.title().split(" ")[1].split(":")
        return int(hours) + int(minutes) / 60

    def output(self):
        self.out.seek(0)
        return self.out.read()

    def place(self):
        """Where the camera is, as B prints it; all earlier events have been handled by then."""
        before = self.output().count("\nplace ")
        xdotool("key", "b")
        until("B to print the place", lambda: self.output().count("\nplace ") > before)
        return self.output().rsplit("\nplace ", 1)[1].split(": ", 1)[1].strip()

    def click(self, x, y):
        """On the panel: button and pointer stay until a frame has seen them; then the pointer goes where it hides nothing."""
        for action in (("mousemove", x, y, "mousedown", 1), ("mouseup", 1), ("mousemove", WIDTH - 40, HEIGHT - 40)):
            xdotool(*action)
            self.place(), self.place()

    def still(self):
        """The picture once the camera rests: asked for twice, so that the frame of the first answer is on the screen."""
        until("the camera to rest", lambda: self.place() == self.place())
        self.place()
        time.sleep(0.2)
        return screen()

    def ends(self):
        try:
            return self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            sys.exit("walk: the window does not close")


def check(condition, what):
    if not condition:
        sys.exit(f"walk: {what}")
    print(f"ok  {what}", flush=True)


def picture_files(folder):
    return sorted(folder.glob("level-*.png"))


def png_size(path):
    return struct.unpack(">2I", path.read_bytes()[16:24])


def check_shaders(walk, shader):
    plain, source = walk.still(), shader.read_text()
    body = source.rstrip().removesuffix("}")
    shader.write_text(body + "    out_display.g = 0.0;\n}\n")
    xdotool("key", "r")
    until("a picture without green", lambda: brightness(screen()) < 0.05 * brightness(plain))
    changed = walk.still()
    check(brightness(changed, 2) > 0.9 * brightness(plain, 2), "R draws with the shader that was changed, red as before")

    shader.write_text(body + "    out_display.g = no_such_thing;\n}\n")
    place = f"tonemap.frag:{body.count(chr(10)) + 1}:"
    xdotool("key", "r")
    until(f"the error at {place}", lambda: place in walk.output())
    check(walk.still() == changed, f"a broken shader is told by file and line ({place}), the one before goes on")
    shader.write_text(source)
    xdotool("key", "r")
    until("the picture of the first shader", lambda: screen() == plain)
    check(True, "mended, it draws the first picture again")


# ---- the panel -----------------------------------------------------------------------------------------------------

def panel_reaches_down():
    """An open list makes the panel so long that it darkens the sunlit grass there."""
    under, beside = (screen(*sides)[HEIGHT - 50:HEIGHT - 20] for sides in ((20, PANEL - 20), (PANEL + 20, WIDTH - 80)))
    return brightness(under) < 0.8 * brightness(beside)


def unfold(walk, row):
    walk.click(100, row)
    until("the panel to grow", panel_reaches_down)


def fold(walk, row):
    walk.click(100, row)
    until("the panel to shrink", lambda: not panel_reaches_down())


def check_layers(walk, noon):
    def choose(line):
        walk.click(100, ROW["layer"])
        walk.click(60, ROW["layer"] + 18 + line * LINE + LINE // 2)
    choose(5)
    until("the layer of normals", lambda: red_share(screen()) == 0 and screen() != noon)
    choose(0)
    until("the final picture", lambda: screen() == noon)
    check(True, "the list of layers shows normals and the final picture again")


def check_weather(walk, noon):
    walk.click(RIGHT, ROW["clouds"])
    until("clouds before the sun", lambda: brightness(screen()) < 0.8 * brightness(noon))
    walk.click(LEFT, ROW["clouds"])
    until("a clear sky", lambda: brightness(screen()) > 0.9 * brightness(noon))
    check(True, "the slider of clouds dims the level, and clears up")


def check_exposure(walk, noon):
    walk.click(130, ROW["exposure"])
    until("an overexposed picture", lambda: brightness(screen()) > 1.3 * brightness(noon))
    walk.click(17, ROW["exposure"])
    until("the eye to get used to it", lambda: brightness(screen()) < 1.3 * brightness(noon))
    check(True, "the slider of exposure overexposes, the automatic one finds back")


def check_place(walk):
    day = brightness(screen())
    unfold(walk, ROW["place"])
    latitude = ROW["place"] + STEP
    walk.click(LEFT, latitude)
    until("night at the south pole in June", lambda: brightness(screen()) < 0.2 * day)
    walk.click(RIGHT, latitude + 4 * STEP)
    until("day there in December", lambda: brightness(screen()) > 0.5 * day)
    check(True, "latitude and month make polar night and polar day")


def check_lists(walk):
    here = walk.place()
    unfold(walk, ROW["cameras"])
    walk.click(60, ROW["cameras"] + 2 * STEP + LINE - 3)
    until("the second camera of the list", lambda: walk.place() != here)
    fold(walk, ROW["cameras"])
    check(True, "the list of cameras goes to its second")
    unfold(walk, ROW["passes"])
    fold(walk, ROW["passes"])
    check(True, "the passes' times open and close")


def check_clock(walk):
    def hours_a_second(at_least):
        before, start = walk.hour(), time.monotonic()
        until("time to pass", lambda: (walk.hour() - before) % 24 > at_least)
        return (walk.hour() - before) % 24 / (time.monotonic() - start)
    walk.click(78, ROW["play"])
    walk.click(38, ROW["play"])
    slow = hours_a_second(0)
    walk.click(270, ROW["play"])
    fast = hours_a_second(2)
    check(fast > 10 * slow, f"the day goes by at the slider's speed ({slow:.2f} and {fast:.1f} hours a second)")
    walk.click(38, ROW["play"])
    until("the day to stand still", lambda: walk.place() and walk.hour() == (walk.place() and walk.hour()))
    check(True, "the button stops it")


def check_panel(daylit, folder):
    walk = Walk(daylit, folder)
    noon = walk.still()
    check_layers(walk, noon)
    check_weather(walk, noon)
    check_exposure(walk, noon)
    check_lists(walk)
    check_place(walk)
    check_clock(walk)
    xdotool("key", "Escape")
    check(walk.ends() == 0, "the walk of the panel ends with status 0")


def main():
    daylit, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    write_level(folder / "level.gltf")
    shader = copy_shaders(folder)

    walk = Walk(daylit, folder)
    first = walk.still()
    check("12:00" in walk.title(), f"the title tells the hour ({walk.title()})")
    check("no baked light" in walk.output(), "says that there is no baked light")
    check(red_share(first) > 0.005, "shows the box")

    xdotool("key", "F1")
    until("the help page", lambda: screen() != first)
    check(brightness(walk.still()) < 0.9 * brightness(first), "F1 shows the help page")
    xdotool("key", "F1")
    until("the picture without help", lambda: screen() == first)
    check(True, "F1 takes it away again")

    xdotool("keydown", "w")
    until("the box to grow", lambda: red_share(screen()) > 2 * red_share(first))
    check(True, "W walks ahead")
    # 4.7 m to go; at the box the camera rests though the key is held.
    stopped = walk.still()
    xdotool("keyup", "w")
    check(walk.still() == stopped, "the box stops the walker")
    check(0.3 < red_share(stopped) < 1, "in front of it, not inside")

    xdotool("key", "2")
    aside = until("the second camera", lambda: (p := walk.still()) != stopped and p)
    check(red_share(aside) < red_share(stopped), "2 goes to the second camera")
    xdotool("key", "1")
    until("the first camera", lambda: screen() == first)
    check(True, "1 comes back to exactly the first picture")

    xdotool("mousemove", WIDTH - 100, HEIGHT // 2, "click", 1)
    xdotool("mousemove_relative", "--sync", "--", -60, 0)
    until("the view to turn", lambda: walk.still() != first)
    turned = walk.still()
    check(red_share(turned) > 0.9 * red_share(first), "a click captures the mouse, moving it turns the view")
    xdotool("key", "Escape")
    walk.place()
    check(walk.process.poll() is None, "Esc frees the mouse")
    xdotool("mousemove_relative", "--sync", "--", 30, 0)
    check(difference(walk.still(), turned) < 0.01, "the free mouse turns nothing")

    xdotool("key", "F12")
    saved = until("the picture file", lambda: picture_files(folder))
    until("its path", lambda: str(saved[0]) in walk.output())
    check(png_size(saved[0]) == (WIDTH, HEIGHT), f"F12 saves {saved[0].name}")

    check_shaders(walk, shader)
    noon = brightness(turned)
    xdotool("mousemove", 150, 15, "mousedown", 1)
    xdotool("mousemove", 60, 15)
    xdotool("mousemove", 20, 15)
    until("the slider's hour", lambda: " 00:" in walk.title() or " 01:" in walk.title())
    xdotool("mouseup", 1)
    until("night", lambda: brightness(screen()) < 0.3 * noon)
    check(True, f"the slider makes night of noon ({walk.title()})")

    before = walk.title()
    xdotool("key", "p")
    until("time to pass", lambda: walk.title() != before)
    xdotool("key", "p")
    walk.still()
    paused = walk.title()
    time.sleep(1)
    walk.still()
    check(walk.title() == paused, "P lets the day go by and stops it")

    xdotool("windowsize", "--sync", walk.window, WIDTH + 80, HEIGHT + 40)
    xdotool("key", "F12")
    until("a picture of the new size", lambda: [p for p in picture_files(folder)
                                                if p.stat().st_size and png_size(p) == (WIDTH + 80, HEIGHT + 40)])
    check(walk.process.poll() is None, "the window can be resized")

    xdotool("key", "Escape")
    check(walk.ends() == 0, "Esc ends with status 0")
    rest = [line for line in walk.output().splitlines() if "tonemap.frag" not in line]
    check(not any("error" in line for line in rest), "nothing else went wrong on the way")
    check_panel(daylit, folder)

    blind = subprocess.run([daylit, "walk", "level.gltf"], cwd=folder, capture_output=True, text=True,
                           env={k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")})
    line = blind.stderr.strip().splitlines()[-1]
    check(blind.returncode == 1 and "daylit shot" in line, f"without a display: {line}")


main()
