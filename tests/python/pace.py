#!/usr/bin/python3 -IS
"""pace.py: the program LAMBENT_PACED, whose worker answers at most PACE jobs a second, as a slow machine would."""
import os
import subprocess
import sys
import time

program, words = os.environ["LAMBENT_PACED"], sys.argv[1:]
if "--jobs" not in words:
    os.execv(program, [program, *words])
worker = subprocess.Popen([program, *words], stdout=subprocess.PIPE)
ready = time.monotonic()
for line in worker.stdout:
    ready = max(ready, time.monotonic() - 0.5) + 1 / float(os.environ["PACE"])
    time.sleep(max(0, ready - time.monotonic()))
    sys.stdout.buffer.write(line)
    sys.stdout.flush()
sys.exit(worker.wait())
