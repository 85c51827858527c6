# Shewchuk's Triangle, from the Python package, as a peer: points on standard input, seconds and triangles on standard output.
import sys
import time

import numpy
import triangle

while True:
    head = sys.stdin.buffer.read(8)
    if len(head) < 8:
        break
    count = int.from_bytes(head, "little")
    points = numpy.frombuffer(sys.stdin.buffer.read(16 * count)).reshape(count, 2).copy()
    since, busy_since = time.perf_counter(), time.process_time()
    mesh = triangle.triangulate({"vertices": points}, "")
    seconds, busy = time.perf_counter() - since, time.process_time() - busy_since
    print(seconds, busy, len(mesh.get("triangles", ())), flush=True)
