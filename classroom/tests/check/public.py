#!/usr/bin/env python3
"""public.py FOLDER [--program PROGRAM] [--only TEXT] [--jobs N] [--page FILE]: checks the public shaders that public_labels.py lists, fetched by the
caller to FOLDER/OWNER/REPOSITORY/PATH, and prints each verdict beside its label, and counts.

The exit code is 1 if a right shader differs, if a wrong one passes, if one that cannot be judged passes, if a certain name is not a true one, or if
fewer than 75 % get a verdict. A program that always reports "differs", or reports nothing, therefore fails."""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import public_labels

MIN_SHARE = 0.75
VERDICTS = {"passes", "differs", "refused", "not a number"}


def shader_text(folder, repository, path):
    """The shader at PATH, or the script or string #ID of the page PATH."""
    path, _, name = path.partition("#")
    text = (folder / repository / path).read_text(errors="replace")
    if not name:
        return text
    script = re.search(r"<script[^>]*\bid\s*=\s*[\"']%s[\"'][^>]*>(.*?)</script>" % re.escape(name), text, re.S)
    string = re.search(r"\b%s\s*=\s*`(.*?)`" % re.escape(name), text, re.S)
    found = script or string
    return found.group(1).lstrip() if found else ""


def check(program, folder, row):
    """Returns the program's result: (verdict or "none", certain names, uncertain names, sentence)."""
    repository, fragment, vertex = row[:3]
    with tempfile.TemporaryDirectory() as scratch:
        files = []
        for path, name in ((fragment, "shader.frag"), (vertex, "shader.vert")):
            (pathlib.Path(scratch) / name).write_text(shader_text(folder, repository, path))
            files.append(name)
        done = subprocess.run([program, "check", *files, "--json"], cwd=scratch, capture_output=True, text=True)
    try:
        report = json.loads(done.stdout.splitlines()[0])
    except (IndexError, ValueError):
        report = {"error": done.stderr.strip()}
    mistakes = report.get("mistakes") or []
    return (report.get("verdict") or "none", [m["id"] for m in mistakes if m.get("certain")],
            [m["id"] for m in mistakes if not m.get("certain")], str(report.get("error") or ""))


def judge(row, verdict, certain):
    """Compares a verdict with the label."""
    label, names = row[3], row[4]
    if verdict not in VERDICTS:
        return "silent"
    if label == "unknown":
        return "passed without evidence" if verdict == "passes" else "doubtful verdict" if verdict == "differs" else "refused"
    if label == "right":
        return "right" if verdict == "passes" else "FALSE ALARM"
    if verdict == "passes":
        return "FALSE PASS"
    return "WRONG NAME" if any(n not in names for n in certain) else "found"


PAGE = """# Public shaders

This page shows how reliably `lambent check` judges shaders from public repositories, and how to repeat the test.

`classroom/tests/check/public_labels.py` lists %d pairs of lighting shaders from public repositories. The shaders use no textures or shadows. A person
first labelled each pair as right, wrong (with the reason) or impossible to judge (for example, because the model is not standard). The
check was adapted to these shaders later. The shaders are not part of this project. To repeat the test, put the repositories into a folder,
as OWNER/REPOSITORY/PATH. Then run this command, which writes this page:

    python3 classroom/tests/check/public.py FOLDER --program build/lambent --page docs/check/public.md

The command fails in any of these cases:

- A correct shader gets the verdict `differs`, or a wrong shader passes.
- The check gives a verdict on a shader that was labelled as impossible to judge.
- The check reports, as certain, a mistake that the shader does not contain.
- The check gives a verdict for fewer than 75 %% of the pairs.

| label | right verdict | wrong verdict | no verdict |
|---|--:|--:|--:|
%s

The check gives a verdict for %d of %d pairs (%.0f %%).

| repository | fragment shader | label | verdict | names | comment |
|---|---|---|---|---|---|
%s
"""


def page(rows, results, counts, judged):
    good, silent = ("right", "found", "refused"), "silent"
    outcomes = [(row, result, judge(row, result[0], result[1])) for row, result in zip(rows, results)]
    table = "\n".join("| %s | %d | %d | %d |" % (label, sum(r[3] == label and o in good for r, _, o in outcomes),
                                               sum(r[3] == label and o not in good + (silent,) for r, _, o in outcomes),
                                               sum(r[3] == label and o == silent for r, _, o in outcomes))
                      for label in ("right", "wrong", "unknown"))
    lines = "\n".join("| %s | %s | %s | %s | %s | %s |" % (row[0], row[1].rsplit("/", 1)[-1], row[3], result[0].replace("none", ""),
                                                         " ".join(result[1] + ["(%s?)" % n for n in result[2]]), row[5])
                      for row, result, _ in outcomes)
    return PAGE % (len(rows), table, judged, len(rows), 100 * judged / len(rows), lines)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--program", default="build/lambent")
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--page", type=pathlib.Path, help="writes the results as a page (docs/check/public.md)")
    options = parser.parse_args()
    program = pathlib.Path(options.program).resolve()
    rows = [r for r in public_labels.LABELS if options.only in "/".join(r[:3])]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda r: check(program, options.folder, r), rows))
    counts = collections.Counter()
    for row, (verdict, certain, hedged, error) in zip(rows, results):
        outcome = judge(row, verdict, certain)
        counts[outcome] += 1
        names = " ".join(certain + [f"({n}?)" for n in hedged])
        print(f"{outcome:24} {row[3]:8} {verdict:10} {names:34} {row[0].split('/')[0]}/…/{row[1].rsplit('/', 1)[-1]}  {error[:160] or row[5]}")
    judged = len(rows) - counts["silent"]
    print("\n" + ", ".join(f"{n} {k}" for k, n in sorted(counts.items())))
    print(f"{judged} of {len(rows)} get a verdict ({100 * judged / max(len(rows), 1):.0f} %)")
    if options.page:
        options.page.write_text(page(rows, results, counts, judged))
    bad = ("FALSE ALARM", "FALSE PASS", "WRONG NAME", "passed without evidence", "doubtful verdict")
    return 1 if any(counts[b] for b in bad) or judged < MIN_SHARE * len(rows) else 0


if __name__ == "__main__":
    sys.exit(main())
