// xxh64.h: computes XXH64, the hash that journals store for pictures, models and everything that determines a picture.
// `xxh64sum` prints the same hashes.
#ifndef XXH64_H
#define XXH64_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct xxh64 {
    uint64_t lanes[4], size;
    unsigned char rest[32]; // bytes of an incomplete stripe: size % 32
};

void xxh64_start(struct xxh64 *hash);
void xxh64_add(struct xxh64 *hash, const void *bytes, size_t size);
void xxh64_add_text(struct xxh64 *hash,
                    const char *text); // also hashes the terminating zero; for NULL, hashes one byte
                                       // with the value 1
uint64_t xxh64_end(const struct xxh64 *hash);

// Hashes a block of bytes.
uint64_t xxh64_of(const void *bytes, size_t size);

// Hashes the bytes of a file. Returns false and sets errno if the file cannot be read or is not a regular file.
bool xxh64_file(const char *path, uint64_t *hash);

// xxh64_print writes a hash in the form "xxh64:0123456789abcdef". xxh64_parse reads this form, and returns false for
// any other text.
enum { XXH64_TEXT = 24 };
void xxh64_print(uint64_t hash, char text[XXH64_TEXT]);
bool xxh64_parse(const char *text, uint64_t *hash);

#endif
