// fake_import.c: stands in for lambent-import, and behaves as the file demands: "xof MODE", then the bytes of a scene.
#include "import_module.h"

#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool take(void *to, size_t size) { return fread(to, 1, size, stdin) == size; }

static void put(const void *from, size_t size)
{
    fwrite(from, 1, size, stdout);
    fflush(stdout);
}

// As in import_main.c.
static void serve(void)
{
    setsid(); // Ctrl-C reaches the other process alone
    for (pid_t process = 1; process;) {
        char byte;
        int files[2];
        union import_handles handles;
        struct iovec data = {&byte, 1};
        struct msghdr message = {
            .msg_iov = &data, .msg_iovlen = 1, .msg_control = &handles, .msg_controllen = sizeof handles};
        ssize_t size = recvmsg(STDIN_FILENO, &message, MSG_CMSG_CLOEXEC);
        const struct cmsghdr *head = size > 0 ? CMSG_FIRSTHDR(&message) : NULL;
        if (!head || head->cmsg_type != SCM_RIGHTS || head->cmsg_len != CMSG_LEN(sizeof files))
            _exit(0);
        memcpy(files, CMSG_DATA(head), sizeof files);
        process = fork();
        if (!process && (dup2(files[0], STDIN_FILENO) < 0 || dup2(files[1], STDOUT_FILENO) < 0))
            _exit(1);
        close(files[0]);
        close(files[1]);
    }
}

int main(int count, char **words)
{
    signal(SIGCHLD, SIG_IGN);
    if (count > 1 && strcmp(words[1], IMPORT_STARTER) == 0)
        serve();

    enum { HEAD = 16 };
    struct import_request request;
    struct import_answer answer = {.version = IMPORT_MODULE_VERSION};
    char head[HEAD + 1] = {0};
    if (!take(&request, sizeof request) || request.size < HEAD || !take(head, HEAD))
        return 1;
    const char *mode = head + 4;
    if (strncmp(mode, "early", 5) == 0)
        return 0;
    uint8_t *bytes = malloc(request.size);
    if (!take(bytes, request.size - HEAD))
        return 1;
    answer.size = request.size - HEAD;
    if (strncmp(mode, "crash", 5) == 0)
        raise(SIGSEGV);
    while (strncmp(mode, "hang", 4) == 0)
        if (poll(&(struct pollfd){.fd = STDIN_FILENO}, 1, -1) > 0)
            _exit(1);
    if (strncmp(mode, "version", 7) == 0)
        answer.version++;
    if (strncmp(mode, "huge", 4) == 0)
        answer.size = UINT64_MAX / 2;
    if (strncmp(mode, "empty", 5) == 0)
        answer.size = 0;
    if (strncmp(mode, "result", 6) == 0)
        answer.result = (uint32_t)atoi(mode + 6);
    if (strncmp(mode, "note", 4) == 0)
        memset(answer.note, '\33', sizeof answer.note); // without an end
    if (strncmp(mode, "unit", 4) == 0) {
        answer.unit_m = -1;
        answer.memory = UINT64_MAX;
    }
    put(&answer, sizeof answer);
    put(bytes, strncmp(mode, "short", 5) == 0 ? 5 : request.size - HEAD);
    return 0;
}
