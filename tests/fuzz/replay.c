// replay.c: runs a corpus through a fuzz target in the normal test run, without libFuzzer.
//
// The target gets every file of the folder CORPUS unchanged, truncated after each of its bytes, and in CHANGES
// mutations, the same in every run; a target with its own mutator (mutate.h) makes half of them. An input that crashes
// the program is saved in the current folder as "fuzz-failure". A target may add a file of its own (fuzz_seed), and
// then needs no folder. Called with a number, the program makes that many mutations of each file; a second number
// selects others.
#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef CORPUS // for a call by hand, from the root of the sources
#define CORPUS "tests/fuzz/corpus/obj"
#endif

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t capacity);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t capacity, unsigned seed) __attribute__((weak));
size_t fuzz_seed(uint8_t *data, size_t capacity) __attribute__((weak)); // 0: none
void __sanitizer_set_death_callback(void (*callback)(void)) __attribute__((weak));

enum {
    SEEDS_MAX = 64,
    SEED_BYTES = 16384,
#ifndef CHANGES     // fewer for slow targets
    CHANGES = 2000, // mutations of each file
#endif
    CUTS_MAX = CHANGES / 4 * 3, // truncations of a longer file
};

static struct seed {
    uint8_t bytes[SEED_BYTES];
    size_t size;
} seeds[SEEDS_MAX];
static int seed_count;

static const uint8_t *running;
static size_t running_size;

static void leave_input(void)
{
    int file = open("fuzz-failure", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0 || (running && write(file, running, running_size) < 0))
        return;
    close(file);
}

static void die(int number)
{
    leave_input();
    signal(number, SIG_DFL);
    raise(number);
}

// The input is in a block of exactly its size: a sanitizer detects every read beyond it.
static void run(const uint8_t *bytes, size_t size)
{
    uint8_t *copy = malloc(size + (size == 0));
    if (!copy)
        abort();
    memcpy(copy, bytes, size);
    running = copy;
    running_size = size;
    LLVMFuzzerTestOneInput(copy, size);
    running = NULL; // leaks are detected at the end, when no input runs
    running_size = 0;
    free(copy);
}

static uint32_t below(uint64_t *random, uint32_t limit)
{
    *random = *random * 6364136223846793005u + 1442695040888963407u;
    return limit ? (uint32_t)(*random >> 33) % limit : 0;
}

// Replaces bytes [at, at + removed) by `piece`, as far as the capacity allows.
static void put_in_place(struct seed *seed, size_t at, size_t removed, const uint8_t *piece, size_t length)
{
    if (at > seed->size || removed > seed->size - at || seed->size - removed + length > SEED_BYTES)
        return;
    memmove(seed->bytes + at + length, seed->bytes + at + removed, seed->size - at - removed);
    memcpy(seed->bytes + at, piece, length);
    seed->size += length - removed;
}

static void change(struct seed *seed, uint64_t *random)
{
    static const char *const words[] = {
        "-1", "0",    "4294967295", "4294967296", "99999999999999999999", "1e999", "-1e-999", "nan", " ",
        "\n", "\\\n", "\r",         "/",          "\xff\xff\xff\xff",     "\x80",  "0.1",     "inf"};
    uint32_t size = (uint32_t)seed->size;
    uint8_t piece[64];
    const struct seed *other = &seeds[below(random, (uint32_t)seed_count)];
    size_t at = below(random, size), length = 1 + below(random, sizeof piece - 1), from = 0;
    switch (below(random, 7)) {
    case 0: // a bit
        if (size)
            seed->bytes[at] ^= (uint8_t)(1 << below(random, 8));
        break;
    case 1: // a byte at a border of its range
        if (size)
            seed->bytes[at] = (uint8_t[]){0, 1, 127, 128, 255}[below(random, 5)];
        break;
    case 2: // a truncated end
        seed->size = at;
        break;
    case 3: // an omitted run
        put_in_place(seed, at, length, piece, 0);
        break;
    case 4: { // an inserted word
        const char *word = words[below(random, sizeof words / sizeof *words)];
        put_in_place(seed, at, below(random, 2) * strlen(word), (const uint8_t *)word, strlen(word));
        break;
    }
    default: // a piece of another file, or of this one
        from = below(random, (uint32_t)other->size);
        length = length < other->size - from ? length : other->size - from;
        memcpy(piece, other->bytes + from, length);
        put_in_place(seed, at, below(random, 2) * length, piece, length);
    }
}

// The change of a part of a file by a target's own mutator.
static uint64_t part_random = 2;

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t capacity)
{
    static struct seed part;
    part.size = size < SEED_BYTES ? size : SEED_BYTES;
    if (part.size)
        memcpy(part.bytes, data, part.size);
    change(&part, &part_random);
    size = part.size < capacity ? part.size : capacity;
    if (size)
        memcpy(data, part.bytes, size);
    return size;
}

static int by_name(const struct dirent **a, const struct dirent **b) { return strcmp((*a)->d_name, (*b)->d_name); }

int main(int word_count, char **words)
{
    const long changes = word_count > 1 ? atol(words[1]) : CHANGES;
    struct dirent **names;
    int count = scandir(CORPUS, &names, NULL, by_name);
    for (int i = 0; i < count; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", CORPUS, names[i]->d_name);
        FILE *file = names[i]->d_name[0] == '.' ? NULL : fopen(path, "rb");
        free(names[i]);
        if (!file)
            continue;
        if (seed_count == SEEDS_MAX) {
            fprintf(stderr, "%s holds more than %d files\n", CORPUS, SEEDS_MAX);
            return 1;
        }
        struct seed *seed = &seeds[seed_count++];
        seed->size = fread(seed->bytes, 1, SEED_BYTES, file);
        if (fgetc(file) != EOF) {
            fprintf(stderr, "%s is longer than %d bytes\n", path, SEED_BYTES);
            return 1;
        }
        fclose(file);
    }
    if (count >= 0)
        free(names);
    if (fuzz_seed && seed_count < SEEDS_MAX)
        seed_count += (seeds[seed_count].size = fuzz_seed(seeds[seed_count].bytes, SEED_BYTES)) > 0;
    if (seed_count == 0) {
        fprintf(stderr, "no files in %s\n", CORPUS);
        return 1;
    }

    if (__sanitizer_set_death_callback)
        __sanitizer_set_death_callback(leave_input);
    signal(SIGABRT, die);
    signal(SIGSEGV, die);
    signal(SIGFPE, die);
    uint64_t random = word_count > 2 ? strtoull(words[2], NULL, 10) : 1;
    size_t runs = 0;
    for (int i = 0; i < seed_count; i++) {
        const struct seed *seed = &seeds[i];
        size_t step = seed->size / CUTS_MAX + 1;
        for (size_t size = 0; size < seed->size; size += step, runs++)
            run(seed->bytes, size);
        run(seed->bytes, seed->size);
        for (long c = 0; c < changes; c++, runs++) {
            static struct seed changed;
            changed = *seed;
            for (uint32_t n = 1 + below(&random, 4); n > 0; n--) {
                if (LLVMFuzzerCustomMutator && c % 2)
                    changed.size =
                        LLVMFuzzerCustomMutator(changed.bytes, changed.size, SEED_BYTES, below(&random, 1u << 31));
                else
                    change(&changed, &random);
            }
            run(changed.bytes, changed.size);
        }
    }
    printf("ok 1 - %zu inputs from %d files\n", runs + (size_t)seed_count, seed_count);
    return 0;
}
