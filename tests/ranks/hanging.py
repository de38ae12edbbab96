# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run under mpiexec: rank 0 waits for another one that never comes, one fails, or all sleep."""

import sys
import time

from mpi4py import MPI

from ranks import watch

what = sys.argv[1]
comm = MPI.COMM_WORLD
watch.begin("a barrier", 600 if what == "sleep" else 2)
if what == "sleep":
    time.sleep(600)
if what == "hang" and comm.rank > 0:
    time.sleep(600)
comm.Barrier()
if what == "fail":
    # The launcher may lose what a rank says while it ends
    print(f"rank {comm.rank}: it has failed", flush=True)
    comm.Barrier()
    raise SystemExit(comm.rank)
print("came to the end")
