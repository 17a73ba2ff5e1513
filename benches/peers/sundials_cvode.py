"""SUNDIALS CVODE, called from C: the compiled library comes with the wheel of scikit-sundae."""

import ctypes
import subprocess
import sys
import tempfile
from pathlib import Path

import common
import numpy as np
import sksundae


def library():
    """The functions of sundials_cvode.c, compiled and linked with the wheel's SUNDIALS."""
    libs = Path(sksundae.__file__).parent.parent / "scikit_sundae.libs"
    for part in ["core", "nvecserial", "cvode"]:
        path = next(libs.glob(f"libsundials_{part}-*"))
        ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL)
    source = Path(__file__).with_suffix(".c")
    with tempfile.TemporaryDirectory() as folder:
        shared = Path(folder) / "cvode.so"
        command = ["cc", "-O2", "-shared", "-fPIC", "-o", shared, source, "-lm"]
        subprocess.run(command, check=True, stdout=sys.stderr)
        loaded = ctypes.CDLL(str(shared))
    number, numbers = ctypes.c_double, ctypes.POINTER(ctypes.c_double)
    loaded.setup.argtypes = [ctypes.c_int, number, number, number, numbers, number]
    loaded.setup.restype = numbers
    loaded.next.argtypes = [numbers, number]
    return loaded


def prepare(scenario, setting):
    forcing = np.array(scenario["forcing"], dtype=float)
    n = len(forcing)
    pointer = forcing.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
    frequencies = scenario["natural_frequency"], scenario["forcing_frequency"]
    state = CVODE.setup(n, scenario["spacing"], *frequencies, pointer, setting["tol"])
    if not state:
        raise RuntimeError("CVODE refuses the set-up")
    y = np.ctypeslib.as_array(state, (2 * n,))

    def run(t, u, v, until, first, forcing=forcing):
        impacts, time = [], ctypes.c_double(t)
        y[:n], y[n:] = u, v
        while time.value < until:
            gap = CVODE.next(time, until)
            if gap == -2:
                raise RuntimeError(f"CVODE fails at t = {time.value}")
            if gap < 0:
                break
            impacts.append((time.value, gap))
            if first:
                break
            common.bounce(y[:n], y[n:], gap, scenario)
        return impacts

    return run


NOTE = "one Python call at each impact"

if __name__ == "__main__":
    CVODE = library()
    settings = [{"tol": 1e-6}, {"tol": 1e-10}, {"tol": 1e-12}]
    common.main("SUNDIALS CVODE", sksundae.SUNDIALS_VERSION, settings, prepare, NOTE)
