// checksum.c: computes CRC-32 with eight tables, and Adler-32 of pixel rows in 16-bit lanes.
#include "checksum.h"

#include <string.h>

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "the picture codecs read pixels as little-endian words"
#endif

enum { ADLER_MODULUS = 65521 };

void crc_tables_make(struct crc_tables *tables)
{
    for (uint32_t byte = 0; byte < 256; byte++) {
        uint32_t crc = byte;
        for (int bit = 0; bit < 8; bit++)
            crc = (crc >> 1) ^ (0xEDB88320u & (0u - (crc & 1)));
        tables->row[0][byte] = crc;
    }
    // Row k contains the CRC of a byte followed by k zero bytes.
    for (int k = 1; k < 8; k++)
        for (int byte = 0; byte < 256; byte++) {
            uint32_t crc = tables->row[k - 1][byte];
            tables->row[k][byte] = (crc >> 8) ^ tables->row[0][crc & 255];
        }
}

uint32_t crc_of(const struct crc_tables *tables, const uint8_t *bytes, size_t size)
{
    const uint32_t(*row)[256] = tables->row;
    uint32_t crc = 0xFFFFFFFFu;
    for (; size >= 8; size -= 8, bytes += 8) {
        uint64_t word;
        memcpy(&word, bytes, 8);
        word ^= crc;
        crc = row[7][word & 255] ^ row[6][word >> 8 & 255] ^ row[5][word >> 16 & 255] ^ row[4][word >> 24 & 255] ^
              row[3][word >> 32 & 255] ^ row[2][word >> 40 & 255] ^ row[1][word >> 48 & 255] ^ row[0][word >> 56];
    }
    for (; size > 0; size--, bytes++)
        crc = (crc >> 8) ^ row[0][(crc ^ *bytes) & 255];
    return ~crc;
}

void adler_byte(struct adler_part *part, uint8_t byte)
{
    struct adler_part next = {byte, byte, 1};
    adler_join(part, &next);
}

void adler_bytes(struct adler_part *part, const uint8_t *bytes, size_t size)
{
    uint64_t sum = 0, weighted = 0;
    for (size_t i = 0; i < size; i++) {
        sum += bytes[i];
        weighted += sum;
    }
    struct adler_part next = {(uint32_t)(sum % ADLER_MODULUS), (uint32_t)(weighted % ADLER_MODULUS), size};
    adler_join(part, &next);
}

void adler_zeros(struct adler_part *part, uint64_t count)
{
    struct adler_part next = {0, 0, count};
    adler_join(part, &next);
}

void adler_join(struct adler_part *part, const struct adler_part *next)
{
    // Joining the sequences increases the weight of every byte of `part` by next->size.
    uint64_t follow = next->size % ADLER_MODULUS * part->sum;
    part->weighted = (uint32_t)((part->weighted + follow + next->weighted) % ADLER_MODULUS);
    part->sum = (part->sum + next->sum) % ADLER_MODULUS;
    part->size += next->size;
}

uint32_t adler_value(const struct adler_part *part)
{
    uint32_t low = (1 + part->sum) % ADLER_MODULUS;
    uint32_t high = (uint32_t)((part->size + part->weighted) % ADLER_MODULUS);
    return high << 16 | low;
}

typedef uint16_t u16x8 __attribute__((vector_size(16)));
typedef uint16_t u16x8_memory __attribute__((vector_size(16), aligned(4), may_alias));

// Four pixels form a vector of eight 16-bit lanes, each with an even and an odd byte. Over a block of vectors j = 0 …
// n−1, two sums are computed per lane: Σ x and Σ (n−1−j)·x. Before each step, the first sum is added to the second. The
// position of a byte is first + j·stride + its offset in the vector, so Σ position·x follows from both sums. With at
// most 22 vectors the second sum stays below 65536:
//  255·22·21/2 = 58905
void adler_row(struct adler_part *part, const uint32_t *row, int width, int bytes_per_pixel)
{
    enum { BLOCK = 22 };
    const int vectors = (width + 3) / 4, stride = 4 * bytes_per_pixel;
    uint64_t sum = 0, positions = 0; // Σ byte, Σ position·byte; below 2²⁷ and 2⁴⁵ for the widest row
    for (int first = 0; first < vectors; first += BLOCK) {
        int n = vectors - first < BLOCK ? vectors - first : BLOCK;
        u16x8 even = {0}, odd = {0}, even_before = {0}, odd_before = {0};
        for (int j = 0; j < n; j++) {
            u16x8 pair = (u16x8)((const u16x8_memory *)row)[first + j];
            even_before += even;
            odd_before += odd;
            even += pair & 255;
            odd += pair >> 8;
        }
        uint32_t total = 0, before = 0, offsets = 0;
        for (int lane = 0; lane < 8; lane++) {
            uint32_t offset = (uint32_t)(lane / 2 * bytes_per_pixel + lane % 2 * 2);
            total += (uint32_t)even[lane] + odd[lane];
            before += (uint32_t)even_before[lane] + odd_before[lane];
            offsets += offset * even[lane] + (offset + 1) * odd[lane];
        }
        sum += total;
        positions += (uint64_t)stride * ((uint64_t)(first + n - 1) * total - before) + offsets;
    }
    uint64_t size = (uint64_t)width * (unsigned)bytes_per_pixel;
    struct adler_part next = {(uint32_t)(sum % ADLER_MODULUS), (uint32_t)((size * sum - positions) % ADLER_MODULUS),
                              size};
    adler_join(part, &next);
}
