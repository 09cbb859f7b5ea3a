#!/usr/bin/env python3
"""daylit report from end to end: the page is well-formed and whole, its numbers agree, and a second start goes on.

Usage: report.py DAYLIT WORK_FOLDER
"""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

daylit, work = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
scene, out = work / "rooms.glb", work / "report"


def run(*arguments, status=0):
    result = subprocess.run([daylit, *map(str, arguments)], capture_output=True, text=True, timeout=600)
    assert result.returncode == status, f"{arguments}: status {result.returncode}\n{result.stderr}"
    return result


def report(*more, **keywords):
    return run("report", scene, "-o", out, "--quick", "--error", "1", "--points", "20", "--spp", "32", "--hours", "11,12",
               "--methods", "lightmap,encodings,whole-day,seen-frames,volume-modes", "--size", "64x36", *more, **keywords)


run("make", "two_rooms", "-o", scene)
report()
page = xml.parse(out / "index.html").getroot()  # well-formed
text = "".join(page.itertext())
data = json.loads((out / "report.json").read_text())
rows = list(csv.DictReader((out / "report.csv").open()))

# The same runs in all three.
assert [run["name"] for run in data["runs"]] == [row["setting"] for row in rows]
settings = [run["name"] for run in data["runs"] if run["method"] == "lightmap"]
assert settings[0] == "base" and len(settings) == 4, settings  # the base, and one of each axis
for setting in settings:
    assert setting in text, setting
for run_, row in zip(data["runs"], rows):
    assert not run_["failure"] or (run_["method"] == "seen-frames" and data["no_pictures"]), run_
    assert all(abs(float(row[key]) - value) <= 1e-6 * abs(value) for key, value in run_["values"].items()), row
base = data["runs"][0]["values"]
assert 0 < base["nrmse"] < 2 and abs(base["bias"]) < 1 and base["file_bytes"] > 1000 and base["bake_seconds"] > 0
assert data["standard_error"]["surface"] > 0

# One solution stored several ways: fewer bytes, larger errors; the paper's scheme the better the more vectors it has.
stored = {run["name"]: run["values"] for run in data["runs"] if run["method"] == "encodings"}
tiles = [values for name, values in stored.items() if name.startswith("tiles")]
paper = [stored[f"paper, {vectors} vectors"] for vectors in (5, 10, 20, 40)]
for finer, coarser in list(zip(tiles, tiles[1:])) + list(zip(paper[1:], paper)):
    assert finer["file_bytes"] > coarser["file_bytes"] and finer["displayed_worst"] < coarser["displayed_worst"]
assert stored["all frames"]["displayed_worst"] < 1e-3
assert all(0 < values["nrmse"] < 2 and abs(values["bias"]) < 1 for values in stored.values())
found = data["findings"]["encodings"]
assert found["frames_bytes"] > stored["all frames"]["file_bytes"] > paper[-1]["file_bytes"]
assert 3 <= found["paper_frames"] and found["paper_over_tiles_bytes"] > 1
assert "half floats" in text

# A day beside an hour: ratios are those of the rows, and rays are traced once.
day, one_bounce, hour = (run["values"] for run in data["runs"] if run["method"] == "whole-day")
for key, what in (("bake_seconds", "wall"), ("bake_processor_seconds", "processor")):
    ratio = data["findings"]["whole-day"][f"day_over_hour_{what}"]
    assert abs(ratio - day[key] / one_bounce[key]) < 1e-9 * ratio
assert "nrmse" not in one_bounce and abs(day["nrmse"] - hour["nrmse"]) < 0.02

# The same light twice, once compressed: the frames are alike, and not the same.
if not data["no_pictures"]:
    seen = next(run["values"] for run in data["runs"] if run["method"] == "seen-frames")
    assert 0 < seen["flip_mean"] < 0.02 and 0 <= seen["yee_share"] < 0.01, seen

# Ways to look a volume up: all are there; fewer bands are farther from the gather itself; what cannot differ does not.
# (How blends compare is seen on fields that are known, VolumeBlends: twenty points and some hundred cells do not tell.)
modes = {}
for run_ in data["runs"]:
    if run_["method"] == "volume-modes":
        modes.setdefault(run_["axis"], []).append(run_["values"])
assert set(modes) == {"Adini-Hermite", "uniform grid", "trilinear", "Oat", "Annen", "half gradient", "two bands",
                      "two bands and ZH3", "four bands"}, modes.keys()
for values in sum(modes.values(), []):
    assert 0 < values["gather_nrmse"] < 1 and 0 < values["nrmse"] < 2 and abs(values["bias"]) < 1, values
    assert values["file_bytes"] > 1000 and 0 < values["look_up_seconds"] < 1e-3
for i, best in enumerate(modes["Adini-Hermite"]):
    four, two = modes["four bands"][i], modes["two bands"][i]
    assert four["nrmse"] == best["nrmse"] and four["file_bytes"] > best["file_bytes"] > two["file_bytes"]
    assert best["gather_nrmse"] < two["gather_nrmse"], i
assert 0 < data["findings"]["volume-modes"]["gather_error"] < 0.2
for mode in ("Adini-Hermite", "trilinear"):
    bytes_of = [values["file_bytes"] for values in modes[mode]]
    fine, coarse = bytes_of[::2], bytes_of[1::2]
    assert fine == sorted(fine, reverse=True) and coarse == sorted(coarse, reverse=True), "largest first"
    assert all(c < 0.9 * f for f, c in zip(fine, coarse)), "the same in coarser steps"

# Charts, and files that the page shows and that are there.
svg = "{http://www.w3.org/2000/svg}"
charts = [c for c in page.iter(svg + "svg") if c.get("role") == "img"]
assert len(charts) >= 3 and all(list(c.iter(svg + "circle")) for c in charts), len(charts)
assert any("best" in circle.get("class") for circle in page.iter(svg + "circle"))
shown = [image.get("src") for image in page.iter("img")]
assert bool(shown) != bool(data["no_pictures"]), "pictures, or why not"
for image in shown:
    assert (out / image).stat().st_size > 0, image
for attribute in (value for element in page.iter() for value in element.attrib.values()):
    assert "://" not in attribute, attribute

# A second start finds everything; with other settings, or after a loss, it measures what is missing.
def numbers(data):
    times = ("seconds", "peak_bytes")
    return [{k: v for k, v in run["values"].items() if not any(t in k for t in times)} for run in data["runs"]]


before = (out / "report.csv").read_text()
assert "were there from before" in report().stderr
assert (out / "report.csv").read_text() == before
(out / "runs" / "lightmap-base.json").unlink()
report()
assert numbers(json.loads((out / "report.json").read_text())) == numbers(data), "not deterministic"

run("report", scene, "-o", out, "--methods", "sparkle", status=2)
run("report", scene, "-o", out, "--hours", "25", status=1)
run("report", scene, "-o", scene, "--quick", status=1)
run("report", scene, status=2)
assert (out / "report.csv").exists()
print("passed")
