// xxh64.c: computes XXH64 with the seed 0, as specified by Yann Collet (xxHash fast digest algorithm, version 0.1.1).
// Four lanes consume 8 bytes each, in turn, and are merged at the end. The hash is not cryptographic: it detects
// changes, but not attacks.
#include "xxh64.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/path.h>

static const uint64_t prime1 = 0x9E3779B185EBCA87u, prime2 = 0xC2B2AE3D27D4EB4Fu, prime3 = 0x165667B19E3779F9u,
                      prime4 = 0x85EBCA77C2B2AE63u, prime5 = 0x27D4EB2F165667C5u;

enum { STRIPE = 32, CHUNK = 32 << 10 };

static uint64_t rotate(uint64_t x, int bits) { return x << bits | x >> (64 - bits); }

// Numbers are little-endian in the specification.
static uint64_t read_number(const unsigned char *at, int bytes)
{
    uint64_t number = 0;
    for (int i = 0; i < bytes; i++)
        number |= (uint64_t)at[i] << (8 * i);
    return number;
}

static uint64_t lane_round(uint64_t lane, uint64_t input) { return rotate(lane + input * prime2, 31) * prime1; }

static void add_stripe(struct xxh64 *hash, const unsigned char *at)
{
    for (int i = 0; i < 4; i++)
        hash->lanes[i] = lane_round(hash->lanes[i], read_number(at + 8 * i, 8));
}

void xxh64_start(struct xxh64 *hash) { *hash = (struct xxh64){.lanes = {prime1 + prime2, prime2, 0, 0 - prime1}}; }

void xxh64_add(struct xxh64 *hash, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    size_t held = hash->size % STRIPE;
    hash->size += size;
    if (held) {
        size_t take = STRIPE - held < size ? STRIPE - held : size;
        memcpy(hash->rest + held, at, take);
        at += take;
        size -= take;
        if (held + take < STRIPE)
            return;
        add_stripe(hash, hash->rest);
    }
    for (; size >= STRIPE; at += STRIPE, size -= STRIPE)
        add_stripe(hash, at);
    if (size)
        memcpy(hash->rest, at, size);
}

void xxh64_add_text(struct xxh64 *hash, const char *text)
{
    xxh64_add(hash, text ? text : "\1", text ? strlen(text) + 1 : 1);
}

uint64_t xxh64_end(const struct xxh64 *hash)
{
    uint64_t sum = prime5;
    if (hash->size >= STRIPE) {
        const uint64_t *lane = hash->lanes;
        sum = rotate(lane[0], 1) + rotate(lane[1], 7) + rotate(lane[2], 12) + rotate(lane[3], 18);
        for (int i = 0; i < 4; i++)
            sum = (sum ^ lane_round(0, lane[i])) * prime1 + prime4;
    }
    sum += hash->size;
    const unsigned char *at = hash->rest;
    size_t left = hash->size % STRIPE;
    for (; left >= 8; at += 8, left -= 8)
        sum = rotate(sum ^ lane_round(0, read_number(at, 8)), 27) * prime1 + prime4;
    if (left >= 4) {
        sum = rotate(sum ^ read_number(at, 4) * prime1, 23) * prime2 + prime3;
        at += 4;
        left -= 4;
    }
    for (; left; at++, left--)
        sum = rotate(sum ^ *at * prime5, 11) * prime1;
    sum = (sum ^ sum >> 33) * prime2;
    sum = (sum ^ sum >> 29) * prime3;
    return sum ^ sum >> 32;
}

uint64_t xxh64_of(const void *bytes, size_t size)
{
    struct xxh64 hash;
    xxh64_start(&hash);
    xxh64_add(&hash, bytes, size);
    return xxh64_end(&hash);
}

bool xxh64_file(const char *path, uint64_t *hash)
{
    unsigned char chunk[CHUNK];
    struct stat about;
    if (lam_path_stat(path, &about) != 0)
        return false;
    if (!S_ISREG(about.st_mode)) {
        errno = EINVAL;
        return false;
    }
    int file = lam_path_open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (file < 0)
        return false;
    struct xxh64 sum;
    xxh64_start(&sum);
    ssize_t got;
    while ((got = read(file, chunk, sizeof chunk)) > 0 || (got < 0 && errno == EINTR))
        xxh64_add(&sum, chunk, got > 0 ? (size_t)got : 0);
    int reason = errno;
    close(file);
    errno = reason;
    *hash = xxh64_end(&sum);
    return got == 0;
}

void xxh64_print(uint64_t hash, char text[XXH64_TEXT]) { snprintf(text, XXH64_TEXT, "xxh64:%016" PRIx64, hash); }

bool xxh64_parse(const char *text, uint64_t *hash)
{
    static const char before[] = "xxh64:";
    if (!text || strncmp(text, before, sizeof before - 1) != 0)
        return false;
    text += sizeof before - 1;
    *hash = strtoull(text, NULL, 16);
    return strlen(text) == 16 && strspn(text, "0123456789abcdef") == 16;
}
