# gif.py: a strict decoder of GIF animations for tests, written from the specification (GIF89a).
import struct


def codes(data, count):
    """Decodes LZW data with 8-bit symbols to `count` indices."""
    table, width, previous, out = None, 9, None, bytearray()
    bits = held = at = 0
    while True:
        while held < width:
            bits |= data[at] << held
            held, at = held + 8, at + 1
        code, bits, held = bits & ((1 << width) - 1), bits >> width, held - width
        if code == 256:
            table, width, previous = [bytes([i]) for i in range(256)] + [b"", b""], 9, None
            continue
        assert table is not None, "no clear code"
        if code == 257:
            break
        assert code < len(table) + (previous is not None), "a code that does not exist yet"
        entry = table[code] if code < len(table) else previous + previous[:1]
        if previous is not None and len(table) < 4096:
            table.append(previous + entry[:1])
            width += len(table) == 1 << width and width < 12
        out += entry
        previous = entry
    assert len(out) == count and at == len(data) and held < 8 and bits == 0, (len(out), count, at, len(data), held)
    return out


def read_gif(data):
    """Returns (width, height, loops, frames). Each frame is (hundredths of a second, RGBA bytes). loops is None without the extension."""
    assert data[:6] == b"GIF89a" and data[-1:] == b"\x3b"
    width, height, flags, _, _ = struct.unpack("<HHBBB", data[6:13])
    assert not flags & 0x80, "a global palette"
    at, frames, loops, control = 13, [], None, None

    def blocks(at):
        joined = b""
        while data[at]:
            joined += data[at + 1:at + 1 + data[at]]
            at += 1 + data[at]
        return joined, at + 1
    while data[at] != 0x3B:
        if data[at] == 0x21 and data[at + 1] == 0xF9:
            control, at = blocks(at + 2)
        elif data[at] == 0x21:
            body, at = blocks(at + 2)
            assert data[at - 1] == 0 and body[:11] == b"NETSCAPE2.0" and body[11] == 1
            loops = struct.unpack("<H", body[12:14])[0]
        else:
            assert data[at] == 0x2C
            x, y, w, h, flags = struct.unpack("<HHHHB", data[at + 1:at + 10])
            assert (x, y, w, h, flags) == (0, 0, width, height, 0x87)
            palette, at = data[at + 10:at + 778], at + 778
            assert data[at] == 8
            body, at = blocks(at + 1)
            how, delay, transparent = struct.unpack("<BHB", control)
            assert how == 9  # the frame is cleared afterwards, and one colour is transparent
            colors = [palette[3 * i:3 * i + 3] + (b"\0" if i == transparent else b"\xff") for i in range(256)]
            colors[transparent] = bytes(4)
            frames.append((delay, b"".join(colors[i] for i in codes(body, w * h))))
            control = None
    assert at == len(data) - 1
    return width, height, loops, frames
