#!/usr/bin/python3
"""Renders the kept references: a street by day and by night, by Pluvia and by Blender's Cycles, in many small batches.

Usage: tools/bench/references.py FOLDER DAY.glb NIGHT.glb [--pluvia build/pluvia] [--samples 16384] [--cycles-samples 4096]
Run the same line again to go on: FOLDER keeps the sums. Needs Debian's python3-openimageio and, for Cycles, blender.

Every batch is a render with a seed of its own; sums and sums of squares over batches are kept in double precision, so
that each reference says how far it may be from the truth. FOLDER gets
  day.exr, night.exr                      the environments, made here, which both programs read
  {day,night}_{pluvia,cycles}.exr         R, G, B (float) and error.R, error.G, error.B: standard error of each (half)
  {day,night}_{pluvia,cycles}.json        scene, program and settings, seeds, samples, standard error of the mean
"""
import argparse
import hashlib
import json
import math
import os
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO as oiio

HERE = os.path.dirname(os.path.abspath(__file__))
# Illuminance of each environment on the horizontal and the share of a sun in it. By day white ground has radiance 1; at
# night the lamps of the scene (300) are left to do the work.
LIGHT = {"day": (math.pi, 0.6), "night": (0.01 * math.pi, 0)}
BATCH = 64  # samples per pixel; its number of batches, not their size, decides how well the error is known


def environment(illuminance, sun_share):
    """Sky gradient, dark ground and a round lobe of 6 degrees for a sun; equirectangular, as both programs map it.

    illuminance: on the horizontal, sun_share of it by the lobe. The lobe is wide enough for texels of 0.7 degrees, so
    that what the programs interpolate between texels is the same light."""
    height, width = 256, 512
    elevation = (0.5 - (numpy.arange(height)[:, None] + 0.5) / height) * math.pi
    azimuth = ((numpy.arange(width)[None, :] + 0.5) / width - 0.25) * 2 * math.pi
    up = numpy.sin(elevation)
    sun_elevation, sun_azimuth = math.radians(40), math.radians(150)
    cosine = up * math.sin(sun_elevation) + numpy.cos(elevation) * math.cos(sun_elevation) * numpy.cos(azimuth - sun_azimuth)
    above = (up > 0)[..., None]
    gradient = numpy.clip(up, 0, 1)[..., None] ** 0.5 * numpy.ones((1, width, 1))
    sky = (1 - gradient) * numpy.array([0.9, 0.95, 1.0]) + gradient * numpy.array([0.25, 0.45, 1.0])
    sky = numpy.where(above, sky, 0.15)
    sun = numpy.exp((cosine[..., None] - 1) * 2 / math.radians(6) ** 2) * numpy.array([1.0, 0.93, 0.8])
    weight = (numpy.maximum(up, 0) * numpy.cos(elevation) * (math.pi / height) * (2 * math.pi / width))[..., None]
    luminance = numpy.array([0.2126, 0.7152, 0.0722])
    sky *= illuminance * (1 - sun_share) / (sky * weight * luminance).sum()
    sun *= illuminance * sun_share / (sun * weight * luminance).sum()
    return (sky + sun).astype(numpy.float32)


def write_exr(path, picture, names, types=None):
    spec = oiio.ImageSpec(picture.shape[1], picture.shape[0], picture.shape[2], "float")
    spec.channelnames = names
    if types:
        spec.channelformats = tuple(oiio.TypeDesc(t) for t in types)
    spec["compression"] = "zip"
    out = oiio.ImageOutput.create(path)
    if not out or not out.open(path + ".tmp.exr", spec) or not out.write_image(numpy.ascontiguousarray(picture, numpy.float32)):
        sys.exit(f"references: {path}: cannot be written ({out.geterror() if out else oiio.geterror()})")
    out.close()
    os.replace(path + ".tmp.exr", path)


def read_rgb(path, names):
    file = oiio.ImageInput.open(path)
    if not file:
        sys.exit(f"references: {path}: cannot be read ({oiio.geterror()})")
    channels = [file.spec().channelnames.index(n) for n in names]
    picture = file.read_image(0, 0, 0, file.spec().nchannels, "float")
    file.close()
    return picture[..., channels].astype(numpy.float64)


def sha256(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


class Reference:
    """One picture: the batches so far, kept in a file of sums."""

    def __init__(self, options, time, program):
        self.options, self.time, self.program = options, time, program
        self.scene = options.day if time == "day" else options.night
        self.environment = f"{options.folder}/{time}.exr"
        self.path = f"{options.folder}/{time}_{program}"
        self.target = options.samples if program == "pluvia" else options.cycles_samples
        self.record = {
            "program": program,
            "program_version": options.versions[program],
            "program_sha256": options.program_sha256[program],
            "scene": os.path.basename(self.scene),
            "scene_sha256": sha256(self.scene),
            "environment": os.path.basename(self.environment),
            "environment_sha256": sha256(self.environment),
            "size": options.size,
            "batch_samples": BATCH,
            "settings": "unlimited bounces" if program == "pluvia" else "tools/bench/cycles.py " + sha256(HERE + "/cycles.py"),
        }
        self.seeds = []
        if os.path.exists(self.path + ".sums.npz"):
            with numpy.load(self.path + ".sums.npz", allow_pickle=False) as kept:
                self.sum, self.squares, self.seeds = kept["sum"], kept["squares"], kept["seeds"].tolist()
                old = json.loads(str(kept["record"]))
            different = [f"{k}: {old.get(k)} there, {v} now" for k, v in self.record.items() if old.get(k) != v]
            if different:
                sys.exit(f"references: {self.path}: was begun with something else ({'; '.join(different)}); "
                         "use another folder or what it was begun with")

    def samples(self):
        return len(self.seeds) * BATCH

    def render(self, seed, folder):
        width, height = self.options.size.split("x")
        if self.program == "pluvia":
            command = [self.options.pluvia, "render", self.scene, "-o", folder, "--size", self.options.size,
                       "--spp", str(BATCH), "--seed", str(seed), "--environment", self.environment, "--progress", "none"]
            names, out = ["background.R", "background.G", "background.B"], folder + "/frame.exr"
        else:
            out, names = folder + "/out.exr", ["R", "G", "B"]
            command = ["blender", "-b", "--factory-startup", "-P", HERE + "/cycles.py", "--", self.scene, out, width,
                       height, str(BATCH), self.environment, str(seed)]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode or not os.path.exists(out):
            sys.exit(f"references: {' '.join(command)}: failed\n{done.stdout[-1000:]}{done.stderr[-1000:]}")
        return read_rgb(out, names)

    def add_batch(self):
        seed = len(self.seeds) + 1
        with tempfile.TemporaryDirectory() as folder:
            picture = self.render(seed, folder)
        if not numpy.isfinite(picture).all():
            sys.exit(f"references: {self.path}: seed {seed} gave values that are not finite")
        if not self.seeds:
            self.sum, self.squares = numpy.zeros_like(picture), numpy.zeros_like(picture)
        self.sum += picture
        self.squares += picture**2
        self.seeds.append(seed)
        self.save()

    def save(self):
        numpy.savez(self.path + ".tmp.npz", sum=self.sum, squares=self.squares, seeds=self.seeds,
                    record=json.dumps(self.record))
        os.replace(self.path + ".tmp.npz", self.path + ".sums.npz")
        n = len(self.seeds)
        mean = self.sum / n
        variance = numpy.maximum(self.squares / n - mean**2, 0) * n / max(n - 1, 1)
        error = numpy.sqrt(variance / n)
        write_exr(self.path + ".exr", numpy.concatenate([mean, error], axis=2),
                  ["R", "G", "B", "error.R", "error.G", "error.B"], ["float"] * 3 + ["half"] * 3)
        record = dict(self.record, seeds=self.seeds, samples=self.samples(), mean=mean.mean(axis=(0, 1)).tolist(),
                      # The samples of pixels are independent, their errors add in quadrature.
                      standard_error_of_mean=(numpy.sqrt((error**2).sum(axis=(0, 1))) / (mean.shape[0] * mean.shape[1])).tolist(),
                      # Noise of the picture as `pluvia validate compare` measures it against the truth.
                      relative_mse=float((error**2 / (mean**2 + 0.01)).mean()))
        with open(self.path + ".json.tmp", "w", encoding="utf-8") as file:
            json.dump(record, file, indent=2)
        os.replace(self.path + ".json.tmp", self.path + ".json")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("day")
    parser.add_argument("night")
    parser.add_argument("--pluvia", default="build/pluvia")
    parser.add_argument("--size", default="1024x512")
    parser.add_argument("--samples", type=int, default=16384)
    parser.add_argument("--cycles-samples", type=int, default=4096, help="0: without Cycles")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    for time, (illuminance, sun_share) in LIGHT.items():
        path = f"{options.folder}/{time}.exr"
        if not os.path.exists(path):
            write_exr(path, environment(illuminance, sun_share), ["R", "G", "B"])
    programs = ["pluvia"] + (["cycles"] if options.cycles_samples else [])
    say = lambda *command: subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\n")[0].strip()
    options.versions = {"pluvia": say(options.pluvia, "--version")}
    options.program_sha256 = {"pluvia": sha256(options.pluvia), "cycles": None}
    if options.cycles_samples:
        options.versions["cycles"] = say("blender", "--version")
    references = [Reference(options, time, program) for program in programs for time in ("day", "night")]
    while True:
        open_ones = [r for r in references if r.samples() < r.target]
        if not open_ones:
            break
        # The one that is furthest from its aim, so that whenever this is stopped all are about equally far.
        reference = min(open_ones, key=lambda r: r.samples() / min(r.target, 4096))
        reference.add_batch()
        print(f"{reference.path}: {reference.samples()} of {reference.target} samples", flush=True)


if __name__ == "__main__":
    main()
