#!/usr/bin/env python3
# worker.py: draws thumbnails with one `lambent batch --jobs -`, which stays running for all of them.  worker.py MODEL ...
import base64
import json
import os
import pathlib
import subprocess
import sys
import threading

models = sys.argv[1:]
worker = subprocess.Popen([os.environ.get("LAMBENT", "lambent"), "batch", "--jobs", "-", "--quiet", "--isolate", "--allow-path", "."],
                          stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def send():
    """Writes in a separate thread, because the worker stops reading while many jobs wait, and sends answers meanwhile."""
    with worker.stdin as jobs:
        for number, model in enumerate(models):
            print(json.dumps({"id": number, "model": model, "options": {"size": 256}, "timeout_s": 20}), file=jobs, flush=True)


threading.Thread(target=send).start()
failed = 0
for line in worker.stdout:  # in the order in which they finish
    answer = json.loads(line)
    if answer["outcome"] == "written":
        picture = pathlib.Path(models[answer["id"]]).name + ".png"
        pathlib.Path(picture).write_bytes(base64.b64decode(answer["data"]))
        print(f"{picture}: {answer['triangles']} triangles, {answer['times_ms']['total']} ms")
    else:
        print(answer["error"])
        failed += 1
worker.wait()
sys.exit(failed > 0)
