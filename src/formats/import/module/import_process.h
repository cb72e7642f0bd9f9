// import_process.h: runs the program lambent-import for one file (import_module.h).
#ifndef IMPORT_PROCESS_H
#define IMPORT_PROCESS_H

#include "import_module.h"
#include "importer.h"

// Sends the request and the bytes of the source, and receives the answer and the scene. Stops within 0.1 s if the call
// is cancelled or its time is over; lambent-import then ends. Fails if lambent-import cannot be started or ends early.
bool import_run(const struct import_source *source, struct import_request *request, struct import_answer *answer,
                struct file_bytes *scene, lam_error *error);

#endif
