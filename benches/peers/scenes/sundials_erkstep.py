"""SUNDIALS ARKODE, ERKStep of order 8, in C with the headers and library of the system."""

import ctypes
import subprocess
import sys
import tempfile
from pathlib import Path

import common
import located
import numpy as np

TOL = 1e-12
SETTINGS = [
    ("order 8, tol=1e-12", (0.0, False)),
    ("order 8, tol=1e-12, stop=1e-12", (1e-12, False)),
    ("order 8, tol=1e-12, stop=1e-12, rates", (1e-12, True)),
]
NUMBERS = ctypes.POINTER(ctypes.c_double)
INTS = ctypes.POINTER(ctypes.c_int)


class Chain(ctypes.Structure):
    _fields_ = [(name, ctypes.c_int) for name in ["n", "frequencies", "rates"]]
    _fields_ += [(name, ctypes.c_double) for name in ["d", "w2", "rtol"]]
    _fields_ += [(name, NUMBERS) for name in ["frequency", "alpha", "beta", "P", "L"]]
    _fields_ += [("shut", INTS)]


def library():
    with tempfile.TemporaryDirectory() as folder:
        shared = Path(folder) / "erkstep.so"
        command = ["cc", "-O3", "-shared", "-fPIC", "-o", shared, Path(__file__).with_suffix(".c")]
        libraries = ["-lsundials_arkode", "-lsundials_nvecserial", "-lm"]
        subprocess.run([*command, *libraries], check=True, stdout=sys.stderr)
        return ctypes.CDLL(str(shared))


def version():
    text = ctypes.create_string_buffer(32)
    LIBRARY.SUNDIALSGetVersion(text, 32)
    return text.value.decode()


NAME = "ERKStep"
DOUBT = "root functions identically 0"
LIBRARY = library()
VERSION = version()


def simulate(case, value, hit):
    stop, rates = value

    def advance(t, x, v, contact):
        arrays = [np.ascontiguousarray(a, dtype=float) for a in
                  [case.frequencies, case.alpha, case.beta, contact.P, contact.L]]  # fmt: skip
        shut = np.ascontiguousarray(contact.shut, dtype=np.intc)
        pointers = [a.ctypes.data_as(NUMBERS) for a in arrays]
        sizes = case.n, len(case.frequencies), rates, case.d, case.w2, TOL
        chain = Chain(*sizes, *pointers, shut.ctypes.data_as(INTS))
        y, time = np.concatenate((x, v)), ctypes.c_double(t)
        until = ctypes.c_double(case.until)
        gap = LIBRARY.advance(ctypes.byref(chain), ctypes.byref(time), until, y.ctypes.data_as(NUMBERS))
        if gap == -2:
            raise common.Warned
        return time.value, y[: case.n], y[case.n :], None if gap < 0 else gap

    located.simulate(case, stop, advance, hit)


if __name__ == "__main__":
    common.main(sys.modules[__name__])
