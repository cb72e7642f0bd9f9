// memory.c: prints the speed of this machine's memory as JSON, in GB/s. These speeds limit all reading and writing of
// data. "read" is the sum of 128 MiB per thread. "copy" is a memcpy of 128 MiB per thread to mapped memory; each copied
// byte counts once. "first_touch" writes one byte into every page of new memory, and counts all bytes of the pages. It
// is measured with pages of 4 KiB and of 2 MiB. Each value is measured with one thread and with two threads.
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>

enum { THREADS_MOST = 2, ROUNDS = 7 };
static const size_t block = (size_t)128 << 20; // for each thread

enum work { READ, COPY, TOUCH_SMALL, TOUCH_HUGE, WORKS };
static const char *const names[WORKS] = {"read", "copy", "first_touch_4k", "first_touch_2m"};

struct job {
    enum work work;
    unsigned char *from, *to;
    uint64_t sum;
};

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static unsigned char *fresh(int huge)
{
    unsigned char *bytes = mmap(NULL, block, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (bytes == MAP_FAILED) {
        fprintf(stderr, "memory: no memory to measure\n");
        exit(1);
    }
    madvise(bytes, block, huge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
    return bytes;
}

static void *run(void *user)
{
    struct job *job = user;
    const uint64_t *words = (const uint64_t *)(void *)job->from;
    uint64_t sums[8] = {0};
    switch (job->work) {
    case READ:
        for (size_t i = 0; i < block / 8; i += 8)
            for (size_t k = 0; k < 8; k++)
                sums[k] += words[i + k];
        for (size_t k = 0; k < 8; k++)
            job->sum += sums[k];
        break;
    case COPY:
        memcpy(job->to, job->from, block);
        job->sum += job->to[block / 2];
        break;
    default:
        for (size_t i = 0; i < block; i += 4096)
            ((volatile unsigned char *)job->to)[i] = 1;
    }
    return NULL;
}

static double measure(enum work work, int threads)
{
    double best = 0;
    struct job jobs[THREADS_MOST] = {0};
    for (int round = 0; round < ROUNDS; round++) {
        for (int t = 0; t < threads; t++) {
            struct job *job = &jobs[t];
            job->work = work;
            if (work == READ || work == COPY) {
                if (!job->from)
                    job->from = memset(fresh(1), 1, block);
                if (!job->to)
                    job->to = memset(fresh(1), 2, block);
            } else {
                job->to = fresh(work == TOUCH_HUGE);
            }
        }
        pthread_t others[THREADS_MOST];
        double start = now_s();
        for (int t = 1; t < threads; t++)
            if (pthread_create(&others[t], NULL, run, &jobs[t]) != 0)
                exit(1);
        run(&jobs[0]);
        for (int t = 1; t < threads; t++)
            pthread_join(others[t], NULL);
        double rate = (double)threads * (double)block / (now_s() - start) / 1e9;
        best = rate > best ? rate : best;
        for (int t = 0; t < threads && work != READ && work != COPY; t++)
            munmap(jobs[t].to, block);
    }
    for (int t = 0; t < threads && (work == READ || work == COPY); t++) {
        munmap(jobs[t].from, block);
        munmap(jobs[t].to, block);
    }
    return best;
}

int main(void)
{
    printf("{");
    for (int work = 0; work < WORKS; work++)
        for (int threads = 1; threads <= THREADS_MOST; threads++)
            printf("%s\"%s_%d\": %.2f", work || threads > 1 ? ", " : "", names[work], threads,
                   measure((enum work)work, threads));
    printf("}\n");
    return 0;
}
