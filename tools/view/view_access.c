// view_access.c: uses the kernel's tables to find the user at the other end of a connection.
#include "view_access.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "progress.h"

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
    *peers = (struct view_peers){.tables = {-1, -1}};
}

// Parses a line of a table: "SL: LOCAL:PORT REMOTE:PORT STATE TX:RX TIMER:WHEN RETRANSMITS UID …", with hexadecimal
// numbers except for UID. Notes the user if the line describes the other end of a connection to `port`.
static void note(struct view_peers *peers, const char *line, int port)
{
    char local[33], remote[33];
    unsigned local_port, remote_port, state, user;
    if (sscanf(line, " %*[^:]: %32[^:]:%x %32[^:]:%x %x %*[^ ] %*[^ ] %*x %u", local, &local_port, remote, &remote_port,
               &state, &user) != 6)
        return;
    // The kernel prints an address as 32-bit numbers in the machine's byte order: one number for IPv4, four for IPv6.
    // For a loopback connection, the last number is 127.0.0.1.
    static const unsigned char bytes[4] = {127, 0, 0, 1};
    unsigned loopback;
    char wanted[9];
    memcpy(&loopback, bytes, sizeof loopback);
    snprintf(wanted, sizeof wanted, "%08X", loopback);
    size_t local_length = strlen(local), remote_length = strlen(remote);
    if (remote_port == (unsigned)port && local_length >= 8 && remote_length >= 8 && local_port < VIEW_PORTS &&
        strcmp(local + local_length - 8, wanted) == 0 && strcmp(remote + remote_length - 8, wanted) == 0 &&
        user != getuid() && !(user == 0 && state == ESTABLISHED))
        peers->others[local_port / 8] |= (unsigned char)(1 << local_port % 8);
}

// Must not open files, because the sandbox is active.
static void read_tables(struct view_peers *peers, int port)
{
    peers->read_ms = clock_ms();
    memset(peers->others, 0, sizeof peers->others);
    for (int i = 0; i < 2; i++) {
        char buffer[16 << 10], line[LINE_MAX_SIZE];
        size_t length = 0;
        if (peers->tables[i] < 0 || lseek(peers->tables[i], 0, SEEK_SET) != 0)
            continue;
        for (ssize_t got; (got = read(peers->tables[i], buffer, sizeof buffer)) > 0;)
            for (ssize_t k = 0; k < got; k++) {
                if (buffer[k] != '\n') {
                    line[length] = buffer[k];
                    length += length + 1 < sizeof line;
                    continue;
                }
                line[length] = 0;
                length = 0;
                note(peers, line, port);
            }
    }
}

bool view_peers_are_own(struct view_peers *peers, int other_port, int port, double since_ms)
{
    if (since_ms >= peers->read_ms)
        read_tables(peers, port);
    return !(peers->others[other_port / 8] >> other_port % 8 & 1);
}
