"""made_part.py: the parts of pages that bench scripts write, between two comments that name the script."""
import re


def write(page, name, script, lines):
    """Replaces the part `name` of the page, which `script` makes; the page must have its two comments."""
    begin, end = "<!-- %s: made by bench/%s -->\n" % (name, script), "<!-- end of %s -->" % name
    with open(page, encoding="utf-8") as file:
        text = file.read()
    text, found = re.subn(re.escape(begin) + ".*?" + end, lambda _: begin + "\n".join(lines) + "\n" + end, text, flags=re.S)
    if found != 1:
        raise SystemExit("%s: %d parts '%s', expected 1" % (page, found, name))
    with open(page, "w", encoding="utf-8") as file:
        file.write(text)
