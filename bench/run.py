#!/usr/bin/env python3
"""run.py: the whole bench: `make bench` (the named rows, a quarter of an hour) or `BENCH=full make bench` (the whole product).

Writes bench/results/DATE.json, the tables and plots of docs/speed.md (report.py), and pictures to build-bench/pictures. The full bench writes
DATE-full.json, row after row, and no page. `run.py WORD…` measures only the rows whose names contain one of the words (also `limits` and `growth`),
and writes build-bench/part.json instead. With BENCH=again, it puts them into the newest result and its page; use this for disturbed rows."""
import datetime
import json
import math
import os
import statistics
import sys
import time

import batch_rows
import frames
import gltf_rows
import measure
import paths
import report
import shadow_rows
import steps
import three_rows
import turning_rows
import whole

NO_TARGET = "none"
HURRY_S = 330  # after this time, one round per row, so that the named rows also finish on a busy machine


def judged_ratio(result, target, isas, at_least=True):
    """A row with a ratio for each instruction set; its target is reached if all of them reach it."""
    values = [result["ratio"][isa]["median"] for isa in isas]
    result["reached"] = target is None or all(v >= target if at_least else v <= target for v in values)
    return result


def row_list(isas, gl_device, display, full):
    """(name, target in words, function that measures and judges)."""
    def ratio_row(name, target, run, at_least=True):
        sign = "≥" if at_least else "≤"
        words = "%s %g ×" % (sign, target) if target else NO_TARGET
        return name, words, lambda: judged_ratio(run(), target, isas, at_least)

    def whole_row(name, target, run):
        def judge():
            result = judged_ratio(run(), target, isas)
            if name in ("whole spot", "whole teapot"):
                result["reached"] = result["reached"] and result["besides_encoder_ms"] < 10
            return result
        words = "≥ %g ×" % target if target else NO_TARGET
        return name, words + (", < 10 ms besides the encoder" if name in ("whole spot", "whole teapot") else ""), judge

    for name, target, run in whole.rows(isas, display, full):
        yield whole_row(name, target, run)
    for name, cpu_target, wall_target, run in gltf_rows.rows(isas, display):
        def judge(run=run, cpu_target=cpu_target, wall_target=wall_target):
            result = judged_ratio(run(), wall_target, isas)
            result["reached"] = result["reached"] and all(result["cpu_ratio"][isa]["median"] >= (cpu_target or 0) for isa in isas)
            return result
        yield name, "≥ %g × in CPU time" % cpu_target if cpu_target else "≥ %g ×" % wall_target, judge

    for name, target, run in batch_rows.rows(isas, display):
        def judge(run=run, target=target):
            result = judged_ratio(run(), target, isas)
            result["reached"] = (result["reached"] and all(result["alone_ratio"][isa]["median"] <= 1.1 for isa in isas) and
                                 all(result["busy"][isa] >= 0.95 for isa in isas))
            return result
        yield name, "≥ %g × in CPU time, ≤ 1.1 of one alone, ≥ 95 %% busy" % target, judge

    def judge_worker():
        result = batch_rows.worker()
        result["reached"] = result["over_ms"]["median"] <= 8
        return result
    yield "worker isolated", "≤ 8 ms a job with -j 1, 1 to 16 in flight", judge_worker

    def judge_prefilter():
        result = gltf_rows.prefilter()
        result["reached"] = result["over_ms"]["median"] <= 60
        return result
    yield "glb prefilter 1024x512", "≤ 60 ms", judge_prefilter
    for name, target, run in frames.rows(isas, gl_device, full):
        yield ratio_row(name, target, run)
    yield ratio_row("1,000 lights", 2, lambda: frames.many_lights(1000, 16, isas), False)
    yield ratio_row("10,000 lights", 5, lambda: frames.many_lights(10000, 48, isas), False)
    for kind, rate in (("ply", 4), ("stl", 4), ("obj", 2)):
        def judge(kind=kind, rate=rate):
            result = steps.reading(kind, isas)
            result["reached"] = all(result["rates"][word + ", lambent"]["median"] >= rate for word in ("1M", "10M"))
            return result
        yield "reading " + kind, "≥ %d GB/s" % rate, judge

    def judge_png():
        result = steps.png()
        ours, theirs = result["encoders"]["lambent"], result["encoders"]["libpng_1"]
        result["reached"] = ours["ms"] <= 3 and ours["bytes"] <= theirs["bytes"]
        return result
    yield "png", "≤ 3 ms, no more bytes than libpng level 1", judge_png

    def judge_lighting():
        result = steps.lighting_step(isas)
        result["reached"] = all(share["median"] >= 0.5 for share in result["shares"].values())
        return result
    yield "lighting step", "≥ 50 % of multiply and add, apart", judge_lighting
    yield ratio_row("two threads", 1.8, lambda: frames.threads(isas))

    def judge_memory():
        result = steps.memory_of_10m(isas)
        result["reached"] = all(share["median"] <= (1.4 if "samples" in key else 1.3) for key, share in result["ratio"].items())
        return result
    yield "memory 10M ply", "≤ 1.3 ×, ≤ 1.4 × with 4 samples", judge_memory

    def judge_thread_memory():
        result = steps.memory_of_threads()
        result["reached"] = all(share["median"] <= 1.5 for share in result["ratio"].values())
        return result
    yield "memory 16 threads", "≤ 1.5 ×", judge_thread_memory

    def judge_start():
        result = steps.start_up()
        result["reached"] = result["over_ms"]["median"] <= 2 and not result["opengl_or_gui_libraries"]
        return result
    yield "start", "≤ 2 ms over /bin/true, no OpenGL or GUI library", judge_start
    for name, target, run in three_rows.rows(isas, gl_device):
        yield ratio_row(name, target, run)
    for name, target, run in shadow_rows.rows(isas):
        yield ratio_row(name, target, run, False)
    yield from turning_rows.rows()


def geometric_mean(rows, isas):
    """Ratios of the frames with each instruction set, and the smallest ratio."""
    found = {}
    for isa in isas:
        ratios = [row["ratio"][isa]["median"] for row in rows if row["name"].startswith("frame ") and "ratio" in row]
        if ratios:
            found[isa] = {"mean": math.exp(statistics.mean(map(math.log, ratios))), "least": min(ratios), "rows": len(ratios)}
    return found


def run_row(number, name, target, judge):
    begun = time.monotonic()
    row = {"number": number, "name": name, "target": target}
    try:
        row.update(judge())
    except measure.Absent as problem:
        row.update(not_measured="Absent: %s" % problem, reached=False)
    except Exception as problem:  # after any failure, the other rows are still measured
        row.update(not_measured="%s: %s" % (type(problem).__name__, problem), reached=False)
    row["took_s"] = round(time.monotonic() - begun, 1)
    print("%2d  %s" % (number, report.line(row)), flush=True)
    return row


def attempt(what, run, problems):
    try:
        return run()
    except measure.Absent:
        return None  # its rows report this
    except Exception as problem:
        problems.append("%s: %s" % (what, problem))
        print("    not measured: %s: %s" % (what, problem), flush=True)
        return None


def save(result, path):
    with open(path, "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1, ensure_ascii=False)
        file.write("\n")


def into_newest(part):
    """Puts the rows of a part into the newest result, which must be of the same day and version."""
    path = os.path.join(paths.RESULTS, part["date"] + ".json")
    with open(path, encoding="utf-8") as file:
        result = json.load(file)
    if result["version"] != part["version"] or result["machine"]["processor"] != part["machine"]["processor"]:
        sys.exit("run.py: %s is of another version or machine" % path)
    rows = {row["name"]: {**row, "apart_load": round(part["machine"]["load_before"], 1)} for row in part["rows"]}
    result["rows"] = sorted({**{row["name"]: row for row in result["rows"]}, **rows}.values(), key=lambda row: row["number"])
    for number, row in enumerate(result["rows"], 1):
        row["number"] = number
    result["frames"] = geometric_mean(result["rows"], result["isas"])
    result.update({key: part[key] for key in ("limits", "distance", "growth") if part.get(key)})
    save(result, path)
    report.write_files(result)


def main():
    full, words = os.environ.get("BENCH") == "full", sys.argv[1:]
    begun, busy = time.monotonic(), measure.busy_s() - measure.own_s()
    os.makedirs(paths.PICTURES, exist_ok=True)
    os.makedirs(paths.RESULTS, exist_ok=True)
    facts, problems = measure.machine(), []
    if not full:
        measure.hurry_from = begun + HURRY_S
    isas = measure.usable_isas()
    gl_device = frames.has_gl_device()
    print("%s, %d processors, load %.2f; %s%s" % (facts["processor"], facts["processors"], facts["load_before"], ", ".join(isas),
                                                "" if gl_device else "; no OpenGL device of our own here"), flush=True)
    result = {"date": datetime.date.today().isoformat(), "version": measure.output([paths.LAMBENT, "--version"]).strip(), "machine": facts,
              "isas": isas, "our_opengl_device": gl_device, "full": full, "rows": []}
    name = result["date"] + ("-full.json" if full else ".json")
    path = os.path.join(paths.OUT, "part.json") if words else os.path.join(paths.RESULTS, name)

    def asked(name):
        return not words or any(word in name for word in words)
    display = whole.Display()
    if asked("whole"):
        attempt("F3D", display.open, problems)
    try:
        for number, (name, target, judge) in enumerate(row_list(isas, gl_device, display, full), 1):
            if asked(name):
                result["rows"].append(run_row(number, name, target, judge))
            if full:
                save(result, path)  # takes hours: results are saved row by row
    finally:
        display.close()
    result["frames"] = geometric_mean(result["rows"], isas)
    if asked("limits"):
        result["limits"] = attempt("limits", steps.limits, problems)
        if result["limits"]:
            result["distance"] = attempt("distance from the limits", lambda: steps.distance(
                isas[0], result["limits"]["memory_gb_s"], result["limits"]["process_ms"]["median"]), problems)
    if asked("growth"):
        result["growth"] = attempt("growth", lambda: frames.growth(isas), problems)
    took = time.monotonic() - begun
    facts["load_after"], result["took_s"], result["problems"] = os.getloadavg()[0], round(took, 1), problems
    # The load from other processes: the report includes it, since numbers from a busy machine mean little.
    facts["share_of_others"] = round(max(0.0, measure.busy_s() - measure.own_s() - busy) / (took * facts["processors"]), 3)
    save(result, path)
    if not words and not full:
        report.write_files(result)
    if words and os.environ.get("BENCH") == "again":
        into_newest(result)
    reached, aimed = (sum(1 for row in result["rows"] if row["target"] != NO_TARGET and not report.is_absent(row) and (row["reached"] or every)) for every in (0, 1))
    print("%d of %d targets reached, in %.0f s, others took %.0f %% of the processors' time; written: %s" % (
        reached, aimed, took, 100 * facts["share_of_others"], os.path.relpath(path, paths.ROOT)))
    return 1 if problems or any("not_measured" in row and not report.is_absent(row) for row in result["rows"]) else 0


if __name__ == "__main__":
    sys.exit(main())
