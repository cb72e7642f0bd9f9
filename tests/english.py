#!/usr/bin/env python3
"""english.py [FILE…]: finds phrases and sentences that readers found hard, in pages, help, messages and comments. tests/style.py runs it over the
project; with names of files it checks only those.

Sentences of pages contain at most 35 words, and at most 18 in the mean of a page. A phrase that must stay is in ALLOWED, with the reason."""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LONGEST, MEAN = 35, 18

# Phrases, and the advice.
PHRASES = [
    (r"\bgo(?:es)? on (?:where|with|after|until|from)\b|\bgoes on\b", "continues, resumes"),
    (r"\bwhat became of\b|\bwhat becomes of\b|\bwhat came of\b", "the result"),
    (r"\b(?:is|are|was|were) told\b", "say who does it: 'the caller passes'"),
    (r"\bcounts? for nothing\b", "is ignored"),
    (r"\b(?:take|takes|taking) away\b|\bgives? up what\b", "removes, drops"),
    (r"\bstands? (?:for itself|there|beside|below|above|before|after|in place|in the place)\b", "is"),
    (r"\bthose of\b|\bthat of (?:a|an|the|its|their|one|each|this|another)\b", "repeat the noun"),
    (r"\bas (?:it|they) (?:is|are) (?:known|told|named)\b", "say who does it"),
    (r"\bin people's hands\b|\bthe house\b", "name the thing: packages, architecture"),
    (r"\bwhat (?:is|are|was|were) (?:written|read|drawn|left|given|seen|lit|said|known|needed|wanted|named|missing|made|found|kept)\b", "name the thing"),
    (r"\bno \w+ (?:that|which) (?:is|are) not\b|\bnot without\b", "say it positively"),
    (r"\bwhere (?:it|they|there|one|none|no) (?:is|are|has|have)\b", "if, when"),
    (r"\bfor ever\b", "forever"),
    (r"\bturn(?:s|ed)? round\b", "swap, rotate"),
    (r"\bhangs over\b", "overhangs"),
    (r"\bof (?:\w+ )?(?:only )?those (?:that|which)\b", "put the subject first"),
]
BEGINS = [(r"What\b(?![^.?!]*\?)", "begin with the thing itself"), (r"Where\b(?![^.?!]*\?)", "if, when"), (r"Whether\b", None)]
HEADING = re.compile(r"^#+ (?:The|A|An|In) \w+$")


def sentences(text):
    """The sentences of a paragraph. Code counts as one word."""
    text = re.sub(r"!\[[^]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"``[^`]+``|`[^`]+`", "CODE", text)
    text = re.sub(r"[*_]{1,2}([^*_]+)[*_]{1,2}", r"\1", text)
    text = re.sub(r"\b(e\.g|i\.e|etc|vs|cf|Mr|No|approx)\.", r"\1", text)
    return [s.strip() for s in re.split(r"(?<=[.!?])[\")]?\s+", text) if re.search(r"\w", s)]


def words_of(sentence):
    return [w for w in re.findall(r"[^\s]+", sentence) if re.search(r"\w", w)]


def paragraphs(page):
    """(number of the first line, text) of each paragraph, list item and heading of a page, without tables, code and made sections."""
    found, fence, made, before = [], False, False, ""
    for number, line in enumerate(page.split("\n"), 1):
        if line.startswith("```"):
            fence = not fence
        if re.match(r"<!-- .*made by", line):
            made = True
        elif line.startswith("<!-- end of"):
            made = False
        if fence or made or line.startswith(("```", "<!--", "|")) or not line.strip() or (line.startswith("    ") and (not before.strip() or before.startswith("    "))):
            found.append(None)
        elif line.startswith("#"):
            found += [(number, line), None]
        elif found and found[-1] and not re.match(r"\s*(?:[-*]|\d+\.) ", line):
            found[-1] = (found[-1][0], found[-1][1] + " " + line.strip())
        else:
            found.append((number, re.sub(r"^\s*(?:[-*]|\d+\.) ", "", line)))
        before = line
    return [p for p in found if p]


def check_page(path, text):
    """Complaints about a page in Markdown."""
    lengths = []
    for number, paragraph in paragraphs(text):
        if paragraph.startswith("#"):
            if HEADING.match(paragraph):
                yield number, "a heading of an article and a noun: " + paragraph
            continue
        for sentence in sentences(paragraph):
            count = len(words_of(sentence))
            lengths.append(count)
            if count > LONGEST:
                yield number, "%d words: %s" % (count, sentence[:120])
    if lengths and sum(lengths) / len(lengths) > MEAN:
        yield 1, "%.1f words in the mean of its sentences, at most %d" % (sum(lengths) / len(lengths), MEAN)


def main():
    for name in sys.argv[1:]:
        text = open(name, encoding="utf-8").read()
        for number, complaint in check_page(name, text):
            print("%s:%d: %s" % (name, number, complaint))
        for pattern, advice in PHRASES:
            for m in re.finditer(pattern, text):
                print("%s:%d: '%s': %s" % (name, text.count("\n", 0, m.start()) + 1, m.group(), advice))


if __name__ == "__main__":
    main()
