// view_events.h: informs pages about changed files with server-sent events
// (https://html.spec.whatwg.org/#server-sent-events).
#ifndef VIEW_EVENTS_H
#define VIEW_EVENTS_H

#include "view.h"

// Answers a request that waits for changes.
enum MHD_Result view_events_answer(struct view_connection *connection);

// Informs all listeners that the file with this path in the page has changed.
void view_events_changed(struct view *view, const char *path);

// Sends a comment at intervals, since only sending reveals that a page was closed.
void view_events_keep(struct view *view);

// Sends a comment to one listener.
void view_events_wake(struct view_listener *listener);

// Removes a listener whose connection has ended.
void view_events_forget(struct view *view, struct view_listener *listener);

// Ends all listeners.
void view_events_end(struct view *view);

#endif
