"""speed.py group: background, depth, four intensities, masks and rainy pictures, from process start to files on disk,
against two renders and a composition per intensity in Blender (cycles_rain.py), by day and at night with 60 lamps.

Pluvia takes as many samples as make its clean picture at most as noisy as Cycles', by what the part `error` measured; where
it has not been, as many as Cycles. The error of each clean picture that it then makes is measured as well.
`drops of a pixel` draws as streaks what cycles_rain.py draws, drops at least a pixel wide, and the others as a medium;
`as by itself` is what `pluvia render --rain` does by default, from a quarter pixel on.
"""
import json
import shutil

import speed_error
from speed_measure import HERE, fail, run
from speed_numbers import median, row, samples_for, spread

INTENSITIES = "10,25,50,100"  # mm/h
TARGETS = {"day": 8, "night": 25}
LAMPS = {"day": 0, "night": 60}
# A number of samples that is no power of two is spread less evenly: 48 have 1.05 times the error that 64 promise.
UNEVEN = 1.05
OWN_SEEDS = 1001  # apart from those of the pictures of `error`


def samples(street, case):
    ours, theirs = (speed_error.errors(street, case, program) for program in ("pluvia", "cycles"))
    if not ours or not theirs:
        return street.options.spp
    return samples_for(UNEVEN * median(ours), street.options.spp, median(theirs))


def ours(street, case, seed, width):
    spp = samples(street, case)
    record = street.pluvia(speed_error.scene(street, LAMPS[case]), street.folder + "/frame", "--size",
                           street.options.size, "--spp", spp, "--seed", seed, "--environment",
                           street.environment(case), "--rain", INTENSITIES, "--streak-width", width)
    return {k: record[k] for k in ("wall", "processor", "load", "streaks")} | {
        "seed": seed, "spp": spp, "relmse": speed_error.error_of_frame(street, case, street.folder + "/frame", spp)}


def theirs(street, case, seed):
    folder = street.folder + "/cycles_rain"
    done = run(["blender", "-b", "--factory-startup", "-t", str(street.threads), "-P", HERE + "/cycles_rain.py", "--",
                speed_error.scene(street, LAMPS[case]), folder, *street.options.size.split("x"),
                str(street.options.spp), street.environment(case), INTENSITIES, str(seed)])
    told = [line for line in done.out.split("\n") if line.startswith("rain: ")]
    if not told:
        fail(f"blender: cycles_rain.py came to no end\n{done.out[-1000:]}")
    shutil.rmtree(folder)
    return {"wall": done.wall, "processor": done.processor, "load": done.load, "seed": seed,
            "quads": json.loads(told[-1][6:])["quads"]}


def measure(street):
    for i in range(street.options.rounds):
        for case in ("day", "night"):
            kept, name = street.kept, f"group/{case}"
            kept.get(f"{name}/blender/{i}", lambda: theirs(street, case, i + 1))
            kept.get(f"{name}/drops of a pixel/{i}", lambda: ours(street, case, OWN_SEEDS + i, 1))
            kept.get(f"{name}/as by itself/{i}", lambda: ours(street, case, OWN_SEEDS + i, 0.25))


def rows(street):
    for case, target in TARGETS.items():
        peer = street.kept.under(f"group/{case}/blender")
        if not peer:
            continue
        seconds = lambda records: median([r["processor"] / street.threads for r in records])
        told = f"quads: {peer[-1]['quads']}"
        if relmse := speed_error.errors(street, case, "cycles"):
            told += f", relMSE {median(relmse):.3g}"
        yield row("group", f"{case}, Blender", seconds(peer), "s", note=told)
        for what in ("drops of a pixel", "as by itself"):
            records = street.kept.under(f"group/{case}/{what}")
            if records:
                told = (f"{records[-1]['spp']} samples, {records[-1]['streaks']} streaks, largest / smallest "
                        f"{spread([r['processor'] for r in records]):.2f}")
                if relmse := [r["relmse"] for r in records if r["relmse"] is not None]:
                    told += f", relMSE {median(relmse):.3g}"
                yield row("group", f"{case}, Pluvia, {what}", seconds(records), "s", seconds(peer), target, higher=False,
                          note=told)
