// reading.c: prints the milliseconds that other programs need to read a model file once from the page cache:
//     reading assimp FILE   Assimp reads the file without post-processing, with its own positions and indices
//     reading touch FILE    the file is mapped, and one thread reads every cache line; no reader with
//                           one thread is faster
//     reading copy FILE     two threads read() the file into new memory; no reader that keeps a copy is faster
// A process reads the file once, like a program that draws one picture.
#include <assimp/cimport.h>
#include <assimp/scene.h>

#include <fcntl.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static int fail(const char *path, const char *why)
{
    fprintf(stderr, "reading: %s: %s\n", path, why);
    return 1;
}

struct half {
    int file;
    unsigned char *to;
    off_t from;
    size_t size;
    int failed;
};

static void *copy_half(void *user)
{
    struct half *half = user;
    while (half->size) {
        ssize_t got = pread(half->file, half->to, half->size, half->from);
        if (got <= 0) {
            half->failed = 1;
            break;
        }
        half->to += got, half->from += got, half->size -= (size_t)got;
    }
    return NULL;
}

static int copy(const char *path, int file, size_t size)
{
    unsigned char *to = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (to == MAP_FAILED)
        return fail(path, "no memory");
    madvise(to, size, MADV_HUGEPAGE);
    size_t middle = size / 2 >> 21 << 21; // each huge page belongs to one thread
    struct half lower = {file, to, 0, middle, 0}, upper = {file, to + middle, (off_t)middle, size - middle, 0};
    pthread_t thread;
    if (pthread_create(&thread, NULL, copy_half, &upper) != 0)
        return fail(path, "no thread");
    copy_half(&lower);
    pthread_join(thread, NULL);
    return lower.failed || upper.failed ? fail(path, "cannot be read") : 0;
}

static int touch(const char *path, int file, size_t size)
{
    const unsigned char *bytes = mmap(NULL, size, PROT_READ, MAP_PRIVATE, file, 0);
    if (bytes == MAP_FAILED)
        return fail(path, "cannot be mapped");
    volatile uint64_t sink = 0;
    uint64_t sum = 0;
    for (size_t i = 0; i < size; i += 64)
        sum += bytes[i];
    sink = sum;
    (void)sink;
    return 0;
}

static int assimp(const char *path)
{
    const struct aiScene *scene = aiImportFile(path, 0);
    if (!scene)
        return fail(path, aiGetErrorString());
    size_t faces = 0;
    for (unsigned i = 0; i < scene->mNumMeshes; i++)
        faces += scene->mMeshes[i]->mNumFaces;
    return faces ? 0 : fail(path, "Assimp found no face");
}

int main(int count, char **arguments)
{
    if (count != 3)
        return fail("usage", "reading assimp|touch|copy FILE");
    const char *path = arguments[2];
    double start = now_ms();
    int bad;
    if (strcmp(arguments[1], "assimp") == 0) {
        bad = assimp(path);
    } else {
        int file = open(path, O_RDONLY);
        struct stat status;
        if (file < 0 || fstat(file, &status) != 0 || status.st_size < 1)
            return fail(path, "cannot be opened, or is empty");
        bad = (strcmp(arguments[1], "copy") == 0 ? copy : touch)(path, file, (size_t)status.st_size);
    }
    if (bad)
        return 1;
    printf("%.4f\n", now_ms() - start);
    fflush(stdout);
    _exit(0); // the time for freeing the memory is not measured
}
