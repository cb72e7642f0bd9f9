// view_access.c: uses the kernel's tables to find the user at the other end of a connection.
#include "view_access.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { ESTABLISHED = 1, LINE_MAX_SIZE = 512 };

void view_peers_open(struct view_peers *peers)
{
    peers->tables[0] = open("/proc/net/tcp", O_RDONLY | O_CLOEXEC);
    peers->tables[1] = open("/proc/net/tcp6", O_RDONLY | O_CLOEXEC);
}

void view_peers_close(struct view_peers *peers)
{
    for (int i = 0; i < 2; i++)
        if (peers->tables[i] >= 0)
            close(peers->tables[i]);
    *peers = (struct view_peers){{-1, -1}};
}

// Parses a line of a table: "SL: LOCAL:PORT REMOTE:PORT STATE TX:RX TIMER:WHEN RETRANSMITS UID …", with hexadecimal
// numbers except for UID. Returns true if the line describes the other end of the given connection.
static bool is_other_end(const char *line, int other_port, int port, unsigned *state, unsigned *user)
{
    char local[33], remote[33];
    unsigned local_port, remote_port;
    if (sscanf(line, " %*[^:]: %32[^:]:%x %32[^:]:%x %x %*[^ ] %*[^ ] %*x %u", local, &local_port, remote, &remote_port,
               state, user) != 6)
        return false;
    // The kernel prints an address as 32-bit numbers in the machine's byte order: one number for IPv4, four for IPv6.
    // For a loopback connection, the last number is 127.0.0.1.
    static const unsigned char bytes[4] = {127, 0, 0, 1};
    unsigned loopback;
    char wanted[9];
    memcpy(&loopback, bytes, sizeof loopback);
    snprintf(wanted, sizeof wanted, "%08X", loopback);
    size_t local_length = strlen(local), remote_length = strlen(remote);
    return local_port == (unsigned)other_port && remote_port == (unsigned)port && local_length >= 8 &&
           remote_length >= 8 && strcmp(local + local_length - 8, wanted) == 0 &&
           strcmp(remote + remote_length - 8, wanted) == 0;
}

// Must not open files, because the sandbox is active.
bool view_peers_are_own(const struct view_peers *peers, int other_port, int port)
{
    for (int i = 0; i < 2; i++) {
        char buffer[16 << 10], line[LINE_MAX_SIZE];
        size_t length = 0;
        if (peers->tables[i] < 0 || lseek(peers->tables[i], 0, SEEK_SET) != 0)
            continue;
        for (ssize_t got; (got = read(peers->tables[i], buffer, sizeof buffer)) > 0;)
            for (ssize_t k = 0; k < got; k++) {
                unsigned state, user;
                if (buffer[k] != '\n') {
                    line[length] = buffer[k];
                    length += length + 1 < sizeof line;
                    continue;
                }
                line[length] = 0;
                length = 0;
                if (is_other_end(line, other_port, port, &state, &user))
                    return user == getuid() || (user == 0 && state == ESTABLISHED);
            }
    }
    return true;
}
