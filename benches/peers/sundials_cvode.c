/* SUNDIALS CVODE on a chain: Adams multistep with fixed-point iteration (nothing is stiff), events at
 * changes of sign from above. Built as a library that sundials_cvode.py calls.
 *
 * The wheel that brings the compiled SUNDIALS has no headers, so the few functions that are used are
 * declared here, as in the user's guide for 64-bit indices and double precision. */

#include <math.h>
#include <stdint.h>

typedef void *Handle;
int SUNContext_Create(int comm, Handle *context);
Handle N_VMake_Serial(int64_t length, double *data, Handle context);
double *N_VGetArrayPointer(Handle vector);
Handle SUNNonlinSol_FixedPoint(Handle vector, int m, Handle context);
Handle CVodeCreate(int method, Handle context);
int CVodeInit(Handle, int (*)(double, Handle, Handle, void *), double t, Handle y);
int CVodeReInit(Handle, double t, Handle y);
int CVodeSStolerances(Handle, double relative, double absolute);
int CVodeSetUserData(Handle, void *);
int CVodeSetNonlinearSolver(Handle, Handle solver);
int CVodeSetMaxNumSteps(Handle, long steps);
int CVodeSetStopTime(Handle, double t);
int CVodeRootInit(Handle, int count, int (*)(double, Handle, double *, void *));
int CVodeSetRootDirection(Handle, int *directions);
int CVodeGetRootInfo(Handle, int *found);
int CVode(Handle, double until, Handle y, double *t, int task);
enum { ADAMS = 1, NORMAL = 1, ROOT_RETURN = 2, MOST = 1000 };

/* One chain: y holds n displacements, then n velocities. */
static struct {
    int n;
    double d, w2, big_w;
    const double *forcing;
    Handle solver, vector;
    double y[2 * MOST];
} chain;

static int motion(double t, Handle state, Handle rate, void *user)
{
    (void)user;
    const double *y = N_VGetArrayPointer(state), *f = chain.forcing;
    double *dy = N_VGetArrayPointer(rate);
    const double c = cos(chain.big_w * t), s = sin(chain.big_w * t);
    const int n = chain.n;
    for (int j = 0; j < n; j++) {
        dy[j] = y[n + j];
        dy[n + j] = f[2 * j] * c + f[2 * j + 1] * s - chain.w2 * y[j];
    }
    return 0;
}

static int widths(double t, Handle state, double *width, void *user)
{
    (void)t;
    (void)user;
    const double *u = N_VGetArrayPointer(state);
    width[0] = chain.d + u[0];
    for (int k = 1; k < chain.n; k++)
        width[k] = chain.d + (u[k] - u[k - 1]);
    width[chain.n] = chain.d - u[chain.n - 1];
    return 0;
}

/* Sets a chain up; returns where its state is kept, or null. */
double *setup(int n, double d, double w, double big_w, const double *forcing, double tolerance)
{
    static int falling[MOST + 1];
    Handle context;
    if (n > MOST || SUNContext_Create(0, &context))
        return 0;
    chain.n = n, chain.d = d, chain.w2 = w * w, chain.big_w = big_w, chain.forcing = forcing;
    for (int k = 0; k <= n; k++)
        falling[k] = -1;
    chain.vector = N_VMake_Serial(2 * n, chain.y, context);
    Handle own = chain.solver = CVodeCreate(ADAMS, context);
    int bad = CVodeInit(own, motion, 0.0, chain.vector);
    bad |= CVodeSStolerances(own, tolerance, tolerance * 1e-3);
    bad |= CVodeSetNonlinearSolver(own, SUNNonlinSol_FixedPoint(chain.vector, 0, context));
    bad |= CVodeSetMaxNumSteps(own, 1000000);
    bad |= CVodeRootInit(own, n + 1, widths);
    bad |= CVodeSetRootDirection(own, falling);
    return bad ? 0 : chain.y;
}

/* Integrates from the state at *t; returns the gap that shut at the new *t, -1 if none did until
 * `until`, -2 on a failure. */
int next(double *t, double until)
{
    static int found[MOST + 1];
    if (CVodeReInit(chain.solver, *t, chain.vector) || CVodeSetStopTime(chain.solver, until))
        return -2;
    const int flag = CVode(chain.solver, until, chain.vector, t, NORMAL);
    if (flag != ROOT_RETURN)
        return flag < 0 ? -2 : -1;
    CVodeGetRootInfo(chain.solver, found);
    for (int k = 0; k <= chain.n; k++)
        if (found[k])
            return k;
    return -2;
}
