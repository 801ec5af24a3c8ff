#!/usr/bin/python3
"""Measures how fast Pluvia is: against Embree alone, against Blender's Cycles, against a pipeline of two renders in
Blender, and against itself as its task grows.

Example: cmake --build build --target pluvia ray_limit
         tools/bench/speed.py out/speed --kaystreet kaystreet.glb --only rays,error
Run the same line again to go on. Needs Debian's python3-openimageio, blender (error, group) and openimageio-tools
(growth). kaystreet.glb: KayKit's City Builder Bits (CC0) as a street, with one camera, exported by Blender.

FOLDER gets speed.json, with all that was measured and the table, table.md, scenes, and the pictures whose errors are
measured.
In the table ratio is the value over what it is held against, or the reverse where less is better: more is always
better. Times are of the processor (user and system, all threads), because on a machine that others use too the clock
measures them as well; programs alternate, and medians are of --rounds runs at least. speed.json also has the clock's.
"""
import argparse
import hashlib
import importlib
import os
import shutil
import sys
import time

import speed_error
import speed_group
import speed_growth
import speed_rays
from speed_measure import Kept, Street, fail, first_line, processor, write_whole
from speed_numbers import table

PARTS = {"rays": speed_rays, "error": speed_error, "group": speed_group, "growth": speed_growth}


def read_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--kaystreet", required=True, help="the .glb file")
    parser.add_argument("--only", default=",".join(PARTS), help="parts, separated by commas [%(default)s]")
    parser.add_argument("--size", default="1024x512", help="[%(default)s]")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel [%(default)s]")
    parser.add_argument("--rounds", type=int, default=3, help="of each measurement at least [%(default)s]")
    parser.add_argument("--batches", type=int, default=16,
                        help="error: pictures of each program; each is held against all others [%(default)s]")
    parser.add_argument("--pluvia", default="build/pluvia", help="[%(default)s]")
    parser.add_argument("--ray-limit", default="build/tools/ray_limit", help="[%(default)s]")
    options = parser.parse_args()
    options.only = options.only.split(",")
    return options


def refuse(text):
    fail(text, 2)


def check(options):
    """Ends with one line where something is missing or wrong."""
    unknown = [p for p in options.only if p not in PARTS]
    if unknown:
        refuse(f"--only: there is no part {unknown[0]} (expected {', '.join(PARTS)})")
    sides = options.size.split("x")
    if len(sides) != 2 or not all(s.isdigit() and 16 <= int(s) <= 65536 for s in sides):
        refuse(f"--size: is no size (got {options.size}, expected WIDTHxHEIGHT of 16 or more)")
    if options.rounds < 1 or options.spp < 1 or options.batches < 2:
        refuse("--rounds, --spp: expected 1 or more; --batches: 2 or more")
    needs = [(options.kaystreet, "a .glb file by --kaystreet"),
             (options.pluvia, "cmake --build build --target pluvia")]
    if "rays" in options.only:
        needs.append((options.ray_limit, "cmake --build build --target ray_limit"))
    for path, how in needs:
        if not os.path.exists(path):
            refuse(f"{path}: is missing (expected {how})")
    if {"error", "group"} & set(options.only) and not shutil.which("blender"):
        refuse("blender: is missing (expected apt-get install blender)")
    if "growth" in options.only and not shutil.which("oiiotool"):
        refuse("oiiotool: is missing (expected apt-get install openimageio-tools)")
    for module, package in (("numpy", "python3-numpy"), ("OpenImageIO", "python3-openimageio")):
        try:
            importlib.import_module(module)
        except ImportError:
            refuse(f"{package}: is missing for {sys.executable} (expected apt-get install {package}, /usr/bin/python3)")


def settings(options):
    """What all measurements of a folder must share."""
    with open(options.pluvia, "rb") as file:
        program = hashlib.sha256(file.read()).hexdigest()
    with open(options.kaystreet, "rb") as file:
        scene = hashlib.sha256(file.read()).hexdigest()
    return {"pluvia": first_line(options.pluvia, "--version"), "pluvia_sha256": program, "kaystreet_sha256": scene,
            "blender": first_line("blender", "--version") if shutil.which("blender") else None,
            "processor": processor(), "size": options.size, "spp": options.spp}


def main():
    options = read_options()
    check(options)
    os.makedirs(options.folder, exist_ok=True)
    options.folder = os.path.abspath(options.folder)
    street = Street(options)
    street.kept = Kept(options.folder, settings(options))
    for name in options.only:
        PARTS[name].measure(street)
    report(street)


def report(street):
    kept = street.kept
    kept.root["table"] = [r for part in PARTS.values() for r in part.rows(street)]
    kept.save()
    runs = kept.root["runs"].values()
    loads = [r["load"] for r in runs if "load" in r]
    told = kept.root["settings"] | {"load while measuring": f"{min(loads):.1f} to {max(loads):.1f}" if loads else "-",
                                    "seeds": ", ".join(map(str, sorted({r["seed"] for r in runs if "seed" in r}))),
                                    "date": time.strftime("%Y-%m-%d %H:%M")}
    text = "\n".join(f"{k}: {v}" for k, v in told.items()) + "\n\n" + table(kept.root["table"]) + "\n"
    write_whole(street.folder + "/table.md", text)
    print(text, end="")


if __name__ == "__main__":
    main()
