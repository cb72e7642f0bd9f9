// view_peer.h: whose connections the viewer answers: its own user's. The address with the token is an argument of xdg-open and of the
// browser, which other users of the machine can read in /proc.
#ifndef VIEW_PEER_H
#define VIEW_PEER_H

#include <stdbool.h>

// The kernel's tables of connections, /proc/net/tcp and tcp6. −1: not there.
struct view_peers {
    int tables[2];
};

void view_peers_open(struct view_peers *peers); // before the sandbox
void view_peers_close(struct view_peers *peers);

// Returns whether the other end of a connection from 127.0.0.1:`other_port` to 127.0.0.1:`port` belongs to this
// process's user, or to root, whose relays bring connections from outside of virtual machines and containers. True
// where the kernel does not list it.
bool view_peers_are_own(const struct view_peers *peers, int other_port, int port);

#endif
