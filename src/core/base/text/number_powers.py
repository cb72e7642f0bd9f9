#!/usr/bin/env python3
"""Writes number_powers.h: the powers of five that number.c multiplies by, computed with exact integers.

Each power 5^q is scaled by a power of two into [2^127, 2^128) and cut to 128 bits, for q from FIRST to LAST. From -27 to
-1, where a quotient by 5^-q may be exact, it is rounded up instead: see Lemire, "Number Parsing at a Gigabyte per
Second" (2021), section 5.
"""
import sys

FIRST, LAST = -342, 308


def scaled_power(q):
    if q >= 0:
        value = 5**q
        shift = value.bit_length() - 128
        return value >> shift if shift > 0 else value << -shift
    divisor = 5**-q
    bits = divisor.bit_length() + 127  # 2^bits / divisor lies in (2^127, 2^128): no power of five but 1 is one of two
    quotient = 2**bits // divisor
    return quotient + 1 if q >= -27 else quotient


with open(sys.argv[1], "w", encoding="ascii") as out:
    out.write("// Made by number_powers.py: 5^q as 128 bits, the high half first.\n")
    out.write(f"enum {{ POWER_FIRST = {FIRST}, POWER_LAST = {LAST} }};\n")
    out.write("static const uint64_t powers_of_five[][2] = {\n")
    for q in range(FIRST, LAST + 1):
        value = scaled_power(q)
        assert value.bit_length() == 128
        out.write(f"    {{0x{value >> 64:016x}u, 0x{value & (2**64 - 1):016x}u}}, // {q}\n")
    out.write("};\n")
