/* Benches.BldcDrive with everything that can be left out of it.
   Inputs v_bus (V), dir (+1, -1, held). Outputs ia, ib, ic, theta, w. */
#include "benches.h"
#include "physics.h"

#include <math.h>

#define PARAMETERS(X)                                                                                       \
    X(R) X(L) X(Ke) X(J) X(b) X(pp) FRICTION(X, shaft)                                                      \
    X(Ra) X(Rb) X(Rc) X(La) X(Lb) X(Lc) X(short_a) X(short_b) X(short_c) X(zeta) X(V_d) X(sag) X(u_max)     \
    X(k_s) X(tau_l) X(mgl) X(mgl_phi) X(cog_a) X(cog_n) X(cog_phi) X(rip_a) X(rip_n) X(rip_phi)             \
    X(iron) X(i_sat) X(heat_k) X(heat_tau) X(law_w3) X(law_warm) X(law_warm_tau) X(law_sqrt)

typedef struct {
#define FIELD(name) double name;
    PARAMETERS(FIELD)
} parameters;

enum { IA, IB, IC, W, THETA, Z, HEAT, STATES };
enum { SHAFT, SECTOR, FLOATING, DIRECTION, MODES };
enum { G_SHAFT, G_SECTOR_LOW, G_SECTOR_HIGH, G_FLOATING, G_DIRECTION, GUARDS };
enum { OPEN = 0, FROM_LOW = 1, FROM_HIGH = -1 }; /* the floating leg's diode that conducts: the sign of its current */
enum { I_WIDTH_MA = 2 };

static const double DEG = 0.017453292519943295;
/* Forward; backward the two change places. */
static const int HIGH_LEG[6] = {0, 0, 1, 1, 2, 2}, LOW_LEG[6] = {1, 2, 2, 0, 0, 1}, FLOAT_LEG[6] = {2, 1, 0, 2, 1, 0};

static const friction *shaft(const parameters *q) { return (const friction *)&q->shaft_tau_c; }

/* Trapezoid of an angle in degrees: 1 from 30 to 150, -1 from 210 to 330. */
static double trapezoid(double angle)
{
    double a = fmod(angle, 360);
    if (a < 0) a += 360;
    if (a < 30) return a / 30;
    if (a < 150) return 1;
    if (a < 210) return (180 - a) / 30;
    if (a < 330) return -1;
    return (a - 360) / 30;
}

typedef struct {
    double R[3], L[3], k[3], e[3], v[3];
    int on[3];
} machine;

/* Legs and windings at a state; `v` is what a leg applies, a switched leg or one on its diode. */
static machine legs(const parameters *q, const int *mode, const double *in, const double *x)
{
    machine m;
    const double dR[3] = {q->Ra, q->Rb, q->Rc}, dL[3] = {q->La, q->Lb, q->Lc};
    const double turns[3] = {1 - q->short_a, 1 - q->short_b, 1 - q->short_c};
    double electrical = q->pp * x[THETA] / DEG;
    double modulation = 1 + q->zeta * cos((electrical - 60) * DEG);
    int sector = mode[SECTOR], forward = mode[DIRECTION] > 0;
    int high = forward ? HIGH_LEG[sector] : LOW_LEG[sector], floating = FLOAT_LEG[sector];
    double bus = q->u_max > 0 ? fmin(in[0], q->u_max) : in[0];
    if (q->sag > 0) bus -= q->sag * (x[high] + (mode[FLOATING] == FROM_HIGH ? x[floating] : 0));
    for (int n = 0; n < 3; n++) {
        double saturation = q->i_sat > 0 ? 1 / (1 + (x[n] / q->i_sat) * (x[n] / q->i_sat)) : 1;
        m.R[n] = (q->R + dR[n]) * turns[n] * (1 + x[HEAT]);
        m.L[n] = (q->L + dL[n]) * turns[n] * turns[n];
        m.k[n] = q->Ke * turns[n] * modulation * trapezoid(electrical - 120 * n) * saturation;
        m.e[n] = m.k[n] * x[W];
        m.on[n] = n != floating || mode[FLOATING] != OPEN;
        m.v[n] = n == high || (n == floating && mode[FLOATING] == FROM_HIGH) ? bus : 0;
        if (q->V_d > 0) m.v[n] -= q->V_d * soft_sign(x[n], I_WIDTH_MA * 1e-3);
    }
    return m;
}

/* Neutral voltage from the currents' sum staying zero. */
static double neutral(const machine *m, const double *x)
{
    double sum = 0, weight = 0;
    for (int n = 0; n < 3; n++)
        if (m->on[n]) {
            sum += (m->v[n] - m->R[n] * x[n] - m->e[n]) / m->L[n];
            weight += 1 / m->L[n];
        }
    return sum / weight;
}

static double rotor_torque(const parameters *q, const machine *m, double t, double w, const double *x)
{
    double motor = m->k[0] * x[IA] + m->k[1] * x[IB] + m->k[2] * x[IC], angle = x[THETA];
    if (q->rip_a != 0) motor *= 1 + q->rip_a * sin(q->rip_n * angle + q->rip_phi);
    double load = (q->b + q->iron) * w + q->k_s * angle + q->tau_l;
    if (q->mgl != 0) load += q->mgl * sin(angle + q->mgl_phi);
    if (q->cog_a != 0) load += q->cog_a * sin(q->cog_n * angle + q->cog_phi);
    if (q->law_w3 != 0) load += q->law_w3 * w * w * w;
    if (q->law_warm != 0) load += q->law_warm * w * exp(-t / q->law_warm_tau);
    if (q->law_sqrt != 0) load += q->law_sqrt * sign_of(w) * sqrt(fabs(w));
    return motor - load;
}

static double sector_position(const parameters *q, const double *x)
{
    double a = fmod(q->pp * x[THETA] / DEG - 30, 360);
    return (a < 0 ? a + 360 : a) / 60;
}

static void start(const double *p, const double *in, const double *x, int *mode)
{
    const parameters *q = (const parameters *)p;
    mode[SHAFT] = friction_start(shaft(q));
    mode[SECTOR] = (int)sector_position(q, x) % 6;
    mode[FLOATING] = OPEN;
    mode[DIRECTION] = in[1] > 0 ? 1 : -1;
}

static void derivative(const double *p, const int *mode, double t, const double *in, const double *x, double *dx)
{
    const parameters *q = (const parameters *)p;
    machine m = legs(q, mode, in, x);
    double vn = neutral(&m, x), copper = 0;
    for (int n = 0; n < 3; n++) {
        dx[n] = m.on[n] ? (m.v[n] - vn - m.R[n] * x[n] - m.e[n]) / m.L[n] : 0;
        copper += m.R[n] * x[n] * x[n];
    }
    double torque = rotor_torque(q, &m, t, x[W], x);
    double lost = friction_torque(shaft(q), mode[SHAFT], x[W], torque, 0, x[THETA], x[Z], &dx[Z]);
    dx[W] = (torque - lost) / q->J;
    dx[THETA] = x[W];
    dx[HEAT] = q->heat_tau > 0 ? (q->heat_k * copper - x[HEAT]) / q->heat_tau : 0;
}

static void guard(const double *p, const int *mode, double t, const double *in, const double *x, double *g)
{
    const parameters *q = (const parameters *)p;
    machine m = legs(q, mode, in, x);
    int floating = FLOAT_LEG[mode[SECTOR]];
    g[G_SHAFT] = friction_guard(shaft(q), mode[SHAFT], x[W], rotor_torque(q, &m, t, 0, x), 0, x[THETA]);
    double into = fmod(sector_position(q, x) - mode[SECTOR] + 9, 6) - 3; /* 0..1 within the sector */
    g[G_SECTOR_LOW] = into;
    g[G_SECTOR_HIGH] = 1 - into > 0 ? 1 - into : -1;
    if (mode[FLOATING] == OPEN) {
        double v = neutral(&m, x) + m.e[floating];
        g[G_FLOATING] = fmin(v + q->V_d, in[0] + q->V_d - v) + 1e-9;
    } else {
        g[G_FLOATING] = mode[FLOATING] * x[floating];
    }
    g[G_DIRECTION] = in[1] * mode[DIRECTION];
}

static void set_floating(const parameters *q, const double *in, double *x, int *mode)
{
    int floating = FLOAT_LEG[mode[SECTOR]];
    if (fabs(x[floating]) > 1e-12) {
        mode[FLOATING] = x[floating] > 0 ? FROM_LOW : FROM_HIGH;
        return;
    }
    mode[FLOATING] = OPEN;
    machine m = legs(q, mode, in, x);
    double v = neutral(&m, x) + m.e[floating];
    if (v < -q->V_d - 1e-9) mode[FLOATING] = FROM_LOW;
    if (v > in[0] + q->V_d + 1e-9) mode[FLOATING] = FROM_HIGH;
}

/* A current that reached zero is put there, its rest shared by the other two. */
static void cut(double *x, int leg)
{
    double rest = x[leg] / 2;
    for (int n = 0; n < 3; n++) x[n] = n == leg ? 0 : x[n] + rest;
}

static void change(const double *p, const double *g, double t, const double *in, double *x, int *mode)
{
    const parameters *q = (const parameters *)p;
    if (g[G_SECTOR_LOW] < 0 || g[G_SECTOR_HIGH] < 0) mode[SECTOR] = (mode[SECTOR] + (g[G_SECTOR_HIGH] < 0 ? 1 : 5)) % 6;
    if (g[G_DIRECTION] < 0) mode[DIRECTION] = in[1] > 0 ? 1 : -1;
    if (g[G_FLOATING] < 0 && mode[FLOATING] != OPEN) cut(x, FLOAT_LEG[mode[SECTOR]]);
    set_floating(q, in, x, mode);
    if (g[G_SHAFT] < 0) {
        x[W] = 0;
        machine m = legs(q, mode, in, x);
        mode[SHAFT] = friction_change(shaft(q), rotor_torque(q, &m, t, 0, x), 0, x[THETA]);
    }
}

static void output(const double *p, const int *mode, double t, const double *in, const double *x, double *y)
{
    (void)p, (void)mode, (void)t, (void)in;
    y[0] = x[IA];
    y[1] = x[IB];
    y[2] = x[IC];
    y[3] = x[THETA];
    y[4] = x[W];
}

#define NAME(name) #name " "
const bench bldc = {PARAMETERS(NAME), STATES, MODES, GUARDS, 5, start, derivative, guard, change, output};
