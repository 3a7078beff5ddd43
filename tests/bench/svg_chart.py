"""Small log-log line charts side by side as SVG, in black and grey, told apart by marker and dash."""

import math
from dataclasses import dataclass
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 270, 230  # of a panel, pixels
LEFT, RIGHT, TOP, BOTTOM = 52, 12, 10, 42
STYLES = [("#000", "", "circle"), ("#000", "5 3", "square"), ("#777", "", "triangle"), ("#777", "2 3", "diamond")]


@dataclass
class Panel:
    x_label: str
    y_label: str
    series: dict  # name: [(x, y), ...], all positive; a single name is not printed


def ticks(low, high):
    """Round numbers from low to high, not too many."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    for digits in ((1, 1.5, 2, 3, 4, 5, 6, 8), (1, 2, 5), (1,)):
        found = [d * 10.0**p for p in powers for d in digits if low * 0.999 <= d * 10.0**p <= high * 1.001]
        if len(found) <= 6:
            break
    return found


def around(values):
    """The nearest round numbers (1, 2 or 5 times a power of ten) below and above all values."""
    steps = [d * 10.0**p for p in range(-12, 13) for d in (1, 2, 5)]
    low = max(s for s in steps if s <= min(values) * 1.001)
    high = min(s for s in steps if s >= max(values) * 0.999 and s > low)
    return low, high


def number(value):
    return f"{value:.0f}" if value >= 10 else f"{value:g}"


def marker(shape, x, y, colour):
    paint = f'fill="#fff" stroke="{colour}"'
    if shape == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.8" {paint}/>'
    if shape == "square":
        return f'<rect x="{x - 2.5:.1f}" y="{y - 2.5:.1f}" width="5" height="5" {paint}/>'
    corners = [(0, -3.4), (3.2, 2.4), (-3.2, 2.4)] if shape == "triangle" else [(0, -3.6), (3.6, 0), (0, 3.6), (-3.6, 0)]
    points = " ".join(f"{x + dx:.1f},{y + dy:.1f}" for dx, dy in corners)
    return f'<polygon points="{points}" {paint}/>'


def draw_panel(panel, left, top):
    xs = [x for points in panel.series.values() for x, _ in points]
    x_low, x_high = min(xs), max(max(xs), min(xs) * 1.001)
    y_low, y_high = around([y for points in panel.series.values() for _, y in points])
    right, bottom = left + WIDTH - RIGHT, top + HEIGHT - BOTTOM
    left, top = left + LEFT, top + TOP

    def place(x, y):
        across = math.log(x / x_low) / math.log(x_high / x_low)
        up = math.log(y / y_low) / math.log(y_high / y_low)
        return left + 8 + across * (right - left - 16), bottom - up * (bottom - top)

    def text(x, y, words, anchor="middle", more=""):
        return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(words)}</text>'

    out = []
    for y in ticks(y_low, y_high):
        height = place(x_low, y)[1]
        out.append(f'<line x1="{left}" y1="{height:.1f}" x2="{right}" y2="{height:.1f}" stroke="#ddd"/>')
        out.append(text(left - 5, height + 3.5, number(y), "end"))
    for x in sorted(set(xs)) if len(set(xs)) <= 7 else ticks(x_low, x_high):
        across = place(x, y_low)[0]
        out.append(f'<line x1="{across:.1f}" y1="{bottom}" x2="{across:.1f}" y2="{bottom + 4}" stroke="#000"/>')
        out.append(text(across, bottom + 15, number(x)))
    out.append(f'<rect x="{left}" y="{top}" width="{right - left}" height="{bottom - top}" fill="none" stroke="#000"/>')
    out.append(text((left + right) / 2, bottom + 32, panel.x_label))
    middle = (top + bottom) / 2
    out.append(text(left - 40, middle, panel.y_label, more=f' transform="rotate(-90 {left - 40} {middle:.1f})"'))
    for i, (name, points) in enumerate(panel.series.items()):
        colour, dash, shape = STYLES[i % len(STYLES)]
        line = " ".join("{:.1f},{:.1f}".format(*place(*p)) for p in points)
        out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="1.4" stroke-dasharray="{dash}"/>')
        out += [marker(shape, *place(*p), colour) for p in points]
        if len(panel.series) > 1:
            key = top + 12 + 13 * i
            out.append(f'<line x1="{left + 8}" y1="{key - 4}" x2="{left + 30}" y2="{key - 4}" stroke="{colour}" '
                       f'stroke-width="1.4" stroke-dasharray="{dash}"/>')
            out.append(marker(shape, left + 19, key - 4, colour))
            out.append(text(left + 35, key, name, "start"))
    return out


def figure(panels, columns):
    """The panels, row by row, as an SVG document."""
    rows = math.ceil(len(panels) / columns)
    width, height = WIDTH * min(columns, len(panels)), HEIGHT * rows
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
           'font-family="Helvetica, Arial, sans-serif" font-size="10.5">',
           f'<rect width="{width}" height="{height}" fill="#fff"/>']
    for i, panel in enumerate(panels):
        out += draw_panel(panel, WIDTH * (i % columns), HEIGHT * (i // columns))
    return "\n".join([*out, "</svg>"]) + "\n"
