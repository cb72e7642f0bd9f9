// squeeze.c: bytes become deflate blocks that are as small as a second or two of work makes them.
#include "squeeze.h"

#include "deflate_codes.h"

#include <stdbool.h>
#include <string.h>

enum {
    BLOCK = 1 << 17,     // bytes with codes of their own
    HASH_BITS = 15,      // of three bytes
    DEPTH = 200,         // earlier places with the same hash that are tried
    QUICK_DEPTH = 16,    // for an estimate
    MATCHES = 8 * BLOCK, // kept for a block; where there are more, its last places have none
    ROUNDS = 8,          // ways through a block, at most
    UNIT = 32,           // of a price: parts of a bit
    RARE = 13 * UNIT,    // the price of what did not occur
};

#define NONE UINT32_MAX

// A match that could be taken: the nearest of this length.
struct match {
    uint16_t length, distance;
};

struct squeeze {
    const uint8_t *bytes;
    size_t end, row;
    uint32_t last[1 << HASH_BITS];        // the last place with a hash
    uint32_t before[SQUEEZE_WINDOW];      // the place before, of the place modulo the window
    struct match matches[MATCHES];        // of the block's places, one after the other, each longer than the last
    uint32_t first[BLOCK + 1];            // of each place
    uint32_t price[BLOCK + 1];            // of the cheapest way there
    struct match step[BLOCK + 1];         // the last step of that way; length 1: a byte
    struct match way[BLOCK], best[BLOCK]; // the steps in order
    uint32_t literal_price[256], length_price[DEFLATE_LONGEST + 1], distance_price[DISTANCES];
    uint32_t counts[LITERALS], distance_counts[DISTANCES];
};

struct squeeze *squeeze_make(struct arena *arena) { return arena_alloc(arena, sizeof(struct squeeze)); }

size_t squeeze_room(size_t size)
{
    // Each block stored at worst, in pieces of a length that 16 bits tell.
    size_t blocks = size / BLOCK + 1;
    return size + 5 * (size / STORED_MOST + blocks) + 5 + 16;
}

// --- matches

static uint32_t hash_of(const uint8_t *at)
{
    uint32_t three = at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16;
    return three * 0x9e3779b1u >> (32 - HASH_BITS);
}

static void insert(struct squeeze *s, size_t at)
{
    if (at + 3 > s->end)
        return;
    uint32_t *last = &s->last[hash_of(s->bytes + at)];
    s->before[at % SQUEEZE_WINDOW] = *last;
    *last = (uint32_t)at;
}

static uint32_t equal_bytes(const uint8_t *a, const uint8_t *b, uint32_t most)
{
    uint32_t count = 0;
    while (count < most && a[count] == b[count])
        count++;
    return count;
}

// Lists the matches at a place, longer and longer, of at most `most` bytes.
// Returns how many.
static uint32_t find(const struct squeeze *s, size_t at, uint32_t most, int depth, struct match *out, uint32_t room)
{
    uint32_t count = 0, longest = 2;
    if (most < 3)
        return 0;
    const uint8_t *here = s->bytes + at;
    for (uint32_t place = s->last[hash_of(here)], next; place != NONE && depth > 0; place = next, depth--) {
        if (at - place > SQUEEZE_WINDOW)
            break;
        const uint8_t *there = s->bytes + place;
        if (there[longest] == here[longest]) {
            uint32_t length = equal_bytes(here, there, most);
            if (length > longest && count < room) {
                out[count++] = (struct match){(uint16_t)length, (uint16_t)(at - place)};
                longest = length;
                if (length == most)
                    break;
            }
        }
        next = s->before[place % SQUEEZE_WINDOW];
        if (next != NONE && next >= place) // the ring has gone round
            break;
    }
    // In flat areas all places tried lie in the same row, and end where it does.
    if (s->row <= at && s->row <= SQUEEZE_WINDOW && count < room && longest < most) {
        uint32_t length = equal_bytes(here, here - s->row, most);
        if (length > longest)
            out[count++] = (struct match){(uint16_t)length, (uint16_t)s->row};
    }
    return count;
}

// RFC 1951, 3.2.5.
static int distance_symbol(uint32_t distance)
{
    uint32_t before = distance - 1;
    if (before < 4)
        return (int)before;
    uint32_t top = 31 - (uint32_t)__builtin_clz(before);
    return (int)(2 * top + (before >> (top - 1) & 1));
}

// Fills the table of the block that begins at `at`.
static void find_all(struct squeeze *s, size_t at, uint32_t size)
{
    uint32_t total = 0, skipped = 0; // places inside of a longest match are not searched from
    for (uint32_t i = 0; i < size; i++) {
        s->first[i] = total;
        uint32_t most = size - i < DEFLATE_LONGEST ? size - i : DEFLATE_LONGEST;
        if (skipped)
            skipped--;
        else {
            uint32_t count = find(s, at + i, most, DEPTH, s->matches + total, MATCHES - total);
            total += count;
            if (count && s->matches[total - 1].length == DEFLATE_LONGEST)
                skipped = DEFLATE_LONGEST - 1;
        }
        insert(s, at + i);
    }
    s->first[size] = total;
}

// --- prices

// log2 of a count in UNITs, rounded down: the fraction by squaring, bit by bit.
static uint32_t logarithm(uint32_t count)
{
    uint32_t whole = 31 - (uint32_t)__builtin_clz(count), units = whole * UNIT;
    uint64_t x = (uint64_t)count << (31 - whole); // 1 … 2 as 2^31 … 2^32
    for (uint32_t bit = UNIT / 2; bit; bit /= 2) {
        x = x * x >> 31;
        if (x >> 32) {
            x >>= 1;
            units += bit;
        }
    }
    return units;
}

static uint32_t price_of(uint32_t count, uint32_t total)
{
    return count ? total - logarithm(count) + 1 : total < RARE ? RARE : total;
}

static void set_prices(struct squeeze *s)
{
    uint32_t all = 0, distances = 0;
    for (int i = 0; i < LITERALS; i++)
        all += s->counts[i];
    for (int i = 0; i < DISTANCES; i++)
        distances += s->distance_counts[i];
    uint32_t of_all = logarithm(all), of_distances = logarithm(distances ? distances : 1);
    for (int i = 0; i < 256; i++)
        s->literal_price[i] = price_of(s->counts[i], of_all);
    for (unsigned length = DEFLATE_SHORTEST; length <= DEFLATE_LONGEST; length++) {
        unsigned extra, symbol = length_symbol(length, &extra);
        s->length_price[length] = price_of(s->counts[symbol], of_all) + extra * UNIT;
    }
    for (int i = 0; i < DISTANCES; i++)
        s->distance_price[i] = price_of(s->distance_counts[i], of_distances) + distance_extra(i) * UNIT;
}

static void count_step(struct squeeze *s, uint8_t byte, struct match step)
{
    unsigned extra;
    if (step.length == 1) {
        s->counts[byte]++;
        return;
    }
    s->counts[length_symbol(step.length, &extra)]++;
    s->distance_counts[distance_symbol(step.distance)]++;
}

static void clear_counts(struct squeeze *s)
{
    memset(s->counts, 0, sizeof s->counts);
    memset(s->distance_counts, 0, sizeof s->distance_counts);
    s->counts[END_OF_BLOCK] = 1;
}

// --- ways

// The longest match at every place, for the first prices.
static void go_greedily(struct squeeze *s, size_t at, uint32_t size)
{
    clear_counts(s);
    for (uint32_t i = 0; i < size;) {
        struct match step = {1, 0};
        if (s->first[i + 1] > s->first[i] && s->matches[s->first[i + 1] - 1].length > 3)
            step = s->matches[s->first[i + 1] - 1];
        count_step(s, s->bytes[at + i], step);
        i += step.length;
    }
}

static inline void offer(struct squeeze *s, uint32_t to, uint32_t price, struct match step)
{
    if (price < s->price[to]) {
        s->price[to] = price;
        s->step[to] = step;
    }
}

// The cheapest way at the current prices: its steps into `way`, what they are made of into the counts.
// Returns how many steps.
static uint32_t go_cheaply(struct squeeze *s, size_t at, uint32_t size)
{
    memset(s->price, 0xff, (size + 1) * sizeof *s->price);
    s->price[0] = 0;
    for (uint32_t i = 0; i < size; i++) {
        uint32_t here = s->price[i], shorter = 2;
        offer(s, i + 1, here + s->literal_price[s->bytes[at + i]], (struct match){1, 0});
        for (uint32_t m = s->first[i]; m < s->first[i + 1]; m++) {
            struct match match = s->matches[m];
            uint32_t far = here + s->distance_price[distance_symbol(match.distance)];
            for (uint32_t length = shorter + 1; length <= match.length; length++)
                offer(s, i + length, far + s->length_price[length], (struct match){(uint16_t)length, match.distance});
            shorter = match.length;
        }
    }
    uint32_t steps = 0;
    for (uint32_t i = size; i > 0; i -= s->step[i].length)
        steps++;
    for (uint32_t i = size, k = steps; i > 0; i -= s->step[i].length)
        s->way[--k] = s->step[i];
    clear_counts(s);
    for (uint32_t k = 0, i = 0; k < steps; i += s->way[k++].length)
        count_step(s, s->bytes[at + i], s->way[k]);
    return steps;
}

static void make_codes(const struct squeeze *s, struct codes *codes)
{
    uint64_t extra_bits = 0;
    for (unsigned symbol = FIRST_LENGTH + 8; symbol < FIRST_LENGTH + 28; symbol++)
        extra_bits += (uint64_t)s->counts[symbol] * ((symbol - FIRST_LENGTH) / 4 - 1);
    codes_make(codes, s->counts, s->distance_counts, extra_bits);
}

static uint8_t *put_block(const struct squeeze *s, const struct codes *codes, size_t at, uint32_t steps,
                          struct bits *bits)
{
    put_codes(bits, codes);
    for (uint32_t k = 0; k < steps; at += s->best[k++].length) {
        struct match step = s->best[k];
        if (step.length == 1) {
            put(bits, codes->code[s->bytes[at]], codes->length[s->bytes[at]]);
            continue;
        }
        unsigned extra, symbol = length_symbol(step.length, &extra);
        put(bits, codes->code[symbol], codes->length[symbol]);
        put(bits, (step.length - DEFLATE_SHORTEST) & ((1u << extra) - 1), extra);
        int far = distance_symbol(step.distance);
        put(bits, codes->distance_code[far], codes->distance_length[far]);
        put(bits, (step.distance - 1) & ((1u << distance_extra(far)) - 1), distance_extra(far));
    }
    put(bits, codes->code[END_OF_BLOCK], codes->length[END_OF_BLOCK]);
    return bits->at;
}

static void put_stored(struct bits *bits, const uint8_t *bytes, size_t size)
{
    while (size) {
        size_t n = size < STORED_MOST ? size : STORED_MOST;
        put(bits, 0, 3);
        if (bits->count)
            put(bits, 0, 8 - bits->count);
        put(bits, n | (~n & 0xffff) << 16, 32);
        memcpy(bits->at, bytes, n);
        bits->at += n;
        bytes += n;
        size -= n;
    }
}

static void squeeze_block(struct squeeze *s, size_t at, uint32_t size, struct bits *bits)
{
    struct codes least = {.bits = UINT64_MAX}, codes;
    uint32_t least_steps = 0;
    find_all(s, at, size);
    go_greedily(s, at, size);
    for (int round = 0; round < ROUNDS; round++) {
        set_prices(s);
        uint32_t steps = go_cheaply(s, at, size);
        make_codes(s, &codes);
        if (codes.bits >= least.bits)
            break;
        least = codes;
        least_steps = steps;
        memcpy(s->best, s->way, steps * sizeof *s->best);
    }
    if (least.bits / 8 < size + 5)
        put_block(s, &least, at, least_steps, bits);
    else
        put_stored(bits, s->bytes + at, size);
}

static void start(struct squeeze *s, const uint8_t *bytes, size_t before, size_t size, size_t row)
{
    s->bytes = bytes;
    s->row = row;
    s->end = before + size;
    memset(s->last, 0xff, sizeof s->last);
    for (size_t i = before > SQUEEZE_WINDOW ? before - SQUEEZE_WINDOW : 0; i < before; i++)
        insert(s, i);
}

size_t squeeze(struct squeeze *s, const uint8_t *bytes, size_t before, size_t size, size_t row, uint8_t *out)
{
    struct bits bits = {.at = out};
    start(s, bytes, before, size, row);
    for (size_t done = 0; done < size; done += BLOCK)
        squeeze_block(s, before + done, size - done < BLOCK ? (uint32_t)(size - done) : BLOCK, &bits);
    return (size_t)(put_boundary(&bits) - out);
}

// The nearest matches are taken as they come, and counted.
uint64_t squeeze_estimate(struct squeeze *s, const uint8_t *bytes, size_t size, size_t row)
{
    struct codes codes;
    uint64_t bits = 0;
    start(s, bytes, 0, size, row);
    for (size_t at = 0; at < size;) {
        size_t end = size - at < BLOCK ? size : at + BLOCK;
        clear_counts(s);
        while (at < end) {
            struct match found[16], step = {1, 0};
            uint32_t most = end - at < DEFLATE_LONGEST ? (uint32_t)(end - at) : DEFLATE_LONGEST;
            uint32_t count = find(s, at, most, QUICK_DEPTH, found, 16);
            if (count &&
                (found[count - 1].length > 4 || (found[count - 1].length > 3 && found[count - 1].distance < 1024)))
                step = found[count - 1];
            count_step(s, bytes[at], step);
            for (size_t next = at + step.length; at < next; at++)
                insert(s, at);
        }
        make_codes(s, &codes);
        bits += codes.bits;
    }
    return bits;
}
