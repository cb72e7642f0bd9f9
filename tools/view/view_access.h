// view_access.h: accepts only connections of the viewer's own user. The address with the token is an argument of xdg-open
// and of the browser, so other users can read the address in /proc.
#ifndef VIEW_ACCESS_H
#define VIEW_ACCESS_H

#include <stdbool.h>

// The file descriptors of the kernel's tables of connections, /proc/net/tcp and tcp6; −1 if a table is missing.
struct view_peers {
    int tables[2];
};

void view_peers_open(struct view_peers *peers); // must be called before the sandbox is entered
void view_peers_close(struct view_peers *peers);

// Returns whether the other end of a connection from 127.0.0.1:`other_port` to 127.0.0.1:`port` belongs to this
// process's user or to root. (Root relays connections into virtual machines and containers.) Also returns true if the
// kernel does not list the connection.
bool view_peers_are_own(const struct view_peers *peers, int other_port, int port);

#endif
