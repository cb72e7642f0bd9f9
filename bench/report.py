#!/usr/bin/env python3
"""report.py: presents results: a line for each row, the tables of docs/speed.md between their markers, and the plots.

    report.py [RESULT.json]   rewrites page, plots and README from that result, by default the newest one
    report.py --check         one check for each of those files: it agrees with the newest result (TAP; part of make test)"""
import json
import math
import os
import sys

import growth_plot
import paths

PAGE, README = os.path.join(paths.ROOT, "docs", "speed.md"), os.path.join(paths.ROOT, "README.md")
BEGIN, END = "<!-- %s: made by bench/report.py -->", "<!-- end of %s -->"
ISA_NAMES = {"avx512": "AVX-512", "avx2": "AVX2", "neon": "NEON", "auto": "widest", "shown": "as shown"}


def times(value):
    return "%.0f ×" % value if value >= 20 else "%.1f ×" % value if value >= 3 else "%.2f ×" % value


def contestant(key):
    """Returns the display name of a program: avx2, culled -> AVX2, culled."""
    isa, comma, rest = key.partition(",")
    return ISA_NAMES.get(isa, isa) + comma + rest


def ms(value):
    return "%.0f" % value if value >= 100 else "%.1f" % value if value >= 10 else "%.2f" % value


def is_absent(row):
    """Whether the row's peer is not installed (measure.Absent)."""
    return row.get("not_measured", "").startswith("Absent: ")


def measured(row):
    """The deciding values of a row for each instruction set, in one cell."""
    if "not_measured" in row:
        return "not measured: " + row["not_measured"].split(": ", 1)[1]
    if "encoders" in row:
        ours, theirs = row["encoders"]["lambent"], row["encoders"]["libpng_1"]
        return "%s ms, %d kB (libpng %s ms, %d kB)" % (ms(ours["ms"]), ours["bytes"] // 1000, ms(theirs["ms"]), theirs["bytes"] // 1000)
    if "frames_per_s" in row:
        return "%.0f frames a second, whole after %s ms" % (row["frames_per_s"]["median"], ms(row["ms"]["the whole picture"]["median"]))
    if "shares" in row:
        return ", ".join("%s: %.0f %%" % (ISA_NAMES.get(isa, isa), 100 * share["median"]) for isa, share in row["shares"].items())
    if "rates" in row:
        return ", ".join("%s: %.1f GB/s" % (word, row["rates"][word + ", lambent"]["median"]) for word in ("1M", "10M"))
    if "over_ms" in row:
        return "%s ms" % ms(row["over_ms"]["median"])
    decides = row["cpu_ratio"] if "CPU time" in row["target"] else row["ratio"]
    cells = ["%s: %s" % (ISA_NAMES.get(isa, isa), times(r["median"])) for isa, r in decides.items() if isa in ISA_NAMES or "bytes" in row]
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
    """The milliseconds of both programs, and further results."""
    if "not_measured" in row:
        return ""
    if "bytes" in row and "file_bytes" in row:
        return "%d MB of a file of %d MB, with 1 sample" % (row["bytes"][next(iter(row["bytes"]))] // 10**6, row["file_bytes"] // 10**6)
    if "bytes" in row:
        return ", ".join("%s %d MB" % (name, peaks[next(iter(peaks))] // 10**6) for name, peaks in row["bytes"].items()) + " with 2 threads"
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
        return ", ".join("%s %s" % (name, ms(t["median"])) for name, t in row["ms"].items()) + " ms"
    text = ", ".join("%s %s" % (contestant(key), ms(t["median"])) for key, t in row.get("ms", {}).items()) + " ms"
    if "cpu_ms" in row:
        text += "; CPU time " + ", ".join("%s %s" % (ISA_NAMES.get(key, key), ms(t["median"])) for key, t in row["cpu_ms"].items()) + " ms (%s)" % (
            ", ".join("%s: %s" % (ISA_NAMES.get(isa, isa), times(r["median"])) for isa, r in row["cpu_ratio"].items()))
    if "decoding_cpu_ms" in row:
        text += "; decoding of the pictures %s ms; without decoding: %s" % (ms(row["decoding_cpu_ms"]["median"]), ", ".join(
            "%s %s" % (ISA_NAMES.get(isa, isa), times(r["median"])) for isa, r in row["besides_decoding_ratio"].items()))
    extra = ["%s: %s" % (key, times(r["median"])) for key, r in row.get("ratio", {}).items() if key not in ISA_NAMES]
    if "alone_ratio" in row:
        extra += ["%s: %.2f of one alone, %.0f %% busy" % (ISA_NAMES.get(isa, isa), r["median"], 100 * row["busy"][isa]) for isa, r in row["alone_ratio"].items()]
    if "scale" in row:
        extra.append("%.0f %% of width and height; %d threads" % (100 * row["scale"], row["threads"]))
    if "peers_tried_ms" in row:
        extra.append("tried: " + ", ".join("%s %s" % (name, ms(t)) for name, t in row["peers_tried_ms"].items()))
    extra += ["failed: " + problem for problem in row.get("peers_failed", [])]
    if "apart_load" in row:
        extra.append("measured separately, at a load of %.1f" % row["apart_load"])
    return "; ".join([text] + extra)


def line(row):
    return "%-34s %-7s %s (target %s)  [%.0f s]" % (row["name"], "" if row["target"] == "none" or is_absent(row) else "reached" if row["reached"] else "NOT", measured(row), row["target"],
                                                  row["took_s"])


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return lines + ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]


def conditions(result):
    machine = result["machine"]
    lines = ["Measured %s on %s, %d processors, Debian %s, in %.0f s; %s. The load was %.2f before and %.2f after. Other processes used %.0f %% of the "
             "processor time. %d of %d rows reached their target." % (
                 result["date"], machine["processor"], machine["processors"], machine["system"], result["took_s"],
                 result["version"].splitlines()[0], machine["load_before"], machine["load_after"], 100 * machine["share_of_others"],
                 sum(1 for r in result["rows"] if r["reached"]), len(result["rows"]))]
    return lines + ["Not measured: %s." % problem for problem in result["problems"]] + [""]


def verdict(reached):
    return "reached" if reached else "**not reached**"


def rows_section(result):
    return conditions(result) + table(("", "row", "target", "measured", "spread", "", "times and details"), (
        (str(row["number"]), row["name"], row["target"], measured(row), spread_of(row), "" if is_absent(row) else verdict(row["reached"]),
         beside(row)) for row in result["rows"])) + [""] + [
        "- Frames against llvmpipe, %s: geometric mean of %d rows %s (target ≥ 5.5 ×: %s), minimum %s." % (
            ISA_NAMES[isa], mean["rows"], times(mean["mean"]), verdict(mean["mean"] >= 5.5), times(mean["least"]))
        for isa, mean in result["frames"].items()]


def limits_section(result):
    lines = []
    if result.get("limits"):
        memory = result["limits"]["memory_gb_s"]
        lines += table(("memory, GB/s", "one thread", "two threads"), (
            (name, "%.1f" % memory[key + "_1"], "%.1f" % memory[key + "_2"]) for name, key in (
                ("read", "read"), ("copy", "copy"), ("first touch, pages of 4 KiB", "first_touch_4k"),
                ("first touch, pages of 2 MiB", "first_touch_2m"))))
    if (result.get("limits") or {}).get("arithmetic"):
        lines += [""] + table(("one core, 10⁹ operations a second", "separate multiply and add", "fused"), (
            (ISA_NAMES.get(isa, isa), "%.0f" % rates["unfused"], "%.0f" % rates["fused"] if rates.get("fused") else "")
            for isa, rates in result["limits"]["arithmetic"].items()))
    if result.get("distance"):
        lines += [""] + table(("step, 1 M PLY, 1024², 1 sample", "ms", "minimum, ms", "times the minimum", "the minimum is the time for"), (
            (name, ms(taken), "%.2f" % least if least else "", times(taken / least) if least else "", why)
            for name, taken, least, why in result["distance"]))
    return lines


def slope(x, y):
    """The slope of the straight line through the logarithms: y grows as x to this power."""
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


def readme_section(result):
    """Returns the README's table of speed, each line from a row; unmeasured values are omitted."""
    rows = {row["name"]: row for row in result["rows"] if "not_measured" not in row}
    isa, lines, numbers = result["isas"][0], [], []
    for kind in ("ply", "stl", "obj"):
        row, default = rows.get("whole 1M " + kind), rows.get("whole 1M %s, default" % kind)
        if row and default and "cpu_ms" in row:
            lines.append(("%s file of a million triangles to a PNG of 1024×1024 pixels" % kind.upper(), ms(row["ms"][isa]["median"]) + " ms", ms(row["ms"]["f3d"]["median"]) + " ms",
                          times(row["ratio"][isa]["median"]), ms(default["ms"][isa]["median"]) + " ms"))
            numbers += [row["number"], default["number"]]
    if "ground 1M ply" in rows:
        row = rows["ground 1M ply"]
        lines.append(("The PLY file with shadow and ground (`--ground`), 512×512 pixels", "", "", "", ms(row["ms"]["--ground"]["median"]) + " ms"))
        numbers.append(row["number"])
    if result["frames"].get(isa):
        lines.append(("One frame, without files (geometric mean of %d scenes)" % result["frames"][isa]["rows"], "", "",
                      times(result["frames"][isa]["mean"]) + ", against OpenGL on llvmpipe", ""))
        numbers += [row["number"] for row in rows.values() if row["name"].startswith("frame ")]
    if not lines:
        return []
    return table(("work", "Lambent, with the settings of F3D", "F3D", "speed", "Lambent's default picture"), lines) + [
        "", "Measured on %d processors (%s, %s): [docs/speed.md](docs/speed.md#results), rows %s." % (
            result["machine"]["processors"], result["machine"]["processor"], ISA_NAMES[isa], ", ".join(map(str, numbers)))]


def files(result):
    """{path: text} of every file made from a result; None if nothing has been measured yet."""
    made = {}
    for path, sections in ((PAGE, (("rows", rows_section), ("limits", limits_section), ("growth", growth_section))),
                           (README, (("speed", readme_section),))):
        with open(path, encoding="utf-8") as file:
            page = file.read()
        for name, section in sections:
            begin, end = BEGIN % name, END % name
            before, rest = page.split(begin, 1)
            lines = section(result) if result else ["Not measured yet."] if path == PAGE else []
            text = "\n".join(lines).rstrip()
            page = before + begin + "\n" + (text + "\n" if text else "") + end + rest.split(end, 1)[1]
        made[path] = page
    for axis, series in ((result or {}).get("growth") or {}).items():
        made[os.path.join(paths.ROOT, "docs", "pictures", "speed-%s.svg" % axis)] = growth_plot.svg(series)
    return made


def write_files(result):
    for path, text in files(result).items():
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


def newest():
    """The newest result of the named rows (not of BENCH=full), or None."""
    names = [name for name in os.listdir(paths.RESULTS) if name.endswith(".json") and "full" not in name] if os.path.isdir(paths.RESULTS) else []
    if not names:
        return None
    with open(os.path.join(paths.RESULTS, max(names)), encoding="utf-8") as source:
        return json.load(source)


def check():
    made = files(newest())
    print("1..%d" % len(made))
    bad = 0
    for number, (path, text) in enumerate(made.items(), 1):
        good = False
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                good = file.read() == text
        bad += not good
        print("%s %d - %s agrees with the newest of bench/results%s" % (
            "ok" if good else "not ok", number, os.path.relpath(path, paths.ROOT), "" if good else "; python3 bench/report.py rewrites it"))
    return 1 if bad else 0


def main():
    if sys.argv[1:] == ["--check"]:
        return check()
    if len(sys.argv) > 1:
        with open(sys.argv[1], encoding="utf-8") as source:
            write_files(json.load(source))
    else:
        write_files(newest())
    return 0


if __name__ == "__main__":
    sys.exit(main())
