// section: 12.9
// value: same = true, inside = true
model RandomNumbers64
  function xorshift
    input Integer stateIn[2];
    output Real result;
    output Integer stateOut[2];
  external "C" ModelicaRandom_xorshift64star(stateIn, stateOut, result);
  end xorshift;
  parameter Integer seed[2] = {1, 2};
  discrete Integer state[2](start=seed, each fixed=true);
  discrete Real r(start=0, fixed=true);
  Boolean same = abs(r - second) < 1e-15, inside = r > 0 and r <= 1;
  constant Real second = again({1, 2});
  function again
    input Integer state[2];
    output Real y;
  protected
    Integer s[2];
  algorithm
    (y, s) := xorshift(state);
    (y, s) := xorshift(s);
  end again;
equation
  when {time > 0.2, time > 0.4} then
    (r, state) = xorshift(pre(state));
  end when;
end RandomNumbers64;
