#!/usr/bin/env python3
"""Fails on an include against the arrows of the layout:

shaders/shared <- engine/{base,scene,baked} <- engine/{gl,render} <- demo,  engine/{base,scene,baked} <- gi <- demo
Usage: arrows.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

CORE = ["engine/base/", "engine/scene/", "engine/baked/"]
# folder -> project folders that its files may include
ALLOWED = {
    "shaders/shared/": ["shaders/shared/"],
    "engine/base/": ["shaders/shared/", "engine/base/"],
    "engine/scene/": ["shaders/shared/", "engine/base/", "engine/scene/"],
    "engine/baked/": ["shaders/shared/"] + CORE,
    "engine/gl/": ["shaders/shared/", "engine/base/", "engine/gl/"],
    "engine/render/": ["shaders/shared/", "engine/gl/", "engine/render/"] + CORE,
    "gi/": ["shaders/shared/", "gi/"] + CORE,
    "content/": ["shaders/shared/", "content/"] + CORE,
    "demo/": ["shaders/shared/", "engine/", "gi/", "content/", "demo/"],
}
# system header -> the only folders that may include it
PRIVATE = {
    "embree3/": ["gi/trace/"],
    "glad/": ["engine/gl/", "engine/render/", "demo/"],
    "GLFW/": ["engine/gl/", "demo/"],
    "EGL/": ["engine/gl/"],
    "GL/": ["engine/gl/"],
    "tiny_gltf.h": ["engine/scene/", "content/"],
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]')


def errors(root):
    checked = 0
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        folder = next((f for f in ALLOWED if name.startswith(f)), None)
        if folder is None or path.suffix not in {".h", ".cpp"}:
            continue
        checked += 1
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            target = match.group(1)
            ours = re.match(r"(shaders|engine|gi|content|demo|tests)/", target)
            if ours and not any(target.startswith(allowed) for allowed in ALLOWED[folder]):
                yield f"{name}:{number}: {folder} may not include {target}"
            for prefix, owners in PRIVATE.items():
                if target.startswith(prefix) and not any(name.startswith(owner) for owner in owners):
                    yield f"{name}:{number}: {target} belongs to {', '.join(owners)}"
    if checked < 20:
        yield f"{root}: only {checked} files found; is this the source folder?"


found = list(errors(pathlib.Path(sys.argv[1])))
print("\n".join(found) or "all includes follow the arrows")
sys.exit(1 if found else 0)
