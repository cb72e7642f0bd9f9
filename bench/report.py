#!/usr/bin/env python3
"""report.py: results in words: a line for each row, the tables of docs/speed.md between their markers, and the plots.

`report.py [RESULT.json]` writes the page anew from that result, the newest one without an argument."""
import json
import math
import os
import sys

import growth_plot
import paths

PAGE = os.path.join(paths.ROOT, "docs", "speed.md")
BEGIN, END = "<!-- %s: made by bench/report.py -->", "<!-- end of %s -->"
ISA_NAMES = {"avx512": "AVX-512", "avx2": "AVX2", "neon": "NEON", "auto": "widest"}


def times(value):
    return "%.0f ×" % value if value >= 20 else "%.1f ×" % value if value >= 3 else "%.2f ×" % value


def ms(value):
    return "%.0f" % value if value >= 100 else "%.1f" % value if value >= 10 else "%.2f" % value


def measured(row):
    """What decides a row, with each instruction set, in one cell."""
    if "not_measured" in row:
        return "not measured: " + row["not_measured"].split(": ", 1)[1]
    if "encoders" in row:
        ours, theirs = row["encoders"]["lambent"], row["encoders"]["libpng_1"]
        return "%s ms, %d kB (libpng %s ms, %d kB)" % (ms(ours["ms"]), ours["bytes"] // 1000, ms(theirs["ms"]), theirs["bytes"] // 1000)
    if "shares" in row:
        return ", ".join("%s: %.0f %%" % (ISA_NAMES.get(isa, isa), 100 * share["median"]) for isa, share in row["shares"].items())
    if "rates" in row:
        return ", ".join("%s: %.1f GB/s" % (word, row["rates"][word + ", lambent"]["median"]) for word in ("1M", "10M"))
    if "over_ms" in row:
        return "%s ms" % ms(row["over_ms"]["median"])
    cells = ["%s: %s" % (ISA_NAMES[isa], times(r["median"])) for isa, r in row["ratio"].items() if isa in ISA_NAMES]
    if "besides_encoder_ms" in row and row["name"] in ("whole spot", "whole teapot"):
        cells.append("%s ms besides the encoder" % ms(row["besides_encoder_ms"]))
    return ", ".join(cells)


def spread_of(row):
    """The spread of the deciding ratio of the widest instruction set."""
    if "shares" in row:
        first = next(iter(row["shares"].values()))
        return "%.0f to %.0f %%" % (100 * first["least"], 100 * first["most"])
    if "ratio" not in row or "rates" in row:
        key = next((k for k in ("over_ms",) if k in row), None)
        return "%s to %s ms" % (ms(row[key]["least"]), ms(row[key]["most"])) if key else ""
    first = next((r for isa, r in row["ratio"].items() if isa in ISA_NAMES), None)
    return "%s to %s" % (times(first["least"]), times(first["most"])) if first and first["rounds"] > 1 else ""


def beside(row):
    """Milliseconds of both, and what is reported beside the target."""
    if "not_measured" in row:
        return ""
    if "bytes" in row:
        return "%d MB of a file of %d MB; 4 samples %s" % (row["bytes"][next(iter(row["bytes"]))] // 10**6, row["file_bytes"] // 10**6,
                                                         times(row["ratio"]["4 samples"]["median"]))
    if "encoders" in row:
        other = row["encoders"]
        return "one thread %s ms; libpng 6 %s ms, %d kB; libdeflate 1 %s ms, %d kB" % (
            ms(other["lambent_one_thread"]["ms"]), ms(other["libpng_6"]["ms"]), other["libpng_6"]["bytes"] // 1000,
            ms(other["libdeflate_1"]["ms"]), other["libdeflate_1"]["bytes"] // 1000)
    if "shares" in row:
        return "%d operations a light; " % row["operations"] + ", ".join("%s: %.0f of %.0f 10⁹/s a core" % (
            ISA_NAMES.get(isa, isa), rate["median"] / row["threads"], row["arithmetic"][isa]["unfused"]) for isa, rate in row["rates"].items())
    if "rates" in row:
        return "; ".join("%s: %s × Assimp, copy %.1f, touch %.1f GB/s, normals %s ms" % (
            word, times(row["ratio"][word]["median"])[:-2], row["rates"][word + ", copy"]["median"], row["rates"][word + ", touch"]["median"],
            ms(row["ms"][word + ", normals"]["median"])) for word in ("1M", "10M"))
    if "over_ms" in row:
        return "lambent %s, true %s ms" % (ms(row["ms"]["lambent"]["median"]), ms(row["ms"]["true"]["median"]))
    text = ", ".join("%s %s" % (ISA_NAMES.get(key, key), ms(t["median"])) for key, t in row.get("ms", {}).items()) + " ms"
    extra = ["%s: %s" % (key, times(r["median"])) for key, r in row.get("ratio", {}).items() if key not in ISA_NAMES]
    if "peers_tried_ms" in row:
        extra.append("tried: " + ", ".join("%s %s" % (name, ms(t)) for name, t in row["peers_tried_ms"].items()))
    return "; ".join([text] + extra)


def line(row):
    return "%-34s %-7s %s (target %s)  [%.0f s]" % (row["name"], "reached" if row["reached"] else "NOT", measured(row), row["target"],
                                                  row["took_s"])


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return lines + ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]


def conditions(result):
    machine = result["machine"]
    return ["Measured %s on %s, %d processors, Debian %s, load %.2f before and %.2f after; %s. %d of %d rows reached their target." % (
        result["date"], machine["processor"], machine["processors"], machine["system"], machine["load_before"], machine["load_after"],
        result["version"].splitlines()[0], sum(1 for r in result["rows"] if r["reached"]), len(result["rows"])), ""]


def rows_section(result):
    return conditions(result) + table(("", "row", "target", "measured", "spread", "", "times, and beside"), (
        (str(row["number"]), row["name"], row["target"], measured(row), spread_of(row), "reached" if row["reached"] else "**not reached**",
         beside(row)) for row in result["rows"])) + [""] + [
        "Frames against llvmpipe, %s: geometric mean **%s** (target ≥ 10 ×), least %s (target ≥ 3 ×), %d rows.  " % (
            ISA_NAMES[isa], times(mean["mean"]), times(mean["least"]), mean["rows"]) for isa, mean in result["frames"].items()]


def limits_section(result):
    lines = []
    if result.get("limits"):
        memory = result["limits"]["memory_gb_s"]
        lines += table(("memory, GB/s", "one thread", "two threads"), (
            (name, "%.1f" % memory[key + "_1"], "%.1f" % memory[key + "_2"]) for name, key in (
                ("read", "read"), ("copy", "copy"), ("first touch, pages of 4 KiB", "first_touch_4k"), ("first touch, pages of 2 MiB", "first_touch_2m"))))
    if result["limits"].get("arithmetic"):
        lines += [""] + table(("one core, 10⁹ operations a second", "multiply and add apart", "fused"), (
            (ISA_NAMES.get(isa, isa), "%.0f" % rates["unfused"], "%.0f" % rates["fused"] if rates.get("fused") else "")
            for isa, rates in result["limits"]["arithmetic"].items()))
    if result.get("distance"):
        lines += [""] + table(("step, 1 M PLY, 1024², 1 sample", "ms", "least, ms", "times the least", "the least is"), (
            (name, ms(taken), "%.2f" % least, times(taken / least) if least else "", why) for name, taken, least, why in result["distance"]))
    return lines


def slope(x, y):
    """Of the straight line through the logarithms: y grows as x to this power."""
    lx, ly = [math.log(v) for v in x], [math.log(v) for v in y]
    mx, my = sum(lx) / len(lx), sum(ly) / len(ly)
    return sum((a - mx) * (b - my) for a, b in zip(lx, ly)) / sum((a - mx) ** 2 for a in lx)


def growth_section(result):
    if not result.get("growth"):
        return ["Not measured."]
    lines, rows = [], []
    for axis, series in result["growth"].items():
        cells = ["%s: %s" % (x, ms(t)) + (" (%s)" % ms(series["peer_ms"][i]) if "peer_ms" in series else "")
                 for i, (x, t) in enumerate(zip(series["x"], series["ours_ms"]))]
        fitted = slope(series["x"], series["ours_ms"]) if len(series["x"]) > 1 else 0
        rows.append((axis, ", ".join(cells), "%.2f" % fitted, "%.2f" % slope(series["x"], series["peer_ms"]) if "peer_ms" in series else ""))
    lines += table(("against", "ms of a frame, lambent (llvmpipe)", "lambent grows with the power", "llvmpipe"), rows) + [""]
    return lines + ["![Time against %s](pictures/speed-%s.svg)" % (axis, axis) for axis in result["growth"]]


def write_page(result):
    page = open(PAGE, encoding="utf-8").read()
    for name, section in (("rows", rows_section), ("limits", limits_section), ("growth", growth_section)):
        begin, end = BEGIN % name, END % name
        before, rest = page.split(begin, 1)
        page = before + begin + "\n" + "\n".join(section(result)).rstrip() + "\n" + end + rest.split(end, 1)[1]
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(page)
    for axis, series in (result.get("growth") or {}).items():
        with open(os.path.join(paths.ROOT, "docs", "pictures", "speed-%s.svg" % axis), "w", encoding="utf-8") as file:
            file.write(growth_plot.svg(series))


def newest():
    return os.path.join(paths.RESULTS, max(name for name in os.listdir(paths.RESULTS) if name.endswith(".json")))


if __name__ == "__main__":
    with open(sys.argv[1] if len(sys.argv) > 1 else newest(), encoding="utf-8") as source:
        write_page(json.load(source))
