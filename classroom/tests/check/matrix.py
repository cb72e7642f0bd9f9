#!/usr/bin/env python3
"""matrix.py PROGRAM [--versions N] [--only TEXT] [--jobs N]: checks correct shaders and every known mistake, in every contract, and prints tables by
contract and by version of GLSL: how many correct shaders pass, and how many mistakes get the right name, no name, or a wrong name. The exit code is 1
if a correct shader fails or a mistake gets a wrong name.

Each mistake is made in N versions of GLSL, in turn (1: some minutes; 20: all, two hours)."""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import correct
import demands
import mutants

BATCH = 200  # shaders per call; each call draws the pictures of mistakes once


def run(program, folder, names, options):
    words = [program, "check", *[f"{n}.{e}" for n in names for e in ("vert", "frag") if (folder / f"{n}.{e}").exists()], "--json", "-s", "64", *options]
    done = subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    found = {r["fragment"].rsplit(".", 1)[0]: r for r in map(json.loads, done.stdout.splitlines())}
    return {n: found.get(n, {"error": done.stderr.decode()[-300:]}) for n in names}


def check(program, folder, rows, jobs):
    """`rows` contains (key, options, texts). Returns the reports by key. Each batch has one contract and stage, like the submissions of a class."""
    batches = collections.defaultdict(list)
    for number, (key, group, options, texts) in enumerate(rows):
        for ending, text in texts.items():
            (folder / f"{number:05}.{ending}").write_text(text, newline="")
        batches[group, tuple(options)].append((f"{number:05}", key))
    calls = [(group[1], some[i:i + BATCH]) for group, some in batches.items() for i in range(0, len(some), BATCH)]
    reports = {}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for call, found in zip(calls, pool.map(lambda c: run(program, folder, [n for n, _ in c[1]], c[0]), calls)):
            reports.update({key: found[name] for name, key in call[1]})
    return reports


def table(title, columns, rows):
    print("\n| %s | %s |\n|---|%s" % (title, " | ".join(columns), "--:|" * len(columns)))
    for name, numbers in rows:
        print("| %s | %s |" % (name, " | ".join(map(str, numbers))))


def judge_correct(program, folder, jobs, only):
    rows = [((name, None), "style", options, texts) for name, options, texts in correct.SHADERS]
    rows += [((f"{contract} {stage} {dialect}", dialect), (contract, stage), [], texts) for contract, stage, dialect, texts in mutants.correct()]
    rows = [r for r in rows if only in r[0][0]]
    reports = check(program, folder, rows, jobs)
    bad = [key for key, r in reports.items() if r.get("verdict") != "passes"]
    styles = [key for key in reports if key[1] is None]
    table("correct shaders", ("pass", "of"), [("in unusual styles", (len([k for k in styles if k not in bad]), len(styles))),
                                              ("plain, in every version", (len(reports) - len(styles) - len([k for k in bad if k not in styles]), len(reports) - len(styles)))])
    for key in bad:
        r = reports[key]
        print("  fails:", key[0], "|", r.get("verdict"), r.get("error", ""), [m["id"] for m in r.get("mistakes", [])],
              [n["text"] for n in r.get("notes", [])][:2])
    return not bad


def contract_of(shader):
    """The contract of a shader. It is given, because a course that wants every mistake named gives its contract; without it, the search is short."""
    return re.sub("-(point|direction|basic|raw|vertex|lights|materials|spot|maps)$", "", shader)


# Combinations of mistakes that equal one mistake with its own name.
SAME = {("clip-space-vectors", "normal-clip-space"): ["clip-space"], ("light-from-object-space", "eye-from-object-space"): ["point-in-object-space"]}


def matches(choices, right):
    """Whether the reported names match the right names in some order. A reported name may represent others with the same pictures."""
    if not choices or not right:
        return not choices and not right
    return any(one in choices[0] and matches(choices[1:], right[:i] + right[i + 1:]) for i, one in enumerate(right)) or any(
        set(pair) <= set(right) and matches(choices, [x for x in right if x not in pair] + whole) for pair, whole in SAME.items())


def judge_mistakes(program, folder, jobs, versions, only):
    rows = [((number, name, contract, stage, dialect, tuple(map(tuple, right))), (contract, stage),
             demands.demanding(program, contract, sum(right, []), folder) or ("--contract", contract_of(contract)), texts)
            for number, (name, contract, stage, dialect, right, texts) in enumerate(mutants.mutants(versions))]
    rows = [r for r in rows if only in " ".join(r[0][1:5])]
    reports = check(program, folder, rows, jobs)
    by = {"contract": collections.defaultdict(collections.Counter), "version": collections.defaultdict(collections.Counter),
          "mistakes": collections.defaultdict(collections.Counter)}
    failures = collections.defaultdict(list)
    for key, r in reports.items():
        _, name, contract, stage, dialect, right = key
        reported = sorted(m["id"] for m in r.get("mistakes", []))
        choices = [{m["id"], *(m["also"] or "").split()} for m in r.get("mistakes", [])]
        certain = all(m["certain"] for m in r.get("mistakes", []))
        known = set(sum(right, ()))
        rest = [c for c in choices if not c & {"no-light", "no-specular"}]
        dark = certain and len(right[0]) > 1 and len(rest) < len(choices) and all(known & c for c in rest)
        # a name for several mistakes is a part of the truth if one of them is there
        partly = {x for x in reported if x in known or any(x in whole and known & set(pair) for pair, whole in SAME.items())}
        unread = "no verdict" in r.get("error", {}).get("text", "") if isinstance(r.get("error"), dict) else "no verdict" in r.get("error", "")
        verdict = "none" if unread else "error" if "error" in r or r.get("verdict") in ("refused", "endless", "crashes") else "right" if any(matches(choices, list(x)) for x in right) else \
            "not seen" if r.get("verdict") == "passes" else "hidden" if dark or (reported and certain and all(known & c for c in choices)) else "part" if reported and set(reported) <= partly and (not certain or set(reported) <= known) else "none" if not reported else "wrong"
        by["contract"][f"{contract}, lit per {'fragment' if stage == 'f' else 'vertex'}"][verdict] += 1
        by["version"][dialect or "none"][verdict] += 1
        by["mistakes"]["one" if len(right[0]) == 1 else "two" if len(right[0]) == 2 else "three"][verdict] += 1
        if verdict != "right":
            failures[verdict, name, contract, stage, " ".join(reported), certain, r.get("error", "")[:200] or " ".join(
                n["text"] for n in r.get("notes", []) if n["kind"] == "compiler")[:200]].append(dialect)
    # hidden: the names explain every picture, so the other mistakes are not visible
    columns = ("right", "hidden", "part", "none", "not seen", "wrong", "error")
    for title, counts in by.items():
        table(title, columns, [(name, [c[x] for x in columns]) for name, c in counts.items()])
    total = sum((c for c in by["mistakes"].values()), collections.Counter())
    table("all", columns, [("shaders with mistakes", [total[x] for x in columns])])
    for (verdict, name, contract, stage, reported, certain, note), where in sorted(failures.items()):
        print(f"  {verdict}: {contract} {stage}: {name}: reported [{reported}]{'' if certain else ' in part'} in {len(where)} versions {note}")
    return total["wrong"] == 0 and total["error"] == 0


def main():
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("program")
    words.add_argument("--versions", type=int, default=1)
    words.add_argument("--only", default="")
    words.add_argument("--jobs", type=int, default=2)
    words.add_argument("--no-correct", action="store_true")
    words = words.parse_args()
    program = str(pathlib.Path(words.program).resolve())
    ok = True
    if not words.no_correct:
        with tempfile.TemporaryDirectory(prefix="lambent-matrix-") as folder:
            ok = judge_correct(program, pathlib.Path(folder), words.jobs, words.only)
    with tempfile.TemporaryDirectory(prefix="lambent-matrix-") as folder:
        ok = judge_mistakes(program, pathlib.Path(folder), words.jobs, words.versions, words.only) and ok
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(main())
