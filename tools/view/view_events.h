// view_events.h: pages that hear of changes: server-sent events (https://html.spec.whatwg.org/#server-sent-events).
#ifndef VIEW_EVENTS_H
#define VIEW_EVENTS_H

#include "view.h"

// Answers a request that waits for changes.
enum MHD_Result view_events_answer(struct view_connection *connection);

// Tells all of them that a file has changed, by its path in the page.
void view_events_changed(struct view *view, const char *path);

// Sends a comment now and then: a page that has gone is only noticed when something is sent to it.
void view_events_keep(struct view *view);

// Sends a comment to one.
void view_events_wake(struct view_listener *listener);

// A listener's connection has ended.
void view_events_forget(struct view *view, struct view_listener *listener);

// Ends all of them.
void view_events_end(struct view *view);

#endif
