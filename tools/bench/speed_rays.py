"""speed.py rays: rays that `pluvia render` traces per second against those that Embree alone traces (ray_limit).

The mix is made the same: Pluvia's counters tell how many rays for the closest hit a path has (its hits that are lit and
its rays that leave the scene) and how many shadow rays (all others); ray_limit then makes its roulette and its shadow
rays fit these numbers. Where panes and glass are hit, which light no sample lights, their rays count as shadow rays; the
note has their share. Both are rays per second of processor time and thread. Pluvia's is what more samples take:
a render with one sample is taken off, so that loading, building and writing do not count. Light is the day's HDR map,
lamps are off.
"""
import os
import re

from speed_measure import fail, run
from speed_numbers import median, row

PANES = ("pane", "frosted_pane", "glass")
TARGETS = {("kaystreet", "real"): 0.4, ("citystreet", "real"): 0.4, ("kaystreet", "grey"): 0.5,
           ("citystreet", "grey"): 0.5, ("dense", "real"): 0.65}


def scenes(street):
    """Name, materials and file of each; files that are missing are made."""
    options, folder = street.options, street.folder
    files = {"kaystreet": options.kaystreet, "citystreet": f"{folder}/citystreet.glb", "dense": f"{folder}/dense.glb"}
    if not os.path.exists(files["citystreet"]):
        run([options.pluvia, "scenes", "citystreet", "-o", folder])
    if not os.path.exists(files["dense"]):
        run(street.script("dense.py", options.kaystreet, files["dense"] + ".part"))
        os.replace(files["dense"] + ".part", files["dense"])
    for name, path in files.items():
        yield name, "real", path
        grey = f"{folder}/{name}_grey.glb"
        if not os.path.exists(grey):
            run(street.script("lambert.py", path, grey, "--grey"))
        yield name, "grey", grey


def render(street, path, seed):
    """Rays, processor time and calls of the samples after the first."""
    size, spp = street.options.size, street.options.spp
    light = ["--size", size, "--environment", street.environment("day"), "--lamps", "off", "--seed", seed]
    one, all_ = (street.pluvia(path, street.folder + "/frame", *light, "--spp", n) for n in (1, spp + 1))
    paths = all_["camera_paths"] - one["camera_paths"]
    calls = {k: all_["calls"].get(k, 0) - one["calls"].get(k, 0) for k in ("environment", "distant_light", *PANES)}
    rays = all_["rays"] - one["rays"]
    segments = (calls["environment"] + calls["distant_light"]) / paths
    return {"rays": rays, "processor": all_["processor"] - one["processor"], "wall": all_["wall"] - one["wall"],
            "load": all_["load"], "seed": seed, "segments": segments, "shadows": rays / paths - segments,
            "panes": sum(calls[k] for k in PANES) / paths}


def limit(street, path, mix):
    """Embree alone with the mix of a render."""
    # Few samples: its three runs are of the same length as they are for the smallest scene.
    done = run([street.options.ray_limit, path, street.options.size, str(max(1, street.options.spp // 4)),
                str(street.threads), f"segments={mix['segments']:.4f}", f"shadows={mix['shadows']:.4f}", "light=sky"])
    found = re.search(r"([\d.]+) million rays a second of processor", done.out)
    got = re.findall(r"has ([\d.]+) segments, ([\d.]+) shadow rays", done.out)
    if not found or not got:
        fail(f"{street.options.ray_limit}: did not print its rates (got {done.out!r})")
    return {"rate": float(found[1]) * 1e6, "segments": float(got[-1][0]), "shadows": float(got[-1][1]),
            "wall": done.wall, "load": done.load}


def measure(street):
    kept, cases = street.kept, list(scenes(street))
    for i in range(street.options.rounds):
        for name, materials, path in cases:
            case = f"rays/{name}/{materials}"
            ours = kept.get(f"{case}/pluvia/{i}", lambda: render(street, path, i))
            kept.get(f"{case}/embree/{i}", lambda: limit(street, path, ours))


def rows(street):
    for name in ("kaystreet", "citystreet", "dense"):
        for materials in ("real", "grey"):
            ours, bare = (street.kept.under(f"rays/{name}/{materials}/{who}") for who in ("pluvia", "embree"))
            if not ours or not bare:
                continue
            rate = median([o["rays"] / o["processor"] for o in ours])
            last, other = ours[-1], bare[-1]
            note = (f"segments + shadow rays a path: {last['segments']:.2f} + {last['shadows']:.2f}, Embree's "
                    f"{other['segments']:.2f} + {other['shadows']:.2f}")
            if last["panes"] > 0.01:
                note += f"; {last['panes']:.2f} panes"
            yield row("rays", f"{name}, {materials}", rate * 1e-6, "M/s a thread",
                      median([b["rate"] for b in bare]) * 1e-6, TARGETS.get((name, materials)), note=note)
