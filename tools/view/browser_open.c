// browser_open.c: opens an address in the user's browser with xdg-open, which requires a display.
#include "browser_open.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/types.h>
#include <unistd.h>

extern char **environ;

bool browser_open(const char *address)
{
    static const char program[] = "xdg-open";
    const char *x11 = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    pid_t process;
    if (!(x11 && *x11) && !(wayland && *wayland))
        return false;
    // The browser keeps running if this program is interrupted. The browser's messages are discarded.
    bool ok = posix_spawn_file_actions_init(&actions) == 0;
    ok = ok && posix_spawnattr_init(&attributes) == 0;
    if (!ok)
        return false;
    ok = posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID) == 0;
    for (int file = 0; file < 3; file++)
        ok = ok && posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_RDWR, 0) == 0;
    char *const words[] = {(char *)(uintptr_t)program, (char *)(uintptr_t)address, NULL};
    ok = ok && posix_spawnp(&process, program, &actions, &attributes, words, environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return ok;
}
