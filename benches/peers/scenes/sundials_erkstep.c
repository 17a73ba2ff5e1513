/* SUNDIALS ARKODE, ERKStep, on a chain: `advance` integrates to an event or to the end. Built as a
 * library that sundials_erkstep.py calls; root finding and settings as in the user's guide. */

#include <arkode/arkode_erkstep.h>
#include <math.h>
#include <nvector/nvector_serial.h>

enum { MOST = 16 };

/* The chain; P, L and shut as in located.py. */
struct chain {
    int n, frequencies;
    double d, w2, rtol;
    const double *frequency, *alpha, *beta; /* amplitudes: a row for each frequency */
    const double *P, *L;
    const int *shut;
};

static void forces(const struct chain *chain, double t, const double *x, double *f)
{
    for (int j = 0; j < chain->n; j++)
        f[j] = -chain->w2 * (x[j] - chain->d * (j + 1));
    for (int k = 0; k < chain->frequencies; k++) {
        double c = cos(chain->frequency[k] * t), s = sin(chain->frequency[k] * t);
        for (int j = 0; j < chain->n; j++)
            f[j] += chain->alpha[k * chain->n + j] * c + chain->beta[k * chain->n + j] * s;
    }
}

static double product(const double *row, const double *f, int n)
{
    double sum = 0;
    for (int j = 0; j < n; j++)
        sum += row[j] * f[j];
    return sum;
}

static int motion(double t, N_Vector y, N_Vector rate, void *user)
{
    const struct chain *chain = user;
    int n = chain->n;
    const double *x = N_VGetArrayPointer(y);
    double *to = N_VGetArrayPointer(rate), f[MOST];
    forces(chain, t, x, f);
    for (int j = 0; j < n; j++) {
        to[j] = x[n + j];
        to[n + j] = product(chain->P + j * n, f, n);
    }
    return 0;
}

static int events(double t, N_Vector y, double *g, void *user)
{
    const struct chain *chain = user;
    int n = chain->n;
    const double *x = N_VGetArrayPointer(y);
    double f[MOST];
    forces(chain, t, x, f);
    for (int k = 0; k <= n; k++) {
        double left = k ? x[k - 1] : 0, right = k < n ? x[k] : chain->d * (n + 1);
        g[k] = chain->shut[k] ? product(chain->L + k * n, f, n) : right - left;
    }
    return 0;
}

/* Integrates y (positions, then velocities) from *t; returns the gap of the event, -1 at the end, -2
 * if the program reports an error. */
int advance(const struct chain *chain, double *t, double until, double *y)
{
    int n = chain->n, found[MOST], falling[MOST], gap = -2;
    SUNContext context;
    if (SUNContext_Create(NULL, &context))
        return -2;
    N_Vector state = N_VMake_Serial(2 * n, y, context);
    void *solver = ERKStepCreate(motion, *t, state, context);
    for (int k = 0; k <= n; k++)
        falling[k] = -1;
    if (!ERKStepSStolerances(solver, chain->rtol, chain->rtol * 1e-3) &&
        !ERKStepSetOrder(solver, 8) && !ERKStepSetUserData(solver, (void *)chain) &&
        !ERKStepSetMaxNumSteps(solver, -1) && !ERKStepSetStopTime(solver, until) &&
        !ERKStepRootInit(solver, n + 1, events) && !ERKStepSetRootDirection(solver, falling)) {
        int flag = ERKStepEvolve(solver, until, state, t, ARK_NORMAL);
        if (flag == ARK_ROOT_RETURN && !ERKStepGetRootInfo(solver, found)) {
            for (gap = 0; gap < n && !found[gap];)
                gap++;
        } else if (flag >= 0)
            gap = -1;
    }
    ERKStepFree(&solver);
    N_VDestroy(state);
    SUNContext_Free(&context);
    return gap;
}
