#!/usr/bin/python3
"""Renders a street through a day and checks that its light changes as a day's does: no jump, no pulsing, no NaN.

Usage: tools/bench/day.py SCENE.glb FOLDER [--camera front] [--weather clear] [--step 1] [--pluvia build/pluvia]
Run the same line again to go on. Needs Debian's python3-openimageio.

FOLDER gets day.csv (minute, sun's elevation in degrees, mean radiance in cd/m2, exposure, mean of the displayed picture)
and strip.png, the picture of each hour at its own exposure. Lamps are off, so that what changes is the sky's light.
Bounds: |d ln L| a minute at most 0.03 with the sun above 20 degrees, 0.12 above 0 and 0.35 above -18 (below, the moon's
0.12), and its change from a minute to the next at most 0.04.
"""
import argparse
import csv
import json
import math
import os
import subprocess
import sys

import numpy
import OpenImageIO as oiio


def read(path, names=None):
    file = oiio.ImageInput.open(path)
    if not file:
        sys.exit(f"day: {path}: cannot be read ({oiio.geterror()})")
    channels = range(3) if names is None else [file.spec().channelnames.index(n) for n in names]
    picture = file.read_image(0, 0, 0, file.spec().nchannels, "float")
    file.close()
    return picture[..., list(channels)].astype(numpy.float64)


def frame(options, minute):
    hour = minute / 60
    command = [options.pluvia, "render", options.scene, "-o", options.folder + "/frame", "--camera", options.camera,
               "--size", "96x48", "--spp", "16", "--weather", options.weather, "--hour", f"{hour:.6f}", "--lamps", "off",
               "--progress", "none", "--json", "--overwrite"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:  # 4 where a sample was not finite
        sys.exit(f"day: {' '.join(command)}: failed\n{done.stderr}")
    sky = subprocess.run([options.pluvia, "sky", "--weather", options.weather, "--hour", f"{hour:.6f}", "--json"],
                         capture_output=True, text=True, check=True)
    radiance = read(options.folder + "/frame/frame.exr", ["background.R", "background.G", "background.B"])
    shown = read(options.folder + "/frame/background.png")
    luminance = float((radiance @ [0.2126, 0.7152, 0.0722]).mean())
    row = {"minute": minute, "sun": json.loads(sky.stdout)["sun"]["elevation_degrees"], "luminance": luminance,
           "ev100": json.loads(done.stdout)["exposure_ev100"], "shown": float(shown.mean())}
    if minute % 60 == 0:
        os.replace(options.folder + "/frame/background.png", f"{options.folder}/{minute // 60:02d}.png")
    return row


def bound(sun):
    return 0.03 if sun >= 20 else 0.12 if sun >= 0 else 0.35 if sun >= -18 else 0.12


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("folder")
    parser.add_argument("--camera", default="front")
    parser.add_argument("--weather", default="clear")
    parser.add_argument("--step", type=int, default=1, help="minutes")
    parser.add_argument("--pluvia", default="build/pluvia")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    path = options.folder + "/day.csv"
    rows = {}
    if os.path.exists(path):
        with open(path, newline="", encoding="utf-8") as file:
            rows = {int(r["minute"]): {k: float(v) for k, v in r.items()} for r in csv.DictReader(file)}
    with open(path, "a", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ["minute", "sun", "luminance", "ev100", "shown"])
        if not rows:
            writer.writeheader()
        for minute in range(0, 1441, options.step):
            if minute not in rows:
                rows[minute] = frame(options, minute)
                writer.writerow(rows[minute])
                file.flush()
    report([rows[m] for m in range(0, 1441, options.step)], options)


def report(rows, options):
    slopes = [(math.log(b["luminance"] / a["luminance"]) / options.step, a, b) for a, b in zip(rows, rows[1:])]
    worst = max(slopes, key=lambda s: abs(s[0]) / bound(s[2]["sun"]))
    bends = [((t[0] - s[0]) / options.step, t[1]) for s, t in zip(slopes, slopes[1:])]
    bend = max(bends, key=lambda b: abs(b[0]))
    flicker = max((abs(b["shown"] - a["shown"]) / options.step, a) for a, b in zip(rows, rows[1:]))
    clock = lambda row: f"{int(row['minute']) // 60:02d}:{int(row['minute']) % 60:02d}"
    print(f"{options.weather}: {len(rows)} pictures")
    print(f"largest |d ln L| a minute against its bound: {worst[0]:+.3f} of {bound(worst[2]['sun'])} at {clock(worst[1])}, "
          f"sun {worst[1]['sun']:.1f} degrees")
    print(f"largest change of it from a minute to the next: {bend[0]:+.3f} at {clock(bend[1])}, sun {bend[1]['sun']:.1f}")
    print(f"largest change of the displayed mean a minute: {255 * flicker[0]:.2f} of 255 at {clock(flicker[1])}")
    print(f"midnight to midnight: {rows[-1]['luminance'] / rows[0]['luminance'] - 1:+.4f}")
    passed = abs(worst[0]) <= bound(worst[2]["sun"]) and abs(bend[0]) <= 0.04
    print("pass" if passed else "FAIL")
    sys.exit(0 if passed else 1)


main()
