#!/usr/bin/env python3
"""light_patterns.py: how well N points of a light's disc stand for the whole, pixel by pixel, in the penumbra of a straight edge.

The share of the disc behind the edge is known exactly. Printed for 16 and 32 points: the root mean square error of a pixel (grain), and that
after a Gaussian blur of one pixel, as an eye sees it that does not resolve pixels: neighbours that err alike are seen as blotches. The first row
is what src/rays/light_pattern.h does."""
import math
import random

SIDE, ANGLES, GOLDEN = 48, 8, 2.39996322972865332


def gradient_noise(x, y):
    part = (x * 0x112e0be8 + y * 0x017e8cd9) & 0xffffffff
    return (part * 3472289 >> 16 & 0xffffffff) / 2.0 ** 32


def lattice_noise(x, y):
    return (x * 0.7548776662466927 + y * 0.5698402909980532) % 1


def white_noise(x, y):
    return random.Random(x * 65537 + y).random()


def vogel(count, turn, radial=None):
    def points(x, y):
        shift = radial(x, y) if radial else 0.5
        for i in range(count):
            radius, angle = math.sqrt((i + shift) / count), GOLDEN * i + 2 * math.pi * turn(x, y)
            yield radius * math.cos(angle), radius * math.sin(angle)
    return points


def shifted_lattice(count, first, second):
    """Fibonacci's lattice in the square, shifted by the pixel (Cranley and Patterson), and mapped to the disc by Shirley's map."""
    def points(x, y):
        for i in range(count):
            a, b = 2 * ((i / count + first(x, y)) % 1) - 1, 2 * ((i * 0.6180339887498949 + second(x, y)) % 1) - 1
            if a == b == 0:
                yield 0, 0
                continue
            radius, angle = (a, math.pi / 4 * b / a) if abs(a) > abs(b) else (b, math.pi / 2 - math.pi / 4 * a / b)
            yield radius * math.cos(angle), radius * math.sin(angle)
    return points


def blurred(errors):
    weights = [math.exp(-d * d / 2) for d in range(-3, 4)]
    total = sum(weights)

    def along(rows):
        return [[sum(w * row[(i + d) % SIDE] for w, d in zip(weights, range(-3, 4))) / total for i in range(SIDE)] for row in rows]
    return list(zip(*along(list(zip(*along(errors))))))


def measure(points):
    squares, blurred_squares, pixels = 0, 0, 0
    discs = [[list(points(x, y)) for x in range(SIDE)] for y in range(SIDE)]
    for k in range(ANGLES):
        angle = math.pi * (k + 0.3) / ANGLES
        c, s = math.cos(angle), math.sin(angle)
        across = [[((x - SIDE / 2) * c + (y - SIDE / 2) * s) / (0.75 * SIDE) for x in range(SIDE)] for y in range(SIDE)]
        errors = [[sum(u * c + v * s < t for u, v in disc) / len(disc) - 0.5 - (t * math.sqrt(1 - t * t) + math.asin(t)) / math.pi
                   for disc, t in zip(discs[y], across[y])] for y in range(SIDE)]
        smooth = blurred(errors)
        for y in range(4, SIDE - 4):
            for x in range(4, SIDE - 4):
                squares, blurred_squares, pixels = squares + errors[y][x] ** 2, blurred_squares + smooth[y][x] ** 2, pixels + 1
    return math.sqrt(squares / pixels), math.sqrt(blurred_squares / pixels)


def main():
    for count in (16, 32):
        for name, points in (("spiral, turned by gradient noise", vogel(count, gradient_noise)),
                             ("spiral, turned by a lattice (R2)", vogel(count, lattice_noise)),
                             ("spiral, turned by white noise", vogel(count, white_noise)),
                             ("spiral, turned and moved outward", vogel(count, gradient_noise, lattice_noise)),
                             ("Fibonacci lattice, shifted", shifted_lattice(count, gradient_noise, lattice_noise))):
            print("%2d points  %-34s  error %.4f  blurred %.4f" % (count, name, *measure(points)), flush=True)


if __name__ == "__main__":
    main()
