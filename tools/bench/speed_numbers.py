"""Numbers of speed.py that can be checked on paper: medians, errors of pictures, and the table of ratios."""
import statistics

import numpy

TRIMMED = 0.001  # share of the pixels that is left out, where the error is largest (rounded down)
OFFSET = 0.01    # of the relative error, in squared units of the picture


def median(values):
    return statistics.median(values)


def spread(values):
    """Largest over smallest."""
    return max(values) / min(values) if min(values) > 0 else float("inf")


def trimmed_relmse(picture, reference):
    """Mean of (x - r)^2 / (r^2 + 0.01) over channels and pixels but for the 0.1 % of pixels where it is largest."""
    errors = ((picture - reference) ** 2 / (reference**2 + OFFSET)).mean(axis=-1).ravel()
    return float(numpy.sort(errors)[: len(errors) - int(TRIMMED * len(errors))].mean())


def left_out_relmse(pictures):
    """trimmed_relmse of each of some independent pictures, at least two, against the mean of all others.

    A mean of n - 1 pictures adds a part 1/(n - 1) of a picture's own variance to what is measured, which the factor
    (n - 1)/n takes off again: exact for the squared error, and nearly so when the worst pixels are left out."""
    n = len(pictures)
    whole = numpy.sum(pictures, axis=0)
    return [trimmed_relmse(p, (whole - p) / (n - 1)) * (n - 1) / n for p in pictures]


def samples_for(error, samples, aim):
    """Samples per pixel with which a picture whose error fell as 1 / samples would have the error that is aimed at."""
    return max(1, int(numpy.ceil(samples * error / aim - 1e-9)))


def slope(xs, ys):
    """Of the straight line through points by least squares, and the largest distance from it over the largest y."""
    slope_, start = numpy.polyfit(xs, ys, 1)
    return float(slope_), float(max(abs(y - start - slope_ * x) for x, y in zip(xs, ys)) / max(map(abs, ys)))


def number(value):
    return "-" if value is None else value if isinstance(value, str) else f"{value:.3g}"


def row(part, what, value, unit, against=None, target=None, higher=True, note=""):
    """A line of the table. ratio: value over what it is held against, or the other way where lower is better, so
    that more is better; met: whether that is at least the target, None without one."""
    ratio = None if against is None else value / against if higher else against / value
    met = None if target is None or ratio is None else bool(ratio >= target)
    return {"part": part, "what": what, "value": value, "unit": unit, "against": against, "ratio": ratio,
            "target": target, "met": met, "note": note}


def table(rows):
    """The lines as a Markdown table."""
    words = {None: "", True: "yes", False: "NO"}
    lines = ["| part | what | value | against | ratio | target | met | note |", "| --- " * 8 + "|"]
    for r in rows:
        value = f"{number(r['value'])} {r['unit']}".strip()
        lines.append(f"| {r['part']} | {r['what']} | {value} | {number(r['against'])} | {number(r['ratio'])} | "
                     f"{number(r['target'])} | {words[r['met']]} | {r['note']} |")
    return "\n".join(lines)
