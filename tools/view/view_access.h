// view_access.h: accepts only connections of the viewer's own user. The address with the token is an argument of xdg-open
// and of the browser, so other users can read the address in /proc.
#ifndef VIEW_ACCESS_H
#define VIEW_ACCESS_H

#include <stdbool.h>

enum { VIEW_PORTS = 1 << 16 };
struct view_peers {
    int tables[2];  // the kernel's tables of connections, /proc/net/tcp and tcp6; −1 if a table is missing
    double read_ms; // the clock_ms() when the tables were last read
    unsigned char others[VIEW_PORTS / 8]; // a bit for each port: whether its connection belongs to another user
};

void view_peers_open(struct view_peers *peers); // must be called before the sandbox is entered
void view_peers_close(struct view_peers *peers);

// Returns whether the other end of a connection from 127.0.0.1:`other_port` to 127.0.0.1:`port` belongs to this
// process's user or to root. (Root relays connections into virtual machines and containers.) Also returns true if the
// kernel does not list the connection. The connection must exist since `since_ms` on the clock of clock_ms(). The tables
// are read once for all connections that existed at that time, because reading them for each of hundreds takes seconds.
bool view_peers_are_own(struct view_peers *peers, int other_port, int port, double since_ms);

#endif
