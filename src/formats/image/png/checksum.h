// checksum.h: computes CRC-32 and Adler-32, as PNG and zlib define them.
#ifndef CHECKSUM_H
#define CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

// Tables for computing the CRC-32 of eight bytes at a time (8 KiB). Because the library keeps no global state, the
// tables are computed for each encoding, which takes about a microsecond.
struct crc_tables {
    uint32_t row[8][256];
};

void crc_tables_make(struct crc_tables *tables);

// Returns the CRC-32 (polynomial 0xEDB88320 reflected, PNG specification annex D) of `size` bytes.
uint32_t crc_of(const struct crc_tables *tables, const uint8_t *bytes, size_t size);

// The Adler-32 checksum of a sequence of bytes, in a form that allows joining adjacent sequences from different
// threads. Both sums are modulo 65521:
//  sum      = Σ byte
//  weighted = Σ (size − position)·byte
struct adler_part {
    uint32_t sum, weighted;
    uint64_t size;
};

// These functions append bytes to the sequence `part`: one byte, several bytes, `count` zeros, a row of pixels, or the
// bytes of the sequence `next`.
//
// A row consists of `width` 32-bit words. The first `bytes_per_pixel` bytes (1 … 4) of a word are in the stream, and
// the other bytes of the word must be zero. The words after the row, up to a multiple of 4, must also be zero.
void adler_byte(struct adler_part *part, uint8_t byte);
void adler_bytes(struct adler_part *part, const uint8_t *bytes, size_t size);
void adler_zeros(struct adler_part *part, uint64_t count);
void adler_row(struct adler_part *part, const uint32_t *row, int width, int bytes_per_pixel);
void adler_join(struct adler_part *part, const struct adler_part *next);

// Returns the checksum as zlib stores it (RFC 1950).
uint32_t adler_value(const struct adler_part *part);

#endif
