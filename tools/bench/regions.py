#!/usr/bin/python3
"""Compares pictures of one camera region by region: sky, ground, walls, and what lies between.

Usage: tools/bench/regions.py FRAME.exr PICTURE.exr [PICTURE.exr ...]
FRAME.exr: by `pluvia render --layers normals`; its background is the first picture, its normals and depth make the
regions. PICTURE.exr: R, G, B and, where known, error.R, error.G, error.B, as `references.py` and `cycles.py` write them.
Several pictures are batches with seeds of their own: their mean is compared, their spread is its error.
Needs Debian's python3-openimageio.

Of each region: share of the picture, both means (luminance), ratio of the means with its standard error where the
pictures tell it, and the trimmed relMSE (worst 0.1 % dropped). Pixels beside another region are left out: there the
pictures may differ by a fraction of a pixel.
"""
import sys

import numpy
import OpenImageIO as oiio

LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])


def read(path, names, optional=False):
    file = oiio.ImageInput.open(path)
    if not file:
        sys.exit(f"regions: {path}: cannot be read ({oiio.geterror()})")
    there = file.spec().channelnames
    missing = [n for n in names if n not in there]
    if missing and optional:
        return None
    if missing:
        sys.exit(f"regions: {path}: has no channel {missing[0]} (got {', '.join(there)})")
    picture = file.read_image(0, 0, 0, file.spec().nchannels, "float")
    file.close()
    return picture[..., [there.index(n) for n in names]].astype(numpy.float64)


def regions(frame):
    up = read(frame, ["N.X", "N.Y", "N.Z"])[..., 1]  # Y is up, as in glTF
    sky = ~numpy.isfinite(read(frame, ["distance.Y"])[..., 0])
    kind = numpy.where(sky, 0, numpy.where(up > 0.9, 1, numpy.where(abs(up) < 0.3, 2, 3)))
    inside = numpy.ones(kind.shape, bool)
    for axis in (0, 1):
        for step in (-1, 1):
            inside &= numpy.roll(kind, step, axis) == kind
    inside[[0, -1], :] = inside[:, [0, -1]] = False
    return {"all": numpy.ones(kind.shape, bool)} | {
        name: (kind == i) & inside for i, name in enumerate(["sky", "ground", "walls", "slopes and undersides"])}


def main():
    if len(sys.argv) < 3 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    frame, others = sys.argv[1], sys.argv[2:]
    ours = read(frame, ["background.R", "background.G", "background.B"])
    pictures = numpy.array([read(path, ["R", "G", "B"]) for path in others])
    theirs = pictures.mean(axis=0)
    if ours.shape != theirs.shape:
        sys.exit(f"regions: {others[0]}: differs in size (got {theirs.shape[1]}x{theirs.shape[0]}, "
                 f"expected {ours.shape[1]}x{ours.shape[0]})")
    error = read(others[0], ["error.R", "error.G", "error.B"], optional=True) if len(others) == 1 else None
    print(f"{'region':24}{'share':>8}{'first':>12}{'second':>12}{'ratio':>9}{'+-':>9}{'relMSE':>11}")
    for name, mask in regions(frame).items():
        n = int(mask.sum())
        if n < 100:
            continue
        a, b = (ours[mask] @ LUMINANCE).mean(), (theirs[mask] @ LUMINANCE).mean()
        if error is not None:  # pixels are independent
            spread = numpy.sqrt(((error[mask] @ LUMINANCE) ** 2).sum()) / n
        elif len(others) > 1:
            spread = numpy.std([(p[mask] @ LUMINANCE).mean() for p in pictures], ddof=1) / len(others) ** 0.5
        else:
            spread = numpy.nan
        relative = numpy.sort(((ours[mask] - theirs[mask]) ** 2 / (theirs[mask] ** 2 + 0.01)).ravel())
        trimmed = relative[: int(len(relative) * 0.999)].mean()
        print(f"{name:24}{mask.mean():8.4f}{a:12.6g}{b:12.6g}{a / b:9.4f}{spread / b:9.4f}{trimmed:11.3g}")


main()
