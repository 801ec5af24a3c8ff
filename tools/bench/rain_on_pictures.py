#!/usr/bin/env python3
"""Rainy pictures side by side on one HTML page, with statistics of what rain changed in them.

  rain_on_pictures.py -o page.html --clean DIR NAME=DIR NAME=DIR ...

--clean: the clean pictures. Each NAME=DIR: rainy pictures with the same names (extensions may differ). Statistics are of
the luma of 8-bit pictures, rainy minus clean. Needs python3-numpy and python3-skimage.
"""
import argparse
import base64
import io
import pathlib

import numpy
import skimage.io
import skimage.transform

THRESHOLD = 15  # levels of luma that count as a change


def read(path):
    return numpy.asarray(skimage.io.imread(path))[..., :3].astype(float)


def luma(picture):
    return picture @ numpy.array([0.299, 0.587, 0.114])


def find(folder, stem):
    for extension in (".png", ".jpg", ".jpeg"):
        path = folder / (stem + extension)
        if path.exists():
            return path
    return None


def runs(changed, difference):
    """Lengths of horizontal runs of changed pixels, and their widths: the sum of the difference over its peak."""
    lengths, widths = [], []
    for row, values in zip(changed, difference):
        edges = numpy.flatnonzero(numpy.diff(numpy.concatenate(([0], row.astype(numpy.int8), [0]))))
        for begin, end in zip(edges[::2], edges[1::2]):
            lengths.append(end - begin)
            # One pixel beyond on either side: the flanks of a streak lie below the threshold.
            part = values[max(0, begin - 1):end + 1]
            widths.append(part.clip(0).sum() / part.max())
    return numpy.array(lengths), numpy.array(widths)


def statistics(clean, rainy):
    difference = luma(rainy) - luma(clean)
    brighter = difference > THRESHOLD
    _, widths = runs(brighter, difference)
    lengths, _ = runs(brighter.T, difference.T)
    # Orientation by the structure tensor: twice the angle of the gradients, weighed by their squares.
    # Of what is brighter alone: elsewhere it is that of the picture's own noise and of the veil.
    gy, gx = numpy.gradient(numpy.where(brighter, difference, 0))
    moment = ((gx + 1j * gy) ** 2).sum() / max((gx ** 2 + gy ** 2).sum(), 1e-9)
    tilt = numpy.degrees(numpy.angle(moment)) / 2  # of the gradients from horizontal = of the streaks from vertical
    def percentiles(values, which):
        return " / ".join(f"{v:.1f}" for v in numpy.percentile(values, which)) if len(values) > 20 else "-"
    linear = lambda p: numpy.where(p / 255 <= 0.04045, p / 255 / 12.92, ((p / 255 + 0.055) / 1.055) ** 2.4)
    added = (linear(rainy) - linear(clean))[brighter].mean(0) if brighter.any() else numpy.full(3, numpy.nan)
    return {
        "brighter by more than 15": f"{100 * brighter.mean():.2f} %",
        "darker by more than 15": f"{100 * (difference < -THRESHOLD).mean():.2f} %",
        "mean change": f"{difference.mean():+.2f}",
        "99 / 99.9 percentile": percentiles(difference, [99, 99.9]),
        "width, px (25/50/75/95 %)": percentiles(widths, [25, 50, 75, 95]),
        "length, px (50/75/95/99 %)": percentiles(lengths, [50, 75, 95, 99]),
        "orientation R": f"{abs(moment):.3f}",
        "tilt": f"{tilt:+.0f}&deg;",
        "colour of what is added": " ".join(f"{c:.2f}" for c in added / added.mean()),
        "linear mean": f"{linear(clean).mean():.3f} &rarr; {linear(rainy).mean():.3f}",
    }


def jpeg(picture, width):
    height = round(picture.shape[0] * width / picture.shape[1])
    small = skimage.transform.resize(picture / 255, (height, width), anti_aliasing=True)
    return encode(small)


def crop(picture):
    """Full size, from the middle."""
    h, w = picture.shape[:2]
    return encode(picture[h // 2 - 160:h // 2 + 160, w // 2 - 256:w // 2 + 256] / 255)


def encode(values):
    buffer = io.BytesIO()
    skimage.io.imsave(buffer, (values.clip(0, 1) * 255).round().astype(numpy.uint8), plugin="pil", format_str="jpeg",
                      quality=88)
    return "data:image/jpeg;base64," + base64.b64encode(buffer.getvalue()).decode()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--clean", type=pathlib.Path, required=True)
    parser.add_argument("--width", type=int, default=768)
    parser.add_argument("rainy", nargs="+", metavar="NAME=DIR")
    options = parser.parse_args()
    sets = [(name, pathlib.Path(folder)) for name, folder in (text.split("=", 1) for text in options.rainy)]
    page = ["<!doctype html><meta charset=utf-8><title>Rain on pictures</title><style>body{font:14px sans-serif;"
            "margin:2em;background:#fff;color:#111}td,th{padding:2px 10px;text-align:left;border-bottom:1px solid #ddd}"
            "figure{display:inline-block;margin:4px}figcaption{font-size:12px}</style><h1>Rain on pictures</h1>"]
    for path in sorted(options.clean.iterdir()):
        clean = read(path)
        shown, rows = [("clean", clean)], {}
        for name, folder in sets:
            rainy_path = find(folder, path.stem)
            if rainy_path is None:
                continue
            rainy = read(rainy_path)
            shown.append((name, rainy))
            rows[name] = statistics(clean, rainy)
        page.append(f"<h2>{path.stem}</h2>")
        for name, picture in shown:
            page.append(f"<figure><img src='{jpeg(picture, options.width)}'><figcaption>{name}</figcaption></figure>")
        page.append("<h3>Middle, at full size</h3>")
        for name, picture in shown:
            page.append(f"<figure><img src='{crop(picture)}'><figcaption>{name}</figcaption></figure>")
        if rows:
            keys = list(next(iter(rows.values())))
            page.append("<table><tr><th>" + "".join(f"<th>{name}" for name in rows))
            for key in keys:
                page.append(f"<tr><td>{key}" + "".join(f"<td>{row[key]}" for row in rows.values()))
                print(path.stem, key, *(f"{name}: {row[key]}" for name, row in rows.items()), sep=" | ")
            page.append("</table>")
    pathlib.Path(options.output).write_text("".join(page))


main()
