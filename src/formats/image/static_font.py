#!/usr/bin/env python3
"""static_font.py FONT OUTPUT: writes a font as the C array `static_font`, compressed by zlib, for caption.c of a static program."""
import pathlib
import sys
import zlib

font = pathlib.Path(sys.argv[1]).read_bytes()
packed = zlib.compress(font, 9)
rows = (packed[at:at + 64] for at in range(0, len(packed), 64))
pathlib.Path(sys.argv[2]).write_text('#include "static_font.h"\nconst unsigned long static_font_size = %d, static_font_packed_size = %d;\n'
                                     "const unsigned char static_font[] = {\n%s};\n" % (
                                         len(font), len(packed), "".join("%s,\n" % ",".join(map(str, row)) for row in rows)))
