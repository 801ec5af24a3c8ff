"""speed.py error: time times relMSE of the clean picture, of Pluvia and of Blender's Cycles.

Each renders the same street under the same HDR map, by day and at night with 60 lamps; Pluvia also with 1,000 lamps. All
pictures of a program have seeds of their own, and each is held against the mean of the program's others, so that
what the programs have differently is not taken for noise. Time is processor time over the number of threads: of Pluvia
from process start to files on disk, of Cycles its call to render alone, which favours Cycles.
"""
import os
import re

import numpy

from speed_measure import HERE, fail, run
from speed_numbers import left_out_relmse, median, row, spread, trimmed_relmse

CASES = [("day", "pluvia", 0), ("day", "cycles", 0), ("night", "pluvia", 60), ("night", "cycles", 60),
         ("thousand", "pluvia", 1000)]
BACKGROUND = ["background.R", "background.G", "background.B"]


def scene(street, lamps):
    return street.lit(lamps) if lamps else street.day()


def environment(street, case):
    return street.environment("day" if case == "day" else "night")


def keep_picture(street, path, file, names):
    import references
    picture = references.read_rgb(file, names)
    if not numpy.isfinite(picture).all():
        fail(f"{file}: holds values that are not finite")
    numpy.save(path + ".part.npy", picture.astype(numpy.float32))
    os.replace(path + ".part.npy", path)


def ours(street, case, lamps, seed, path):
    frame = street.folder + "/frame"
    record = street.pluvia(scene(street, lamps), frame, "--size", street.options.size, "--spp", street.options.spp,
                           "--seed", seed, "--environment", environment(street, case))
    keep_picture(street, path, frame + "/frame.exr", BACKGROUND)
    return {k: record[k] for k in ("wall", "processor", "load", "rays")} | {"seed": seed}


def theirs(street, case, lamps, seed, path):
    out = street.folder + "/cycles.exr"
    done = run(["blender", "-b", "--factory-startup", "-t", str(street.threads), "-P", HERE + "/cycles.py", "--",
                scene(street, lamps), out, *street.options.size.split("x"), str(street.options.spp),
                environment(street, case), str(seed)])
    found = re.search(r"cycles: ([\d.]+) s, ([\d.]+) s of processor", done.out)
    if not found or not os.path.exists(out):
        fail(f"blender: wrote no picture\n{done.out[-1000:]}")
    keep_picture(street, path, out, ["R", "G", "B"])
    os.remove(out)
    return {"wall": float(found[1]), "processor": float(found[2]), "load": done.load, "seed": seed}


def measure(street):
    batches = max(street.options.rounds, street.options.batches)
    for i in range(batches):
        for case, program, lamps in CASES:
            path = f"{street.folder}/error_{case}_{program}_{i}.npy"
            make = ours if program == "pluvia" else theirs
            street.kept.get(f"error/{case}/{program}/{i}", lambda: make(street, case, lamps, i + 1, path))


def pictures(street, case, program):
    count = len(street.kept.under(f"error/{case}/{program}"))
    return [numpy.load(f"{street.folder}/error_{case}_{program}_{i}.npy").astype(float) for i in range(count)]


def errors(street, case, program):
    """Trimmed relMSE of each picture so far; none where there are fewer than two."""
    kept = pictures(street, case, program)
    return left_out_relmse(kept) if len(kept) > 1 else []


def error_of_frame(street, case, frame, spp):
    """Trimmed relMSE of the clean picture of a frame of Pluvia with seeds of its own; None where there is nothing to hold
    it against. What the mean of the kept pictures is off is taken out."""
    import references
    kept = pictures(street, case, "pluvia")
    if not kept:
        return None
    picture = references.read_rgb(frame + "/frame.exr", BACKGROUND).astype(float)
    return trimmed_relmse(picture, numpy.mean(kept, axis=0)) / (1 + spp / (len(kept) * street.options.spp))


def rows(street):
    product = {}
    for case, program, _ in CASES:
        relmse = errors(street, case, program)
        if not relmse:
            continue
        times = [r["processor"] / street.threads for r in street.kept.under(f"error/{case}/{program}")]
        product[case, program] = median(times) * median(relmse)
        product[case, program, "note"] = (f"{median(times):.3g} s (largest / smallest {spread(times):.2f}), relMSE "
                                          f"{median(relmse):.3g} ({spread(relmse):.2f}), {len(relmse)} pictures")
    for case, target in (("day", 3), ("night", 20)):
        if (case, "cycles") in product:
            yield row("error", f"{case}, Cycles", product[case, "cycles"], "s", note=product[case, "cycles", "note"])
        if (case, "pluvia") in product:
            yield row("error", f"{case}, Pluvia", product[case, "pluvia"], "s", product.get((case, "cycles")), target,
                      higher=False, note=product[case, "pluvia", "note"])
    if ("thousand", "pluvia") in product:
        yield row("error", "night, 1,000 lamps against 60", product["thousand", "pluvia"], "s",
                  product.get(("night", "pluvia")), 1 / 1.5, higher=False, note=product["thousand", "pluvia", "note"])
