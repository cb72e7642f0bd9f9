#!/usr/bin/env python3
"""sample_sentences.py [SEED]: prints 200 sentences for a reader who judges their English: 40 from the README, 40 from the help, 60 from ten pages and
60 from the comments of twenty files, chosen by the seed (1). If a text contains fewer sentences, it prints fewer. Each line contains a number, the
file and the sentence."""
import os
import random
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests"))
import english  # noqa: E402


# Three words in a row: other texts are code or formulas.
ENGLISH = re.compile(r"[A-Za-z']{2,}[, ]+[A-Za-z']+[, ]+[A-Za-z']{2,}")

SMALL = set("a and as by for from in is it no not of on or that the to with".split())


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def is_list(text):
    """Whether a text only lists names, such as the other names of an option."""
    return all(re.fullmatch(r"[a-z-]+", word) and word not in SMALL for word in text.split())


def sentences_of(path):
    """The sentences of a page or of a file's comments that have at least four words, unchanged. Lines of code, and
    formulas and tables in comments, are not sentences."""
    texts = english.paragraphs(read(path)) if path.endswith(".md") else [text for text in english.c_texts(read(path)) if not re.search(r"%[-.0-9]*[a-z]", text[1])]
    for _, text in texts:
        if not text.startswith(("#", "  ", "---")) and not is_list(text):
            for sentence in re.split(r"\\n|(?<=[.!?])(?<! [A-Z]\.)\s+", text):
                if len(sentence.split()) >= 4 and ENGLISH.search(sentence) and not re.search(r";(?:\s*//|$)|\{\w+\}", sentence):
                    yield path, sentence


def cells(path):
    """The descriptions of the tables of a page."""
    for line in read(path).split("\n"):
        if line.startswith("| `"):
            text = line.rstrip(" |").rsplit(" | ", 1)[-1]
            yield from ((path, sentence) for sentence in re.split(r"<br>|(?<=[.!?])(?<! [A-Z]\.)\s+", text) if len(sentence.split()) >= 4)


def main():
    chance = random.Random(int(sys.argv[1]) if len(sys.argv) > 1 else 1)
    files = subprocess.run(["git", "ls-files", "docs/*.md", "docs/*/*.md", "src/*.c", "src/*.h", "program/*.c", "program/*.h", "classroom/*.c", "classroom/*.h", "tools/*.c", "tools/*.h"], cwd=ROOT, stdout=subprocess.PIPE,
                           check=True).stdout.decode().split()
    pages = [path for path in files if path.endswith(".md") and path not in ("docs/check/contracts.md", "docs/command-line.md")]
    code = [path for path in files if not path.endswith(".md") and len(list(sentences_of(path))) >= 3]
    chosen = []
    for texts, count in ((list(sentences_of("README.md")) + list(cells("README.md")), 40), (list(cells("docs/command-line.md")), 40),
                         ([s for path in chance.sample(sorted(pages), 10) for s in sentences_of(path)], 60),
                         ([s for path in chance.sample(sorted(code), 20) for s in sentences_of(path)], 60)):
        chosen += chance.sample(texts, min(count, len(texts)))
    for number, (path, sentence) in enumerate(chosen, 1):
        print("%3d  %s: %s" % (number, path, sentence))


if __name__ == "__main__":
    main()
