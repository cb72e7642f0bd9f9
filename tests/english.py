#!/usr/bin/env python3
"""english.py [FILE…]: finds phrases and sentences that readers found hard, in pages, help, messages and comments; without names, it checks the whole
project, like tests/style.py. Names are relative to the project's folder.

Sentences of pages contain at most 35 words, and at most 18 in the mean of a page. ALLOWED contains phrases that must stay, with the reason."""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LONGEST, MEAN = 35, 18

# Phrases, and the advice.
PHRASES = [
    (r"\bgo(?:es)? on\b(?! (?:the|a|top)\b)", "continues, resumes"),
    (r"\bwhat (?:became|becomes|came|comes) of\b", "the result"),
    (r"\b(?:is|are|was|were) told\b", "say who does it: 'the caller passes'"),
    (r"\bcounts? for nothing\b", "is ignored"),
    (r"\b(?:take|takes|taking) away\b|\bgives? up what\b", "removes, drops"),
    (r"\bstands? (?:for|itself|there|beside|below|above|before|after|in place|in the place)\b", "is; means"),
    (r"\bthose of\b|\bthat of (?:a|an|the|its|their|one|each|this|another)\b", "repeat the noun, or use 's"),
    (r"\bof (?:\w+ )?(?:only )?those (?:that|which)\b", "put the subject first"),
    (r"\bin people's hands\b|\bthe house\b", "name the thing: packages, architecture"),
    (r"\bwhat (?:is|are|was|were) (?:written|read|drawn|left|given|seen|lit|said|known|needed|wanted|named|missing|made|kept|in the way)\b", "name the thing"),
    (r"\bno \w+ (?:that|which) (?:is|are) not\b|\bnot without\b", "say it positively"),
    (r"\bwhere (?:it|they|there|one|none|no) (?:is|are|has|have)\b", "if, when"),
    (r"\bfor ever\b", "forever"),
    (r"\bturn(?:s|ed)? round\b", "swap, rotate"),
    (r"\bhangs over\b", "overhangs"),
    (r"\bworked out\b", "computed"),
    (r"(?:^|[.!?] )What (?!is |are |does |do )[^.?!]*(?:[.!]|$)", "begin with the thing itself"),
    (r"(?:^|; )NULL: none\b|; false: LAM_", "'NULL if there is none'; 'fails with LAM_'"),
    (r"\b(?:is|are) there twice\b", "is listed twice"),
    (r"\banew\b", "again"),
    (r"\bso many\b(?! \w+ that\b)", "this number of"),
    (r"\bcomes? back as\b|\bgives? way\b|\b(?:take|takes|in) the place of\b", "becomes; yields; replaces"),
    (r"\bfor want of\b", "if memory is insufficient"),
    (r"\bsays? so\b", "states this, reports this"),
    (r"\b(?:whoever|wherever|however many|however large|however small)\b", "for any"),
    (r"\bas (?:it|they) (?:is|are) (?:there|written|asked)\b|\bas (?:people|one) ha(?:s|ve)\b", "name the form"),
]
# Phrases of pages alone, the advice, and a text that the phrase finds. Comments still contain some
# of them.
PAGE_PHRASES = [
    (r"\b(?:is|are) left out\b", "omits; 'Lambent omits it'", "shadows are left out"),
    (r"\bhas none\b", "'does not support them', 'contains none'", "the format has none"),
    (r"\b[Tt]o see (?:the|them|it)\b[^.]*: `", "'Use `--show` to draw'", "To see the term alone: `--show ambient`"),
    (r"\bCorrect: ", "an imperative: 'Normalize it'", "Correct: `normalize` first."),
    (r"\bhowever many\b|\bwhatever (?:the|its|their)\b", "'for any number of', 'independent of'", "a pixel is lit once, however many triangles"),
    (r"\bgoes? (?:only )?with\b", "can be combined with; needs", "the key goes with a spot"),
    (r"\btakes? for granted\b|\bcontestants?\b|\bmend(?:s|ed)?\b|\bcures?\b", "assumes; program; fixes", "the fault is mended"),
]
HEADING = re.compile(r"^#+ (?:The|A|An|In) \w+$")


# A text that contains each phrase, in the same order: a pattern without a match is a mistake.
EXAMPLES = ["the run goes on", "what became of it", "it is told the size", "a cut line counts for nothing", "it takes away light", "it stands for a number",
            "those of the file", "of levels only those that are read", "the house", "what is written", "no picture that is not drawn", "where it is missing",
            "it waits for ever", "the face is turned round", "it hangs over a surface", "it is worked out", "Errors are values. What remains is drawn.",
            "the name; NULL: none", "the key is there twice", "it is made anew", "an array of so many numbers",
            "one in the place of another", "refused for want of memory", "unless it says so", "lights, wherever they are", "a file as people have it"]


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
    """Returns (number of the first line, text) of each paragraph, list item and heading of a page, without tables, code and generated sections."""
    found, fence, made, before = [], False, False, ""
    for number, line in enumerate(page.split("\n"), 1):
        if line.startswith("```"):
            fence = not fence
        if re.match(r"<!-- .*made by", line):
            made = True
        elif line.startswith("<!-- end of"):
            made = False
        if fence or made or line.lstrip().startswith(("```", "<!--", "|")) or not line.strip() or (line.startswith("    ") and (not before.strip() or before.startswith("    "))):
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


# Sentences that keep a phrase: (path, text, reason).
ALLOWED = []
MADE = ("docs/check/contracts.md",)  # from programs of courses, in their own words


def c_texts(source):
    """(number of the line, text) of each comment and each literal of a C file. Consecutive lines of comments in one column are one text;
    an empty line and an item of a list begin another. Indented lines (formulas, tables) are texts of their own, which begin with two spaces."""
    found, before, item = [], None, False
    for m in re.finditer(r"//([^\n]*)|'(?:[^'\\\n]|\\.)+'|((?:\"(?:[^\"\\\n]|\\.)*\"\s*)+)", source):
        line = source.count("\n", 0, m.start()) + 1
        if m.group(1) is not None:
            start = source.rfind("\n", 0, m.start()) + 1
            column, text = m.start() - start, m.group(1).strip()
            follows = before == (line - 1, column) and not source[start:m.start()].strip()
            verbatim = m.group(1).startswith("  ") and not (item and follows) or text.startswith("clang-format o")
            begins = bool(re.match(r"(?:\d+\.|[-*]) ", text))
            if text and follows and not verbatim and not begins:
                found[-1] = (found[-1][0], found[-1][1] + " " + text)
            elif text:
                found.append((line, "  " + text if verbatim else text))
                item = begins
            before = (line, column) if text and not verbatim else None
        elif m.group(2):
            found.append((line, "".join(re.findall(r"\"((?:[^\"\\\n]|\\.)*)\"", m.group(2)))))
    return found


def texts_of(path, text):
    return [(n, t) for n, t in enumerate(text.split("\n"), 1) if t.lstrip().startswith("|")] + paragraphs(text) if path.endswith(".md") else c_texts(text)


def check_phrases(path, text):
    phrases = PHRASES + [(pattern, advice) for pattern, advice, _ in PAGE_PHRASES if path.endswith(".md")]
    for number, part in texts_of(path, text):
        for pattern, advice in phrases:
            m = re.search(pattern, part)
            if m and not any(path == p and t in part for p, t, _ in ALLOWED):
                yield number, "'%s': %s" % (m.group().strip(), advice)


def files():
    """The checked files, by group."""
    def below(folder, endings):
        for path, _, names in sorted(os.walk(os.path.join(ROOT, folder))):
            yield from (os.path.relpath(os.path.join(path, name), ROOT) for name in sorted(names) if name.endswith(endings))
    pages = [path for path in ["README.md", "CONTRIBUTING.md", "SECURITY.md", *below("docs", ".md")] if path not in MADE]
    yield "pages", pages
    for folder in ("include", "src", "program", "classroom", "tools"):
        yield folder, [path for path in below(folder, (".c", ".h", ".inc"))]


def complaints(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        text = file.read()
    found = list(check_phrases(path, text))
    if path.endswith(".md") and path != "docs/command-line.md":  # whose sentences come from the help
        found += check_page(path, text)
    return ["%s:%d: %s" % (path, number, complaint) for number, complaint in sorted(found)]


def main():
    for path in sys.argv[1:] or [path for _, group in files() for path in group]:
        for complaint in complaints(path):
            print(complaint)


if __name__ == "__main__":
    main()
