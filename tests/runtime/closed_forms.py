"""Small hybrid models whose trajectories are known in closed form, as functions of their parameters.

Each closed form is analytic between its events, so that its exact derivative is a complex step (J. N. Lyness,
C. B. Moler, SIAM J. Numer. Anal. 4 (1967) 202-210): branches are taken by the real part.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

STEP = 1e-30


@dataclass(frozen=True)
class ClosedForm:
    name: str
    text: str  # of the model
    stop: float
    parameters: dict[str, float]  # values, those to be differentiated by
    outputs: Mapping[str, Callable[..., np.ndarray]]  # name -> f(t, **parameters)
    instants: Callable[..., list]  # of events that change anything, from the parameters
    states: dict[str, str] = field(default_factory=dict)  # parameter of the closed form -> state whose start it is

    def derivative(self, output: str, parameter: str, t: np.ndarray) -> np.ndarray:
        moved = {**self.parameters, parameter: self.parameters[parameter] + 1j * STEP}
        return np.imag(self.outputs[output](t.astype(complex), **moved)) / STEP


def _bounces(t, e, g, h0, v0):
    """Height after any number of bounces: each flight is a parabola from the ground."""
    fall = (v0 + np.sqrt(v0 * v0 + 2 * g * h0)) / g
    speed, start = g * fall - v0, fall
    height = h0 + v0 * t - g * t * t / 2
    for _ in range(12):
        speed = e * speed
        height = np.where(t.real > np.real(start), speed * (t - start) - g * (t - start) ** 2 / 2, height)
        start = start + 2 * speed / g
    return height


def _ball_instants(e, g, h0, v0):
    fall = (v0 + np.sqrt(v0 * v0 + 2 * g * h0)) / g
    speed, found = g * fall - v0, [fall]
    for _ in range(12):
        speed *= e
        found.append(found[-1] + 2 * speed / g)
    return found


BALL = ClosedForm(
    "n bounces, a parameter in the reset",
    """model Ball
  parameter Real e = 0.8;
  parameter Real g = 9.81;
  parameter Real h0 = 1;
  Real h(start = h0, fixed = true);
  Real v(start = 0, fixed = true);
equation
  der(h) = v;
  der(v) = -g;
  when h < 0 then
    reinit(v, -e*pre(v));
  end when;
end Ball;""",
    2.5, {"e": 0.8, "g": 9.81, "h0": 1.0, "v0": 0.0}, {"h": _bounces}, _ball_instants, {"v0": "v"},
)  # fmt: skip


def _slide(t, m, mu, F, v0):
    """Coasts to rest against dry friction; from t = 1 on a force F t pulls until it overcomes 1.5 mu, and it slides."""
    rest, slip = v0 * m / mu, 1 + 1.5 * mu / F
    x = np.where(t.real < np.real(rest), v0 * t - mu / m * t * t / 2, v0 * rest - mu / m * rest * rest / 2)
    s = t - slip
    pull = F * (slip - 1) - mu
    return np.where(s.real > 0, x + (pull * s * s / 2 + F * s**3 / 6) / m, x)


STICK_SLIP = ClosedForm(
    "stick and slip, Boolean-frozen branches",
    """model Slide
  parameter Real m = 2;
  parameter Real mu = 3;
  parameter Real F = 4;
  parameter Real v0 = 1;
  Real x(start = 0, fixed = true);
  Real v(start = v0, fixed = true);
  Real pull = if time > 1 then F*(time - 1) else 0;
  Boolean stuck(start = false, fixed = true);
equation
  der(x) = v;
  m*der(v) = if stuck then 0 else pull - mu;
  when not pre(stuck) and v < 0 then
    stuck = true;
    reinit(v, 0);
  elsewhen pre(stuck) and pull > 1.5*mu then
    stuck = false;
  end when;
end Slide;""",
    3.0, {"m": 2.0, "mu": 3.0, "F": 4.0, "v0": 1.0}, {"x": _slide},
    lambda m, mu, F, v0: [v0 * m / mu, 1 + 1.5 * mu / F],
)  # fmt: skip


def _ramp(t, a, b, T, k):
    """Rises with slope 1; falls with slope -k after it has met the moving threshold a + b t, and stops at T."""
    meet = a / (1 - b)
    x = np.where(t.real < np.real(meet), t, meet - k * (t - meet))
    return np.where(t.real < np.real(T), x, meet - k * (T - meet))


MOVING = ClosedForm(
    "a guard that moves, a time event whose instant is a parameter",
    """model Moving
  parameter Real a = 0.6;
  parameter Real b = 0.25;
  parameter Real T = 1.7;
  parameter Real k = 0.5;
  Real x(start = 0, fixed = true);
  Boolean met(start = false, fixed = true);
equation
  der(x) = if time > T then 0 elseif met then -k else 1;
  when x > a + b*time then
    met = true;
  end when;
end Moving;""",
    2.0, {"a": 0.6, "b": 0.25, "T": 1.7, "k": 0.5}, {"x": _ramp}, lambda a, b, T, k: [a / (1 - b), T],
)  # fmt: skip


def _sampled(t, Ts, K, x0):
    """x' = u, u = -K x at the samples 0, Ts, 2 Ts ... and held between them."""
    x, value = x0 + 0 * t, x0
    for n in range(60):
        x = np.where(t.real >= np.real(n * Ts), value * (1 - K * (t - n * Ts)), x)
        value = value * (1 - K * Ts)
    return x


def _held(t, Ts, K, x0):
    u = 0 * t
    for n in range(60):
        u = np.where(t.real >= np.real(n * Ts), -K * x0 * (1 - K * Ts) ** n, u)
    return u


SAMPLED = ClosedForm(
    "a sampled controller: discrete variables, an interval that is a parameter",
    """model Sampled
  parameter Real Ts = 0.13;
  parameter Real K = 2;
  parameter Real x0 = 1.5;
  Real x(start = x0, fixed = true);
  discrete Real u(start = 0, fixed = true);
equation
  der(x) = u;
  when sample(0, Ts) then
    u = -K*x;
  end when;
end Sampled;""",
    2.0, {"Ts": 0.13, "K": 2.0, "x0": 1.5}, {"x": _sampled, "u": _held},
    lambda Ts, K, x0: [n * Ts for n in range(1, 60)],
)  # fmt: skip


def _start_stop(t, c, d):
    """The relation time > c holds from the start on, x reaches d at the stop: nothing but x = c t + 1."""
    return c * t + 1 + 0 * d


START_STOP = ClosedForm(
    "events at start and stop",
    """model StartStop
  parameter Real c = 2;
  parameter Real d = 5;
  Real x(start = 1, fixed = true);
  discrete Real seen(start = 0, fixed = true);
equation
  der(x) = if time > 0 then c else -c;
  when x >= d then
    seen = c*time;
  end when;
end StartStop;""",
    2.0, {"c": 2.0, "d": 5.0}, {"x": _start_stop}, lambda c, d: [],
)  # fmt: skip


def _initial(t, a, q):
    return (a * a + np.sqrt(q)) * np.exp(-t)


INITIAL = ClosedForm(
    "parameters that only enter initial equations, solved for the states",
    """model Initial
  parameter Real a = 1.5;
  parameter Real q = 2;
  Real x;
  Real y(start = 1);
initial equation
  x - y = a*a;
  y*y*y + 0*x = q*sqrt(q);
equation
  der(x) = -x;
  der(y) = 0;
end Initial;""",
    1.0, {"a": 1.5, "q": 2.0}, {"x": _initial}, lambda a, q: [],
)  # fmt: skip

ALL = (BALL, STICK_SLIP, MOVING, SAMPLED, START_STOP, INITIAL)
