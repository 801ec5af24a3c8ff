"""speed.py growth: how Pluvia's time and memory grow with pixels, samples, streaks and triangles.

Time: processor seconds of the whole process, kaystreet by day; the value of a line is the seconds per million camera
samples, held against those of the smallest: 1 is linear. Streaks: processor time that rain adds per streak hit, with
the light of streaks and of the fine rain behind them. Memory: the largest resident set less 145 MB of program and
libraries, against hierarchy, vertices and textures as `pluvia inspect` counts them. First sample: process start to files
on disk with one sample of 64x32 pixels, of a street of 4 million triangles with 500 MB of textures.
"""
import json
import os

from speed_measure import run
from speed_numbers import median, row, slope

SAMPLES = (16, 64, 256)
INTENSITIES = (10, 25, 50, 100)  # mm/h


def sizes(street):
    """Half and the whole of each side, and twice."""
    width, height = map(int, street.options.size.split("x"))
    return [f"{round(width * f)}x{round(height * f)}" for f in (0.5, 1, 2)]


def render(street, scene, seed, *arguments):
    record = street.pluvia(scene, street.folder + "/frame", "--environment", street.environment("day"), "--seed", seed,
                           *arguments) | {"seed": seed}
    return {k: record[k] for k in ("wall", "processor", "peak", "load", "camera_paths", "streak_hits", "streaks", "seed")}


def large_street(street):
    path = f"{street.folder}/large.glb"
    if not os.path.exists(path):
        run(street.script("large_street.py", path + ".part", "--copies", "0"))
        os.replace(path + ".part", path)
    return path


def inspect(street, scene):
    return json.loads(run([street.options.pluvia, "inspect", scene, "--json"]).out)


def measure(street):
    kept, small = street.kept, sizes(street)[0]
    large = large_street(street)
    kept.get("growth/inspect/large", lambda: inspect(street, large)["memory_megabytes"])
    for i in range(street.options.rounds):
        for size in sizes(street):
            kept.get(f"growth/pixels {size}/{i}",
                     lambda: render(street, street.day(), i, "--size", size, "--spp", 16))
        for spp in SAMPLES:
            kept.get(f"growth/samples {spp}/{i}",
                     lambda: render(street, street.day(), i, "--size", small, "--spp", spp))
        for rain in ("0", *map(str, INTENSITIES), ",".join(map(str, INTENSITIES))):
            given = [] if rain == "0" else ["--rain", rain, "--streak-width", "1"]
            kept.get(f"growth/rain {rain}/{i}",
                     lambda: render(street, street.day(), i, "--size", small, "--spp", 16, *given))
        kept.get(f"growth/first sample/{i}", lambda: render(street, large, i, "--size", "64x32", "--spp", 1))


def cost(records):
    """Processor seconds per million camera samples."""
    return median([r["processor"] / r["camera_paths"] * 1e6 for r in records])


def linear_rows(street, what, names):
    of = {n: street.kept.under(f"growth/{what} {n}") for n in names}
    least = next((cost(r) for r in of.values() if r), None)
    for name, records in of.items():
        if records:
            yield row("growth", f"{what} {name}", cost(records), "us a sample", least, higher=False)


def rows(street):
    yield from linear_rows(street, "pixels", sizes(street))
    yield from linear_rows(street, "samples", SAMPLES)
    rain = {n: street.kept.under(f"growth/rain {n}") for n in ("0", *map(str, INTENSITIES))}
    if all(rain.values()):
        hits = [median([r["streak_hits"] for r in records]) for n, records in rain.items() if n != "0"]
        times = [median([r["processor"] for r in records]) for n, records in rain.items() if n != "0"]
        per_hit, apart = slope(hits, times)
        yield row("growth", "rain, with its light", per_hit * 1e9, "ns more a streak hit",
                  note=f"{hits[0]:.3g} to {hits[-1]:.3g} hits, at most {100 * apart:.0f} % off a straight line")
    together = street.kept.under("growth/rain " + ",".join(map(str, INTENSITIES)))
    if together and all(rain.values()):
        apart = sum(median([r["processor"] for r in rain[str(n)]]) for n in INTENSITIES)
        yield row("growth", "four intensities in one render", median([r["processor"] for r in together]), "s", apart,
                  higher=False, note="against four renders")
    first, held = street.kept.under("growth/first sample"), street.kept.root["runs"].get("growth/inspect/large")
    if first and held:
        yield row("growth", "first sample, by the clock", median([r["wall"] for r in first]), "s", 10, 1, higher=False,
                  note=f"{median([r['processor'] for r in first]):.3g} s of processor")
        scene = held["total"] - held["program"]
        yield row("growth", "memory", median([r["peak"] for r in first]) / 1e6 - held["program"], "MB", scene, 1 / 1.3,
                  higher=False, note="hierarchy is an estimate by triangles")
