/* SUNDIALS ARKODE, ERKStep, on a chain: `advance` integrates to an event or to the end. Built as a
 * library that sundials_erkstep.py calls; root finding and settings as in the user's guide. With `rates`
 * the least widths of each gap are roots as well, and one below zero shows that the gap shut before. */

#include <arkode/arkode_erkstep.h>
#include <math.h>
#include <nvector/nvector_serial.h>

enum { MOST = 16 };

/* Below the rounding of a rate: ARKODE stops at a root that is zero from one step to the next. */
static const double NEVER_ZERO = 1e-30;

/* The chain; P, L and shut as in located.py. */
struct chain {
    int n, frequencies, rates;
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
    int any = 0;
    for (int k = 0; k <= n; k++)
        any |= chain->shut[k];
    if (any)
        forces(chain, t, x, f);
    for (int k = 0; k <= n; k++) {
        double left = k ? x[k - 1] : 0, right = k < n ? x[k] : chain->d * (n + 1);
        g[k] = chain->shut[k] ? product(chain->L + k * n, f, n) : right - left;
        double rate = (k < n ? x[n + k] : 0) - (k ? x[n + k - 1] : 0);
        if (chain->rates)
            g[n + 1 + k] = chain->shut[k] ? 1 : rate - NEVER_ZERO;
    }
    return 0;
}

/* The width of an open gap at a time of the last step, with the state there. */
static double width(const struct chain *chain, void *solver, int k, double t, N_Vector state)
{
    const double *x = N_VGetArrayPointer(state);
    ERKStepGetDky(solver, t, 0, state);
    return (k < chain->n ? x[k] : chain->d * (chain->n + 1)) - (k ? x[k - 1] : 0);
}

/* Whether gap k, which is at its least width at *t, shut before in the last step; then *t is when. */
static int dipped(const struct chain *chain, void *solver, int k, double *t, N_Vector state)
{
    double end, step, high = *t;
    if (width(chain, solver, k, high, state) >= 0)
        return 0;
    ERKStepGetCurrentTime(solver, &end);
    ERKStepGetLastStep(solver, &step);
    double low = end - step;
    if (width(chain, solver, k, low, state) <= 0)
        return 0;
    for (double middle; middle = 0.5 * (low + high), low < middle && middle < high;)
        *(width(chain, solver, k, middle, state) > 0 ? &low : &high) = middle;
    *t = high;
    width(chain, solver, k, high, state);
    return 1;
}

/* Integrates y (positions, then velocities) from *t; returns the gap of the event, -1 at the end, -2
 * if the program reports an error. */
int advance(const struct chain *chain, double *t, double until, double *y)
{
    int n = chain->n, found[2 * MOST], sign[2 * MOST], gap = -2;
    SUNContext context;
    if (SUNContext_Create(NULL, &context))
        return -2;
    N_Vector state = N_VMake_Serial(2 * n, y, context);
    N_VEnableFusedOps_Serial(state, 1);
    void *solver = ERKStepCreate(motion, *t, state, context);
    for (int k = 0; k <= n; k++)
        sign[k] = -1, sign[n + 1 + k] = 1;
    int roots = (1 + chain->rates) * (n + 1);
    if (!ERKStepSStolerances(solver, chain->rtol, chain->rtol * 1e-3) &&
        !ERKStepSetOrder(solver, 8) && !ERKStepSetUserData(solver, (void *)chain) &&
        !ERKStepSetMaxNumSteps(solver, -1) && !ERKStepSetStopTime(solver, until) &&
        !ERKStepRootInit(solver, roots, events) && !ERKStepSetRootDirection(solver, sign)) {
        int flag;
        while (gap == -2 && (flag = ERKStepEvolve(solver, until, state, t, ARK_NORMAL)) >= 0) {
            if (flag != ARK_ROOT_RETURN)
                gap = -1;
            else if (ERKStepGetRootInfo(solver, found))
                break;
            for (int k = 0; gap == -2 && k < roots; k++)
                if (found[k] && (k <= n || dipped(chain, solver, k - n - 1, t, state)))
                    gap = k % (n + 1);
        }
    }
    ERKStepFree(&solver);
    N_VDestroy(state);
    SUNContext_Free(&context);
    return gap;
}
