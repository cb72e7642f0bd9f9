// http.h: declares the functions of libmicrohttpd, which `lambent view` loads with dlopen.
// https://www.gnu.org/software/libmicrohttpd/manual/libmicrohttpd.html
#ifndef HTTP_H
#define HTTP_H

#include <microhttpd.h>
#include <stdbool.h>

#include <lambent/base.h>

#define HTTP_LIBRARY "libmicrohttpd.so.12"

// The functions used. Each function is a member of struct http with the type of its declaration.
#define HTTP_FUNCTIONS(each)                                                                                           \
    each(MHD_start_daemon) each(MHD_stop_daemon) each(MHD_run) each(MHD_get_daemon_info) each(MHD_get_connection_info) \
        each(MHD_get_timeout) each(MHD_queue_response) each(MHD_create_response_from_buffer)                           \
            each(MHD_create_response_from_callback) each(MHD_create_response_from_fd64) each(MHD_add_response_header)  \
                each(MHD_destroy_response) each(MHD_lookup_connection_value) each(MHD_get_connection_values)           \
                    each(MHD_suspend_connection) each(MHD_resume_connection)

struct http {
#define MEMBER(name) __typeof__(&name) name;
    HTTP_FUNCTIONS(MEMBER)
#undef MEMBER
};

#endif
