"""Drops a soft ball: falling.py PREFIX, where sbcollide is installed with BUILD_SHARED_LIBS=ON."""
import ctypes
import glob
import sys

[library] = glob.glob(sys.argv[1] + "/lib/**/libsbcollide-softbody.so", recursive=True)
c = ctypes.CDLL(library)
c.sbcollide_world_new.restype = ctypes.c_void_p
c.sbcollide_world_error.restype = ctypes.c_char_p
c.sbcollide_world_y.restype = ctypes.POINTER(ctypes.c_float)
c.sbcollide_world_time.restype = ctypes.c_double

world = ctypes.c_void_p(c.sbcollide_world_new())


def call(function, *arguments):
    if function(world, *arguments) != 0:
        sys.exit(c.sbcollide_world_error(world).decode())


call(c.sbcollide_world_add_text, b"[ground]\n[[body]]\nposition = [0, 2, 0]\nmesh = {radius = 0.5}")
call(c.sbcollide_world_start, 1, None)
for _ in range(4):
    call(c.sbcollide_world_step, 15)
    heights = c.sbcollide_world_y(world)[:c.sbcollide_world_vertices(world)]
    print("%.2f s: %.3f m" % (c.sbcollide_world_time(world), sum(heights) / len(heights)))
c.sbcollide_world_free(world)
