#!/usr/bin/env python3
"""make.py: writes the pictures in this folder: FORMAT/NAME.EXT, and expected/FORMAT-NAME.png with the expected decoded pixels.

Run it by hand when you add a picture (needs python3-pil); `make test` reads the files. The expected pixels are the pixels from which the file was
made. If Pillow can read the file, it must agree: within 1 if 5 bits become 8 (Pillow truncates), exactly otherwise. For lossy files, the expected
pixels are Pillow's. Each file is also a seed of its format's fuzz target (tests/fuzz)."""
import io
import os
import struct
import zlib

from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
W, H = 13, 7
SIZE = [(x, y) for y in range(H) for x in range(W)]


def five(v):
    return (v * 510 + 31) // 62


def scaled(v, largest):
    return (v * 510 + largest) // (2 * largest)


RGB = {(x, y): (x * 21, y * 42, (x * y * 13 + 40) % 256) for x, y in SIZE}
ALPHA = {(x, y): (x * 37 + y * 91) % 256 for x, y in SIZE}
INDEX = {(x, y): (x // 3 + y * 2) % 16 for x, y in SIZE}
COLORS = [(i * 16, 255 - i * 9, (i * 77) % 256) for i in range(16)]


def row_order(top_down, step=1):
    return range(H) if top_down else range(H - 1, -1, -1)


def save(kind, name, data, expected, pillow=True, slack=0):
    """`expected`: {(x, y): (r, g, b, a)}; None means Pillow's pixels."""
    folder = os.path.join(HERE, kind)
    os.makedirs(folder, exist_ok=True)
    os.makedirs(os.path.join(HERE, "expected"), exist_ok=True)
    open(os.path.join(folder, name), "wb").write(data)
    if pillow:
        read = Image.open(io.BytesIO(data)).convert("RGBA")
        theirs = {(x, y): read.getpixel((x, y)) for x, y in SIZE}
        if expected is None:
            expected = theirs
        worst = max(abs(a - b) for at in SIZE for a, b in zip(theirs[at], expected[at]))
        if worst > slack:
            at = next(at for at in SIZE if theirs[at] != expected[at])
            raise SystemExit("%s/%s: Pillow differs by %d, at %s: %s, not %s" % (kind, name, worst, at, theirs[at], expected[at]))
    out = Image.new("RGBA", (W, H))
    for at in SIZE:
        out.putpixel(at, expected[at])
    out.save(os.path.join(HERE, "expected", "%s-%s.png" % (kind, name.rsplit(".", 1)[0])), optimize=True)


def opaque(colors):
    return {at: tuple(colors[at][:3]) + (255,) for at in SIZE}


# --- BMP

def bmp_rows(bits, values, top_down=False):
    """Rows of packed numbers, padded to four bytes."""
    rows = b""
    for y in row_order(top_down):
        number = 0
        for x in range(W):
            number = number << bits | values[x, y]
        used = W * bits
        bytes_needed = (used + 31) // 32 * 4
        rows += (number << (bytes_needed * 8 - used)).to_bytes(bytes_needed, "big")
    return rows


def swapped(size, values):
    """Whole-byte numbers, lowest byte first, for bmp_rows."""
    return {at: int.from_bytes(values[at].to_bytes(size, "little"), "big") for at in SIZE}


def bmp(header, bits, pixels, palette=(), compression=0, top_down=False, masks=(), used=None, after=b""):
    height = -H if top_down else H
    if header == 12:
        head = struct.pack("<IHHHH", 12, W, H, 1, bits)
        table = b"".join(struct.pack("BBB", b, g, r) for r, g, b in palette)
    else:
        head = struct.pack("<IiiHHIIiiII", 40, W, height, 1, bits, compression, len(pixels), 2835, 2835,
                           len(palette) if used is None else used, 0)
        inside = b"".join(struct.pack("<I", m) for m in masks)
        if header > 40:
            head = (struct.pack("<I", header) + head[4:] + inside).ljust(header, b"\0")
            inside = b""
        table = inside + b"".join(struct.pack("BBBB", b, g, r, 0) for r, g, b in palette)
    start = 14 + len(head) + len(table) + len(after)
    return struct.pack("<2sIHHI", b"BM", start + len(pixels), 0, 0, start) + head + table + after + pixels


def indexed(colors, index):
    return {at: colors[index[at]] + (255,) for at in SIZE}


def write_bmp():
    one = {at: INDEX[at] & 1 for at in SIZE}
    by16 = indexed(COLORS, INDEX)
    bgr = {at: RGB[at][2] << 16 | RGB[at][1] << 8 | RGB[at][0] for at in SIZE}
    for header in (12, 40):
        # OS/2 palettes contain all entries for their number of bits.
        full = COLORS if header == 40 else COLORS + [(0, 0, 0)] * 240
        save("bmp", "bits1-%d.bmp" % header, bmp(header, 1, bmp_rows(1, one), COLORS[:2]), indexed(COLORS, one))
        save("bmp", "bits4-%d.bmp" % header, bmp(header, 4, bmp_rows(4, INDEX), COLORS), by16)
        save("bmp", "bits8-%d.bmp" % header, bmp(header, 8, bmp_rows(8, INDEX), full), by16)
        save("bmp", "bits24-%d.bmp" % header, bmp(header, 24, bmp_rows(24, bgr)), opaque(RGB))
    save("bmp", "short-palette-12.bmp", bmp(12, 8, bmp_rows(8, INDEX), COLORS), by16, pillow=False)
    save("bmp", "os2.bmp", bmp(64, 8, bmp_rows(8, INDEX), COLORS), by16)
    save("bmp", "top-down.bmp", bmp(40, 8, bmp_rows(8, INDEX, True), COLORS, top_down=True), by16)
    save("bmp", "gap.bmp", bmp(40, 24, bmp_rows(24, bgr), after=b"gap!"), opaque(RGB))
    # 16 bits: 5 bits each, 5-6-5 with masks, and 4 bits each with alpha.
    fives = {at: tuple(v >> 3 for v in RGB[at]) for at in SIZE}
    value = {at: r << 10 | g << 5 | b for at, (r, g, b) in fives.items()}
    save("bmp", "bits16.bmp", bmp(40, 16, bmp_rows(16, swapped(2, value))), opaque({at: tuple(map(five, fives[at])) for at in SIZE}),
         slack=1)
    value = {at: r >> 3 << 11 | g >> 2 << 5 | b >> 3 for at, (r, g, b) in RGB.items()}
    exact = {at: (five(r >> 3), scaled(g >> 2, 63), five(b >> 3)) for at, (r, g, b) in RGB.items()}
    for header in (40, 52, 56, 108, 124):
        save("bmp", "masks565-%d.bmp" % header,
             bmp(header, 16, bmp_rows(16, swapped(2, value)), compression=3, masks=(0xf800, 0x7e0, 0x1f)), opaque(exact), slack=1,
             pillow=header in (40, 108, 124))
    value = {at: ALPHA[at] >> 4 << 12 | RGB[at][0] >> 4 << 8 | RGB[at][1] >> 4 << 4 | RGB[at][2] >> 4 for at in SIZE}
    exact = {at: tuple(v // 16 * 17 for v in RGB[at] + (ALPHA[at],)) for at in SIZE}
    save("bmp", "masks4444-124.bmp", bmp(124, 16, bmp_rows(16, swapped(2, value)), compression=3, masks=(0xf00, 0xf0, 0xf, 0xf000)),
         exact, pillow=False)
    # 32 bits: the fourth byte is ignored without a mask; alpha; 10 bits each.
    value = {at: ALPHA[at] << 24 | RGB[at][0] << 16 | RGB[at][1] << 8 | RGB[at][2] for at in SIZE}
    rgba = {at: RGB[at] + (ALPHA[at],) for at in SIZE}
    save("bmp", "bits32.bmp", bmp(40, 32, bmp_rows(32, swapped(4, value))), opaque(RGB))
    masks = (0xff0000, 0xff00, 0xff, 0xff000000)
    save("bmp", "alpha-108.bmp", bmp(108, 32, bmp_rows(32, swapped(4, value)), compression=3, masks=masks), rgba)
    save("bmp", "alpha-40.bmp", bmp(40, 32, bmp_rows(32, swapped(4, value)), compression=6, masks=masks), rgba, pillow=False)
    value = {at: RGB[at][0] * 4 << 20 | RGB[at][1] * 4 + 3 << 10 | RGB[at][2] * 4 for at in SIZE}
    exact = {at: (scaled(r * 4, 1023), scaled(g * 4 + 3, 1023), scaled(b * 4, 1023)) for at, (r, g, b) in RGB.items()}
    save("bmp", "masks10.bmp", bmp(40, 32, bmp_rows(32, swapped(4, value)), compression=3, masks=(0x3ff00000, 0xffc00, 0x3ff)),
         opaque(exact), pillow=False)
    # Run lengths, the bottom row first: a run, a literal of odd length, a step over pixels, and rows that keep the
    # background.
    marks = {at: 0 for at in SIZE}

    def put(x, y, colors):
        for i, color in enumerate(colors):
            marks[x + i, H - 1 - y] = color
    put(0, 0, [3] * 13), put(0, 1, [1, 2, 3, 4, 5]), put(5, 1, [7] * 8), put(4, 3, [9, 9]), put(6, 3, [10, 11, 12, 13])
    eight = bytes([13, 3, 0, 0, 0, 5, 1, 2, 3, 4, 5, 0, 8, 7, 0, 0, 0, 2, 4, 1, 2, 9, 0, 4, 10, 11, 12, 13, 0, 1])
    # Pillow 9.4 reads the two bytes of a step twice.
    save("bmp", "runs8.bmp", bmp(40, 8, eight, COLORS, compression=1), indexed(COLORS, marks), pillow=False)
    four = bytes([13, 0x33, 0, 0, 0, 5, 0x12, 0x34, 0x50, 0, 8, 0x77, 0, 0, 0, 2, 4, 1, 2, 0x99, 0, 4, 0xab, 0xcd, 0, 1])
    save("bmp", "runs4.bmp", bmp(40, 4, four, COLORS, compression=2), indexed(COLORS, marks), pillow=False)
    marks = {at: 3 for at in SIZE}
    whole = b"".join(bytes([8, 3, 0, 5, 3, 3, 3, 3, 3, 0, 0, 0]) for _ in range(H)) + bytes([0, 1])
    save("bmp", "rows8.bmp", bmp(40, 8, whole, COLORS, compression=1), indexed(COLORS, marks))
    marks = {(x, y): 5 if x % 2 else 6 for x, y in SIZE}
    turns = b"".join(bytes([13, 0x65, 0, 0]) for _ in range(H)) + bytes([0, 1])
    save("bmp", "turns4.bmp", bmp(40, 4, turns, COLORS, compression=2), indexed(COLORS, marks), pillow=False)


# --- TGA

def tga(kind, bits, pixels, palette=b"", first=0, colors=0, color_bits=0, flags=0, remark=b""):
    return struct.pack("<BBBHHBHHHHBB", len(remark), 1 if palette else 0, kind, first, colors, color_bits, 0, 0, W, H, bits,
                       flags) + remark + palette + pixels


def tga_order(flags):
    return [(W - 1 - x if flags & 16 else x, y) for y in row_order(flags & 32) for x in range(W)]


def packets(values, step, longest):
    """Run lengths: runs of two and more pixels with literals between them; neither ends at the end of its row."""
    out, at = b"", 0
    while at < len(values):
        run = 1
        while at + run < len(values) and run < longest and values[at + run] == values[at]:
            run += 1
        if run > 1:
            out += bytes([127 + run]) + values[at]
        else:
            while at + run < len(values) and run < longest and values[at + run] != values[at + run - 1]:
                run += 1
            out += bytes([run - 1]) + b"".join(values[at:at + run])
        at += run
    return out


def write_tga():
    by16 = indexed(COLORS, INDEX)
    rgba = {at: RGB[at] + (ALPHA[at],) for at in SIZE}
    grey = {at: (RGB[at][2],) * 3 + (255,) for at in SIZE}
    map24 = b"".join(bytes([b, g, r]) for r, g, b in COLORS)
    map32 = b"".join(bytes([b, g, r, 255 - r]) for r, g, b in COLORS)
    map16 = b"".join(struct.pack("<H", r >> 3 << 10 | g >> 3 << 5 | b >> 3) for r, g, b in COLORS)
    five_of = [tuple(five(v >> 3) for v in c) for c in COLORS]
    for flags in (0, 16, 32, 48):
        order = tga_order(flags)
        bytes24 = [bytes(reversed(RGB[at])) for at in order]
        # Pillow ignores the right-to-left flag.
        save("tga", "bits24-%d.tga" % flags, tga(2, 24, b"".join(bytes24), flags=flags), opaque(RGB), pillow=not flags & 16)
        save("tga", "runs24-%d.tga" % flags, tga(10, 24, packets(bytes24, 3, 128), flags=flags), opaque(RGB), pillow=False)
    order = tga_order(0)
    index = [bytes([INDEX[at]]) for at in order]
    save("tga", "palette24.tga", tga(1, 8, b"".join(index), map24, 0, 16, 24), by16)
    save("tga", "palette32.tga", tga(1, 8, b"".join(index), map32, 0, 16, 32, flags=8),
         {at: COLORS[INDEX[at]] + (255 - COLORS[INDEX[at]][0],) for at in SIZE}, pillow=False)
    save("tga", "palette16.tga", tga(1, 8, b"".join(index), map16, 0, 16, 16), indexed(five_of, INDEX), slack=1, pillow=False)
    save("tga", "palette-first.tga", tga(1, 8, b"".join(bytes([i[0] + 100]) for i in index), map24, 100, 16, 24, remark=b"a remark"),
         by16, pillow=False)
    save("tga", "palette-runs.tga", tga(9, 8, packets(index, 1, 128), map24, 0, 16, 24), by16, pillow=False)
    fives = {at: tuple(v >> 3 for v in RGB[at]) for at in SIZE}
    for bits, flags in ((15, 0), (16, 0), (16, 1)):
        value = [struct.pack("<H", (ALPHA[at] >> 7) << 15 | fives[at][0] << 10 | fives[at][1] << 5 | fives[at][2]) for at in order]
        expected = {at: tuple(map(five, fives[at])) + (255 * (ALPHA[at] >> 7) if flags else 255,) for at in SIZE}
        save("tga", "bits%d-alpha%d.tga" % (bits, flags), tga(2, bits, b"".join(value), flags=flags), expected, pillow=False)
    value = [bytes([RGB[at][2], RGB[at][1], RGB[at][0], ALPHA[at]]) for at in order]
    save("tga", "bits32.tga", tga(2, 32, b"".join(value), flags=8), rgba)
    save("tga", "bits32-unsaid.tga", tga(2, 32, b"".join(value)), rgba)
    save("tga", "runs32.tga", tga(10, 32, packets(value, 4, 5), flags=8), rgba, pillow=False)
    save("tga", "bits32-no-alpha.tga", tga(2, 32, b"".join(v[:3] + b"\0" for v in value)), opaque(RGB), pillow=False)
    value = [bytes([RGB[at][2]]) for at in order]
    save("tga", "grey.tga", tga(3, 8, b"".join(value)), grey)
    save("tga", "grey-runs.tga", tga(11, 8, packets(value, 1, 128)), grey, pillow=False)
    footer = struct.pack("<II", 0, 0) + b"TRUEVISION-XFILE.\0"
    save("tga", "footer.tga", tga(3, 8, b"".join(value)) + footer, grey)


# --- PNG

def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(color, bits, rows, interlaced=False, before=b""):
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", W, H, bits, color, 0, 0, interlaced)) + before +
            chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def png_rows(bits, values, interlaced):
    """Filter 0; `values`: a tuple of numbers of `bits` bits for each pixel."""
    passes = [(0, 8, 0, 8), (4, 8, 0, 8), (0, 4, 4, 8), (2, 4, 0, 4), (0, 2, 2, 4), (1, 2, 0, 2), (0, 1, 1, 2)]
    out = b""
    for x0, dx, y0, dy in passes if interlaced else [(0, 1, 0, 1)]:
        for y in range(y0, H, dy):
            number, used = 1, 0
            for x in range(x0, W, dx):
                for v in values[x, y]:
                    number, used = number << bits | v, used + bits
            if used:
                pad = -used % 8
                out += b"\0" + (number << pad).to_bytes((used + pad) // 8 + 1, "big")[1:]
    return out


def write_png():
    for interlaced in (False, True):
        end = "-interlaced.png" if interlaced else ".png"
        for bits in (1, 2, 4, 8):
            index = {at: (INDEX[at] & (1 << bits) - 1,) for at in SIZE}
            table = COLORS[:1 << bits]
            before = chunk(b"PLTE", bytes(v for c in table for v in c)) + chunk(b"tRNS", b"\x40\xff")
            expected = {at: table[i] + (64 if i == 0 else 255,) for at, (i,) in index.items()}
            save("png", "palette%d%s" % (bits, end), png(3, bits, png_rows(bits, index, interlaced), interlaced, before), expected)
        wide = {at: tuple((v * 257 + 100) & 0xffff for v in RGB[at] + (ALPHA[at],)) for at in SIZE}
        cut = {at: tuple(v >> 8 for v in wide[at]) for at in SIZE}
        save("png", "bits16%s" % end, png(6, 16, png_rows(16, wide, interlaced), interlaced), cut, pillow=False)
        grey = {at: (wide[at][0],) for at in SIZE}
        save("png", "grey16%s" % end, png(0, 16, png_rows(16, grey, interlaced), interlaced),
             {at: (cut[at][0],) * 3 + (255,) for at in SIZE}, pillow=False)


# --- WebP and JPEG, by Pillow

def write_pillow():
    rgba = Image.new("RGBA", (W, H))
    for at in SIZE:
        rgba.putpixel(at, RGB[at] + (ALPHA[at],))

    def saved(image, kind, **how):
        out = io.BytesIO()
        image.save(out, kind, **how)
        return out.getvalue()
    exact = {at: RGB[at] + (ALPHA[at],) for at in SIZE}
    save("webp", "lossless-alpha.webp", saved(rgba, "WEBP", lossless=True, exact=True), exact)
    save("webp", "lossless.webp", saved(rgba.convert("RGB"), "WEBP", lossless=True), opaque(RGB))
    save("webp", "lossy-alpha.webp", saved(rgba, "WEBP", quality=80), None)
    save("webp", "lossy.webp", saved(rgba.convert("RGB"), "WEBP", quality=80), None)
    save("webp", "profile.webp", saved(rgba, "WEBP", quality=80, exif=b"Exif\0\0II*\0\x08\0\0\0\0\0\0\0\0\0"), None)
    rgb = rgba.convert("RGB")
    save("jpeg", "cmyk.jpg", saved(rgb.convert("CMYK"), "JPEG", quality=90), None)
    save("jpeg", "cmyk-progressive.jpg", saved(rgb.convert("CMYK"), "JPEG", quality=90, progressive=True), None)
    for sampling, name in ((0, "444"), (1, "422"), (2, "420")):
        save("jpeg", "color%s.jpg" % name, saved(rgb, "JPEG", quality=85, subsampling=sampling), None)
    save("jpeg", "color420-progressive.jpg", saved(rgb, "JPEG", quality=85, subsampling=2, progressive=True), None)
    save("jpeg", "grey.jpg", saved(rgb.convert("L"), "JPEG", quality=85), None)


write_bmp()
write_tga()
write_png()
write_pillow()
